// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The side of an edge that a point is on, where normals are estimated: the body against a naive version on several back
// ends. Given normals decide by themselves: on the wrong side they are too oblique for its plane.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/finish/choose_edge_sides.h>

#include <cmath>
#include <set>
#include <tuple>
#include <utility>

BOOST_AUTO_TEST_SUITE(test_edge_sides)

using namespace CGAL::Tandem::internal;

class Slow_edge_sides {
public:
  explicit Slow_edge_sides(const Fixture& f) : f_(f) {}

  // The points that three steps to the farther half of the neighbors reach, in the last to every second one, in the
  // order of a depth-first search.
  std::vector<std::uint32_t> around(std::uint32_t i, int steps = 3) const
  {
    std::vector<std::uint32_t> points;
    const int k = (std::min)(f_.cloud.k, tuning::normals::maximum_neighbors);
    for(int j = k / 2; steps > 0 && j < k && f_.cloud.row(i)[j] != no_index; j += steps > 1 ? 1 : 2) {
      points.push_back(f_.cloud.row(i)[j]);
      const std::vector<std::uint32_t> beyond = around(f_.cloud.row(i)[j], steps - 1);
      points.insert(points.end(), beyond.begin(), beyond.end());
    }
    return points;
  }

  // The mean of the distances to plane t, with their signs and at most epsilon, of the points of shape s around i; 0 if
  // it is at most a ratio of the mean of the absolute values.
  double mean_edge_side(std::uint32_t i, std::uint32_t s, std::uint32_t t) const
  {
    const double epsilon = double(f_.tolerance_of(i).distance);
    double sum = 0, size = 0;
    const auto add = [&](std::uint32_t q) {
      if(f_.label[q] != s)
        return;
      const double e = double(signed_distance(f_.plane[t], f_.point[q]));
      const double bounded = (std::max)(-epsilon, (std::min)(epsilon, e));
      sum += bounded;
      size += std::fabs(bounded);
    };
    for(std::uint32_t q : around(i))
      add(q);
    const tuning::Ratio ratio = tuning::edge_sides::clear_ratio;
    return double(ratio.denominator) * std::fabs(sum) > double(ratio.numerator) * size ? sum : 0;
  }

  bool is_aligned_naively(std::uint32_t s, std::uint32_t t) const
  {
    const Plane &a = f_.plane[s], &b = f_.plane[t];
    const double scale = normal_scale * normal_scale;
    return std::fabs(double(a.nx) * b.nx + double(a.ny) * b.ny + double(a.nz) * b.nz) / scale >=
           std::sqrt(double(f_.tolerance.squared_cosine) / 4294967296.);
  }

  // The label and the normal that point i takes.
  std::pair<std::uint32_t, std::uint32_t> choose_naively(std::uint32_t i) const
  {
    const std::uint32_t own = f_.label[i];
    std::uint32_t best = own, normal = f_.point[i].normal;
    std::set<std::uint32_t> seen = {own};
    f_.for_each_neighbor(i, [&](std::uint32_t q) {
      const std::uint32_t t = f_.label[q];
      if(own >= first_mark || t >= first_mark || !seen.insert(t).second ||
         f_.distance(t, i) > std::uint64_t(f_.tolerance_of(i).distance) || is_aligned_naively(best, t))
        return;
      const double of_best = mean_edge_side(i, best, t), of_t = mean_edge_side(i, t, best);
      const double to_t = double(signed_distance(f_.plane[t], f_.point[i])),
                   to_best = double(signed_distance(f_.plane[best], f_.point[i]));
      if(of_best != 0 && of_t != 0 && (of_t > 0 ? to_best : -to_best) > (of_best > 0 ? to_t : -to_t)) {
        best = t;
        normal = f_.point[q].normal;
      }
    });
    return {best, normal};
  }

private:
  const Fixture& f_;
};

BOOST_AUTO_TEST_CASE(bodies)
{
  for(const Fixture& f : fixtures()) {
    const std::uint32_t n = f.cloud.size;
    const Slow_edge_sides slow(f);
    const Edge_view view = {f.cloud, f.label.data(), f.plane.data(), f.tolerance};
    std::vector<std::uint32_t> side(n), normal_of_side(n);
    const std::vector<std::uint8_t> state(n, 0);
    std::size_t moved = 0;
    for(std::uint32_t i = 0; i < n; ++i) {
      std::tie(side[i], normal_of_side[i]) = slow.choose_naively(i);
      moved += side[i] != f.label[i];
    }
    CHECK_AT(n < 100 || moved > 20, f.name + ": hardly any point changes");
    on_body_backends([&](auto backend, const std::string& name) {
      const auto edge = backend.compact(n, Is_at_edge{view, state.data()});
      std::vector<std::uint32_t> chosen(n), normal(n);
      backend.for_each(n, Copy_items<std::uint32_t>{view.label, chosen.data()});
      backend.for_each(edge.size(), Choose_edge_side{view, edge.data(), chosen.data(), normal.data()});
      check_lists(chosen, side, name + ", " + f.name + ": sides");
      std::vector<Grid_point> point = f.point;
      backend.for_each(edge.size(), Take_normals{edge.data(), normal.data(), point.data()});
      for(std::uint32_t i = 0; i < n; ++i)
        CHECK_AT(point[i].normal == normal_of_side[i] && point[i].x == f.point[i].x,
                 name + ", " + f.name + ": normals");
    });
  }
}

BOOST_AUTO_TEST_SUITE_END()
