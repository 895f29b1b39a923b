// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A detection beside the true faces of a cloud: points, faces and relations.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_TRUTH_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_TRUTH_H

#include "evaluate.h"

#include <utility>

namespace CGAL {
namespace Tandem {
namespace benchmark {

struct Truth {
  std::vector<std::int32_t> label; // per point: its face, -1 for none
  std::vector<Plane> faces;
};

struct Face_score {
  std::size_t shapes_found = 0, faces_found = 0;
  double precision = 0, recall = 0, f1 = 0;
};

// Of the pairs of matched shapes whose faces have the relation: how many have it
// in the result; and how many pairs have it whose faces do not.
struct Pair_score {
  std::size_t true_pairs = 0, kept = 0, false_pairs = 0;

  double share() const { return true_pairs == 0 ? 1 : double(kept) / double(true_pairs); }
};

struct Relation_score {
  std::size_t pairs = 0; // of matched shapes
  Pair_score parallel, orthogonal, coplanar;
};

struct Truth_criteria {
  std::size_t faces = 0;           // with enough points to count
  double point_precision = 0;      // share of the assigned points that lie on the main face of their shape
  double point_recall = 0;         // share of all face points that are so assigned
  double false_points = 0;         // share of the assigned points that lie on no face
  Face_score at_50, at_75;         // matched where intersection / union is above .5, above .75
  double shapes_per_face = 0;      // of the faces found; 1 is right, more is over-segmentation
  std::size_t split_faces = 0;     // found as several shapes
  std::size_t swallowed_faces = 0; // half of the face is in a shape of another one
  double angle_error_deg = 0;      // mean over the matched shapes
  Relation_score exact, relaxed;
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

  // (shape, face) with more than this intersection over union: from one half on unique, so "more" matters.
  std::vector<std::pair<std::size_t, std::size_t>> matches(double bound) const
  {
    std::vector<std::pair<std::size_t, std::size_t>> result;
    for(std::size_t s = 0; s < shapes; ++s)
      if(main_face[s] != faces && intersection_over_union(s, main_face[s]) > bound)
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

// A shape that matches a face too small to count is neither right nor wrong for recall, but right for precision.
inline Face_score score_faces(const Overlap& overlap, double bound, std::size_t smallest_face, std::size_t faces)
{
  Face_score score;
  for(auto match : overlap.matches(bound)) {
    ++score.shapes_found;
    score.faces_found += overlap.face_size[match.second] >= smallest_face;
  }
  score.precision = ratio(double(score.shapes_found), double(overlap.shapes));
  score.recall = ratio(double(score.faces_found), double(faces));
  score.f1 = ratio(2 * score.precision * score.recall, score.precision + score.recall);
  return score;
}

inline void add_pair(Pair_score& score, bool is_true, bool is_made)
{
  score.true_pairs += is_true;
  score.kept += is_true && is_made;
  score.false_pairs += !is_true && is_made;
}

inline Relation_score score_relations(const Overlap& overlap, const Plane_relations& truth, const Plane_relations& made)
{
  Relation_score score;
  auto matches = overlap.matches(0.5);
  for(std::size_t i = 0; i < matches.size(); ++i)
    for(std::size_t j = 0; j < i; ++j) {
      std::size_t s = matches[i].first, t = matches[j].first, f = matches[i].second, g = matches[j].second;
      ++score.pairs;
      add_pair(score.parallel, truth.are_parallel(f, g), made.are_parallel(s, t));
      add_pair(score.orthogonal, truth.are_orthogonal(f, g), made.are_orthogonal(s, t));
      add_pair(score.coplanar, truth.are_coplanar(f, g), made.are_coplanar(s, t));
    }
  return score;
}

inline void score_points(const Overlap& overlap, Truth_criteria& criteria)
{
  std::size_t assigned = 0, right = 0, on_no_face = 0, on_faces = 0;
  for(std::size_t s = 0; s < overlap.shapes; ++s) {
    assigned += overlap.shape_size[s];
    on_no_face += overlap.common(s, overlap.faces);
    right += overlap.main_face[s] == overlap.faces ? 0 : overlap.common(s, overlap.main_face[s]);
  }
  for(std::size_t f = 0; f < overlap.faces; ++f)
    on_faces += overlap.face_size[f];
  criteria.point_precision = ratio(double(right), double(assigned));
  criteria.point_recall = ratio(double(right), double(on_faces));
  criteria.false_points = ratio(double(on_no_face), double(assigned));
}

inline void score_segmentation(const Overlap& overlap, std::size_t smallest_face, Truth_criteria& criteria)
{
  std::vector<std::size_t> parts(overlap.faces, 0);
  std::vector<bool> is_swallowed(overlap.faces, false);
  for(std::size_t s = 0; s < overlap.shapes; ++s) {
    std::size_t main = overlap.main_face[s];
    if(main != overlap.faces && 2 * overlap.common(s, main) >= overlap.shape_size[s])
      ++parts[main];
    for(std::size_t f = 0; f < overlap.faces; ++f)
      if(f != main && overlap.face_size[f] >= smallest_face && 2 * overlap.common(s, f) >= overlap.face_size[f])
        is_swallowed[f] = true;
  }
  std::size_t found = std::size_t(std::count_if(parts.begin(), parts.end(), [](std::size_t n) { return n > 0; }));
  criteria.shapes_per_face = ratio(double(std::accumulate(parts.begin(), parts.end(), std::size_t(0))), double(found));
  criteria.split_faces = std::size_t(std::count_if(parts.begin(), parts.end(), [](std::size_t n) { return n > 1; }));
  criteria.swallowed_faces = std::size_t(std::count(is_swallowed.begin(), is_swallowed.end(), true));
}

inline double mean_angle_error_deg(const Overlap& overlap, const Truth& truth, const Detection& detection)
{
  double sum = 0;
  auto matches = overlap.matches(0.5);
  for(auto match : matches) {
    const Vec &a = detection.planes[match.first].normal, &b = truth.faces[match.second].normal;
    sum += std::atan2(length(cross(a, b)), std::abs(dot(a, b))) * 57.29577951308232;
  }
  return ratio(sum, double(matches.size()));
}

// Faces with fewer than `smallest_face` points need not be found.
inline Truth_criteria evaluate_truth(const Truth& truth, const Detection& detection, const Extent& extent,
                                     std::size_t smallest_face)
{
  if(truth.label.size() != detection.label.size())
    throw std::runtime_error(std::to_string(truth.label.size()) + " true labels for " +
                             std::to_string(detection.label.size()) + " labels");
  Overlap overlap(truth, detection);
  Truth_criteria criteria;
  for(std::size_t f = 0; f < overlap.faces; ++f)
    criteria.faces += overlap.face_size[f] >= smallest_face;
  score_points(overlap, criteria);
  score_segmentation(overlap, smallest_face, criteria);
  criteria.at_50 = score_faces(overlap, 0.5, smallest_face, criteria.faces);
  criteria.at_75 = score_faces(overlap, 0.75, smallest_face, criteria.faces);
  criteria.angle_error_deg = mean_angle_error_deg(overlap, truth, detection);
  Relation_tolerance relaxed = relaxed_relations(extent.diagonal, extent.center);
  Plane_relations relations(truth.faces, relaxed);
  criteria.exact = score_relations(overlap, relations, Plane_relations(detection.planes, exact_relations()));
  criteria.relaxed = score_relations(overlap, relations, Plane_relations(detection.planes, relaxed));
  return criteria;
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_TRUTH_H
