// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tests whether shapes accept the planes that the regularity step proposes, by their moments and by their points. See
// the manual, "Verification and Rollback". Only the table of accepted planes changes. Counting points is left to a
// callback, which is called a few times with all open cases:
//   verify(shapes, planes, counts)  adds to counts[k] the points of shapes[k] that fit its
//                                  local plane, but not planes[k]
//   verify.for_each(n, f, few)      f(i) for i in [0, n), in any order, in parallel unless n < few

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_VERIFIED_PLANES_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_VERIFIED_PLANES_H

#include <CGAL/Tandem/internal/regularity/Direction_index.h>
#include <CGAL/Tandem/internal/regularity/relations.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The largest number of misfits that a shape accepts: a share of its points, and a number of points.
struct Misfit_limit {
  double share, points;
};

// The shapes with the plane that each has accepted last, which is the local fit at first. A plane close to it needs no
// test, so a shape is rarely counted twice. All lengths are grid steps, all costs steps^2.
template <class Verify>
class Verified_planes {
public:
  Verified_planes(const Shape_fits& shapes, const Regularity_options& options, Verify& verify)
    : shapes(shapes), options(options), verify(verify)
  {
    accepted.resize(shapes.size());
    for(std::size_t i = 0; i < shapes.size(); ++i)
      accepted[i] = through_centroid(shapes[i], canonical(shapes[i].fit.normal));
  }

  // The executor of the regularity step.
  template <class F>
  void for_each(std::size_t n, F f, std::size_t few = 8192) const
  {
    verify.for_each(n, f, few);
  }

  // Whether a direction adds too much to the distances of the points. It takes moments only, so it costs no count.
  bool is_too_far(int shape, const Vector& n) const
  {
    const double allowed = tuning::verification::rms_share * options.maximum_distance;
    return added(shape, n) > allowed * allowed * shapes[shape].scatter.count;
  }

  // What a plane of this normal through the centroid adds to the sum of squared distances of the local fit.
  double added(int shape, const Vector& n) const
  {
    const Shape_fit& s = shapes[shape];
    return quadratic_form(s.scatter.matrix, n) - quadratic_form(s.scatter.matrix, s.fit.normal);
  }

  // Whether the plane is too far from the centroid, at any angle.
  bool is_shifted_too_far(int shape, const Regular_plane& plane) const
  {
    return std::fabs(dot(plane.normal, shapes[shape].scatter.centroid) - plane.offset) >
           tuning::verification::rms_share * options.maximum_distance;
  }

  // Tests candidates[k] against planes[k], with one call of the callback. Entry k of the result: whether it rejects the
  // plane. Accepted planes are stored. No shape may be there twice, since its accepted plane would be written twice.
  std::vector<char> test(const std::vector<int>& candidates, const Regular_planes& planes,
                         const Misfit_limit& limit = {tuning::verification::misfit_share, 1e300})
  {
    enum : char { still, rejected, open }; // only open cases are counted
    std::vector<char> verdict(candidates.size());
    for(std::size_t k = 0; k < candidates.size(); ++k) {
      const int i = candidates[k];
      const bool is_still = motion(i, planes[k]) <= tuning::verification::still_share * options.maximum_distance;
      verdict[k] = is_shifted_too_far(i, planes[k]) ? rejected : is_still ? still : open;
    }
    std::vector<int> selected;
    Regular_planes selected_planes;
    std::vector<std::size_t> position;
    selected.reserve(candidates.size());
    selected_planes.reserve(candidates.size());
    position.reserve(candidates.size());
    for(std::size_t k = 0; k < candidates.size(); ++k)
      if(verdict[k] == open) {
        selected.push_back(candidates[k]);
        selected_planes.push_back(planes[k]);
        position.push_back(k);
      }
    std::vector<std::int64_t> counts(selected.size(), 0);
    if(!selected.empty())
      verify(selected, selected_planes, counts);
    for(std::size_t a = 0; a < selected.size(); ++a) {
      const bool is_rejected = double(counts[a]) > maximum_misfits(shapes[selected[a]].scatter.count, limit);
      verdict[position[a]] = is_rejected ? rejected : still;
      if(!is_rejected)
        accepted[selected[a]] = selected_planes[a];
    }
    for(char& a : verdict)
      a = a == rejected;
    return verdict;
  }

private:
  // The largest number of misfits with which a shape of so many points accepts a plane.
  double maximum_misfits(double size, const Misfit_limit& limit) const
  {
    const double strips = (std::max)(options.points_of_strips, options.strip_share * size);
    const double spare = size >= options.minimum_size ? size - options.minimum_size : size;
    return (std::min)({limit.share * size, limit.points, strips, spare});
  }

  // A bound on the distance between the plane and the accepted one, within two standard deviations of the shape. They
  // are taken along its longest axis.
  double motion(int shape, const Regular_plane& plane) const
  {
    const Scatter& s = shapes[shape].scatter;
    const Regular_plane& old = accepted[shape];
    const double side = dot(plane.normal, old.normal) < 0 ? -1 : 1;
    const double shift =
      (dot(plane.normal, s.centroid) - plane.offset) - side * (dot(old.normal, s.centroid) - old.offset);
    const double sine = std::sqrt(Direction_index::squared_distance(plane.normal, old.normal));
    return std::fma(sine, tuning::verification::extent_deviations * std::sqrt(shapes[shape].fit.largest / s.count),
                    std::fabs(shift));
  }

  const Shape_fits& shapes;
  const Regularity_options& options;
  Verify& verify;
  Regular_planes accepted;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_VERIFIED_PLANES_H
