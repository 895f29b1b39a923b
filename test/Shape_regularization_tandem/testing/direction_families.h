// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Families of many directions, with ties and near the bounds, and groups of shapes of such directions.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_DIRECTION_FAMILIES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_DIRECTION_FAMILIES_H

#include "rectangles.h"

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace CGAL::Tandem::internal {

struct Random {
  std::mt19937_64 engine;
  std::normal_distribution<double> gauss;

  explicit Random(int seed) : engine(std::uint64_t(seed)) {}
  int below(int n) { return int(engine() % std::uint64_t(n)); }
  double uniform() { return double(engine() >> 11) * 0x1p-53; }
  Vector vector() { return {gauss(engine), gauss(engine), gauss(engine)}; }
  Vector direction() { return unit(vector()); }
};

using Directions = std::vector<Vector>;

inline Directions random_directions(Random& random, int n)
{
  Directions d;
  for(int i = 0; i < n; ++i)
    d.push_back(random.direction());
  return d;
}

// Orthogonal triples, and directions orthogonal to one of them.
inline Directions frames(Random& random, int n)
{
  Directions d;
  while(int(d.size()) < n) {
    const Vector z = random.direction(), x = made_orthogonal(random.direction(), z), y = orthogonal_to_both(z, x);
    d.insert(d.end(), {x, -y, z, made_orthogonal(random.direction(), z)});
  }
  return d;
}

// Turned from right angles by about the bound, or by much less: both sides, and equal to it.
inline Directions near_the_bound(Random& random, int n)
{
  Directions d = frames(random, n);
  for(Vector& v : d)
    if(random.below(2) == 0)
      v = add_scaled(v, std::ldexp(1.0, -40 - random.below(15)), random.direction());
  return d;
}

// Directions of a lattice: many are equal, and many lie on edges and corners of the cube.
inline Directions lattice(Random& random, int n)
{
  Directions d;
  for(int i = 0; i < n; ++i)
    d.push_back(unit({random.below(7) - 3., random.below(7) - 3., random.below(7) - 3.}));
  return d;
}

// A cylinder, and its axis; the axis is that of a coordinate for every other seed.
inline Directions cylinder(Random& random, int n)
{
  const Vector axis = random.below(2) == 0 ? Vector{1, 0, 0} : random.direction();
  Directions d = {axis};
  for(int i = 1; i < n; ++i)
    d.push_back(made_orthogonal(random.direction(), axis));
  return d;
}

// Around a few directions, closer than the cells of any grid.
inline Directions clusters(Random& random, int n)
{
  const Directions centers = frames(random, 8);
  Directions d;
  for(int i = 0; i < n; ++i)
    d.push_back(
      unit(add_scaled(centers[std::size_t(i) % 8], std::ldexp(1.0, -20 - random.below(20)), random.vector())));
  return d;
}

const std::map<std::string, Directions (*)(Random&, int)> families = {
  {"random", random_directions}, {"frames", frames},     {"near the bound", near_the_bound},
  {"lattice", lattice},          {"cylinder", cylinder}, {"clusters", clusters}};

inline void for_each_family(int n, int seeds,
                            const std::function<void(const std::string&, Random&, const Directions&)>& test)
{
  for(const auto& [name, make] : families)
    for(int seed = 0; seed < seeds; ++seed) {
      Random random(seed);
      test(name + " " + std::to_string(seed), random, make(random, n));
    }
}

// A plate with this normal, of some size and noise.
inline Direction_group make_group(Random& random, const Vector& normal, bool is_small)
{
  const Vector n = unit(normal), u = made_orthogonal(random.direction(), n), v = cross(n, u);
  const double width = is_small ? 10 : 10 + 1e4 * random.uniform() * random.uniform();
  Direction_group g;
  g.weight = g.largest = double(100 + random.below(3));
  g.matrix = square(g.weight * width * width, u) + square(g.weight * width * width * random.uniform(), v) +
             square(g.weight * random.uniform(), n);
  g.eigen = eigen_system(g.matrix);
  g.fitted = canonical(g.eigen.vector[0]);
  g.minimum = quadratic_form(g.matrix, g.fitted);
  return g;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_DIRECTION_FAMILIES_H
