// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eight floats side by side, for filters whose close cases are decided in integers: last bits do not matter. Two
// vectors of four, as SSE2 has them: without AVX, compilers split a vector of eight into scalars.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_FLOAT8_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_FLOAT8_H

#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace CGAL {
namespace Tandem {
namespace internal {

typedef float Float4 __attribute__((vector_size(16)));
typedef std::int32_t Int4 __attribute__((vector_size(16)));

// Of any alignment.
template <class Vector, class T>
inline Vector load4(const T* p)
{
  Vector r;
  std::memcpy(&r, p, sizeof r);
  return r;
}

// These three stay intrinsics on x86-64: without those the search for neighbors takes 3 to 15 % longer.
#ifdef __SSE2__

inline Float4 min4(Float4 a, Float4 b) { return _mm_min_ps(a, b); }
inline Float4 max4(Float4 a, Float4 b) { return _mm_max_ps(a, b); }
inline int less_equal4(Float4 a, Float4 b) { return _mm_movemask_ps(Float4(a <= b)); }

#else

inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }

inline int less_equal4(Float4 a, Float4 b)
{
  const Int4 bits = (a <= b) & Int4{1, 2, 4, 8};
  return bits[0] | bits[1] | bits[2] | bits[3];
}

#endif

struct Float8 {
  Float4 low, high;
};

inline Float8 load8(const float* p)
{
  Float8 r;
  std::memcpy(&r, p, sizeof r);
  return r;
}

inline void store8(float* p, const Float8& a) { std::memcpy(p, &a, sizeof a); }

inline Float8 fill8(float f) { return {Float4{f, f, f, f}, Float4{f, f, f, f}}; }

// float(p[i] - origin), exact below 2^24 and rounded above. The difference must fit int32: coordinates are within
// +-2^28.
inline Float8 difference8(const std::int32_t* p, std::int32_t origin)
{
  return {__builtin_convertvector(load4<Int4>(p) - origin, Float4),
          __builtin_convertvector(load4<Int4>(p + 4) - origin, Float4)};
}

inline Float8 operator+(const Float8& a, const Float8& b) { return {a.low + b.low, a.high + b.high}; }
inline Float8 operator-(const Float8& a, const Float8& b) { return {a.low - b.low, a.high - b.high}; }
inline Float8 operator*(const Float8& a, const Float8& b) { return {a.low * b.low, a.high * b.high}; }

inline Float8 min8(const Float8& a, const Float8& b) { return {min4(a.low, b.low), min4(a.high, b.high)}; }
inline Float8 max8(const Float8& a, const Float8& b) { return {max4(a.low, b.low), max4(a.high, b.high)}; }

// Bit i of the result is a[i] <= b[i].
inline unsigned less_equal8(const Float8& a, const Float8& b)
{
  return unsigned(less_equal4(a.low, b.low) | less_equal4(a.high, b.high) << 4);
}

// The lowest bits of each float become `tag`. Positive floats are ordered like their bits, so a small tag changes their
// order only among nearly equal ones.
inline Float8 tagged8(const Float8& a, std::uint32_t tag, std::uint32_t tag_mask)
{
  const std::int32_t kept = std::int32_t(~tag_mask), bits = std::int32_t(tag);
  return {Float4((Int4(a.low) & kept) | bits), Float4((Int4(a.high) & kept) | bits)};
}

// A compiler may contract this to fma, which rounds less often. The error bounds of the users still hold.
inline Float8 squared_length8(const Float8& x, const Float8& y, const Float8& z) { return x * x + y * y + z * z; }

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_FLOAT8_H
