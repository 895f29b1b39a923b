// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sine and cosine of the angles among the parameters, in degrees. Those of C libraries differ between machines in the
// last bit. These are fixed polynomials evaluated with fma, so decisions may depend on them.

#ifndef CGAL_TANDEM_INTERNAL_BASE_ANGLES_H
#define CGAL_TANDEM_INTERNAL_BASE_ANGLES_H

#include <cmath>

namespace CGAL::Tandem::internal {
namespace angles {

constexpr double radians_per_degree = 0.017453292519943295769;

// A polynomial in x^2, by Horner's rule. The Taylor series leave out less than 5e-17 on [0, pi/4]. That is below
// half of the last bit of the result.
inline double series(const double* c, int terms, double x2)
{
  double sum = c[terms - 1];
  for(int i = terms - 2; i >= 0; --i)
    sum = fused(sum, x2, c[i]);
  return sum;
}

// 0 <= deg <= 45
inline double small_sine(double deg)
{
  static const double c[8] = {1.0,          -1.0 / 6,        1.0 / 120,          -1.0 / 5040,
                              1.0 / 362880, -1.0 / 39916800, 1.0 / 6227020800.0, -1.0 / 1307674368000.0};
  const double x = deg * radians_per_degree;
  return x * series(c, 8, x * x);
}

inline double small_cosine(double deg)
{
  static const double c[9] = {1.0,
                              -0.5,
                              1.0 / 24,
                              -1.0 / 720,
                              1.0 / 40320,
                              -1.0 / 3628800,
                              1.0 / 479001600.0,
                              -1.0 / 87178291200.0,
                              1.0 / 20922789888000.0};
  const double x = deg * radians_per_degree;
  return series(c, 9, x * x);
}

} // namespace angles

// The sine of any finite angle: reduced to a turn, a half turn, a quarter and 45 degrees. fmod and all subtractions of
// the reduction are exact, so it adds no error.
inline double sine_deg(double deg)
{
  const double turn = std::fmod(deg < 0 ? -deg : deg, 360.0);
  const bool is_lower_half = turn > 180;
  const double half = is_lower_half ? turn - 180 : turn;
  const double acute = half > 90 ? 180 - half : half;
  const double s = acute <= 45 ? angles::small_sine(acute) : angles::small_cosine(90 - acute);
  return (deg < 0) != is_lower_half ? -s : s;
}

// The cosine of any finite angle, in the same way; it ignores the sign.
inline double cosine_deg(double deg)
{
  const double turn = std::fmod(deg < 0 ? -deg : deg, 360.0);
  const double half = turn > 180 ? 360 - turn : turn;
  const double acute = half > 90 ? 180 - half : half;
  const double c = acute <= 45 ? angles::small_cosine(acute) : angles::small_sine(90 - acute);
  return half > 90 ? -c : c;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_ANGLES_H
