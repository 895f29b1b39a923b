// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Hilbert curve through a cube of 2^21 positions an axis. Each octant of the cube, and each octant of an octant, is
// one contiguous range of codes. So a cloud in the order of the codes is also in the order of an octree. Consecutive
// positions are adjacent, unlike those of Morton codes, so ranges of points are compact.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_CURVE_H
#define CGAL_TANDEM_INTERNAL_CLOUD_CURVE_H

#include <CGAL/Tandem/internal/base/types.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Bits of a coordinate in a code, which has 3 * 21 = 63 bits.
constexpr int curve_bits = 21;

// Moves bit i of v < 2^21 to bit 3 i, so that three coordinates can be interleaved.
CGAL_TANDEM_HD inline std::uint64_t spread_bits(std::uint32_t v)
{
  std::uint64_t s = v;
  s = (s | s << 32) & 0x001f00000000ffffu;
  s = (s | s << 16) & 0x001f0000ff0000ffu;
  s = (s | s << 8) & 0x100f00f00f00f00fu;
  s = (s | s << 4) & 0x10c30c30c30c30c3u;
  s = (s | s << 2) & 0x1249249249249249u;
  return s;
}

// The number whose bit i is the parity of the bits of v above i.
CGAL_TANDEM_HD inline std::uint32_t parity_above(std::uint32_t v)
{
  v >>= 1;
  v ^= v >> 1;
  v ^= v >> 2;
  v ^= v >> 4;
  v ^= v >> 8;
  v ^= v >> 16;
  return v;
}

// One level of Skilling's construction (2004), from the top level down. The lower bits are taken to the frame of
// their octant: a reflection and up to two swaps of axes. There are no branches and no tables, so loops over
// points vectorize.
CGAL_TANDEM_HD inline void enter_octant(std::uint32_t& x, std::uint32_t& y, std::uint32_t& z, int bit)
{
  const std::uint32_t below = (1u << bit) - 1;
  x ^= below & (0u - (x >> bit & 1u));
  const std::uint32_t upper_y = below & (0u - (y >> bit & 1u));
  const std::uint32_t xy = (x ^ y) & (below ^ upper_y);
  x ^= xy ^ upper_y;
  y ^= xy;
  const std::uint32_t upper_z = below & (0u - (z >> bit & 1u));
  const std::uint32_t xz = (x ^ z) & (below ^ upper_z);
  x ^= xz ^ upper_z;
  z ^= xz;
}

// The code from the transformed coordinates. Octants of a level follow each other in a Gray code, which is undone here.
CGAL_TANDEM_HD inline std::uint64_t interleave_octants(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  y ^= x;
  z ^= y;
  const std::uint32_t flip = parity_above(z);
  return spread_bits(x ^ flip) << 2 | spread_bits(y ^ flip) << 1 | spread_bits(z ^ flip);
}

// The position along the curve; all coordinates are below 2^21. In the lowest octant the axes are exchanged in turn, so
// three levels of it leave them as they are.
CGAL_TANDEM_HD inline std::uint64_t hilbert_code(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  int bit = curve_bits - 1;
  while(bit > 2 && (x | y | z) >> (bit - 2) == 0)
    bit -= 3;
  for(; bit > 0; --bit)
    enter_octant(x, y, z, bit);
  return interleave_octants(x, y, z);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CLOUD_CURVE_H
