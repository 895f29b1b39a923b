// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What detections end with. Relations must not drop faces of hardly more than the minimum size. Planes lie in the
// middle of their points. Planes through clutter are no shapes: see drop_clutter_shapes() in result/extract_shapes.h.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/result/explain_free_points.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>

#include <string>
#include <tuple>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_end_game)

using namespace CGAL::Tandem::internal;

constexpr double epsilon = .02;

// A floor, and small faces over it that are nearly parallel to it: it would take so many of their points that they fall
// below the minimum size.
BOOST_AUTO_TEST_CASE(small_faces)
{
  const std::size_t floor_size = 20000, face_size = 104;
  const int columns = 6;
  const double width = .6, turn = 1.8 * epsilon / width;
  scenes::Random random(1);
  Cloud cloud;
  for(std::size_t i = 0; i < floor_size; ++i)
    cloud.emplace_back(Kernel::Point_3(columns * random.uniform(), columns * random.uniform(), 0),
                       Kernel::Vector_3(0, 0, 1));
  for(int face = 0; face < columns * columns; ++face)
    for(std::size_t i = 0; i < face_size; ++i) {
      const double x = width * random.uniform(), y = width * random.uniform();
      const double z = 10 * epsilon + turn * x + .3 * epsilon * random.gaussian();
      cloud.emplace_back(Kernel::Point_3(face % columns + x, face / columns + y, z), Kernel::Vector_3(-turn, 0, 1));
    }
  const Shapes shapes = detect(cloud, make_parameters(epsilon, 100));
  check_equal(shapes.number_of_shapes(), std::size_t(1 + columns * columns), "a floor and small faces over it");
}

// A plane lies in the middle of all points of its shapes; without any it stays.
BOOST_AUTO_TEST_CASE(center_of_planes)
{
  Relations r;
  const Vector up = {0, 0, 1};
  r.planes = {{up, 10}, {up, 30}, {up, 40}};
  std::vector<Shape_summary> shapes;
  for(const auto& [plane, points, z] : {std::make_tuple(0, 100., 11.), std::make_tuple(0, 300., 7.),
                                        std::make_tuple(0, 0., 1e6), std::make_tuple(1, 0., 5.)}) {
    r.plane_of.push_back(plane);
    shapes.push_back({});
    shapes.back().fit.scatter.count = points;
    shapes.back().fit.scatter.centroid = {5, 6, z};
  }
  center_planes(shapes, r);
  CHECK(r.planes[0].offset == 8 && r.planes[1].offset == 30 && r.planes[2].offset == 40 && r.planes[0].normal.z == 1);
}

// Near neighbors and all, by shape; of the labels, and where many shapes have two slots. Eleven of twenty near ones
// suffice.
BOOST_AUTO_TEST_CASE(neighbors_of_clutter_shapes)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    for(std::uint32_t factor : {1u, Neighbor_scratch::slots / 2}) {
      std::vector<std::uint32_t> label = f.label;
      for(std::uint32_t& s : label)
        s = s < first_mark ? s * factor : s;
      std::vector<Plane> plane;
      std::vector<std::uint8_t> is_low_noise;
      for(std::uint32_t s = 0; s < f.plane.size() * factor; ++s) {
        plane.push_back(f.plane[s % f.plane.size()]);
        is_low_noise.push_back(s / 2 % 2);
      }
      std::vector<std::uint64_t> counts(plane.size() * neighbor_counts::size, 0), expected = counts;
      for(std::uint32_t i = 0; i < f.cloud.size; ++i)
        if(label[i] < first_mark)
          f.for_each_neighbor(i, [&](std::uint32_t q) {
            if(label[q] < first_mark && label[q] != label[i] && is_low_noise[label[q]])
              return;
            std::uint64_t* const c = expected.data() + std::size_t(label[i]) * neighbor_counts::size;
            ++c[neighbor_counts::all];
            c[neighbor_counts::near] +=
              label[q] == label[i] || is_near(plane[label[i]], f.point[q], f.tolerance_of(i).distance);
          });
      backend.template for_each_cell<Neighbor_scratch>(
        f.cells.size(), Count_neighbors<decltype(backend)>{f.cloud, f.cells.data(), label.data(), plane.data(),
                                                           is_low_noise.data(), counts.data(), f.tolerance});
      check_lists(counts, expected, name);
    }
  });
  for(std::uint64_t all : {20u, 1000u, 4000000000u})
    for(std::uint64_t near : {all * 11 / 20 - 1, all * 11 / 20, all}) {
      const std::uint64_t counts[] = {near, all};
      check_equal(is_clutter(counts), 20 * near < 11 * all, std::to_string(near) + " near of " + std::to_string(all));
    }
}

// A cube of points at random, with normals along an axis, and a face through it. Every layer of the cube, 25 of them,
// has enough points for a shape; most are dropped.
BOOST_AUTO_TEST_CASE(clutter_shapes)
{
  const std::size_t on_face = 10000, in_cube = 20000;
  Cloud cloud;
  scenes::Random random(5);
  for(std::size_t i = 0; i < on_face + in_cube; ++i) {
    const double z = i < on_face ? .5 + .2 * epsilon * random.gaussian() : random.uniform();
    cloud.emplace_back(Kernel::Point_3(random.uniform(), random.uniform(), z), Kernel::Vector_3(0, 0, 1));
  }
  const Shapes shapes = detect_valid("clutter shapes", cloud, make_parameters(epsilon, 200));
  CHECK(shapes.number_of_shapes() <= 12);
  CHECK_AT(shapes.size(0) > on_face * 9 / 10, std::to_string(shapes.size(0)) + " points of the face");
}

BOOST_AUTO_TEST_SUITE_END()
