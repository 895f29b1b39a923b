// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes that meet at a line end at the same vertices of it.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_COMMON_ENDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_COMMON_ENDS_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Straight_border.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// An end of a piece: of its two ends, the one that `side` says.
struct Piece_end {
  Border_piece* piece;
  std::size_t shape;
  int side;

  Border_piece::End& end() const { return piece->ends[side]; }
};

// The ends of a line to one side, in its direction. Ends at corners stay. Others that are close to one move there, and
// the rest become the mean of those that are close to each other. An end moves by at most the reach of its piece.
class Common_ends {
public:
  explicit Common_ends(std::vector<Piece_end> ends) : ends(std::move(ends))
  {
    std::stable_sort(this->ends.begin(), this->ends.end(),
                     [](const Piece_end& a, const Piece_end& b) { return a.end().along < b.end().along; });
  }

  void join()
  {
    for(const Piece_end& e : ends)
      if(e.end().third < 0)
        move_to_corner(e);
    std::vector<Piece_end> cluster;
    for(const Piece_end& e : ends) {
      if(e.end().third >= 0)
        continue;
      if(!cluster.empty() && !belongs(e, cluster))
        move_to_mean(cluster);
      cluster.push_back(e);
    }
    move_to_mean(cluster);
  }

private:
  static void move(const Piece_end& e, double along, int third)
  {
    const Border_piece::End before = e.end();
    e.end().along = along;
    e.end().third = third;
    if(!(e.piece->length() > e.piece->spacing))
      e.end() = before;
  }

  // The third plane of an end is neither of its own two: it can be that of another shape's end.
  void move_to_corner(const Piece_end& e) const
  {
    const Piece_end* nearest = nullptr;
    const auto distance = [&](const Piece_end& other) { return std::fabs(other.end().along - e.end().along); };
    for(const Piece_end& other : ends)
      if(other.end().third >= 0 && other.shape != e.shape &&
         (nearest == nullptr || distance(other) < distance(*nearest)))
        nearest = &other;
    if(nearest != nullptr && distance(*nearest) <= e.piece->reach)
      move(e, nearest->end().along, nearest->end().third);
  }

  static bool belongs(const Piece_end& e, const std::vector<Piece_end>& cluster)
  {
    const auto is_own = [&](const Piece_end& other) { return other.shape == e.shape; };
    const double span = e.end().along - cluster.front().end().along;
    return span <= (std::min)(e.piece->reach, cluster.front().piece->reach) &&
           std::none_of(cluster.begin(), cluster.end(), is_own);
  }

  static void move_to_mean(std::vector<Piece_end>& cluster)
  {
    double sum = 0;
    for(const Piece_end& e : cluster)
      sum += e.end().along;
    const double mean = sum / double(cluster.size());
    if(cluster.size() > 1)
      for(const Piece_end& e : cluster)
        move(e, mean, -1);
    cluster.clear();
  }

  std::vector<Piece_end> ends;
};

// `all` has the pieces of each shape.
inline void join_common_ends(std::vector<Border_pieces>& all)
{
  std::map<std::pair<int, int>, std::vector<Piece_end>> of_line[2];
  for(std::size_t s = 0; s < all.size(); ++s)
    for(Border_piece& piece : all[s])
      for(int side : {0, 1})
        of_line[side][{piece.line.planes[0], piece.line.planes[1]}].push_back({&piece, s, side});
  for(auto& lines : of_line)
    for(auto& [line, ends] : lines)
      Common_ends(std::move(ends)).join();
}

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_COMMON_ENDS_H
