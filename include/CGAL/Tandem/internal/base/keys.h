// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers as keys: pairs of ids, and doubles as integers of the same order.

#ifndef CGAL_TANDEM_INTERNAL_BASE_KEYS_H
#define CGAL_TANDEM_INTERNAL_BASE_KEYS_H

#include <CGAL/Tandem/internal/base/types.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace CGAL::Tandem::internal {

// --- Pairs of ids as one number, first id << 32 | second id.

// The same number for both orders: the smaller id is the first one.
CGAL_TANDEM_HD inline std::uint64_t unordered_pair(std::uint32_t a, std::uint32_t b)
{
  return a < b ? std::uint64_t(a) << 32 | b : std::uint64_t(b) << 32 | a;
}

// Multiplicative: ids of one pair are often close to each other. The factor is 2^64 over the golden ratio; the upper
// bits are the better ones.
CGAL_TANDEM_HD inline std::uint64_t hash_of_pair(std::uint64_t pair) { return pair * 0x9e3779b97f4a7c15u; }

// --- Numbers in the order of others.

// Bits that are in the order of the numbers. Both zeros get the same.
CGAL_TANDEM_HD inline std::uint64_t ordered_bits(double value)
{
  constexpr std::uint64_t sign = std::uint64_t(1) << 63;
  const double one_zero = value + 0.;
  std::uint64_t bits;
  std::memcpy(&bits, &one_zero, sizeof(bits));
  return bits & sign ? ~bits : bits | sign;
}

inline double from_ordered_bits(std::uint64_t ordered)
{
  const std::uint64_t bits = ordered >> 63 ? ordered & ~(std::uint64_t(1) << 63) : ~ordered;
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

// The number of bits that hold all numbers up to this one; at least 1. A radix sort takes time for each bit of its
// keys.
inline int bits_of(std::size_t largest)
{
  int bits = 1;
  while(largest >> bits)
    ++bits;
  return bits;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_KEYS_H
