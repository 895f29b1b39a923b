// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The degrees of freedom of directions with right angles, against the rank of the equations that these are: as
// few as there are, and those of the largest shapes that can have them.

#include "testing/direction_families.h"

#include <CGAL/Tandem/internal/result/export_shapes.h>

#include <Eigen/Dense>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_freedom)

using namespace CGAL::Tandem::internal;
using Pairs = std::vector<std::pair<int, int>>;
using Sizes = std::vector<std::int64_t>;

// The turns of all directions that keep the right angles, to first order, are the null space of one equation a pair. By
// falling size, each direction adds what it has of the freedom that larger ones leave.
std::vector<int> freedom_by_rank(const Directions& d, const Sizes& size, const Pairs& pairs)
{
  Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(Eigen::Index(pairs.size()), Eigen::Index(2 * d.size()));
  Eigen::Index row = 0;
  for(const auto& [a, b] : pairs) {
    const Plane_basis of_a(d[std::size_t(a)]), of_b(d[std::size_t(b)]);
    equations(row, 2 * a) = dot(of_a.u, d[std::size_t(b)]);
    equations(row, 2 * a + 1) = dot(of_a.v, d[std::size_t(b)]);
    equations(row, 2 * b) = dot(of_b.u, d[std::size_t(a)]);
    equations(row++, 2 * b + 1) = dot(of_b.v, d[std::size_t(a)]);
  }
  const auto rank = [&] { return pairs.empty() ? 0 : int(Eigen::FullPivLU<Eigen::MatrixXd>(equations).rank()); };
  std::vector<int> order(d.size()), freedom(d.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return size[std::size_t(a)] > size[std::size_t(b)]; });
  for(int next : order) { // whose columns are removed
    const int before = rank();
    equations.middleCols<2>(2 * next).setZero();
    freedom[std::size_t(next)] = 2 - before + rank();
  }
  return freedom;
}

// Each direction is orthogonal to none, one or two of the others before it.
BOOST_AUTO_TEST_CASE(rank_of_right_angles)
{
  int right_angles = 0;
  for(int seed = 0; seed < 400; ++seed) {
    Random random(seed);
    Directions d;
    Sizes size;
    for(int n = 2 + random.below(14), parents; int(d.size()) < n;) {
      const Vector &p = d.empty() ? random.direction() : d[std::size_t(random.below(int(d.size())))],
                   &q = d.empty() ? p : d[std::size_t(random.below(int(d.size())))];
      parents = d.empty() ? 0 : random.below(3);
      d.push_back(parents == 2 && squared_sine(p, q) > .01 ? orthogonal_to_both(p, q)
                  : parents > 0                            ? made_orthogonal(random.direction(), p)
                                                           : random.direction());
      for(std::size_t k = 0; k + 1 < d.size(); ++k) // parallel ones would be one
        if(squared_sine(d[k], d.back()) < 1e-6) {
          d.pop_back();
          break;
        }
      size.resize(d.size(), 1 + random.below(100));
    }
    const Pairs pairs = orthogonal_pairs(d);
    CHECK_AT(Direction_freedom(size, pairs)() == freedom_by_rank(d, size, pairs), "seed " + std::to_string(seed));
    right_angles += int(pairs.size());
  }
  check(right_angles > 2000, "right angles", right_angles);
}

// A floor and its walls: it has the freedom of its size, whatever the number of its right angles.
BOOST_AUTO_TEST_CASE(floor_and_walls)
{
  const Pairs pairs = {{0, 1}, {0, 2}, {0, 3}, {0, 4}};
  const auto freedom = [&](const Sizes& size) { return Direction_freedom(size, pairs)(); };
  CHECK(freedom({9, 5, 6, 7, 8}) == std::vector<int>({2, 1, 1, 1, 1}));
  CHECK(freedom({7, 5, 6, 9, 8}) == std::vector<int>({0, 1, 1, 2, 2}));
  CHECK(freedom({8, 5, 6, 9, 7}) == std::vector<int>({1, 1, 1, 2, 1}));
}

BOOST_AUTO_TEST_SUITE_END()
