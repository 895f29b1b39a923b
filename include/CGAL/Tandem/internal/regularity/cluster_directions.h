// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Gauss map of unoriented normals, and its clusters (section 4.1 of the paper). Distances are sines, so that
// opposite normals coincide. Groups of normals are found by mean shift; normals and shapes do not change. See the
// manual, "Gauss Map Clustering".

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_CLUSTER_DIRECTIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_CLUSTER_DIRECTIONS_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/regularity/Mean_shift.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

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

// Normals and weights gathered in small cubes. So the cost of the mean shift depends on the number of different
// directions, not of shapes. Sums are integers: bins do not depend on the order of the shapes.
// normal[b] is the mean direction of bin b, rounded; weight[b] the sum of weights.
struct Direction_bins {
  std::vector<Vector> normal;
  std::vector<double> weight;
};

// Bins of the given width, sorted by cube. n log n for n normals.
template <class Executor>
Direction_bins make_direction_bins(const std::vector<Vector>& normals, const std::vector<double>& weights, double width,
                                   const Executor& executor)
{
  using Item = std::array<std::int64_t, 4>; // weighted normal, weight
  const std::size_t n = normals.size();
  // 21 bits a coordinate: for tolerances below a thousandth of a degree, bins are wider.
  const double cubes = 1 / (std::max)(width, std::ldexp(1.0, -19));
  const double scale = double(1 << 26); // times at most 2^32 points fits int64
  std::vector<Item> items(n);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(n); // by cube
  executor.for_each(n, [&](std::size_t i) {
    const Vector v = canonical(normals[i]);
    std::uint64_t cube = 0;
    for(double c : {v.x, v.y, v.z})
      cube = cube << 21 | std::uint64_t(llrint(c * cubes) + (1 << 20));
    const std::int64_t w = llrint(weights[i]);
    items[i] = {w * llrint(v.x * scale), w * llrint(v.y * scale), w * llrint(v.z * scale), w};
    order[i] = {cube, std::uint32_t(i)};
  });
  std::sort(order.begin(), order.end());
  Direction_bins bins;
  for(std::size_t i = 0, j; i < n; i = j) {
    Item sum = {0, 0, 0, 0};
    for(j = i; j < n && order[j].first == order[i].first; ++j)
      for(std::size_t k = 0; k < 4; ++k)
        sum[k] += items[order[j].second][k];
    bins.normal.push_back(rounded_normal(canonical(unit({double(sum[0]), double(sum[1]), double(sum[2])}))));
    bins.weight.push_back(double(sum[3]));
  }
  return bins;
}

// Groups of normals within the radius (a sine) of a mode, as lists of positions in the input. A normal joins the
// nearest mode; of equally near ones, the denser. Those that no mode reaches are clustered again, and stay alone at
// last. Each position is in one group. For the executor see Mean_shift.
template <class Executor>
std::vector<std::vector<int>> cluster_directions(const std::vector<Vector>& normals, const std::vector<double>& weights,
                                                 double radius, const Executor& executor)
{
  std::vector<std::vector<int>> groups;
  std::vector<int> rest(normals.size());
  for(std::size_t i = 0; i < rest.size(); ++i)
    rest[i] = int(i);
  for(int pass = 0; pass < tuning::clustering::maximum_passes && !rest.empty(); ++pass) {
    std::vector<Vector> n(rest.size());
    std::vector<double> w(rest.size());
    for(std::size_t k = 0; k < rest.size(); ++k) {
      n[k] = normals[std::size_t(rest[k])];
      w[k] = weights[std::size_t(rest[k])];
    }
    const Direction_bins bins =
      make_direction_bins(n, w, radius / tuning::clustering::direction_bins_per_radius, executor);
    const std::vector<Vector> modes = Mean_shift<Direction_index>(bins.normal, bins.weight, radius).modes(executor);
    const Direction_index index(modes, radius);
    const std::size_t start = groups.size();
    groups.resize(start + modes.size());
    std::vector<std::pair<double, std::size_t>> nearest(rest.size(), {2.0, 0});
    executor.for_each(rest.size(), [&](std::size_t k) {
      index.near(n[k], [&](std::size_t m, double q) { nearest[k] = (std::min)(nearest[k], {q, m}); });
    });
    // A squared sine is at most 1: larger means that no mode is near.
    std::vector<int> left;
    for(std::size_t k = 0; k < rest.size(); ++k)
      (nearest[k].first <= 1 ? groups[start + nearest[k].second] : left).push_back(rest[k]);
    rest.swap(left);
  }
  for(int i : rest)
    groups.push_back({i});
  groups.erase(std::remove_if(groups.begin(), groups.end(), [](const std::vector<int>& g) { return g.empty(); }),
               groups.end());
  return groups;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_CLUSTER_DIRECTIONS_H
