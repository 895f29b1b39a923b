// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planes lie in the middle of their points at the end: the offset of a plane is the mean over the points of all of its
// shapes.

#include "testing/test_support.h"

#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>

#include <cmath>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_center)

namespace {

using namespace CGAL::Tandem::internal;

Shape_summary summary(double points, const Vector& centroid)
{
  Shape_summary s = {};
  s.fit.scatter.count = points;
  s.fit.scatter.centroid = centroid;
  return s;
}

// Two shapes of one plane, one of another, and dead ones.
BOOST_AUTO_TEST_CASE(test_offsets)
{
  const Vector up = {0, 0, 1}, aslant = {.6, 0, .8};
  Relations r;
  r.planes = {{up, 10}, {aslant, 20}, {up, 30}, {up, 40}};
  r.plane_of = {0, 1, 0, 0, 2, 1};
  const std::vector<Shape_summary> shapes = {summary(100, {5, 6, 11}),   summary(50, {100, 7, -50}),
                                             summary(300, {-900, 2, 7}), summary(0, {0, 0, 1e6}),
                                             summary(0, {1, 2, 3}),      summary(0, {5, 5, 5})};
  center_planes(shapes, r);
  check_close(r.planes[0].offset, (100 * 11 + 300 * 7) / 400., 1e-12, "offset of the plane of two shapes");
  check_close(r.planes[1].offset, 60 - 40, 1e-12, "offset of the plane of one shape");
  check_equal(r.planes[2].offset, 30., "offset of the plane of a dead shape");
  check_equal(r.planes[3].offset, 40., "offset of a plane without shapes");
  for(std::size_t p : {0u, 2u, 3u})
    CHECK(r.planes[p].normal.x == 0 && r.planes[p].normal.y == 0 && r.planes[p].normal.z == 1);
  CHECK(r.planes[1].normal.x == .6 && r.planes[1].normal.z == .8);
}

// By coplanar group; a shape without partner is one. Points that only the last checks have freed are missing, so the
// mean is near zero only.
std::size_t check_means(const Cloud& cloud, const Shapes& shapes, double epsilon, const std::string& where)
{
  std::vector<double> sum(shapes.number_of_coplanar_groups(), 0), count(sum.size(), 0);
  for(std::size_t i = 0; i < cloud.size(); ++i) {
    if(shapes.shape_index(i) < 0)
      continue;
    const std::size_t s = std::size_t(shapes.shape_index(i)), group = std::size_t(shapes.data().coplanar_group[s]);
    const auto& c = shapes.coefficients(s);
    const auto& p = cloud[i].first;
    sum[group] += c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3];
    ++count[group];
  }
  for(std::size_t g = 0; g < sum.size(); ++g)
    check_close(sum[g] / (epsilon * count[g]), 0, .05,
                where + ": mean distance, in epsilons, of group " + std::to_string(g) + " of " +
                  std::to_string(int(count[g])) + " points");
  return sum.size();
}

BOOST_AUTO_TEST_CASE(test_scenes)
{
  for(const char* name : {"house", "indoor", "part", "village", "staircase"})
    for(double noise : {.0003, .001})
      for(Given given : {Given::normals, Given::nothing}) {
        const std::string where = std::string(name) + ", noise " + std::to_string(noise) +
                                  (given == Given::normals ? ", normals are given" : ", normals are estimated");
        const scenes::Scene scene = scenes::make_scene(name, scene_options(20000, noise, .05));
        const Cloud cloud = to_cloud(scene);
        const double epsilon = 3 * noise * scene.diagonal;
        const Shapes shapes = detect_valid(where, cloud, make_parameters(epsilon, 60), given);
        CHECK_AT(check_means(cloud, shapes, epsilon, where) > 10, where + ": few planes");
      }
}

} // namespace

BOOST_AUTO_TEST_SUITE_END()
