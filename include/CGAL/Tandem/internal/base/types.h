// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plain data of the engine: points on an integer grid, and planes with integer coefficients. fits() is the test
// that decides whether a point may belong to a plane. All of it is integer arithmetic without overflow, so that hosts
// and devices decide alike. See the manual, "Grid and Units".

#ifndef CGAL_TANDEM_INTERNAL_BASE_TYPES_H
#define CGAL_TANDEM_INTERNAL_BASE_TYPES_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) ||                         \
  (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "Tandem gives the same answer everywhere and finds what is not finite: compile without -ffast-math and -Ofast"
#endif

#ifndef __SIZEOF_INT128__
#error "Tandem needs 128-bit integers: use g++ or clang on a 64-bit machine"
#endif

// Marks what runs on the host and on a device from the same source.
#ifdef __CUDACC__
#define CGAL_TANDEM_HD __host__ __device__
#else
#define CGAL_TANDEM_HD
#endif

namespace CGAL::Tandem::internal {

// The conversion to float, for values that are used as double afterwards. It rounds in any case: g++ 12 leaves out
// conversions to float and back where it vectorizes, and with them the rounding. It keeps those around an assembler
// statement.
template <class T>
CGAL_TANDEM_HD inline float to_float(T x)
{
  float rounded = float(x);
#if defined(__GNUC__) && !defined(__CUDA_ARCH__)
#if defined(__SSE2__)
  asm("" : "+x"(rounded));
#elif defined(__aarch64__)
  asm("" : "+w"(rounded));
#else
  asm("" : "+m"(rounded));
#endif
#endif
  return rounded;
}

#if defined(__GNUC__) && defined(__x86_64__) && !defined(__FMA__) && !defined(__CUDA_ARCH__)
#define CGAL_TANDEM_ASKS_FOR_FMA
inline const bool has_fma = __builtin_cpu_supports("fma");
#endif

// a b + c, rounded once: std::fma(). Where the compiler does not know whether the processor has the instruction, that
// is a call, before which all values are stored.
CGAL_TANDEM_HD inline double fused(double a, double b, double c)
{
#ifdef CGAL_TANDEM_ASKS_FOR_FMA
  if(has_fma) {
    asm("vfmadd231sd {%2, %1, %0|%0, %1, %2}" : "+x"(c) : "x"(a), "x"(b)); // in both syntaxes of assemblers
    return c;
  }
#endif
  return std::fma(a, b, c);
}

// The length of the normal of an integer plane is 2^28. Signed distances are in units of 2^-28 steps for that reason.
constexpr int normal_bits = 28;
constexpr double normal_scale = double(std::int64_t(1) << normal_bits);

// Coordinates stay within +-2^28, so that n.p + d fits int64 (28 + 28 + log2(3) + 1 < 63).

// A cell is at most 2^23 steps wide, but for surfels that stick out by up to 2^16 steps, and has at most 2^16 points. Products of two coordinates relative to a point of the
// cell then sum to at most 2^62.
constexpr int cell_extent_bits = 23;

// No point, no item. Positions are below 2^31, so it is also larger than all of them in a minimum.
constexpr std::uint32_t no_index = 0xffffffffu;

struct Grid_point {
  std::int32_t x, y, z; // steps of the grid, relative to its origin
  std::uint32_t normal; // octahedral, 2 x 16 bits (see encode_normal()); no_normal if there is none
};

// Bounds of a set of points, in grid steps; both corners belong to the box. Minima and maxima of integers: neither the
// order of points nor the number of threads can change them. It starts empty, with low > high, and can
// only grow. When points are taken out of the set it stays a valid bound, though not the tightest one.
struct Box {
  std::int32_t low[3] = {(std::numeric_limits<std::int32_t>::max)(), (std::numeric_limits<std::int32_t>::max)(),
                         (std::numeric_limits<std::int32_t>::max)()};
  std::int32_t high[3] = {(std::numeric_limits<std::int32_t>::min)(), (std::numeric_limits<std::int32_t>::min)(),
                          (std::numeric_limits<std::int32_t>::min)()};

  CGAL_TANDEM_HD void add(const Grid_point& p)
  {
    const std::int32_t c[3] = {p.x, p.y, p.z};
    for(int a = 0; a < 3; ++a) {
      low[a] = c[a] < low[a] ? c[a] : low[a];
      high[a] = c[a] > high[a] ? c[a] : high[a];
    }
  }

  // An empty box changes nothing.
  CGAL_TANDEM_HD void add(const Box& b)
  {
    for(int a = 0; a < 3; ++a) {
      low[a] = b.low[a] < low[a] ? b.low[a] : low[a];
      high[a] = b.high[a] > high[a] ? b.high[a] : high[a];
    }
  }
};

// Positions [first, last) in the sorted cloud.
struct Range {
  std::uint32_t first, last;
  CGAL_TANDEM_HD std::uint32_t size() const { return last - first; }
};

// Tolerances of points are levels: 0 is epsilon, and each further one is smaller by a factor of 2^(1/8). A tolerance is
// rounded down to a level, which takes one byte a point.
constexpr int levels_per_octave = 8;

// Of tolerances below all others, which no distance is within.
constexpr std::uint8_t no_level = 255;

// The tolerance of a level, in epsilons.
CGAL_TANDEM_HD inline double level_factor(std::uint8_t level)
{
  constexpr double root[levels_per_octave] = {1,
                                              0.91700404320467123,
                                              0.84089641525371454,
                                              0.77110541270397041,
                                              0.70710678118654752,
                                              0.64841977732550483,
                                              0.59460355750136053,
                                              0.54525386633262883};
  const std::uint64_t exponent = std::uint64_t(1023 - level / levels_per_octave)
                                 << 52; // no division: this is called often
  double power;
  std::memcpy(&power, &exponent, sizeof(power));
  return level == no_level ? 0 : root[level % levels_per_octave] * power;
}

// The octave that it is in: its tolerance is at least 2^-octave epsilons, and less than twice that.
CGAL_TANDEM_HD inline int octave_of(std::uint8_t level) { return (level + levels_per_octave - 1) / levels_per_octave; }

// Its square, in 2^-24, so that sums over 2^38 points fit 64 bits; at least 1, so that only the sum of no point is 0.
constexpr std::int64_t squared_level_unit = std::int64_t(1) << 24;

CGAL_TANDEM_HD inline std::int64_t squared_level(std::uint8_t level)
{
  constexpr std::int64_t root[4] = {squared_level_unit, 14107900, 11863283, 9975792};
  const std::int64_t square = level < no_level ? root[level % 4] >> level / 4 : 0;
  return square > 1 ? square : 1;
}

// The smallest level that does not exceed a tolerance.
inline std::uint8_t level_of(double tolerance, double epsilon)
{
  if(!(tolerance < epsilon))
    return 0;
  const double quotient = tolerance / epsilon; // its octave is certain up to one
  const int octave = quotient > 0 ? -std::ilogb(quotient) - 2 : no_level;
  int level = (std::min)((std::max)(octave, 0) * levels_per_octave, int(no_level));
  while(level < no_level && !(epsilon * level_factor(std::uint8_t(level)) <= tolerance))
    ++level;
  return std::uint8_t(level);
}

// The bounds of fits(). distance: epsilon in grid steps times 2^28. squared_cosine: cos^2(alpha) times 2^32.
struct Tolerance {
  std::int64_t distance;
  std::int64_t squared_cosine;
  std::int64_t margin = 0; // part of the distance that is the same for points of smaller tolerances

  // That of a point with a tolerance of its own. It is never 0, so that distances can be divided by it.
  CGAL_TANDEM_HD Tolerance at(std::uint8_t level) const
  {
    const std::int64_t scaled = std::int64_t(double(distance - margin) * level_factor(level));
    return {(scaled > 1 ? scaled : 1) + margin, squared_cosine, margin};
  }
};

// The points that surfels stand for, surfel by surfel. Without surfels each point is one, and both tables are null.
struct Surfels_view {
  const Grid_point* point;             // all points
  const std::uint32_t* first;          // by surfel: its first point; one entry more is the end
  const std::uint32_t* surfel;         // by point
  const std::uint8_t* level = nullptr; // by point, of its tolerance; null: all have that of a detection

  CGAL_TANDEM_HD Range points(std::uint32_t i) const
  {
    return first != nullptr ? Range{first[i], first[i + 1]} : Range{i, i + 1};
  }
  // How often an edge of surfel i counts: for each point, as far as sums of 32 bits allow.
  CGAL_TANDEM_HD std::uint32_t edge_weight(std::uint32_t i) const
  {
    const std::uint32_t n = points(i).size(), most = 1u << 16;
    return n < most ? n : most;
  }
  CGAL_TANDEM_HD std::uint32_t of_point(std::uint32_t p) const { return surfel != nullptr ? surfel[p] : p; }
  CGAL_TANDEM_HD std::uint8_t level_of_point(std::uint32_t p) const { return level != nullptr ? level[p] : 0; }
  CGAL_TANDEM_HD Tolerance tolerance_of_point(std::uint32_t p, const Tolerance& most) const
  {
    return level != nullptr ? most.at(level[p]) : most;
  }
};

// A callback without effect.
struct Nothing {
  void operator()() const {}
};

// The first i in [first, last) without f(i), or last, by bisection. f must hold up to some place, and not from there
// on. std::partition_point needs iterators and does not run on a device.
template <class F>
CGAL_TANDEM_HD std::uint32_t partition_point(std::uint32_t first, std::uint32_t last, F f)
{
  while(first < last) {
    const std::uint32_t middle = first + (last - first) / 2;
    if(f(middle))
      first = middle + 1;
    else
      last = middle;
  }
  return first;
}

struct Int_vector {
  std::int32_t x, y, z;
};

// Both components are -32768, which no direction has.
constexpr std::uint32_t no_normal = 0x80008000u;

// The direction of an octahedral code, as integers. It has an L1 norm of 32767 and is not unit: tests compare squared
// cosines instead of normalizing. no_normal decodes to the null vector.
CGAL_TANDEM_HD inline Int_vector decode_normal(std::uint32_t code)
{
  if(code == no_normal)
    return {0, 0, 0};
  const std::int32_t u = std::int32_t(code << 16) >> 16, v = std::int32_t(code) >> 16;
  const std::int32_t au = u < 0 ? -u : u;
  const std::int32_t av = v < 0 ? -v : v;
  const std::int32_t w = 32767 - au - av;
  const std::int32_t folded = w < 0 ? -w : 0; // compiles without a branch, which could not be predicted
  return {u < 0 ? u + folded : u - folded, v < 0 ? v + folded : v - folded, w};
}

// Whether the codes are so close that the directions make less than a right angle, which needs no decoding. If both
// components of a code change by s in all, the square of the change of the direction is at most 2 s^2: less than the sum
// of both squared lengths, each at least 32767^2 / 3. Says nothing of no_normal.
CGAL_TANDEM_HD inline bool have_close_codes(std::uint32_t code, std::uint32_t other)
{
  const std::int32_t u = std::int16_t(code & 0xffffu) - std::int16_t(other & 0xffffu);
  const std::int32_t v = std::int16_t(code >> 16) - std::int16_t(other >> 16);
  return (u < 0 ? -u : u) + (v < 0 ? -v : v) < 18900;
}

// Of directions: at most 2^30.
CGAL_TANDEM_HD inline std::int64_t int_product(const Int_vector& u, const Int_vector& v)
{
  return std::int64_t(u.x) * v.x + std::int64_t(u.y) * v.y + std::int64_t(u.z) * v.z;
}

// nx x + ny y + nz z + d = 0, with |(nx, ny, nz)| = 2^28 up to rounding. The sign of the normal has no meaning.
struct Plane {
  std::int32_t nx, ny, nz;
  std::int64_t d;
};

CGAL_TANDEM_HD inline bool operator==(const Plane& s, const Plane& t)
{
  return s.nx == t.nx && s.ny == t.ny && s.nz == t.nz && s.d == t.d;
}

// The signed distance to the plane, in 2^-28 grid steps.
CGAL_TANDEM_HD inline std::int64_t signed_distance(const Plane& s, const Grid_point& p)
{
  return std::int64_t(s.nx) * p.x + std::int64_t(s.ny) * p.y + std::int64_t(s.nz) * p.z + s.d;
}

// Whether the point is within the distance, of the same unit; both sides of the plane count alike.
CGAL_TANDEM_HD inline bool is_near(const Plane& s, const Grid_point& p, std::int64_t distance)
{
  const std::int64_t e = signed_distance(s, p);
  return (e < 0 ? -e : e) <= distance;
}

// The squared cosine of the angle between two normals, times 2^32, as a fraction of numbers below 2^62 and 2^30.
// A comparison with cos^2(alpha) needs no division, and its product stays below 2^62.
struct Squared_cosine {
  std::int64_t squared_dot, squared_length;

  // A null normal is never aligned, whatever the bound.
  CGAL_TANDEM_HD bool is_at_least(std::int64_t squared_cosine) const
  {
    return squared_dot > 0 && squared_dot >= squared_length * squared_cosine;
  }
};

// The dot product of the normals of a plane and of a point: below 2^43.
CGAL_TANDEM_HD inline std::int64_t normal_product(const Plane& s, const Int_vector& m)
{
  return std::int64_t(s.nx) * m.x + std::int64_t(s.ny) * m.y + std::int64_t(s.nz) * m.z;
}

CGAL_TANDEM_HD inline Squared_cosine squared_cosine(const Plane& s, const Grid_point& p)
{
  const Int_vector m = decode_normal(p.normal);
  const std::int64_t product = normal_product(s, m);
  const std::int64_t dot = (product < 0 ? -product : product) >> 12; // < 2^31, so that its square fits
  const std::int64_t length2 = int_product(m, m);
  return {dot * dot, length2};
}

// Whether the normals are within alpha of each other. Orientation is ignored.
CGAL_TANDEM_HD inline bool is_aligned(const Plane& s, const Grid_point& p, std::int64_t minimum_squared_cosine)
{
  return squared_cosine(s, p).is_at_least(minimum_squared_cosine);
}

// Whether a point fits a plane: the definition of the manual, in its first table of terms.
CGAL_TANDEM_HD inline bool fits(const Plane& s, const Grid_point& p, const Tolerance& t)
{
  return is_near(s, p, t.distance) && is_aligned(s, p, t.squared_cosine);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_TYPES_H
