// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eight floats side by side, for filters whose close cases are decided in integers: last bits do not matter. SSE2 is
// part of every x86-64; elsewhere plain loops do the same. Intrinsics stay, since the vector extensions of the
// compilers make the search for neighbors slower.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_FLOAT8_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_FLOAT8_H

#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace CGAL::Tandem::internal {

#ifdef __SSE2__

// Two registers of SSE2, so that no flag of the compiler is needed.
struct Float8 {
  __m128 low, high;
};

inline Float8 load8(const float* p) { return {_mm_loadu_ps(p), _mm_loadu_ps(p + 4)}; }
inline Float8 fill8(float f) { return {_mm_set1_ps(f), _mm_set1_ps(f)}; }
inline void store8(float* p, const Float8& a)
{
  _mm_storeu_ps(p, a.low);
  _mm_storeu_ps(p + 4, a.high);
}

// float(p[i] - origin), exact below 2^24 and rounded above. The difference must fit int32: coordinates are within
// +-2^28.
inline Float8 difference8(const std::int32_t* p, std::int32_t origin)
{
  const __m128i o = _mm_set1_epi32(origin);
  const __m128i* v = reinterpret_cast<const __m128i*>(p);
  return {_mm_cvtepi32_ps(_mm_sub_epi32(_mm_loadu_si128(v), o)),
          _mm_cvtepi32_ps(_mm_sub_epi32(_mm_loadu_si128(v + 1), o))};
}

inline Float8 operator+(const Float8& a, const Float8& b)
{
  return {_mm_add_ps(a.low, b.low), _mm_add_ps(a.high, b.high)};
}
inline Float8 operator-(const Float8& a, const Float8& b)
{
  return {_mm_sub_ps(a.low, b.low), _mm_sub_ps(a.high, b.high)};
}
inline Float8 operator*(const Float8& a, const Float8& b)
{
  return {_mm_mul_ps(a.low, b.low), _mm_mul_ps(a.high, b.high)};
}
inline Float8 min8(const Float8& a, const Float8& b) { return {_mm_min_ps(a.low, b.low), _mm_min_ps(a.high, b.high)}; }
inline Float8 max8(const Float8& a, const Float8& b) { return {_mm_max_ps(a.low, b.low), _mm_max_ps(a.high, b.high)}; }

// Bit i of the result is a[i] <= b[i].
inline unsigned less_equal8(const Float8& a, const Float8& b)
{
  return unsigned(_mm_movemask_ps(_mm_cmple_ps(a.low, b.low)) | _mm_movemask_ps(_mm_cmple_ps(a.high, b.high)) << 4);
}

// The lowest bits of each float become `tag`. Positive floats are ordered like their bits, so a small tag changes their
// order only among nearly equal ones.
inline Float8 tagged8(const Float8& a, std::uint32_t tag, std::uint32_t tag_mask)
{
  const __m128 m = _mm_castsi128_ps(_mm_set1_epi32(int(tag_mask))), t = _mm_castsi128_ps(_mm_set1_epi32(int(tag)));
  return {_mm_or_ps(_mm_andnot_ps(m, a.low), t), _mm_or_ps(_mm_andnot_ps(m, a.high), t)};
}

#else

// Loops of constant length, which compilers vectorize for the machine.
struct Float8 {
  float v[8];
};

template <class F>
inline Float8 make8(F f)
{
  Float8 r;
  for(int i = 0; i < 8; ++i)
    r.v[i] = f(i);
  return r;
}

inline Float8 load8(const float* p)
{
  return make8([&](int i) { return p[i]; });
}
inline Float8 fill8(float f)
{
  return make8([&](int) { return f; });
}
inline void store8(float* p, const Float8& a) { std::memcpy(p, a.v, sizeof a.v); }

// float(p[i] - origin). This function and those below give the same as those of SSE2.
inline Float8 difference8(const std::int32_t* p, std::int32_t origin)
{
  return make8([&](int i) { return float(p[i] - origin); });
}

inline Float8 operator+(const Float8& a, const Float8& b)
{
  return make8([&](int i) { return a.v[i] + b.v[i]; });
}
inline Float8 operator-(const Float8& a, const Float8& b)
{
  return make8([&](int i) { return a.v[i] - b.v[i]; });
}
inline Float8 operator*(const Float8& a, const Float8& b)
{
  return make8([&](int i) { return a.v[i] * b.v[i]; });
}
inline Float8 min8(const Float8& a, const Float8& b)
{
  return make8([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
inline Float8 max8(const Float8& a, const Float8& b)
{
  return make8([&](int i) { return a.v[i] < b.v[i] ? b.v[i] : a.v[i]; });
}

inline unsigned less_equal8(const Float8& a, const Float8& b)
{
  unsigned mask = 0;
  for(int i = 0; i < 8; ++i)
    mask |= unsigned(a.v[i] <= b.v[i]) << i;
  return mask;
}

// Bits are copied: a cast of pointers would be undefined.
inline Float8 tagged8(const Float8& a, std::uint32_t tag, std::uint32_t tag_mask)
{
  std::uint32_t bits[8];
  std::memcpy(bits, a.v, sizeof bits);
  for(std::uint32_t& b : bits)
    b = (b & ~tag_mask) | tag;
  Float8 r;
  std::memcpy(r.v, bits, sizeof bits);
  return r;
}

#endif

// A compiler may contract this to fma, which rounds less often. The error bounds of the users still hold.
inline Float8 squared_length8(const Float8& x, const Float8& y, const Float8& z) { return x * x + y * y + z * z; }

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_FLOAT8_H
