// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels beside true labels, as EVOPS (Kornilova et al., 2022) compares them, by intersection over union (IoU).

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SEGMENTATION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SEGMENTATION_H

#include "table.h"

namespace CGAL::Tandem::benchmark {

// Shares of shapes, or of faces, are 0 where there are none.
struct Segmentation {
  std::size_t shapes = 0, faces = 0; // faces with enough points to count

  // A shape and a face match with an IoU of at least .75, and partly with at least .2.
  double precision = 0, recall = 0, f = 0;
  double mean_iou = 0;        // of the shapes that match
  double over_segmented = 0;  // share of the faces that several shapes match partly
  double under_segmented = 0; // share of the shapes that match several faces partly
};

class Segmentation_judge {
public:
  // Faces with fewer points need not be found; a shape that matches one is right.
  Segmentation_judge(const Overlap& overlap, std::size_t smallest_face) : o_(overlap)
  {
    for(std::size_t f = 0; f < o_.faces; ++f)
      counts_.push_back(o_.face_size[f] > 0 && o_.face_size[f] >= smallest_face);
    result_.shapes = o_.shapes;
    result_.faces = std::size_t(std::count(counts_.begin(), counts_.end(), true));
  }

  Segmentation operator()()
  {
    match();
    match_partly();
    return result_;
  }

private:
  static constexpr double full = 0.75, part = 0.2;

  double iou(std::size_t s, std::size_t f) const { return o_.intersection_over_union(s, f); }

  void match()
  {
    std::size_t found = 0, right = 0;
    for(std::size_t s = 0; s < o_.shapes; ++s)
      for(std::size_t f = 0; f < o_.faces; ++f)
        if(iou(s, f) >= full) {
          ++right;
          found += counts_[f];
          result_.mean_iou += iou(s, f);
        }
    result_.mean_iou = ratio(result_.mean_iou, double(right));
    result_.precision = ratio(double(right), double(o_.shapes));
    result_.recall = ratio(double(found), double(result_.faces));
    result_.f = ratio(2 * result_.precision * result_.recall, result_.precision + result_.recall);
  }

  void match_partly()
  {
    std::vector<std::size_t> faces(o_.shapes, 0), shapes(o_.faces, 0); // their partners
    for(std::size_t s = 0; s < o_.shapes; ++s)
      for(std::size_t f = 0; f < o_.faces; ++f)
        if(iou(s, f) >= part) {
          ++faces[s];
          ++shapes[f];
        }
    for(std::size_t s = 0; s < o_.shapes; ++s)
      result_.under_segmented += faces[s] > 1;
    for(std::size_t f = 0; f < o_.faces; ++f)
      result_.over_segmented += counts_[f] && shapes[f] > 1;
    result_.under_segmented = ratio(result_.under_segmented, double(o_.shapes));
    result_.over_segmented = ratio(result_.over_segmented, double(result_.faces));
  }

  const Overlap& o_;
  std::vector<bool> counts_; // by face
  Segmentation result_;
};

inline Segmentation evaluate_segmentation(const Truth& truth, const Detection& detection, std::size_t smallest_face)
{
  const Overlap overlap(truth, detection);
  return Segmentation_judge(overlap, smallest_face)();
}

// Empty where the truth is not known, so that all rows have the same columns.
inline void append_segmentation(Row& row, bool is_known, const Segmentation& s)
{
  append_cell_if(row, is_known, "segmentation_precision", s.precision);
  append_cell_if(row, is_known, "segmentation_recall", s.recall);
  append_cell_if(row, is_known, "segmentation_f", s.f);
  append_cell_if(row, is_known, "mean_iou", s.mean_iou);
  append_cell_if(row, is_known, "over_segmented", s.over_segmented);
  append_cell_if(row, is_known, "under_segmented", s.under_segmented);
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SEGMENTATION_H
