// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The noise that warnings are about, where it cannot be measured or is none.

#undef NDEBUG

#include "testing/checks.h"

#include "result_warnings.h"

#include <functional>
#include <limits>
#include <new>

static std::function<double()> measure;

double program::measured_noise(const Point_set&) { return measure(); }

// Another rank has measured this.
class Two_ranks : public program::Ranks {
public:
  explicit Two_ranks(double other) : other_(other) {}
  int size() const override { return 2; }
  double largest(double own) const override { return (std::max)(own, -other_); }

private:
  double other_;
};

int main()
{
  const double infinity = std::numeric_limits<double>::infinity();
  program::Point_set points;
  points.insert({1, 2, 3});
  const program::Shapes shapes;
  const auto noise = [&](double other) { return program::noise_of(points, shapes, Two_ranks(other)); };
  measure = [] { return .5; };
  CHECK(noise(infinity) == .5);
  CHECK(noise(.25) == .25);
  measure = []() -> double { throw std::bad_alloc(); }; // it goes on, and takes part in what all ranks do
  CHECK(noise(infinity) == infinity);
  CHECK(noise(.25) == .25);
  measure = [] { return 0.; }; // all points are one
  CHECK(noise(infinity) == infinity);
  CHECK(noise(.25) == .25);
  return report();
}
