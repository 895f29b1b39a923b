// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes that reach the limits of tables and of the grid: many small faces in one cell, cells as wide, as full and as
// small as they may be, faces behind better seeds.

#include "testing/patches_cloud.h"

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
  Squares faces = {1200, 40, 2};
  faces.high = 60;
  add_squares(random, cloud, faces);
  const Shapes shapes = detect_valid("many faces", cloud, make_parameters(.02, 20));
  check(shapes.number_of_shapes() >= 95 * faces.count / 100, "many faces", double(shapes.number_of_shapes()));
  check(shapes.statistics().coverage >= .95, "many faces: coverage", shapes.statistics().coverage);
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

// A plane that must have most of the points: it takes rounds and unions until a shape is that large.
BOOST_AUTO_TEST_CASE(test_large_minimum)
{
  Random random(11);
  Cloud cloud;
  const std::size_t size = 60000;
  for(std::size_t i = 0; i < size; ++i)
    add(cloud, {between(random, 0, 10), between(random, 0, 10), between(random, -.01, .01)}, {0, 0, 1});
  const Shapes shapes = check_plane("large minimum", cloud, make_parameters(.02, size / 10 * 9));
  CHECK_AT(shapes.statistics().number_of_rounds > 1, std::to_string(shapes.statistics().number_of_rounds));
}

// Small faces in one cell, after the large plane that the others have is done: the loop does not end before them.
BOOST_AUTO_TEST_CASE(test_late_faces)
{
  Squares plane = {1, 200000, 100}, tiles = {144, 49, .14};
  plane.distance_noise = .0005;
  tiles.low = 30;
  tiles.high = 33;
  const Shapes shapes = detect_valid("late faces", make_squares_cloud(plane, tiles), make_parameters(.005, 29));
  check(shapes.number_of_shapes() > 130, "late faces", double(shapes.number_of_shapes()));
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
  patches.width = .03;
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
