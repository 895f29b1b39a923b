// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last step that decides on single points: each one is checked against the
// final plane of its shape, in double and in the caller's coordinates. It is
// filtered: the integer test decides all but the points close to a bound.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_EXACT_CHECK_H
#define CGAL_TANDEM_INTERNAL_FINISH_EXACT_CHECK_H

#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The caller's points and normals, if there are any.
struct Caller_view {
  Vectors_view coordinates;
  Vectors_view normals; // of any length
};

// The integer test with its margins leaves open whether the point is within the bounds.
struct Is_uncertain {
  const Grid_point* point;
  const std::uint32_t* label;
  const Plane* plane; // by shape
  Tolerance certain;  // the bounds of the engine, less all rounding

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const
  {
    return label[i] < first_mark && !fits(plane[label[i]], point[i], certain);
  }
};

struct Uncertain_point {
  std::uint32_t shape, origin, normal; // origin: the imported point
};

struct Gather_uncertain {
  const Grid_point* point;
  const std::uint32_t* label;
  const std::uint32_t* origin;
  const std::uint32_t* place;
  Uncertain_point* uncertain;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    uncertain[i] = {label[place[i]], origin[place[i]], point[place[i]].normal};
  }
};

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

// The test itself, on the host, where the caller's coordinates are.
struct Check_exactly {
  Caller_view caller;
  const Coefficients* plane; // by shape
  Exact_bounds bounds;

  bool is_within(const Uncertain_point& u) const
  {
    const Vector normal =
      caller.normals.data != nullptr ? normalized(caller.normals[u.origin]) : unpacked_normal(u.normal);
    return bounds.is_near(plane[u.shape], caller.coordinates[u.origin]) && bounds.is_aligned(plane[u.shape], normal);
  }
};

// The points that are checked, with labels of their own.
struct Points_to_check {
  const Grid_point* point;
  const std::uint32_t* origin; // the imported points
  std::uint32_t* label;
  std::size_t size;
};

// Frees the points that are not within the bounds of their shape. plane, certain: see Is_uncertain.
template <class Backend>
void check_exactly(Backend& backend, const Points_to_check& points, const Plane* plane, const Tolerance& certain,
                   const Check_exactly& check)
{
  const auto place = backend.compact(points.size, Is_uncertain{points.point, points.label, plane, certain});
  typename Backend::template Buffer<Uncertain_point> buffer(place.size());
  backend.for_each(place.size(),
                   Gather_uncertain{points.point, points.label, points.origin, place.data(), buffer.data()});
  std::vector<Uncertain_point> uncertain(place.size());
  backend.to_host(buffer.data(), uncertain.size(), uncertain.data());
  std::vector<std::uint8_t> is_rejected(uncertain.size());
  backend.for_each_on_host(uncertain.size(), [&](std::size_t i) { is_rejected[i] = !check.is_within(uncertain[i]); });
  const auto rejected = backend.read_access(is_rejected);
  backend.for_each(place.size(), Lock_rejected{place.data(), rejected.data(), points.label});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_EXACT_CHECK_H
