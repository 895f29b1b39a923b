// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfels against a map of cubes that are counted in plain arithmetic, of points with one tolerance and with tolerances
// of their own, whose cubes are smaller by octaves: which points surfels have, where they are, their normals and
// levels, the cells that they are in, and which ones join.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/engine/connect_cloud.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_surfels)

using namespace CGAL::Tandem::internal;
namespace scenes = CGAL::Tandem::scenes;

struct Leveled_points {
  std::vector<Grid_point> point;
  std::vector<std::uint8_t> level;
  Grid_point low, high;
};

struct Case {
  Surfel_cells cells;
  int width;
  std::size_t points;
  bool has_normals;

  std::string text() const
  {
    return "width " + std::to_string(cells.width_steps) + ", " + std::to_string(cells.octaves) + " octaves" +
           (has_normals ? "" : ", no normals");
  }
};

// In a box of so many steps, around which two points are the corners; some are copies of others or near to them. All
// levels of tolerances, and more of the small ones.
Leveled_points random_points(const Case& c)
{
  scenes::Random random(std::uint64_t(c.points) + std::uint64_t(c.cells.octaves));
  Leveled_points p;
  p.low = {-2 * (c.width / 3), -c.width / 5, 7, no_normal};
  p.high = {p.low.x + c.width, p.low.y + c.width, p.low.z + c.width, no_normal};
  for(std::size_t i = 0; i < c.points; ++i) {
    if(i > 0 && random.uniform() < .3) {
      const std::size_t other = std::size_t(random.uniform() * double(i));
      p.level.push_back(p.level[other]);
      p.point.push_back(p.point[other]);
      p.point.back().x = (std::min)(p.point.back().x + std::int32_t(random.uniform() * 9), p.high.x);
      continue;
    }
    const auto at = [&](std::int32_t from) { return from + std::int32_t(random.uniform() * (c.width + .999)); };
    const scenes::Vec d = random.direction();
    const std::int32_t x = at(p.low.x), y = at(p.low.y), z = at(p.low.z);
    p.point.push_back({x, y, z, !c.has_normals || i % 17 == 0 ? no_normal : encode_normal({d.x, d.y, d.z})});
    const double below = random.uniform() < .7 ? 50 : 255;
    p.level.push_back(std::uint8_t(random.uniform() * below));
  }
  return p;
}

// Clusters of points of one face and nearly one tolerance, many across the borders of cubes.
Leveled_points random_clusters(std::size_t clusters, const Surfel_cells& surfels, int width, std::uint64_t seed)
{
  scenes::Random random(seed);
  Leveled_points p = random_points({surfels, width, 0, true});
  for(std::size_t cluster = 0; cluster < clusters; ++cluster) {
    const int octave = int(cluster) % (surfels.octaves + 1);
    const double radius = std::ldexp(surfels.width_steps, -octave) / 4;
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

// The axis and sign of the largest component of the normal.
int naive_face(const Grid_point& p)
{
  const Int_vector n = decode_normal(p.normal);
  const int v[] = {n.x, n.y, n.z};
  const int* const largest = std::max_element(v, v + 3, [](int a, int b) { return std::abs(a) < std::abs(b); });
  return 2 * int(largest - v) + (*largest < 0);
}

// x, y, z of the cube of an octave.
using Cube = std::array<std::int64_t, 3>;

Cube cube_of(const Grid_point& p, const Grid_point& low, double width, int octave)
{
  const auto at = [&](std::int32_t v, std::int32_t from) {
    return std::int64_t(std::floor((double(v) - from) * (1 / width) * std::pow(2, octave)));
  };
  return {at(p.x, low.x), at(p.y, low.y), at(p.z, low.z)};
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

// The surfels that points have: for each octave, cube and face.
using Key = std::array<std::int64_t, 5>;

Key key_of(const Grid_point& p, std::uint8_t level, const Grid_point& low, const Surfel_cells& cells)
{
  const int octave = naive_octave(level, cells.octaves);
  const Cube cube = cube_of(p, low, cells.width_steps, octave);
  return {octave, cube[0], cube[1], cube[2], naive_face(p)};
}

// Its points are those of its key, it is at their mean, with the mean of their normals and the level of the smallest
// tolerance.
template <class Backend>
void check_surfel(Surfel_cloud<Backend>& s, std::uint32_t i, const Leveled_points& p, const Surfel_cells& cells,
                  const std::map<Key, std::size_t>& size, const std::string& name)
{
  const Surfels_view surfels = s.cloud.surfels();
  const Range range = surfels.points(i);
  const std::uint32_t* order = s.cloud.order.data();
  const Grid_point& front = p.point[order[range.first]];
  const Key key = key_of(front, p.level[order[range.first]], p.low, cells);
  check_equal(std::size_t(range.size()), size.at(key), name + ": points of a surfel");
  Vector sum = {0, 0, 0}, normal = {0, 0, 0};
  std::uint8_t largest = 0;
  for(std::uint32_t q = range.first; q < range.last; ++q) {
    const Grid_point& point = p.point[order[q]];
    const std::uint8_t level = p.level[order[q]];
    CHECK_AT(surfels.of_point(q) == i, name + ": surfel of a point");
    CHECK_AT(surfels.level_of_point(q) == level, name + ": level of a point");
    CHECK_AT(key_of(point, level, p.low, cells) == key, name + ": points of one octave, cube and face");
    CHECK_AT(std::memcmp(&surfels.point[q], &point, sizeof point) == 0, name + ": order of the points");
    const Int_vector v = decode_normal(point.normal);
    sum = sum + Vector{double(point.x), double(point.y), double(point.z)};
    normal = normal + Vector{double(v.x), double(v.y), double(v.z)};
    largest = (std::max)(largest, level);
  }
  const Grid_point& center = s.cloud.point.data()[i];
  const auto mean = [&](double v) { return std::int32_t(std::floor(v / range.size() + .5)); };
  CHECK_AT(center.x == mean(sum.x) && center.y == mean(sum.y) && center.z == mean(sum.z), name + ": centroid");
  CHECK_AT(center.normal ==
             (front.normal == no_normal || range.size() == 1 ? front.normal : encode_normal(unit(normal))),
           name + ": mean normal");
  CHECK_AT(s.cloud.levels()[i] == largest, name + ": level of a surfel");
}

template <class Backend>
void check_surfels(Backend& backend, const std::string& of, const Case& c, const Leveled_points& p)
{
  const std::string name = of + ", " + c.text();
  Surfel_cloud<Backend> s(backend, p, c.cells, 64);
  std::map<Key, std::size_t> size;
  for(std::size_t i = 0; i < p.point.size(); ++i)
    ++size[key_of(p.point[i], p.level[i], p.low, c.cells)];
  check_equal(s.cloud.number_of_surfels(), size.size(), name + ": number of surfels");
  check_equal(s.cloud.number_of_points(), c.points, name + ": number of points");
  for(std::uint32_t i = 0; i < s.cloud.number_of_surfels(); ++i)
    check_surfel(s, i, p, c.cells, size, name);
  check_ranges(s.ranges, s.cloud.number_of_surfels(), 64, name);
}

BOOST_AUTO_TEST_CASE(surfels_of_cubes)
{
  constexpr int most = CGAL::Tandem::internal::tuning::grid::maximum_octaves;
  const Case cases[] = {{{.7, 0}, 20000, 100, true},     {{333.25, 0}, 20000, 2000, true},
                        {{1000, 0}, 9000, 5000, true},   {{1000, 0}, 9000, 5000, false},
                        {{60000, 0}, 20000, 2000, true}, {{1000.7, 1}, 9000, 8000, true},
                        {{2000, 3}, 9000, 20000, true},  {{333.3, 5}, 1500, 20000, true},
                        {{333.3, 5}, 1500, 5000, false}, {{4e6, most}, 200000000, 6000, true}};
  for(const Case& c : cases) {
    const Leveled_points p = random_points(c);
    on_body_backends([&](auto backend, const std::string& name) { check_surfels(backend, name, c, p); });
  }
}

// Surfels join the heaviest neighbor of the same octave and face that is nearer to all points of both than its width.
std::uint32_t naive_target(const Cloud_view& cloud, const Surfel_cells& cells, std::uint32_t i, const Range& cell)
{
  const int octave = naive_octave(cloud.level_of(i), cells.octaves);
  const double width = std::floor(std::floor(cells.width_steps) / std::pow(2, octave));
  std::uint32_t best = i;
  const auto size = [&](std::uint32_t s) { return cloud.surfels.points(s).size(); };
  for(const std::uint32_t* q = cloud.row(i); q != cloud.row(i) + cloud.k && *q != no_index; ++q) {
    const std::uint32_t j = *q;
    if(j < cell.first || j >= cell.last || naive_octave(cloud.level_of(j), cells.octaves) != octave ||
       naive_face(cloud.point[j]) != naive_face(cloud.point[i]))
      continue;
    bool are_near = true;
    for(const std::uint32_t s : {i, j})
      for(std::uint32_t p = cloud.surfels.points(s).first; p < cloud.surfels.points(s).last; ++p) {
        const Grid_point &a = cloud.surfels.point[p], &b = cloud.point[j];
        are_near = are_near && std::hypot(double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z) < width;
      }
    if(are_near && (size(j) > size(best) || (size(j) == size(best) && j < best)))
      best = j;
  }
  return best;
}

BOOST_AUTO_TEST_CASE(targets_of_joins)
{
  const int octaves = 3;
  const Surfel_cells surfels = {1000.7, octaves};
  const Leveled_points p = random_clusters(400, surfels, 9000, 8);
  on_body_backends([&](auto backend, const std::string& name) {
    Surfel_cloud<decltype(backend)> s(backend, p, surfels, 300);
    const std::uint32_t size = std::uint32_t(s.cloud.number_of_surfels());
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
  });
}

// A cloud too wide for surfels has none, and far points need no more than 64 bits.
BOOST_AUTO_TEST_CASE(wide_frames)
{
  const Grid_point low = {-(1 << 28), 0, 0, 0}, high = {(1 << 28) - 8, 5, 5, 0};
  CHECK_AT(make_code_frame(low, high, {600}).has_surfels(), "2^29 steps of cubes of 600");
  CHECK_AT(!make_code_frame(low, high, {500}).has_surfels(), "2^29 steps of cubes of 500");
  CHECK_AT(!make_code_frame(low, high, {0}).has_surfels(), "no surfels");
  const Code_frame frame = make_code_frame(low, high, {600});
  CHECK_AT(frame.code(low) != frame.code(high) && frame.code(high) >> 63 == 0, "codes of both ends");
}

BOOST_AUTO_TEST_SUITE_END()
