// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last step that decides on single points: each is tested against the final plane of its shape. The test is in
// double, on the caller's coordinates and normals. It is filtered: integers accept all points that are not close to a
// bound. Changes labels, nothing else. In the loop, apply_planes() of shapes/update_shapes.h has detached most points
// that do not fit. See the manual, "Exact Check".

#ifndef CGAL_TANDEM_INTERNAL_RESULT_EXACT_CHECK_H
#define CGAL_TANDEM_INTERNAL_RESULT_EXACT_CHECK_H

#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The caller's values, in the order of the imported points.
struct Caller_view {
  Vectors_view coordinates;
  Vectors_view normals; // of any length; null where they were estimated
};

// Whether the filter fails for a labeled point. The reduced bounds cover the rounding of the point, of its normal and
// of the plane. So a point that fits within them passes the exact test, too.
struct Is_uncertain {
  Surfels_view points;
  const std::uint32_t* label;
  const Plane* plane; // by shape
  Tolerance certain;  // epsilon and alpha, less all rounding: see tuning::exactness

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const
  {
    return label[i] < first_mark && !fits(plane[label[i]], points.point[i], points.tolerance_of_point(i, certain));
  }
};

// What the host needs of a point to test it. The normal is the packed one, for clouds with estimated normals.
struct Uncertain_point {
  std::uint32_t shape, origin, normal, level; // origin: the imported point; level: of its tolerance
};

// Item i is the i-th uncertain point, at position place[i] of the sorted cloud.
struct Gather_uncertain {
  Surfels_view points;
  const std::uint32_t* label;
  const std::uint32_t* origin;
  const std::uint32_t* place;
  Uncertain_point* uncertain;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    uncertain[i] = {label[place[i]], origin[place[i]], points.point[place[i]].normal, points.level_of_point(place[i])};
  }
};

// Points that fail lose their label, and no plane is fitted afterwards.
struct Lock_rejected {
  const std::uint32_t* place;
  const std::uint8_t* is_rejected;
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(is_rejected[i])
      label[place[i]] = locked_label;
  }
};

// The test itself. It runs on the host, because the caller's coordinates and normals are there.
struct Check_exactly {
  Caller_view caller;
  const Coefficients* plane; // by shape
  Exact_bounds bounds;

  bool is_within(const Uncertain_point& u) const
  {
    // An estimated normal is what the result reports for the point: its packed value.
    const Vector normal =
      caller.normals.data != nullptr ? normalized(caller.normals[u.origin]) : unpacked_normal(u.normal);
    return bounds.is_near(plane[u.shape], caller.coordinates[u.origin], std::uint8_t(u.level)) &&
           bounds.is_aligned(plane[u.shape], normal);
  }
};

// The points that are tested, in the order of the sorted cloud. The labels are those of the extraction, so a test
// between two rounds changes no label of the loop.
struct Points_to_check {
  Surfels_view of_surfels;
  const std::uint32_t* origin; // the imported points
  std::uint32_t* label;
  std::size_t size;
};

// Takes the label of each point that is not within the bounds of its shape. Few points are uncertain, so little goes to
// the host and back. plane, certain: see Is_uncertain.
template <class Backend>
void check_exactly(Backend& backend, const Points_to_check& points, const Plane* plane, const Tolerance& certain,
                   const Check_exactly& check)
{
  const auto place = backend.compact(points.size, Is_uncertain{points.of_surfels, points.label, plane, certain});
  typename Backend::template Buffer<Uncertain_point> buffer(place.size());
  backend.for_each(place.size(),
                   Gather_uncertain{points.of_surfels, points.label, points.origin, place.data(), buffer.data()});
  const std::vector<Uncertain_point> uncertain = to_vector(backend, buffer);
  const auto is_rejected = backend.template make_buffer<std::uint8_t>(
    uncertain.size(), [&](std::size_t i) { return std::uint8_t(!check.is_within(uncertain[i])); });
  backend.for_each(place.size(), Lock_rejected{place.data(), is_rejected.data(), points.label});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_RESULT_EXACT_CHECK_H
