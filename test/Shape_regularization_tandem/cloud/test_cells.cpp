// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first and the last step between the caller's points and the engine: the cells
// of the octree, and the exact check at the bounds.

#include "testing/random_points.h"
#include "testing/test_support.h"

#include <CGAL/Tandem/internal/engine/prepare.h>

BOOST_AUTO_TEST_SUITE(test_cells)

using namespace CGAL::Tandem::internal;
using scenes::Random;

// Cells are consecutive, not too large, not too wide.
void check_cells(const std::vector<Grid_point>& points, std::size_t cell_size, const std::string& name)
{
  Sequential_backend backend;
  const Code_frame frame = make_code_frame(points.data(), points.size());
  auto order = sort_along_curve(backend, {points.data(), points.size()}, frame);
  const std::vector<Range> cells = split_cells(backend, order, frame, cell_size);
  std::vector<int> seen(points.size(), 0);
  for(const auto& entry : order)
    ++seen[entry.index];
  CHECK_AT(std::count(seen.begin(), seen.end(), 1) == long(seen.size()), name + ": the order is no permutation");
  std::uint32_t next = 0;
  for(const Range& cell : cells) {
    CHECK_AT(cell.first == next && cell.size() > 0 && cell.size() <= cell_size,
             name + ", cell at " + std::to_string(cell.first));
    next = cell.last;
    Box box;
    for(std::uint32_t i = cell.first; i < cell.last; ++i)
      box.add(points[order.view().index(i)]);
    for(int a = 0; a < 3; ++a)
      CHECK_AT(std::int64_t(box.high[a]) - box.low[a] <= std::int64_t(1) << cell_extent_bits,
               name + ", cell at " + std::to_string(cell.first));
  }
  CHECK_AT(next == points.size(), name + ": the cells end at " + std::to_string(next));
}

BOOST_AUTO_TEST_CASE(test_cells)
{
  Random random(6);
  for(int bits : {0, 2, 10, 22, 28})
    for(std::size_t cell_size : {std::size_t(64), std::size_t(1000)}) {
      std::vector<Grid_point> points;
      for(int i = 0; i < 5000; ++i)
        points.push_back(random_point(random, bits));
      check_cells(points, cell_size, std::to_string(bits) + " bits");
      points.insert(points.end(), 3000, points[0]); // more equal points than a cell may have
      check_cells(points, cell_size, std::to_string(bits) + " bits and duplicates");
    }
  check_cells({random_point(random, 28)}, 64, "one point");
}

// The filter may only pass points that are within the bounds, and nothing that is clearly within is freed.
BOOST_AUTO_TEST_CASE(test_exact_check)
{
  Random random(7);
  Import in;
  in.grid.step = std::ldexp(1, -12);
  in.grid.origin = {4000 + 5 * in.grid.step, -777, 13};
  Parameters parameters = make_parameters(1.3 * 1024 * in.grid.step, 10);
  const Options options = make_options(in, parameters);
  const double epsilon = parameters.maximum_distance;
  Sequential_backend backend;
  int kept = 0, freed = 0;
  for(int i = 0; i < 20000; ++i) {
    const scenes::Vec n = random.direction(), tilt = unit(add_scaled(n, .9 * random.uniform(), random.direction()));
    const Regular_plane plane = {{n.x, n.y, n.z}, 1e6 * (random.uniform() - .5)};
    const auto c = to_caller(plane, in.grid);
    const scenes::Vec u = unit(cross(n, scenes::Vec{n.y, n.z, -n.x}));
    // Exactly on the bound, up to rounding, or near it by a few grid steps.
    const double off = epsilon + (i % 3 == 0 ? 0 : 1e-3 * epsilon * random.gaussian());
    const double along = 100 * random.uniform();
    double p[3];
    for(int a = 0; a < 3; ++a) {
      const double na = a == 0 ? n.x : a == 1 ? n.y : n.z, ua = a == 0 ? u.x : a == 1 ? u.y : u.z;
      const double oa = a == 0 ? in.grid.origin.x : a == 1 ? in.grid.origin.y : in.grid.origin.z;
      p[a] = oa + in.grid.step * plane.offset * na + off * na + along * ua;
    }
    const double normal[3] = {tilt.x, tilt.y, tilt.z};
    const Grid_point g =
      to_grid(in.grid, 1 / in.grid.step, {p[0], p[1], p[2]}, encode_normal({tilt.x, tilt.y, tilt.z}));
    const std::uint32_t origin = 0;
    std::uint32_t label = 0;
    const Plane integer = rounded(plane);
    check_exactly(backend, {{&g, nullptr, nullptr}, &origin, &label, 1}, &integer, options.certain,
                  {{{p, false}, {normal, false}}, &c, options.exact});
    const long double e =
      (long double)(c[0]) * p[0] + (long double)(c[1]) * p[1] + (long double)(c[2]) * p[2] + (long double)(c[3]);
    const long double cosine =
      std::fabs((long double)(c[0]) * normal[0] + (long double)(c[1]) * normal[1] + (long double)(c[2]) * normal[2]);
    const long double least = std::cos(25 * 3.14159265358979323846L / 180);
    const std::string where = "point " + std::to_string(i);
    if(label == 0)
      CHECK_AT(std::fabs(e) <= (long double)(epsilon) && cosine >= least, where + " is kept");
    else
      CHECK_AT(std::fabs(e) > (long double)(epsilon) * (1 - 1e-9L) || cosine < least + 1e-6L, where + " is freed");
    (label == 0 ? kept : freed) += 1;
  }
  CHECK(kept > 1000 && freed > 1000);
}

// With any instruction set: of a plane through the origin, no negative zero.
BOOST_AUTO_TEST_CASE(test_zero_offset)
{
  Grid grid = {};
  grid.step = .5;
  grid.origin = {7, 0, 1};
  const auto c = to_caller(Regular_plane{{0, 0, 1}, -2}, grid);
  CHECK(c[2] == 1 && c[3] == 0 && !std::signbit(c[3]));
}

BOOST_AUTO_TEST_SUITE_END()
