// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A detection beside the true faces of a cloud: points, faces, and pairs of them.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_TRUTH_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_TRUTH_H

#include "evaluate.h"

#include <utility>

namespace CGAL::Tandem::benchmark {

struct Truth {
  std::vector<std::int32_t> label; // per point: its face, -1 for none
  std::vector<Plane> faces;
};

struct Truth_criteria {
  std::size_t faces = 0;           // with enough points to count
  double top_10_faces = 0;         // ratio of the points on the ten largest
  double point_precision = 0;      // ratio of the assigned points that lie on the main face of their shape
  std::size_t shapes_matched = 0;  // a shape and a face match where intersection / union is above one half
  double face_f1 = 0;              // of these matches
  double angle_error_deg = 0;      // mean over the matched shapes
  std::size_t pairs = 0;           // of matched shapes
  std::size_t false_parallels = 0; // of these: are parallel within 1e-6, although their faces are not
};

// How many points each shape shares with each face; column `faces` is no face.
class Overlap {
public:
  Overlap(const Truth& truth, const Detection& detection)
    : shapes(detection.planes.size()), faces(truth.faces.size()), shape_size(shape_sizes(detection)),
      face_size(faces + 1, 0), main_face(shapes, faces), common_(shapes * (faces + 1), 0)
  {
    for(std::size_t i = 0; i < truth.label.size(); ++i) {
      std::size_t f = face_of(truth.label[i]);
      ++face_size[f];
      if(detection.label[i] >= 0)
        ++common_[std::size_t(detection.label[i]) * (faces + 1) + f];
    }
    for(std::size_t s = 0; s < shapes; ++s)
      for(std::size_t f = 0; f < faces; ++f)
        if(common(s, f) > (main_face[s] == faces ? 0 : common(s, main_face[s])))
          main_face[s] = f;
  }

  std::size_t common(std::size_t s, std::size_t f) const { return common_[s * (faces + 1) + f]; }

  double intersection_over_union(std::size_t s, std::size_t f) const
  {
    std::size_t both = common(s, f);
    return both == 0 ? 0 : double(both) / double(shape_size[s] + face_size[f] - both);
  }

  // (shape, face) with an intersection over union of more than one half: unique, so "more" matters.
  std::vector<std::pair<std::size_t, std::size_t>> matches() const
  {
    std::vector<std::pair<std::size_t, std::size_t>> result;
    for(std::size_t s = 0; s < shapes; ++s)
      if(main_face[s] != faces && intersection_over_union(s, main_face[s]) > 0.5)
        result.emplace_back(s, main_face[s]);
    return result;
  }

  std::size_t shapes, faces;
  std::vector<std::size_t> shape_size, face_size, main_face; // main_face == faces: none

private:
  std::size_t face_of(std::int32_t label) const
  {
    return label >= 0 && std::size_t(label) < faces ? std::size_t(label) : faces;
  }

  std::vector<std::size_t> common_;
};

inline double ratio(double a, double b) { return b > 0 ? a / b : 0; }

inline double point_precision(const Overlap& overlap)
{
  std::size_t assigned = 0, right = 0;
  for(std::size_t s = 0; s < overlap.shapes; ++s) {
    assigned += overlap.shape_size[s];
    right += overlap.main_face[s] == overlap.faces ? 0 : overlap.common(s, overlap.main_face[s]);
  }
  return ratio(double(right), double(assigned));
}

// Faces with fewer than `smallest_face` points need not be found.
inline Truth_criteria evaluate_truth(const Truth& truth, const Detection& detection, const Extent& extent,
                                     std::size_t smallest_face)
{
  if(truth.label.size() != detection.label.size())
    throw std::runtime_error(std::to_string(truth.label.size()) + " true labels for " +
                             std::to_string(detection.label.size()) + " labels");
  const Overlap overlap(truth, detection);
  Truth_criteria criteria;
  for(std::size_t f = 0; f < overlap.faces; ++f)
    criteria.faces += overlap.face_size[f] >= smallest_face;
  criteria.top_10_faces =
    Size_curve({overlap.face_size.begin(), overlap.face_size.end() - 1}, truth.label.size()).top(10);
  criteria.point_precision = point_precision(overlap);
  const Plane_relations true_relations(truth.faces, extent.diagonal, extent.center),
    relations(detection.planes, extent.diagonal, extent.center);
  const auto matches = overlap.matches();
  std::size_t found = 0;
  double angles = 0;
  for(std::size_t i = 0; i < matches.size(); ++i) {
    const auto [s, f] = matches[i];
    found += overlap.face_size[f] >= smallest_face;
    const Vec &a = detection.planes[s].normal, &b = truth.faces[f].normal;
    angles += std::atan2(length(cross(a, b)), std::abs(dot(a, b))) * 57.29577951308232;
    for(std::size_t j = 0; j < i; ++j) {
      ++criteria.pairs;
      criteria.false_parallels +=
        relations.are_parallel(s, matches[j].first) && !true_relations.are_parallel(f, matches[j].second);
    }
  }
  criteria.shapes_matched = matches.size();
  criteria.angle_error_deg = ratio(angles, double(matches.size()));
  // A shape that matches a face too small to count is neither right nor wrong for recall, but right for precision.
  const double precision = ratio(double(matches.size()), double(overlap.shapes)),
               recall = ratio(double(found), double(criteria.faces));
  criteria.face_f1 = ratio(2 * precision * recall, precision + recall);
  return criteria;
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_TRUTH_H
