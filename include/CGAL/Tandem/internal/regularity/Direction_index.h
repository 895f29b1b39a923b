// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Gauss map of unoriented normals (section 4.1 of the paper): queries for those within an angle. Distances are
// sines, so that opposite normals coincide. Nothing is changed.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_INDEX_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_INDEX_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The one of n and -n whose last nonzero coordinate is positive. Adding 0 removes negative zeros, so that equal
// directions have equal bits.
inline Vector canonical(const Vector& n)
{
  const bool is_opposite = n.z < 0 || (n.z == 0 && (n.y < 0 || (n.y == 0 && n.x < 0)));
  const Vector m = is_opposite ? -n : n;
  return {m.x + 0.0, m.y + 0.0, m.z + 0.0};
}

// A normal on a grid of 2^-24, which is less than 4e-6 degrees. Products of coordinates, of their differences and with
// float weights are exact then. So contraction cannot change a sum, and no std::fma is needed: a call on plain x86-64.
inline Vector rounded_normal(const Vector& n)
{
  const double scale = double(1 << 24);
  return {double(llrint(n.x * scale)) / scale, double(llrint(n.y * scale)) / scale,
          double(llrint(n.z * scale)) / scale};
}

inline double rounded_dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Rounded unit normals in a dense grid of cubes, sorted by cube, for queries within a radius. Those near the equator
// are entered with both signs, so that a query is for one sign only. Memory: at most 80 bytes a normal.
class Direction_index {
public:
  using Position = Vector;

  // The weighted mean of rounded normals, with signs as seen from `side`. Calls of add() must have a fixed order.
  class Mean {
  public:
    explicit Mean(const Vector& side) : side(side) {}

    void add(const Vector& n, double weight)
    {
      // The sign is certain, as n is near; weights of 24 bits make the products exact.
      const double w = rounded_dot(side, n) < 0 ? -to_float(weight) : to_float(weight);
      sum.x += w * n.x;
      sum.y += w * n.y;
      sum.z += w * n.z;
    }

    Vector value() const { return dot(sum, sum) > 0 ? canonical(unit(sum)) : side; }

  private:
    Vector side, sum = {0, 0, 0};
  };

  // The squared sine of the angle of two unit vectors.
  static double squared_distance(const Vector& a, const Vector& b)
  {
    const Vector c = cross(a, b);
    return dot(c, c);
  }

  // |a - b| of two unit vectors whose acute angle has this sine; that of a right angle reaches all of them.
  static double chord_of(double sine)
  {
    return sine < 1 ? sine * std::sqrt(2 / (1 + std::sqrt(std::fma(-sine, sine, 1.0)))) : std::sqrt(2.0);
  }

  // Queries compare chords, a little wider than that of the sine.
  static double reach_of(double sine) { return chord_of(sine) * (1 + tuning::exactness::reach_margin); }

  // radius: the sine of the largest angle that a query reaches. Linear in the number of normals.
  Direction_index(const std::vector<Vector>& normals, double radius) : chord(chord_of(radius))
  {
    choose_size(normals.size());
    std::vector<Entry> entries;
    entries.reserve(2 * normals.size());
    for(std::size_t i = 0; i < normals.size(); ++i) {
      const Vector n = rounded_normal(canonical(normals[i]));
      entries.push_back({n, std::uint32_t(i)});
      if(n.z <= chord)
        entries.push_back({-n, std::uint32_t(i)});
    }
    sort_into_cubes(entries);
  }

  // Calls f(i, squared sine) for the normals within the radius, in the order of the cubes, then of the input.
  template <class Function>
  void near(const Vector& normal, Function f) const
  {
    near(normal, chord, f);
  }

  // The same within a smaller reach: see reach_of().
  template <class Function>
  void near(const Vector& normal, double reach, Function f) const
  {
    for_each_piece(normal, reach, [&](const Piece& piece) {
      for(int k = 0; k < piece.size; ++k)
        f(piece.index[k], piece.squared_sine[k]);
    });
  }

  // Calls f(i, kernel(squared sine)) for those within the radius, in the same order.
  template <class Kernel, class Function>
  void weigh(const Vector& normal, Kernel kernel, Function f) const
  {
    for_each_piece(normal, chord, [&](Piece& piece) {
      for(int k = 0; k < piece.size; ++k) // a loop of its own, for vector instructions
        piece.squared_sine[k] = kernel(piece.squared_sine[k]);
      for(int k = 0; k < piece.size; ++k)
        f(piece.index[k], piece.squared_sine[k]);
    });
  }

private:
  // Some of the normals near a query.
  struct Piece {
    static constexpr int capacity = 32;
    double squared_sine[capacity];
    std::uint32_t index[capacity];
    int size;
  };

  struct Entry {
    Vector normal;
    std::uint32_t index;
  };

  // The cube of a coordinate; coordinates outside have the first or the last one.
  int slot(double c) const
  {
    const int s = int((c + 1) * 0.5 * size);
    return s < 0 ? 0 : s < size ? s : size - 1;
  }

  std::size_t cube(const Vector& n) const { return (std::size_t(slot(n.x)) * size + slot(n.y)) * size + slot(n.z); }

  // Calls f(piece) for the normals within the reach, some at a time. No branch depends on a normal, as it would be
  // mispredicted often.
  template <class Function>
  void for_each_piece(const Vector& normal, double reach, Function f) const
  {
    Piece piece;
    piece.size = 0;
    const Vector n = rounded_normal(canonical(normal));
    const double squared_reach = reach * reach, beside = reach + tuning::exactness::reach_margin;
    const int z0 = slot(n.z - beside), z1 = slot(n.z + beside), x1 = slot(n.x + beside), y1 = slot(n.y + beside);
    for(int cx = slot(n.x - beside); cx <= x1; ++cx)
      for(int cy = slot(n.y - beside); cy <= y1; ++cy) {
        const std::size_t row = (std::size_t(cx) * size + cy) * size;
        for(std::uint32_t i = first[row + z0], end = first[row + z1 + 1]; i < end;) {
          i = fill(piece, n, squared_reach, i, end);
          if(piece.size == Piece::capacity) {
            f(piece);
            piece.size = 0;
          }
        }
      }
    f(piece);
  }

  // Appends the normals of [begin, end) that are within reach, until the piece may be full. Returns where it ends.
  std::uint32_t fill(Piece& piece, const Vector& n, double squared_reach, std::uint32_t begin, std::uint32_t end) const
  {
    const std::uint32_t room = std::uint32_t(Piece::capacity - piece.size);
    const std::uint32_t last = end - begin < room ? end : begin + room;
    int size = piece.size;
    for(std::uint32_t i = begin; i < last; ++i) {
      const Vector d = n - sorted[i].normal;
      const double q = rounded_dot(d, d);
      piece.index[size] = sorted[i].index;
      piece.squared_sine[size] = q * (1 - 0.25 * q);
      size += int(q <= squared_reach);
    }
    piece.size = size;
    return last;
  }

  // Cubes at least as wide as the radius, but not many more than four a normal.
  void choose_size(std::size_t n)
  {
    int maximum = 4;
    while(maximum < 256 && std::size_t(maximum) * maximum * maximum < 4 * n)
      ++maximum;
    size = chord * maximum > 2 ? (std::max)(1, int(2 / chord)) : maximum;
  }

  void sort_into_cubes(const std::vector<Entry>& entries)
  {
    first.assign(std::size_t(size) * size * size + 1, 0);
    for(const Entry& e : entries)
      ++first[cube(e.normal) + 1];
    for(std::size_t c = 1; c < first.size(); ++c)
      first[c] += first[c - 1];
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    sorted.resize(entries.size());
    for(const Entry& e : entries)
      sorted[next[cube(e.normal)]++] = e;
  }

  double chord;
  int size;
  std::vector<std::uint32_t> first;
  std::vector<Entry> sorted;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_INDEX_H
