// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last step that decides on single points: each one is checked against the
// final plane of its shape, in double and in the caller's coordinates. It is
// filtered: the integer test decides all but the points close to a bound.

#ifndef CGAL_TANDEM_INTERNAL_EXACT_CHECK_H
#define CGAL_TANDEM_INTERNAL_EXACT_CHECK_H

#include <CGAL/Tandem/internal/Engine_result.h>
#include <CGAL/Tandem/internal/Import.h>
#include <CGAL/Tandem/internal/Shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The caller's points and normals, if there are any.
struct Caller_view {
  Vectors_view coordinates;
  Vectors_view normals; // of any length
};

// Not -fma(...): g++ makes one instruction of it, and has the other zero than without that.
inline Coefficients to_caller(const Regular_plane& p, const Grid& grid)
{
  return {p.normal.x, p.normal.y, p.normal.z, 0. - std::fma(grid.step, p.offset, dot(p.normal, grid.origin))};
}

// The vector that a packed normal stands for: of unit length, rounded to float,
// so that it can be written to a file as it was used. Null if there is none.
inline Vector unpacked_normal(std::uint32_t code)
{
  const Int_vector m = decode_normal(code);
  const Vector n = unit({double(m.x), double(m.y), double(m.z)});
  return {double(float(n.x)), double(float(n.y)), double(float(n.z))};
}

struct Exact_bounds {
  double maximum_distance;
  double cosine; // of maximum_angle, raised by what a normal may lose when it is rounded to float

  // True only if every order of evaluation in double finds the point within epsilon.
  bool is_near(const Coefficients& c, const Vector& p) const
  {
    const double x = c[0] * p.x, y = c[1] * p.y, z = c[2] * p.z;
    const double size = std::fabs(x) + std::fabs(y) + std::fabs(z) + std::fabs(c[3]);
    const double e = std::fma(c[0], p.x, std::fma(c[1], p.y, std::fma(c[2], p.z, c[3])));
    return std::fma(size, 1e-15, std::fabs(e)) <= maximum_distance;
  }

  bool is_aligned(const Coefficients& c, const Vector& n) const
  {
    return std::fabs(dot({c[0], c[1], c[2]}, n)) >= cosine;
  }
};

constexpr double rounded_normal_margin = 2e-7;

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

struct Lock_refused {
  const std::uint32_t* place;
  const std::uint8_t* is_refused;
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(is_refused[i])
      label[place[i]] = is_locked;
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

// Frees the points that are not within the bounds of their shape.
template <class Backend>
void check_exactly(Backend& backend, const Is_uncertain& is_uncertain, std::uint32_t* label, std::size_t size,
                   const std::uint32_t* origin, const Check_exactly& check)
{
  const auto place = backend.compact(size, is_uncertain);
  typename Backend::template Buffer<Uncertain_point> buffer(place.size());
  backend.for_each(place.size(), Gather_uncertain{is_uncertain.point, label, origin, place.data(), buffer.data()});
  std::vector<Uncertain_point> uncertain(place.size());
  backend.to_host(buffer.data(), uncertain.size(), uncertain.data());
  std::vector<std::uint8_t> is_refused(uncertain.size());
  backend.for_each_on_host(uncertain.size(), [&](std::size_t i) { is_refused[i] = !check.is_within(uncertain[i]); });
  const auto refused = backend.lend(is_refused);
  backend.for_each(place.size(), Lock_refused{place.data(), refused.data(), label});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_EXACT_CHECK_H
