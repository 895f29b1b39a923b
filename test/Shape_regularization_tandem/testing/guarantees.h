// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fidelity of a result, without the tolerance for rounding that is_valid_result() has: the caller's points and the
// public interface, with 113 bits.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_GUARANTEES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_GUARANTEES_H

#include "test_support.h"

#include <cfloat>

namespace guarantees {

// The product of two doubles is exact.
#if LDBL_MANT_DIG >= 113
using Real = long double;
#else
using Real = __float128;
#endif

using Vector = std::array<Real, 3>;

inline Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

template <class Geometry>
Vector to_vector(const Geometry& g)
{
  return {Real(g.x()), Real(g.y()), Real(g.z())};
}

// The Taylor series, for 0 to 90 degrees.
inline Real cosine(double degrees)
{
  const Real pi = Real(0x1.921fb54442d18p+1) + Real(0x1.1a62633145c07p-53) + Real(-0x1.f1976b7ed8fbcp-109);
  const Real x = Real(degrees) * pi / 180;
  Real sum = 0, term = 1;
  for(int i = 1; i <= 60; i += 2) {
    sum += term;
    term *= -x * x / (i * (i + 1));
  }
  return sum;
}

// The first point of a shape that does not fit its plane, or nothing. Distances and angles are compared by their squares.
inline std::string infidelity(const Cloud& cloud, Given given, const Shapes& shapes)
{
  const Real least_cosine = cosine(shapes.parameters().maximum_angle);
  const Real epsilon = Real(shapes.parameters().maximum_distance);
  for(std::size_t i = 0; i < cloud.size(); ++i) {
    if(shapes.shape_index(i) < 0)
      continue;
    const auto& c = shapes.coefficients(std::size_t(shapes.shape_index(i)));
    const Vector normal = {Real(c[0]), Real(c[1]), Real(c[2])};
    const Vector of_point =
      to_vector(given == Given::normals ? cloud[i].second : Kernel::Vector_3(shapes.estimated_normal(i)));
    const Real squared_length = dot(normal, normal);
    const Real distance = dot(normal, to_vector(cloud[i].first)) + Real(c[3]);
    if(!(distance * distance <= epsilon * epsilon * squared_length))
      return "too far from its plane is point " + std::to_string(i);
    const Real aligned = dot(normal, of_point);
    const Real least = least_cosine * least_cosine * squared_length * dot(of_point, of_point);
    if(!(aligned * aligned >= least && least > 0))
      return "too oblique is the normal of point " + std::to_string(i);
  }
  return "";
}

} // namespace guarantees

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_GUARANTEES_H
