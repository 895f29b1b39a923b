// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfels of points with tolerances of their own, whose cubes are smaller by octaves: keys of the sort against cubes that
// are counted in plain arithmetic, the octree of all cubes, sizes of cells, tolerances of surfels, and which ones join.

#include "testing/body_fixture.h"
#include "testing/naive_side.h"

#include <CGAL/Tandem/internal/neighbors/join_surfels.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_surfel_octaves)

using namespace CGAL::Tandem::internal;
namespace scenes = CGAL::Tandem::scenes;

struct Leveled_points {
  std::vector<Grid_point> point;
  std::vector<std::uint8_t> level;
  Grid_point low, high;
};

// In a box of so many steps, around which two points are the corners. All levels of tolerances, and more of the small ones.
Leveled_points random_points(std::size_t n, int width, std::uint64_t seed)
{
  scenes::Random random(seed);
  Leveled_points p;
  p.low = {-width / 3, -width / 5, 7, no_normal};
  p.high = {p.low.x + width, p.low.y + width, p.low.z + width, no_normal};
  for(std::size_t i = 0; i < n; ++i) {
    const auto at = [&](std::int32_t from) { return from + std::int32_t(random.uniform() * (width + .999)); };
    const scenes::Vec d = random.direction();
    const std::int32_t x = at(p.low.x), y = at(p.low.y), z = at(p.low.z);
    p.point.push_back({x, y, z, i % 17 == 0 ? no_normal : encode_normal({d.x, d.y, d.z})});
    const double below = random.uniform() < .7 ? 50 : 255;
    p.level.push_back(std::uint8_t(random.uniform() * below));
  }
  return p;
}

// Heaps of points of one side and nearly one tolerance, many across the borders of cubes.
Leveled_points random_heaps(std::size_t heaps, const Surfel_cells& surfels, int width, std::uint64_t seed)
{
  scenes::Random random(seed);
  Leveled_points p = random_points(0, width, seed);
  for(std::size_t heap = 0; heap < heaps; ++heap) {
    const int octave = int(heap) % (surfels.octaves + 1);
    const double radius = std::ldexp(surfels.edge, -octave) / 4;
    const auto at = [&](std::int32_t from) { return from + radius + random.uniform() * (width - 2 * radius); };
    const double x = at(p.low.x), y = at(p.low.y), z = at(p.low.z);
    const scenes::Vec d = random.direction();
    for(int i = 0; i < 20; ++i) {
      const auto near = [&](double v) { return std::int32_t(v + radius * (2 * random.uniform() - 1)); };
      const std::int32_t px = near(x), py = near(y), pz = near(z);
      p.point.push_back({px, py, pz, encode_normal({d.x, d.y, d.z})});
      p.level.push_back(std::uint8_t(octave == 0 ? 0 : 8 * octave - int(random.bits() % 8)));
    }
  }
  return p;
}

// A cube is no larger for a point than its tolerance needs: 2^-octave is at most the tolerance, in epsilons.
int naive_octave(std::uint8_t level, int octaves) { return (std::min)(int(std::ceil(level / 8.)), octaves); }

// x, y, z of the cube of an octave.
using Cube = std::array<std::int64_t, 3>;

Cube cube_of(const Grid_point& p, const Grid_point& low, double edge, int octave)
{
  const auto at = [&](std::int32_t v, std::int32_t from) {
    return std::int64_t(std::floor((double(v) - from) * (1 / edge) * std::pow(2, octave)));
  };
  return {at(p.x, low.x), at(p.y, low.y), at(p.z, low.z)};
}

struct Case {
  double edge;
  int octaves, width;
  std::size_t points;
};

// Two points have one key if they have one octave, one cube of it and one side, and else they have not.
void test_keys(const Case& c, const std::string& name)
{
  const Leveled_points p = random_points(c.points, c.width, 3);
  const Code_frame frame = make_code_frame(p.low, p.high, {c.edge, c.octaves});
  CHECK_AT(frame.has_surfels(), name);
  std::map<std::array<std::int64_t, 5>, std::uint64_t> key_of_surfel;
  std::map<std::uint64_t, int> surfels_of_key;
  for(std::size_t i = 0; i < p.point.size(); ++i) {
    const int octave = naive_octave(p.level[i], c.octaves);
    const Cube cube = cube_of(p.point[i], p.low, c.edge, octave);
    const std::uint64_t key = frame.code(p.point[i], p.level[i]);
    const auto added = key_of_surfel.emplace(
      std::array<std::int64_t, 5>{octave, cube[0], cube[1], cube[2], naive_side(p.point[i])}, key);
    CHECK_AT(added.first->second == key, name + ": points of a surfel have two keys");
    surfels_of_key[key] += added.second;
  }
  for(const auto& k : surfels_of_key)
    CHECK_AT(k.second == 1, name + ": two surfels have one key");
  CHECK_AT(c.points < 7000 || key_of_surfel.size() < c.points, name + ": no surfel has two points");
}

// Keys ascend along an octree of cubes: those of a cube, of all smaller ones within and of their points are consecutive,
// and only keys of larger cubes that contain it may be among them.
void test_octree(const Case& c, const std::string& name)
{
  const Leveled_points p = random_points(c.points, c.width, 4);
  const Code_frame frame = make_code_frame(p.low, p.high, {c.edge, c.octaves});
  std::vector<std::uint64_t> key;
  for(std::size_t i = 0; i < p.point.size(); ++i)
    key.push_back(frame.code(p.point[i], p.level[i]));
  for(int octave = 0; octave <= c.octaves; ++octave) {
    std::map<Cube, std::pair<std::uint64_t, std::uint64_t>> keys_of; // the first and the last one
    for(std::size_t i = 0; i < key.size(); ++i)
      if(naive_octave(p.level[i], c.octaves) >= octave) {
        auto& k =
          keys_of.emplace(cube_of(p.point[i], p.low, c.edge, octave), std::make_pair(key[i], key[i])).first->second;
        k = {(std::min)(k.first, key[i]), (std::max)(k.second, key[i])};
      }
    std::map<std::uint64_t, std::pair<std::uint64_t, Cube>> by_first;
    for(const auto& k : keys_of)
      by_first[k.second.first] = {k.second.second, k.first};
    CHECK_AT(by_first.size() == keys_of.size(), name);
    std::uint64_t end = 0;
    for(const auto& k : by_first) {
      CHECK_AT(k.first >= end, name + ": keys of two cubes of octave " + std::to_string(octave));
      end = k.second.first + 1;
    }
    for(std::size_t i = 0; i < key.size(); ++i) {
      const auto after = by_first.upper_bound(key[i]);
      if(after == by_first.begin() || std::prev(after)->second.first < key[i])
        continue;
      const int own = (std::min)(octave, naive_octave(p.level[i], c.octaves));
      Cube cube = std::prev(after)->second.second;
      for(std::int64_t& v : cube)
        v >>= octave - own;
      CHECK_AT(cube == cube_of(p.point[i], p.low, c.edge, own), name + ": a key within those of another cube");
    }
  }
}

// What the engine makes of the points.
template <class Backend>
struct Surfel_cloud {
  Sorted_cloud<Backend> cloud;
  std::vector<Range> ranges; // of surfels

  Surfel_cloud(Backend& backend, const Leveled_points& p, const Surfel_cells& surfels, std::size_t cell_size)
  {
    using Table = typename Backend::Sort_table::View;
    const std::size_t n = p.point.size();
    const Code_frame frame = make_code_frame(p.low, p.high, surfels);
    const auto sorted = sort_along_curve(backend, {p.point.data(), n, p.level.data()}, frame);
    auto cells = to_buffer(backend, split_cells(backend, sorted, frame, cell_size));
    cloud.has_levels = true;
    cloud.order.reset(n);
    cloud.all_points.reset(n);
    cloud.level_of_point.reset(n);
    backend.for_each(n,
                     Gather_points<Table>{sorted.view(),
                                          {p.point.data(), nullptr, p.level.data()},
                                          {cloud.all_points.data(), cloud.order.data(), cloud.level_of_point.data()}});
    make_surfels(backend, sorted, cloud, cells);
    ranges = to_vector(backend, cells);
  }
};

// The level of a surfel is that of its smallest tolerance, and its points have one octave.
template <class Backend>
void check_levels(Surfel_cloud<Backend>& s, const Leveled_points& p, int octaves, const std::string& name)
{
  const Surfels_view surfels = s.cloud.surfels();
  std::size_t larger = 0;
  for(std::uint32_t i = 0; i < s.cloud.size(); ++i) {
    std::uint8_t largest = 0;
    for(std::uint32_t q = surfels.points(i).first; q < surfels.points(i).last; ++q) {
      const std::uint8_t level = p.level[s.cloud.order.data()[q]];
      CHECK_AT(surfels.level_of_point(q) == level, name + ": level of a point");
      CHECK_AT(naive_octave(level, octaves) == naive_octave(s.cloud.levels()[i], octaves),
               name + ": octave of a point");
      larger += level > p.level[s.cloud.order.data()[surfels.points(i).first]];
      largest = (std::max)(largest, level);
    }
    CHECK_AT(s.cloud.levels()[i] == largest, name + ": level of a surfel");
  }
  CHECK_AT(larger > 0, name + ": all points of a surfel have one level");
}

// No cell has more surfels than it may have, where cubes of all octaves have points, and most all sides.
template <class Backend>
void test_cell_sizes(Backend& backend, const std::string& name)
{
  for(const int octaves : {0, 1, 2, 4})
    for(const std::size_t cell_size : {50u, 64u, 80u, 300u, 8192u}) {
      const std::string where = name + ", " + std::to_string(octaves) + " octaves, " + std::to_string(cell_size);
      // Eight cubes of the largest edge for two octaves, one for four.
      const double edge = octaves == 4 ? 4000 : 2000;
      const Leveled_points p = random_points(40000, 3999, std::uint64_t(octaves));
      Surfel_cloud<Backend> s(backend, p, {edge, octaves}, cell_size);
      std::uint32_t next = 0, most_points = 0;
      for(const Range& cell : s.ranges) {
        CHECK_AT(cell.first == next && cell.size() > 0, where + ": cells follow each other");
        next = cell.last;
        CHECK_AT(cell.size() <= cell_size, where + ": surfels of a cell: " + std::to_string(cell.size()));
        const Surfels_view surfels = s.cloud.surfels();
        most_points = (std::max)(most_points, surfels.points(cell.last - 1).last - surfels.points(cell.first).first);
      }
      check_equal(std::size_t(next), s.cloud.size(), where + ": cells have all surfels");
      CHECK_AT(most_points > cell_size || octaves > 1 || cell_size > 5000, where + ": no crowd");
      check_levels(s, p, octaves, where);
    }
}

// Surfels join the heaviest neighbor of the same octave and side that is nearer to all points of both than its edge.
std::uint32_t naive_target(const Cloud_view& cloud, const Surfel_cells& cells, std::uint32_t i, const Range& cell)
{
  const int octave = naive_octave(cloud.level_of(i), cells.octaves);
  const double edge = std::floor(std::floor(cells.edge) / std::pow(2, octave));
  std::uint32_t best = i;
  const auto size = [&](std::uint32_t s) { return cloud.surfels.points(s).size(); };
  for(const std::uint32_t* q = cloud.row(i); q != cloud.row(i) + cloud.k && *q != no_index; ++q) {
    const std::uint32_t j = *q;
    if(j < cell.first || j >= cell.last || naive_octave(cloud.level_of(j), cells.octaves) != octave ||
       naive_side(cloud.point[j]) != naive_side(cloud.point[i]))
      continue;
    bool are_near = true;
    for(const std::uint32_t s : {i, j})
      for(std::uint32_t p = cloud.surfels.points(s).first; p < cloud.surfels.points(s).last; ++p) {
        const Grid_point &a = cloud.surfels.point[p], &b = cloud.point[j];
        are_near = are_near && std::hypot(double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z) < edge;
      }
    if(are_near && (size(j) > size(best) || (size(j) == size(best) && j < best)))
      best = j;
  }
  return best;
}

template <class Backend>
void test_targets(Backend& backend, const std::string& name)
{
  const int octaves = 3;
  const Surfel_cells surfels = {1000.7, octaves};
  const Leveled_points p = random_heaps(400, surfels, 9000, 8);
  Surfel_cloud<Backend> s(backend, p, surfels, 300);
  const std::uint32_t size = std::uint32_t(s.cloud.size());
  s.cloud.k = 12;
  s.cloud.neighbor.reset(size * std::size_t(s.cloud.k));
  find_neighbors(backend, s.cloud.point.data(), size, s.cloud.k, s.cloud.neighbor.data());
  const auto cells = to_buffer(backend, s.ranges);
  auto target = filled_buffer(backend, size, no_index);
  const Cloud_view cloud = s.cloud.view();
  backend.template for_each_cell<No_scratch>(cells.size(),
                                             Choose_target{{cloud, surfels}, cells.data(), target.data()});
  std::array<int, octaves + 1> joined = {};
  for(const Range& cell : s.ranges)
    for(std::uint32_t i = cell.first; i < cell.last; ++i) {
      check_equal(target.data()[i], naive_target(cloud, surfels, i, cell), name + ": what a surfel joins");
      joined[std::size_t(naive_octave(cloud.level_of(i), octaves))] += target.data()[i] != i;
    }
  for(int octave = 0; octave <= octaves; ++octave)
    CHECK_AT(joined[std::size_t(octave)] > 0, name + ": none joins in octave " + std::to_string(octave));
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  constexpr int most = CGAL::Tandem::internal::tuning::grid::maximum_octaves;
  const Case cases[] = {{1000, 0, 9000, 5000},
                        {1000.7, 1, 9000, 8000},
                        {2000, 3, 9000, 20000},
                        {333.3, 5, 1500, 40000},
                        {4e6, most, 200000000, 6000}};
  for(const Case& c : cases) {
    const std::string name = "edge " + std::to_string(c.edge) + ", " + std::to_string(c.octaves) + " octaves";
    test_keys(c, name);
    test_octree(c, name);
  }
  on_body_backends([](auto backend, const std::string& name) {
    test_cell_sizes(backend, name);
    test_targets(backend, name);
  });
}

BOOST_AUTO_TEST_SUITE_END()
