// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes that reach the limits of tables and of the grid: many small faces in one cell, cells as wide, as full and as small as
// they may be, stray points far away, faces behind better seeds.

#include "testing/patches_cloud.h"

#include <CGAL/Shape_regularization_tandem/adapters.h>
#include <CGAL/Shape_regularization_tandem/regularize_planes.h>

BOOST_AUTO_TEST_SUITE(test_limits)

using scenes::Random;
using scenes::Vec;

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

// One plane that has nearly all points.
Shapes check_plane(const std::string& name, const Cloud& cloud, const Parameters& parameters)
{
  const Shapes shapes = detect_valid(name, cloud, parameters);
  check_counts(name, shapes, 1, 1, 1);
  CHECK_AT(shapes.statistics().coverage > .99, name + std::to_string(shapes.statistics().coverage));
  return shapes;
}

// Thousands of faces, of which a cell holds hundreds: none of them may wait for ever.
BOOST_AUTO_TEST_CASE(test_many_faces)
{
  Random random(5);
  Cloud cloud;
  const int faces = 1200, side = 11, points = 40;
  for(int f = 0; f < faces; ++f) {
    const Vec n = random.direction();
    const Vec u = unit(cross(n, Vec{.3, .5, -.7})), v = cross(n, u);
    const Vec o = {3. * (f % side), 3. * (f / side % side), 3. * (f / side / side)};
    for(int i = 0; i < points; ++i) {
      const Vec on_face = add_scaled(add_scaled(o, between(random, -1, 1), u), between(random, -1, 1), v);
      add(cloud, add_scaled(on_face, between(random, -.01, .01), n), n);
    }
  }
  const Shapes shapes = detect_valid("many faces", cloud, make_parameters(.02, points / 2));
  CHECK_AT(shapes.number_of_shapes() >= 95 * faces / 100, std::to_string(shapes.number_of_shapes()));
  CHECK_AT(shapes.statistics().coverage >= .95, std::to_string(shapes.statistics().coverage));
}

// The sums of a cell are largest when it is full and its points are far from its first one.
BOOST_AUTO_TEST_CASE(test_full_cell)
{
  Random random(7);
  Cloud cloud;
  add(cloud, {0, 0, 0}, {0, 0, 1});
  for(int i = 0; i < 60000; ++i)
    add(cloud, {between(random, 159, 160), between(random, 159, 160), 160}, {0, 0, 1});
  Parameters parameters = make_parameters(.01, 100);
  for(std::size_t cell_size : {8192, 65536}) {
    parameters.cell_size = cell_size;
    check_plane("full cell of " + std::to_string(cell_size), cloud, parameters);
  }
}

// A point of no plane does not matter to the planes of the others, wherever it is.
BOOST_AUTO_TEST_CASE(test_stray_point)
{
  Random random(9);
  std::vector<Kernel::Point_3> points;
  std::vector<int> plane_of;
  for(int i = 0; i < 900; ++i) {
    points.emplace_back(random.uniform(), random.uniform(), i % 3 * .3 + .001 * random.uniform());
    plane_of.push_back(i % 3);
  }
  points.emplace_back(1e9, 0, 0);
  plane_of.push_back(-1);
  std::vector<Kernel::Plane_3> planes = {{0, 0, 1, 0}, {0, .01, 1, -.3}, {.01, 0, 1, -.6}};
  const auto relations = CGAL::Tandem::regularize_planes(
    planes, points,
    CGAL::Tandem::parameters::plane_index_map(CGAL::Tandem::Position_index_map(plane_of))
      .maximum_angle(8)
      .maximum_offset(.01));
  check_equal(relations.number_of_parallel_groups(), 1u, "stray point: directions");
}

// A plane that must have most of the points: it takes rounds until a shape is that large.
BOOST_AUTO_TEST_CASE(test_large_minimum)
{
  Random random(11);
  Cloud cloud;
  const std::size_t size = 60000;
  for(std::size_t i = 0; i < size; ++i)
    add(cloud, {between(random, 0, 10), between(random, 0, 10), between(random, -.01, .01)}, {0, 0, 1});
  const Shapes shapes = check_plane("large minimum", cloud, make_parameters(.02, size / 10 * 9));
  CHECK_AT(shapes.statistics().number_of_rounds > 4, std::to_string(shapes.statistics().number_of_rounds));
}

// Small faces in one cell, after the large plane that the others have is done: the loop does not end before them.
BOOST_AUTO_TEST_CASE(test_late_faces)
{
  Random random(4);
  Cloud cloud;
  for(int i = 0; i < 200000; ++i)
    add(cloud, {between(random, 0, 100), between(random, 0, 100), between(random, 0, .002)}, {0, 0, 1});
  const int tiles = 12, side = 7; // tiles of side x side points, tiles x tiles of them
  const double spacing = .02, pitch = 1.3 * side * spacing;
  for(int t = 0; t < tiles * tiles; ++t) {
    const double x0 = 40 + pitch * (t / tiles), y0 = 40 + pitch * (t % tiles), z0 = between(random, 3, 3.3);
    const double slope_x = between(random, -.3, .3), slope_y = between(random, -.3, .3);
    for(int i = 0; i < side * side; ++i) {
      const double x = spacing * (i / side + between(random, 0, .3)), y = spacing * (i % side + between(random, 0, .3));
      add(cloud, {x0 + x, y0 + y, z0 + slope_x * x + slope_y * y}, unit(Vec{-slope_x, -slope_y, 1}));
    }
  }
  const Shapes shapes = detect_valid("late faces", cloud, make_parameters(.005, 29));
  CHECK_AT(shapes.number_of_shapes() > 130, std::to_string(shapes.number_of_shapes()));
}

// Patches too small for a shape have the best seeds of all cells: the loop does not end before the faces begin, and
// gets there in few rounds.
void check_faces_behind_patches(const Squares& faces, const Squares& patches, std::size_t minimum,
                                std::size_t cell_size)
{
  const std::string name = "faces behind " + std::to_string(patches.count) + " patches, minimum " +
                           std::to_string(minimum) + ", cells of " + std::to_string(cell_size);
  Parameters parameters = make_parameters(.05, minimum);
  parameters.cell_size = cell_size;
  const Shapes shapes = detect_valid(name, make_squares_cloud(faces, patches), parameters);
  for(std::size_t face = 0; face < faces.count; ++face) {
    bool has_most = false;
    for(std::size_t s = 0; s < shapes.number_of_shapes() && !has_most; ++s) {
      const auto points = shapes.points(s);
      has_most = 2 * std::count_if(points.begin(), points.end(), [&](auto i) { return i / faces.points == face; }) >
                 std::ptrdiff_t(faces.points);
    }
    CHECK_AT(has_most, name + ": face " + std::to_string(face));
  }
  check(shapes.statistics().number_of_rounds <= 12, name + ": rounds", double(shapes.statistics().number_of_rounds));
}

BOOST_AUTO_TEST_CASE(test_faces_of_late_seeds)
{
  check_faces_behind_patches(make_rough_faces(.02), make_patches(300), 100, 65535);
  check_faces_behind_patches(make_rough_faces(.02), make_patches(1000), points_of_patch + 1, 8192);
  // No cell has as many points of a face as the smallest shape.
  Squares faces = make_rough_faces(.02), patches = make_patches(30000);
  faces.count = 3;
  faces.points = 8000;
  faces.low = 1;
  faces.high = 2;
  patches.points = 13;
  patches.side = .03;
  patches.high = 3;
  check_faces_behind_patches(faces, patches, 5000, 8192);
}

// Of at most as many points as a point has neighbors.
BOOST_AUTO_TEST_CASE(test_small_cells)
{
  Cloud cloud;
  for(int i = 0; i < 130 * 130; ++i)
    add(cloud, {.1 * (i % 130), .1 * (i / 130), 0}, {0, 0, 1});
  Parameters parameters = make_parameters(.05, 100);
  parameters.k_neighbors = parameters.cell_size = 64;
  check_plane("small cells", cloud, parameters);
}

// Few points on a tilted plane are a shape if as few are asked for, whatever the number of neighbors is.
BOOST_AUTO_TEST_CASE(test_few_points)
{
  for(std::size_t k : {6u, 12u})
    for(std::size_t n : {3, 4, 5, 6, 7, 8, 12, 20})
      for(std::uint64_t seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        Cloud cloud;
        for(std::size_t i = 0; i < n; ++i) {
          const double x = random.uniform(), y = random.uniform();
          add(cloud, {x, y, .3 * x}, unit(Vec{-.3, 0, 1}));
        }
        Parameters parameters = make_parameters(.05, 3);
        parameters.k_neighbors = k;
        for(Given given : {Given::normals, Given::nothing}) {
          const std::string name = std::to_string(n) + " points, seed " + std::to_string(seed);
          const Shapes shapes = detect_valid(name, cloud, parameters, given);
          check_counts(name, shapes, 1, 1, 1);
          check_equal(shapes.statistics().number_of_assigned_points, n, name + ": points of the shape");
        }
      }
}

BOOST_AUTO_TEST_SUITE_END()
