// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfels against a map of cubes, on several back ends and for shuffled points: which points they have, where they are,
// their normals, and the cells that they are in. No surfel, joined or not, has points of two layers that are 1.1
// epsilon apart, and none points of two shapes in a valid result.

#include "testing/body_fixture.h"
#include "testing/change_table.h"
#include "testing/naive_side.h"

#include <CGAL/Shape_regularization_tandem/is_valid_result.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/engine/connect_cloud.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_surfels)

using namespace CGAL::Tandem::internal;
namespace scenes = CGAL::Tandem::scenes;

using Points = std::vector<Grid_point>;

// Points in a box of some cubes, many of them copies of others or in heaps.
Points random_points(std::size_t n, bool has_normals, std::uint64_t seed)
{
  scenes::Random random(seed);
  Points points;
  for(std::size_t i = 0; i < n; ++i) {
    if(i > 0 && random.uniform() < .3) {
      points.push_back(points[std::size_t(random.uniform() * double(i))]);
      points.back().x += std::int32_t(random.uniform() * 9);
      continue;
    }
    const auto at = [&] { return std::int32_t(20000 * random.uniform()) - 12345; };
    const scenes::Vec d = random.direction();
    const std::int32_t x = at(), y = at(), z = at();
    points.push_back({x, y, z, has_normals ? encode_normal({d.x, d.y, d.z}) : no_normal});
  }
  return points;
}

// x, y, z of the cube, then the side.
using Key = std::array<std::int64_t, 4>;

Key key_of(const Grid_point& p, const Grid_point& low, double edge)
{
  const auto cube = [&](std::int32_t v, std::int32_t from) {
    return std::int64_t(std::floor(double(std::int64_t(v) - from) * (1 / edge)));
  };
  return {cube(p.x, low.x), cube(p.y, low.y), cube(p.z, low.z), naive_side(p)};
}

Box box_of(const Points& points)
{
  Box box;
  for(const Grid_point& p : points)
    box.add(p);
  return box;
}

template <class Backend>
void test_against_map(Backend& backend, const std::string& name, const Points& points, double edge)
{
  const Box box = box_of(points);
  const Grid_point low = {box.low[0], box.low[1], box.low[2], 0}, high = {box.high[0], box.high[1], box.high[2], 0};
  const Code_frame frame = make_code_frame(low, high, {edge});
  const std::size_t n = points.size();
  const auto input = to_buffer(backend, points);
  const auto sorted = sort_along_curve(backend, {input.data(), n}, frame);
  Sorted_cloud<Backend> cloud;
  auto cells = to_buffer(backend, split_cells(backend, sorted, frame, 64));
  cloud.order.reset(n);
  cloud.all_points.reset(n);
  using Table = typename Backend::Sort_table::View;
  backend.for_each(n, Gather_points<Table>{sorted.view(),
                                           {input.data(), nullptr, nullptr},
                                           {cloud.all_points.data(), cloud.order.data(), nullptr}});
  make_surfels(backend, sorted, cloud, cells);

  std::map<Key, std::vector<Grid_point>> expected;
  for(const Grid_point& p : points)
    expected[key_of(p, low, edge)].push_back(p);
  check_equal(cloud.size(), expected.size(), name + ": number of surfels");
  check_equal(cloud.number_of_points(), n, name + ": number of points");
  const Surfels_view surfels = cloud.surfels();
  for(std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Range range = surfels.points(i);
    const std::vector<Grid_point>& own = expected[key_of(surfels.point[range.first], low, edge)];
    if(std::size_t(range.size()) != own.size()) {
      check_equal(std::size_t(range.size()), own.size(), name + ": points of a surfel");
      continue;
    }
    double sum[3] = {0, 0, 0}, normal[3] = {0, 0, 0};
    for(std::uint32_t p = range.first; p < range.last; ++p) {
      CHECK_AT(surfels.of_point(p) == i, name + ": surfel of a point");
      CHECK_AT(key_of(surfels.point[p], low, edge) == key_of(surfels.point[range.first], low, edge),
               name + ": points of one cube and side");
      CHECK_AT(std::memcmp(&surfels.point[p], &points[cloud.order.data()[p]], sizeof(Grid_point)) == 0,
               name + ": order of the points");
      const Int_vector v = decode_normal(surfels.point[p].normal);
      const std::int32_t c[3] = {surfels.point[p].x, surfels.point[p].y, surfels.point[p].z}, m[3] = {v.x, v.y, v.z};
      for(int axis = 0; axis < 3; ++axis) {
        sum[axis] += c[axis];
        normal[axis] += m[axis];
      }
    }
    const Grid_point& center = cloud.point.data()[i];
    const std::int32_t c[3] = {center.x, center.y, center.z};
    for(int axis = 0; axis < 3; ++axis)
      CHECK_AT(c[axis] == std::int32_t(std::floor(sum[axis] / range.size() + .5)), name + ": centroid");
    const std::uint32_t mean = points.front().normal == no_normal ? no_normal
                               : range.size() == 1                ? surfels.point[range.first].normal
                                                   : encode_normal(unit({normal[0], normal[1], normal[2]}));
    CHECK_AT(center.normal == mean, name + ": mean normal");
  }
  std::uint32_t next = 0;
  for(const Range& cell : to_vector(backend, cells)) {
    CHECK_AT(cell.first == next && cell.size() > 0, name + ": cells follow each other");
    next = cell.last;
  }
  check_equal(std::size_t(next), cloud.size(), name + ": cells have all surfels");
}

// Places and normals of the surfels and sizes, of points in any order.
std::vector<std::array<std::int64_t, 5>> listed_surfels(const Points& points, double edge)
{
  Sequential_backend backend;
  const Box box = box_of(points);
  const Code_frame frame =
    make_code_frame({box.low[0], box.low[1], box.low[2], 0}, {box.high[0], box.high[1], box.high[2], 0}, {edge});
  const auto sorted = sort_along_curve(backend, {points.data(), points.size()}, frame);
  Sorted_cloud<Sequential_backend> cloud;
  auto cells = to_buffer(backend, split_cells(backend, sorted, frame, 64));
  cloud.order.reset(points.size());
  cloud.all_points.reset(points.size());
  backend.for_each(points.size(),
                   Gather_points<Host_sort_table::View>{sorted.view(),
                                                        {points.data(), nullptr, nullptr},
                                                        {cloud.all_points.data(), cloud.order.data(), nullptr}});
  make_surfels(backend, sorted, cloud, cells);
  std::vector<std::array<std::int64_t, 5>> list;
  for(std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Grid_point& p = cloud.point[i];
    list.push_back({p.x, p.y, p.z, p.normal, cloud.surfels().points(i).size()});
  }
  return list;
}

void test_permutations()
{
  Points points = random_points(3000, true, 5);
  const auto expected = listed_surfels(points, 1000);
  std::reverse(points.begin(), points.end());
  CHECK_AT(listed_surfels(points, 1000) == expected, "surfels of reversed points");
}

// Two layers of random direction, 1.1 epsilon apart, of points in heaps, so that surfels join. Returns whether they did.
bool test_layers(Given given, std::uint64_t seed)
{
  scenes::Random random(seed);
  const double epsilon = .7;
  const scenes::Vec n = random.direction(), u = unit(cross(n, random.direction())), v = cross(n, u);
  Cloud cloud;
  std::vector<int> layer;
  for(int heap = 0; heap < 300; ++heap) {
    const double a = 40 * random.uniform(), b = 40 * random.uniform();
    for(int i = 0; i < 12; ++i) {
      layer.push_back(i % 2);
      add(cloud,
          (1.1 * epsilon * layer.back()) * n + (a + .2 * random.gaussian()) * u + (b + .2 * random.gaussian()) * v, n);
    }
  }
  Sequential_backend backend;
  using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, ::First<Kernel>, ::Second<Kernel>, CGAL::Sequential_tag>;
  Import in = read_points(backend, cloud, Item_reader<Traits>(Traits(), ::First<Kernel>(), ::Second<Kernel>()));
  if(given == Given::nothing) {
    in.has_normals = false;
    in.normals = Vector_table();
  }
  const Parameters p = make_parameters(epsilon, 20);
  choose_grid(in, p);
  Labeled_cloud<Sequential_backend> points(backend);
  points.cloud.k = int(p.k_neighbors);
  sort_points(backend, in, p.cell_size, points.cloud, points.cells);
  const std::size_t before = points.cloud.size();
  connect_cloud(points, in, make_options(in, p).tight);
  const Surfels_view surfels = points.cloud.surfels();
  for(std::uint32_t i = 0; i < points.cloud.size(); ++i)
    for(std::uint32_t q = surfels.points(i).first; q < surfels.points(i).last; ++q)
      if(layer[points.cloud.order[q]] != layer[points.cloud.order[surfels.points(i).first]]) {
        CHECK_AT(false, "a surfel has points of two layers, seed " + std::to_string(seed));
        return false;
      }
  return points.cloud.size() < before;
}

// Two squares of one plane that are apart. Each surfel has many points; one of each square changes its shape.
void test_mixed_surfels()
{
  scenes::Random random(4);
  Cloud cloud;
  for(int i = 0; i < 20000; ++i)
    add(cloud, {random.uniform() + 3 * (i % 2), random.uniform(), 0}, {0, 0, 1});
  const Shapes shapes = detect_valid("two squares", cloud, make_parameters(.1, 100));
  check_counts("two squares", shapes, 2, 1, 1);
  const auto maps = CGAL::parameters::point_map(::First<Kernel>()).normal_map(::Second<Kernel>());
  for(std::size_t i = 0; i < 200; i += 2) {
    Shapes::Data data = shapes.data();
    change_table(data.shape_of, [&](std::vector<std::int32_t>& labels) { std::swap(labels[i], labels[i + 1]); });
    std::string why;
    CHECK_AT(!is_valid_result(cloud, Shapes(data), maps, &why) && why.find("not connected") != std::string::npos,
             "shapes of one surfel exchange points: " + why);
  }
}

// A cloud too wide for surfels has none, and far points need no more than 64 bits.
void test_wide_frames()
{
  const Grid_point low = {-(1 << 28), 0, 0, 0}, high = {(1 << 28) - 8, 5, 5, 0};
  CHECK_AT(make_code_frame(low, high, {600}).has_surfels(), "2^29 steps of cubes of 600");
  CHECK_AT(!make_code_frame(low, high, {500}).has_surfels(), "2^29 steps of cubes of 500");
  CHECK_AT(!make_code_frame(low, high, {0}).has_surfels(), "no surfels");
  const Code_frame frame = make_code_frame(low, high, {600});
  CHECK_AT(frame.code(low) != frame.code(high) && frame.code(high) >> 63 == 0, "codes of both ends");
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  on_body_backends([](auto backend, const std::string& name) {
    for(const bool has_normals : {true, false})
      for(const double edge : {.7, 333.25, 1000., 60000.})
        test_against_map(backend, name + ", edge " + std::to_string(edge),
                         random_points(edge < 1 ? 100 : 2000, has_normals, 3), edge);
  });
  test_permutations();
  int joined = 0;
  for(std::uint64_t seed = 1; seed <= 40; ++seed)
    for(const Given given : {Given::normals, Given::nothing})
      joined += test_layers(given, seed);
  CHECK_AT(joined > 20, "surfels were joined in " + std::to_string(joined) + " of 80 clouds");
  test_mixed_surfels();
  test_wide_frames();
}

BOOST_AUTO_TEST_SUITE_END()
