// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The noise that warnings are about, where it cannot be measured or is none.

#undef NDEBUG

#include "testing/checks.h"

#include "result_warnings.h"

#include <limits>
#include <new>

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
  const auto check = [&](const auto& measure, double alone) {
    CHECK(program::smallest_noise(measure, Two_ranks(infinity)) == alone);
    CHECK(program::smallest_noise(measure, Two_ranks(.25)) == .25);
  };
  check([] { return .5; }, .5);
  check([]() -> double { throw std::bad_alloc(); }, infinity); // it goes on, and takes part in what all ranks do
  check([] { return 0.; }, infinity);                          // all points are one
  return report();
}
