// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors of numbers with 113 bits.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_EXTENDED_PRECISION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_EXTENDED_PRECISION_H

#include <array>
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

inline Vector cross(const Vector& a, const Vector& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

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

} // namespace guarantees

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_EXTENDED_PRECISION_H
