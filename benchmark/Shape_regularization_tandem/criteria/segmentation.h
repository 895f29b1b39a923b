// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels beside true labels, as EVOPS (Kornilova et al., 2022) compares them, by intersection over union (IoU).

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SEGMENTATION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SEGMENTATION_H

#include "table.h"

namespace CGAL::Tandem::benchmark {

// Ratios of shapes, or of faces, are 0 where there are none.
struct Segmentation {
  // A shape and a face match with an IoU of at least .75, and partly with at least .2.
  double precision = 0, recall = 0, f = 0;
  double mean_iou = 0;        // of the shapes that match
  double over_segmented = 0;  // ratio of the faces that several shapes match partly
  double under_segmented = 0; // ratio of the shapes that match several faces partly
};

// Faces with fewer points need not be found; a shape that matches one is right.
inline Segmentation evaluate_segmentation(const Truth& truth, const Detection& detection, std::size_t smallest_face)
{
  constexpr double full = 0.75, part = 0.2;
  const Overlap overlap(truth, detection);
  Segmentation result;
  std::vector<std::size_t> parts_of_shape(overlap.shapes, 0);
  double faces = 0, found = 0, right = 0;
  for(std::size_t f = 0; f < overlap.faces; ++f) {
    const bool counts = overlap.face_size[f] > 0 && overlap.face_size[f] >= smallest_face;
    std::size_t parts = 0;
    faces += counts;
    for(std::size_t s = 0; s < overlap.shapes; ++s) {
      const double iou = overlap.intersection_over_union(s, f);
      parts += iou >= part;
      parts_of_shape[s] += iou >= part;
      right += iou >= full;
      found += iou >= full && counts;
      result.mean_iou += iou >= full ? iou : 0;
    }
    result.over_segmented += counts && parts > 1;
  }
  const double shapes = double(overlap.shapes);
  result.mean_iou = ratio(result.mean_iou, right);
  result.precision = ratio(right, shapes);
  result.recall = ratio(found, faces);
  result.f = ratio(2 * result.precision * result.recall, result.precision + result.recall);
  result.over_segmented = ratio(result.over_segmented, faces);
  for(std::size_t parts : parts_of_shape)
    result.under_segmented += parts > 1;
  result.under_segmented = ratio(result.under_segmented, shapes);
  return result;
}

// What a face keeps is the ratio of its points in the largest shape of which it is the main face.
struct Kept_faces {
  double worst = 1, all = 0; // of the faces; the ratio of the points of all faces

  // Whether each face has a shape of its own.
  bool is_right() const { return worst >= 0.9; }
};

inline Kept_faces evaluate_kept(const Truth& truth, const Detection& detection)
{
  const Overlap overlap(truth, detection);
  Kept_faces result;
  double points = 0;
  for(std::size_t f = 0; f < overlap.faces; ++f) {
    std::size_t most = 0;
    for(std::size_t s = 0; s < overlap.shapes; ++s)
      if(overlap.main_face[s] == f)
        most = (std::max)(most, overlap.common(s, f));
    result.all += double(most);
    points += double(overlap.face_size[f]);
    result.worst = (std::min)(result.worst, ratio(double(most), double(overlap.face_size[f])));
  }
  result.all = ratio(result.all, points);
  return result;
}

// Empty where the truth is not known, so that all rows have the same columns.
inline void append_segmentation(Row& row, bool is_known, const Segmentation& s, const Kept_faces& kept)
{
  append_cell_if(row, is_known, "segmentation_precision", s.precision);
  append_cell_if(row, is_known, "segmentation_recall", s.recall);
  append_cell_if(row, is_known, "segmentation_f", s.f);
  append_cell_if(row, is_known, "mean_iou", s.mean_iou);
  append_cell_if(row, is_known, "over_segmented", s.over_segmented);
  append_cell_if(row, is_known, "under_segmented", s.under_segmented);
  append_cell_if(row, is_known, "all_faces_kept", int(kept.is_right()));
  append_cell_if(row, is_known, "worst_face_kept", kept.worst);
  append_cell_if(row, is_known, "mean_kept", kept.all);
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SEGMENTATION_H
