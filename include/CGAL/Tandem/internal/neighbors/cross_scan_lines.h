// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Neighbors across scan lines. Many sensors sample on lines, which are much farther apart than the points of a line.
// There the k nearest surfels of a surfel are on its own line: they tell nothing of the surface across it, and no shape
// grows from one line to the next. Such a surfel gets half of its neighbors from thinned clouds: the first surfel of each
// octant, of the two smallest levels of octants where neighborhoods have a width. Changes rows of the neighbor graph. See
// the manual, "Scan Lines".

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_CROSS_SCAN_LINES_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_CROSS_SCAN_LINES_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/base/keys.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/cloud/sort_along_curve.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>
#include <CGAL/Tandem/internal/neighbors/grow_neighborhoods.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Which neighborhoods are lines.

// Whether a neighborhood is narrow.
CGAL_TANDEM_HD inline bool is_line(const Neighborhood& h)
{
  const covariance::Matrix c = covariance::cofactors({h.xx, h.xy, h.xz, h.yy, h.yz, h.zz});
  // Of the variances a >= b >= c: their sum, and a b + b c + c a. So b / a is about product / sum^2.
  const double sum = double(h.xx) + h.yy + h.zz, product = double(c.xx) + c.yy + c.zz;
  return !(product > tuning::scan_lines::width2_of_length2 * sum * sum);
}

// Thinned clouds from which a surfel gets neighbors. With one, lines at uneven distances are not connected: those of a pair
// have a width by themselves.
constexpr std::uint8_t needed_levels = 2;

// Counts the lines among the rows of a sample, by position in the cloud of all ranks.
struct Count_lines {
  Cloud_view cloud;

  CGAL_TANDEM_HD void operator()(std::size_t sampled, std::int64_t* sum) const
  {
    constexpr std::uint32_t stride = tuning::scan_lines::surfels_per_sampled;
    const std::uint32_t i = std::uint32_t(sampled) * stride + (stride - cloud.first % stride) % stride;
    if(i >= cloud.size)
      return;
    ++sum[0];
    sum[1] += is_line(nearest_neighborhood(cloud, i, used_neighbors(cloud.k)));
  }
};

// The direction of a line: the longest column of its covariance.
CGAL_TANDEM_HD inline std::uint32_t line_direction(const Neighborhood& h)
{
  if(h.xx >= h.yy && h.xx >= h.zz)
    return encode_normal({h.xx, h.xy, h.xz});
  return h.yy >= h.zz ? encode_normal({h.xy, h.yy, h.yz}) : encode_normal({h.xz, h.yz, h.zz});
}

// Whether lines run along each other, within 45 degrees.
CGAL_TANDEM_HD inline bool are_along(std::uint32_t a, std::uint32_t b)
{
  const Int_vector u = decode_normal(a), v = decode_normal(b);
  return 2 * int_product(u, v) * int_product(u, v) > int_product(u, u) * int_product(v, v);
}

// By surfel: how many thinned clouds it needs neighbors of, and the direction of its row if that is a line; no_normal for
// others.
struct Mark_lines {
  Cloud_view cloud;
  std::uint8_t* needed;
  std::uint32_t* direction;

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint32_t i = std::uint32_t(at);
    const Neighborhood h = nearest_neighborhood(cloud, i, used_neighbors(cloud.k));
    needed[i] = is_line(h) ? needed_levels : 0;
    direction[i] = needed[i] > 0 ? line_direction(h) : no_normal;
  }
};

// Where a line turns, a row has a width, but shows nothing of the surface across the line. So a row is a line, too, if
// a third of its surfels have rows that are lines. Its direction is that of the nearest one. Reads the directions of
// before.
struct Mark_corners {
  Cloud_view cloud;
  const std::uint32_t* before;
  std::uint8_t* needed;
  std::uint32_t* direction;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    direction[i] = before[i];
    const std::uint32_t* const row = cloud.row(std::uint32_t(i));
    int lines = 0, size = 0;
    std::uint32_t nearest = no_normal;
    for(; size < used_neighbors(cloud.k) && row[size] != no_index; ++size)
      if(const std::uint32_t d = before[row[size]]; d != no_normal) {
        ++lines;
        if(nearest == no_normal)
          nearest = d;
      }
    if(needed[i] > 0 || lines == 0 || lines * tuning::scan_lines::neighbors_per_line < size)
      return;
    needed[i] = needed_levels;
    direction[i] = nearest;
  }
};

struct Count_in_need {
  const std::uint8_t* needed;

  CGAL_TANDEM_HD void operator()(std::size_t i, std::int64_t* sum) const { sum[0] += needed[i] > 0; }
};

// --- The thinned cloud.

struct Mark_first {
  const Range* cell;
  std::uint8_t* is_first;

  CGAL_TANDEM_HD void operator()(std::size_t c) const { is_first[cell[c].first] = 1; }
};

// The first surfels of octants along the curve. An octant ends with the cell, so that it is on one rank. Surfel 0 is the
// first one of a cell.
struct Begins_octant {
  const Grid_point* point;
  const std::uint8_t* is_first_of_cell;
  Code_frame frame;
  int level; // of the octants

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const
  {
    return is_first_of_cell[i] != 0 || !frame.share_octant(point[i - 1], point[i], level);
  }
};

// A surfel of any rank, by its number there.
struct Write_number {
  const std::uint32_t* surfel;
  std::uint64_t first; // number of the first one of this rank
  std::uint64_t* number;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { number[i] = first + surfel[i]; }
};

// With the tables of its points by place; ghosts have the latter, too.
struct Thinned_view {
  Cloud_view cloud;
  const std::uint32_t* surfel;    // that it is: its place
  const std::uint32_t* direction; // of its line

  // The place of the octant of a surfel.
  CGAL_TANDEM_HD std::uint32_t place_of(std::uint32_t s) const
  {
    return partition_point(0, cloud.size, [&](std::uint32_t i) { return surfel[i] <= s; }) - 1;
  }
};

// Marks the points of a thinned cloud whose rows are wide. Only neighbors count whose own lines run along that of the
// point: where a line turns a corner, it has a width, but it does not show the surface across it.
struct Mark_wide {
  Thinned_view thinned;
  std::uint8_t* is_wide;

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint32_t i = std::uint32_t(at), own = thinned.direction[i];
    const Cloud_view& of = thinned.cloud;
    const std::uint32_t* const row = of.row(i);
    Neighborhood_sum sum;
    sum.add({0, 0, 0});
    for(int j = 0; j < used_neighbors(of.k) && row[j] != no_index; ++j) {
      const std::uint32_t other = thinned.direction[row[j]];
      if(own == no_normal || other == no_normal || are_along(own, other))
        sum.add(difference(of.point[row[j]], of.point[i]));
    }
    is_wide[i] = !is_line(sum.mean());
  }
};

// A surfel in need keeps its nearest neighbors, and gets the farther ones of the first surfel of its octant, if those are no
// line: the second half of its row, and then, from the next thinned cloud, the last quarter.
struct Cross_lines {
  Cloud_view cloud;
  Thinned_view thinned;
  const std::uint8_t* is_wide; // by place in the thinned cloud
  std::uint8_t* needed;
  std::uint32_t* neighbor;

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    if(needed[at] == 0)
      return;
    const std::uint32_t i = std::uint32_t(at), place = thinned.place_of(i);
    if(is_wide[place] == 0)
      return;
    const int used = used_neighbors(cloud.k), kept = needed[i] == needed_levels ? used / 2 : used - used / 4;
    --needed[i];
    std::uint32_t* const row = neighbor + at * std::size_t(cloud.k);
    const std::uint32_t* const farther = thinned.cloud.row(place);
    int size = 0;
    while(size < kept && row[size] != no_index)
      ++size;
    for(int j = used / 2; j < cloud.k && size < cloud.k && farther[j] != no_index; ++j) {
      const std::uint32_t s = thinned.surfel[farther[j]];
      bool is_new = s != i;
      for(int other = 0; other < size; ++other)
        is_new = is_new && row[other] != s;
      if(is_new)
        row[size++] = s;
    }
    for(; size < cloud.k; ++size)
      row[size] = no_index;
  }
};

// Sums the logarithms of the squared distances to the next line, over the surfels that got neighbors across their line. The
// bits of a double are its logarithm, but for a line between powers of two.
struct Sum_spacings {
  static constexpr int dropped_bits = 36; // so that a sum fits 64 bits

  Cloud_view cloud;
  const std::uint32_t* direction;
  const std::uint8_t* needed;

  CGAL_TANDEM_HD void operator()(std::size_t at, std::int64_t* sum) const
  {
    const std::uint32_t i = std::uint32_t(at);
    if(direction[i] == no_normal || needed[i] == needed_levels)
      return;
    // Neighbors on the line itself are near it, those on the next one at least a quarter as far as the farthest.
    double farthest = 0, nearest = 0;
    for(int pass = 0; pass < 2; ++pass)
      for_each_squared_distance(i, [&](double d) {
        if(pass == 0)
          nearest = farthest = d > farthest ? d : farthest;
        else if(16 * d >= farthest && d < nearest)
          nearest = d;
      });
    if(nearest > 0) {
      ++sum[0];
      sum[1] += std::int64_t(ordered_bits(nearest) >> dropped_bits);
    }
  }

  static double mean(std::int64_t sum, std::int64_t size)
  {
    return std::sqrt(from_ordered_bits(std::uint64_t(sum / size) << dropped_bits));
  }

private:
  // Of the neighbors from the line through surfel i.
  template <class F>
  CGAL_TANDEM_HD void for_each_squared_distance(std::uint32_t i, F f) const
  {
    const Int_vector d = decode_normal(direction[i]);
    const double length2 = double(int_product(d, d));
    const std::uint32_t* const row = cloud.row(i);
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const Float_vector v = difference(cloud.point[row[j]], cloud.point[i]);
      const float along = to_float(exact_dot(v, {to_float(d.x), to_float(d.y), to_float(d.z)}));
      f(exact_dot(v, v) - exact_product(along, along) / length2);
    }
  }
};

// Writes the rows of a cloud whose k is set. meanwhile() is called while a device searches.
template <class Backend, class Meanwhile = Nothing>
void find_rows(Backend& backend, Ranks<Backend>& ranks, Sorted_cloud<Backend>& cloud, int rings,
               Meanwhile meanwhile = Meanwhile())
{
  cloud.neighbor.reset(cloud.number_of_surfels() * std::size_t(cloud.k));
  find_neighbors(backend, cloud.point.data(), std::uint32_t(cloud.number_of_surfels()), cloud.k, cloud.neighbor.data());
  meanwhile();
  ranks.connect(cloud, rings);
}

// One level after the other, while there are lines left.
template <class Backend>
class Scan_line_crossing {
  template <class T>
  using Buffer = Buffer_of<Backend, T>;

public:
  Scan_line_crossing(Backend& backend, const Ranks<Backend>& ranks, Sorted_cloud<Backend>& cloud,
                     const Buffer<Range>& cells)
    : backend_(backend), ranks_(ranks), cloud_(cloud), view_(cloud.view()), needed_(view_.size),
      direction_(cloud.size_with_ghosts()), is_first_of_cell_(filled_buffer(backend, view_.size, std::uint8_t(0)))
  {
    Buffer<std::uint32_t> before(direction_.size());
    backend_.for_each(view_.size, Mark_lines{view_, needed_.data(), direction_.data()});
    for(int pass = 0; pass < 2; ++pass) {
      ranks_.refresh(direction_.data(), Rings::inner);
      std::swap(before, direction_);
      backend_.for_each(view_.size, Mark_corners{view_, before.data(), needed_.data(), direction_.data()});
    }
    backend_.for_each(cells.size(), Mark_first{cells.data(), is_first_of_cell_.data()});
  }

  // Returns the numbers of the surfels whose places in the rows follow those of the present ghosts.
  std::vector<std::uint64_t> operator()(const Code_frame& frame)
  {
    std::vector<std::uint64_t> added;
    std::size_t last = ranks_.total(view_.size);
    for(int level = 1; level < curve_bits && is_any_left(); ++level) {
      const auto surfel =
        backend_.compact(view_.size, Begins_octant{view_.point, is_first_of_cell_.data(), frame, level});
      const std::size_t size = ranks_.total(surfel.size());
      if(!tuning::scan_lines::thinned.is_exceeded(std::int64_t(size), std::int64_t(last))) {
        cross(surfel, added);
        last = size;
      }
    }
    return added;
  }

  // The mean distance to the next line, in steps, after the ranks have been connected again; 0 if no row is wide.
  double spacing_steps() const
  {
    const auto own =
      backend_.template sum<2>(view_.size, Sum_spacings{cloud_.view(), direction_.data(), needed_.data()});
    const std::vector<std::uint64_t> all =
      ranks_.total(std::vector<std::uint64_t>{std::uint64_t(own[0]), std::uint64_t(own[1])});
    return all[0] == 0 ? 0 : Sum_spacings::mean(std::int64_t(all[1]), std::int64_t(all[0]));
  }

private:
  bool is_any_left() const
  {
    return ranks_.total(std::size_t(backend_.template sum<1>(view_.size, Count_in_need{needed_.data()})[0])) > 0;
  }

  void cross(const Buffer<std::uint32_t>& surfel, std::vector<std::uint64_t>& added)
  {
    const std::size_t n = surfel.size();
    Sorted_cloud<Backend> thinned;
    thinned.k = view_.k;
    thinned.point.reset(n);
    backend_.for_each(n, Gather_items<Grid_point>{view_.point, surfel.data(), thinned.point.data()});
    Ranks<Backend> ranks(backend_);
    find_rows(backend_, ranks, thinned, 1);
    Buffer<std::uint32_t> direction(thinned.size_with_ghosts());
    backend_.for_each(n, Gather_items<std::uint32_t>{direction_.data(), surfel.data(), direction.data()});
    ranks.refresh(direction.data(), Rings::inner);
    const Buffer<std::uint32_t> with_ghosts = places(ranks, surfel, thinned.ghosts, added);
    const Thinned_view view = {thinned.view(), with_ghosts.data(), direction.data()};
    Buffer<std::uint8_t> is_wide(n);
    backend_.for_each(n, Mark_wide{view, is_wide.data()});
    backend_.for_each(view_.size, Cross_lines{view_, view, is_wide.data(), needed_.data(), cloud_.neighbor.data()});
  }

  // The places of the surfels of a thinned cloud, and of its ghosts. Ghosts that have none so far are added.
  Buffer<std::uint32_t> places(const Ranks<Backend>& ranks, const Buffer<std::uint32_t>& surfel, std::size_t ghosts,
                               std::vector<std::uint64_t>& added)
  {
    const std::size_t n = surfel.size();
    Buffer<std::uint32_t> place = extended<std::uint32_t>(backend_, surfel, n + ghosts);
    if constexpr(Ranks<Backend>::are_many) {
      Buffer<std::uint64_t> number(n + ghosts);
      backend_.for_each(n, Write_number{surfel.data(), ranks_.number(0), number.data()});
      ranks.refresh(number.data(), Rings::inner);
      std::vector<std::uint32_t> of_ghosts;
      for(const std::uint64_t ghost : to_vector(backend_, number.data() + n, ghosts)) {
        of_ghosts.push_back(ranks_.place_of(ghost));
        if(of_ghosts.back() != no_index)
          continue;
        const auto next = std::uint32_t(cloud_.size_with_ghosts() + added.size());
        const auto [known, is_new] = place_of_added_.emplace(ghost, next);
        of_ghosts.back() = known->second;
        if(is_new)
          added.push_back(ghost);
      }
      write_to(backend_, of_ghosts, place.data() + n);
    }
    return place;
  }

  Backend& backend_;
  const Ranks<Backend>& ranks_;
  Sorted_cloud<Backend>& cloud_;
  Cloud_view view_;
  Buffer<std::uint8_t> needed_; // by surfel: thinned clouds
  Buffer<std::uint32_t> direction_;
  Buffer<std::uint8_t> is_first_of_cell_;
  std::map<std::uint64_t, std::uint32_t> place_of_added_; // by number
};

// Whether there are scan lines is decided for the whole cloud; not with few neighbors, which are lines by chance. The rows
// are complete.
template <class Backend>
void cross_scan_lines(Backend& backend, Ranks<Backend>& ranks, Sorted_cloud<Backend>& cloud,
                      const Buffer_of<Backend, Range>& cells, const Code_frame& frame)
{
  const Cloud_view view = cloud.view();
  if(view.k < tuning::scan_lines::minimum_neighbors)
    return;
  const auto own = backend.template sum<2>(view.size / tuning::scan_lines::surfels_per_sampled + 1, Count_lines{view});
  const std::size_t sampled = ranks.total(std::size_t(own[0])), lines = ranks.total(std::size_t(own[1]));
  if(!tuning::scan_lines::of_cloud.is_exceeded(std::int64_t(lines), std::int64_t(sampled)))
    return;
  Scan_line_crossing<Backend> crossing(backend, ranks, cloud, cells);
  ranks.connect_again(cloud, crossing(frame));
  cloud.line_spacing_steps = crossing.spacing_steps();
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_CROSS_SCAN_LINES_H
