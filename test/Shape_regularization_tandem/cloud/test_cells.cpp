// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Hilbert curve: a bijection, octants are contiguous ranges at every level, and consecutive codes belong to
// positions that share a face. The cells of the octree along it, and the blocks that have neighbors of a block. The
// exact check at the bounds.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/cloud/Block_rows.h>
#include <CGAL/Tandem/internal/engine/prepare.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_cells)

using namespace CGAL::Tandem::internal;
using scenes::Random;

using Position = std::array<std::uint32_t, 3>;

constexpr std::uint32_t end_of_curve = 1u << curve_bits;

// The cube of 2^bits octants an axis, of 2^level positions an axis, that has a random position: its codes are a range,
// each octant has a range of them, whatever the position in it is, and consecutive octants share a face.
void check_cube(Random& random, int bits, int level)
{
  const auto below = [&](std::uint32_t n) { return std::uint32_t(random.bits() % n); };
  const std::uint32_t width = 1u << bits, cubes = end_of_curve >> (bits + level);
  const std::size_t count = std::size_t(1) << (3 * bits);
  const Position corner = {width * below(cubes), width * below(cubes), width * below(cubes)}; // in octants
  const auto code = [&](const Position& p) {
    const auto at = [&](int axis) { return p[std::size_t(axis)] << level | below(1u << level); };
    return hilbert_code(at(0), at(1), at(2)) >> (3 * level);
  };
  const std::string where = std::to_string(bits) + " bits at level " + std::to_string(level);
  const std::uint64_t first = code(corner) & ~std::uint64_t(count - 1);
  std::vector<Position> at(count);
  std::vector<char> seen(count, 0);
  for(std::uint32_t i = 0; i < count; ++i) {
    const Position p = {corner[0] + (i & (width - 1)), corner[1] + (i >> bits & (width - 1)),
                        corner[2] + (i >> 2 * bits)};
    const std::uint64_t offset = code(p) - first;
    CHECK_AT(offset < count && !seen[offset], where + ": code used twice, or outside of the range of its cube");
    if(offset >= count)
      return;
    seen[offset] = 1;
    at[offset] = p;
  }
  for(std::size_t i = 1; i < count; ++i) {
    int steps = 0;
    for(std::size_t axis = 0; axis < 3; ++axis)
      steps += std::abs(int(at[i - 1][axis]) - int(at[i][axis]));
    CHECK_AT(steps == 1, where + ": consecutive codes are not face neighbors");
  }
}

BOOST_AUTO_TEST_CASE(cubes_of_the_curve)
{
  CHECK(hilbert_code(0, 0, 0) == 0);
  Random random(4242);
  for(int level = 0; level + 3 <= curve_bits; ++level)
    for(int repeat = 0; repeat < 10; ++repeat)
      check_cube(random, 3, level);
  check_cube(random, 6, 0);
}

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
  check_ranges(cells, points.size(), cell_size, name);
  for(const Range& cell : cells) {
    Box box;
    for(std::uint32_t i = cell.first; i < cell.last; ++i)
      box.add(points[order.view().index(i)]);
    for(int a = 0; a < 3; ++a)
      CHECK_AT(std::int64_t(box.high[a]) - box.low[a] <= std::int64_t(1) << cell_extent_bits,
               name + ", cell at " + std::to_string(cell.first));
  }
}

BOOST_AUTO_TEST_CASE(cells)
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

// Cells of surfels have all points also where the cloud is narrower than its largest cells, whose codes have marks.
BOOST_AUTO_TEST_CASE(cells_of_small_clouds)
{
  Sequential_backend backend;
  Random random(8);
  const int levels = CGAL::Tandem::internal::levels_per_octave;
  for(const int octaves : {0, 2, 6})
    for(const int bits : {0, 3, 5})
      for(const std::size_t cell_size : {std::size_t(16), std::size_t(4096)}) {
        std::vector<Grid_point> points;
        std::vector<std::uint8_t> level;
        for(int i = 0; i < 3000; ++i) {
          points.push_back(random_point(random, bits));
          level.push_back(std::uint8_t(i % 2 == 0 ? 0 : octaves * levels));
        }
        const std::string name = std::to_string(octaves) + " octaves, " + std::to_string(bits) + " bits";
        Grid_point low = points[0], high = low;
        for(const Grid_point& p : points) {
          low = {(std::min)(low.x, p.x), (std::min)(low.y, p.y), (std::min)(low.z, p.z), no_normal};
          high = {(std::max)(high.x, p.x), (std::max)(high.y, p.y), (std::max)(high.z, p.z), no_normal};
        }
        const Code_frame frame = make_code_frame(low, high, {std::ldexp(1., octaves), octaves});
        CHECK_AT(frame.has_surfels(), name);
        const auto order = sort_along_curve(backend, {points.data(), points.size(), level.data()}, frame);
        check_ranges(split_cells(backend, order, frame, cell_size), points.size(), points.size(), name);
      }
}

using Blocks = std::set<std::uint32_t>;

// The blocks that points of each block have neighbors in, against sets of them. A row that has overflown has more
// blocks than fit. Another rank has the points from `own` on, which are in blocks, too. Returns how many rows are
// listed, and how many are not.
template <class Backend>
std::array<int, 2> check_rows(Backend& backend, const std::string& name, const Fixture& f, std::uint32_t own)
{
  Labeled_cloud<Backend> points(backend);
  take_cloud(f, points);
  points.cloud.ghosts = f.point.size() - own;
  const Block_rows<Backend> blocks(backend, points.cloud);
  const std::vector<Block_row> row = to_vector(backend, blocks.row);
  const std::vector<Block_entries> entries = to_vector(backend, blocks.of_surfel);
  check_equal(entries.size(), std::size_t(own), name + ": number of points");
  check_equal(row.size(), std::size_t((own + 63) / 64), name + ": number of blocks");
  std::vector<Blocks> expected(row.size());
  for(std::uint32_t i = 0; i < own; ++i) {
    const Block_row& of_point = row[i / 64];
    expected[i / 64].insert(i / 64);
    Block_entries of_neighbors = 1; // its own block, and those of its neighbors
    f.for_each_neighbor(i, [&](std::uint32_t j) {
      expected[i / 64].insert(j / 64);
      of_neighbors = Block_entries(of_neighbors | of_point.entry(j / 64));
    });
    // Where the row is not listed others may be among them.
    CHECK_AT(of_point.size <= Block_row::capacity ? entries[i] == of_neighbors : (entries[i] & 1) != 0,
             name + ": entries of point " + std::to_string(i));
  }
  std::array<int, 2> number = {};
  for(std::size_t b = 0; b < row.size(); ++b) {
    const bool is_listed = expected[b].size() <= Block_row::capacity;
    ++number[is_listed ? 0 : 1];
    CHECK_AT(is_listed
               ? row[b].size == expected[b].size() && Blocks(row[b].block, row[b].block + row[b].size) == expected[b]
               : row[b].size > Block_row::capacity,
             name + ": row of block " + std::to_string(b));
  }
  return number;
}

// Some blocks have neighbors anywhere, from none to more than a row has.
BOOST_AUTO_TEST_CASE(rows_of_blocks)
{
  on_fixtures([](auto& backend, const std::string& name, Fixture f) {
    const std::uint32_t size = f.cloud.size;
    for(std::uint32_t i = 0; i < size; ++i)
      if(i % 64 < i / 64 % 40)
        f.neighbor[i * std::size_t(f.cloud.k)] = std::uint32_t(std::uint64_t(i) * 7919 % size);
    f.cloud.neighbor = f.neighbor.data();
    const std::array<int, 2> all = check_rows(backend, name, f, size),
                             own = check_rows(backend, name + ", ghosts", f, size - size / 3);
    CHECK_AT(size < 1000 || (all[0] > 10 && all[1] > 2 && own[0] > 2 && own[1] > 0),
             name + ": rows that are listed, or not");
  });
}

// The filter may only pass points that are within the bounds, and nothing that is clearly within is freed.
BOOST_AUTO_TEST_CASE(exact_check)
{
  Random random(7);
  Import in;
  in.grid.step = std::ldexp(1, -12);
  in.grid.origin = {4000 + 5 * in.grid.step, -777, 13};
  Parameters parameters = make_parameters(1.3 * 1024 * in.grid.step, 10);
  const Stage_parameters options = make_stage_parameters(in, parameters);
  const double epsilon = parameters.maximum_distance;
  Sequential_backend backend;
  int kept = 0, freed = 0;
  for(int i = 0; i < 20000; ++i) {
    using Real = long double;
    const scenes::Vec n = random.direction(), tilt = unit(add_scaled(n, .9 * random.uniform(), random.direction())),
                      u = unit(cross(n, scenes::Vec{n.y, n.z, -n.x}));
    const Regular_plane plane = {{n.x, n.y, n.z}, 1e6 * (random.uniform() - .5)};
    const auto c = to_caller(plane, in.grid);
    // Exactly on the bound, up to rounding, or near it by a few grid steps.
    const double off = epsilon + (i % 3 == 0 ? 0 : 1e-3 * epsilon * random.gaussian());
    const scenes::Vec origin = {in.grid.origin.x, in.grid.origin.y, in.grid.origin.z},
                      at = origin + (in.grid.step * plane.offset + off) * n + 100 * random.uniform() * u;
    const double p[3] = {at.x, at.y, at.z}, normal[3] = {tilt.x, tilt.y, tilt.z};
    const Grid_point g =
      to_grid(in.grid, 1 / in.grid.step, {p[0], p[1], p[2]}, encode_normal({tilt.x, tilt.y, tilt.z}));
    const std::uint32_t index = 0;
    std::uint32_t label = 0;
    const Plane integer = rounded(plane);
    check_exactly(backend, 1, {{{&g, nullptr, nullptr}, &integer, options.certain}, &label, &index},
                  {{p, false}, {normal, false}, &c, options.exact});
    Real e = c[3], cosine = 0;
    for(int a = 0; a < 3; ++a) {
      e += Real(c[a]) * p[a];
      cosine += Real(c[a]) * normal[a];
    }
    const Real least = std::cos(25 * 3.14159265358979323846L / 180);
    const std::string where = "point " + std::to_string(i);
    if(label == 0)
      CHECK_AT(std::fabs(e) <= Real(epsilon) && std::fabs(cosine) >= least, where + " is kept");
    else
      CHECK_AT(std::fabs(e) > Real(epsilon) * (1 - 1e-9L) || std::fabs(cosine) < least + 1e-6L, where + " is freed");
    (label == 0 ? kept : freed) += 1;
  }
  CHECK(kept > 1000 && freed > 1000);
}

// With any instruction set: of a plane through the origin, no negative zero.
BOOST_AUTO_TEST_CASE(zero_offset)
{
  Grid grid = {};
  grid.step = .5;
  grid.origin = {7, 0, 1};
  const auto c = to_caller(Regular_plane{{0, 0, 1}, -2}, grid);
  CHECK(c[2] == 1 && c[3] == 0 && !std::signbit(c[3]));
}

BOOST_AUTO_TEST_SUITE_END()
