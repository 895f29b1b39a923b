// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Hilbert curve: a bijection, octants are contiguous ranges at every level,
// and consecutive codes belong to positions that share a face.

#include "testing/checks.h"

#include <CGAL/Tandem/internal/cloud/sort_along_curve.h>

#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_curve)

using CGAL::Tandem::internal::curve_bits;
using CGAL::Tandem::internal::hilbert_code;

namespace {

struct Position {
  std::uint32_t x, y, z;
};

void expect(bool ok, const char* what, const Position& p, std::uint64_t value)
{
  CHECK_AT(ok, what + (" at (" + std::to_string(p.x)) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) +
                 "): " + std::to_string(value));
}

std::uint64_t code(const Position& p) { return hilbert_code(p.x, p.y, p.z); }

// The cube of 2^bits positions an axis whose lowest corner is `corner`, a multiple of its size.
void test_cube(const Position& corner, int bits)
{
  const std::uint32_t side = 1u << bits;
  const std::size_t count = std::size_t(1) << (3 * bits);
  const std::uint64_t first = code(corner) & ~std::uint64_t(count - 1);
  std::vector<Position> at(count);
  std::vector<char> seen(count, 0);
  for(std::uint32_t z = 0; z < side; ++z)
    for(std::uint32_t y = 0; y < side; ++y)
      for(std::uint32_t x = 0; x < side; ++x) {
        const Position p = {corner.x + x, corner.y + y, corner.z + z};
        const std::uint64_t offset = code(p) - first;
        expect(offset < count, "code outside of the range of its cube", p, code(p));
        if(offset >= count)
          continue;
        expect(!seen[offset], "code used twice", p, code(p));
        seen[offset] = 1;
        at[offset] = p;
      }
  for(std::size_t i = 1; i < count && failures() == 0; ++i) {
    const Position &p = at[i - 1], &q = at[i];
    const int steps = std::abs(int(p.x) - int(q.x)) + std::abs(int(p.y) - int(q.y)) + std::abs(int(p.z) - int(q.z));
    expect(steps == 1, "consecutive codes are not face neighbors", q, code(q));
  }
}

// All positions of an octant at `level` share the upper digits of their codes with its
// corner, and no position outside of it does.
void test_octants(std::mt19937& random)
{
  const std::uint32_t mask = (1u << curve_bits) - 1;
  for(int repeat = 0; repeat < 20000; ++repeat) {
    const Position p = {std::uint32_t(random() & mask), std::uint32_t(random() & mask), std::uint32_t(random() & mask)};
    const int level = int(random() % unsigned(curve_bits));
    const std::uint32_t low = (1u << level) - 1;
    const Position q = {(p.x & ~low) | (std::uint32_t(random()) & low), (p.y & ~low) | (std::uint32_t(random()) & low),
                        (p.z & ~low) | (std::uint32_t(random()) & low)};
    expect(code(p) >> (3 * level) == code(q) >> (3 * level), "octant is not a range", p, code(p));
    const Position other = {p.x ^ (1u << level), q.y, q.z};
    expect(code(p) >> (3 * level) != code(other) >> (3 * level), "octants overlap", p, code(p));
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(all_cases)
{
  const std::uint32_t end = 1u << curve_bits;
  test_cube({0, 0, 0}, 6);
  test_cube({end - 32, end - 32, end - 32}, 5);
  std::mt19937 random(4242);
  for(int repeat = 0; repeat < 30; ++repeat) {
    const std::uint32_t mask = (end - 1) & ~7u;
    test_cube({std::uint32_t(random()) & mask, std::uint32_t(random()) & mask, std::uint32_t(random()) & mask}, 3);
  }
  test_octants(random);
  expect(code({0, 0, 0}) == 0, "the curve does not start at the origin", {0, 0, 0}, code({0, 0, 0}));
}

BOOST_AUTO_TEST_SUITE_END()
