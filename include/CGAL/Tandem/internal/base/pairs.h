// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of ids as one number, first id << 32 | second id.

#ifndef CGAL_TANDEM_INTERNAL_BASE_PAIRS_H
#define CGAL_TANDEM_INTERNAL_BASE_PAIRS_H

#include <CGAL/Tandem/internal/base/types.h>

#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// The same number for both orders: the smaller id is the first one.
CGAL_TANDEM_HD inline std::uint64_t unordered_pair(std::uint32_t a, std::uint32_t b)
{
  return a < b ? std::uint64_t(a) << 32 | b : std::uint64_t(b) << 32 | a;
}

// Multiplicative: ids of one pair are often close to each other. The factor is 2^64 over the golden ratio; the upper
// bits are the better ones.
CGAL_TANDEM_HD inline std::uint64_t hash_of_pair(std::uint64_t pair) { return pair * 0x9e3779b97f4a7c15u; }

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BASE_PAIRS_H
