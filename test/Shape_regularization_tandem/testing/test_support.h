// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of whole detections share: generated scenes as a range of points
// with normals, one call for each back end, results that can be compared.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SUPPORT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SUPPORT_H

#include "box_cloud.h"
#include "scenes/scenes.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cstring>

namespace scenes = CGAL::Tandem::scenes;
using CGAL::Tandem::Parameters;
using Kernel = CGAL::Simple_cartesian<double>;
using Cloud = Pairs<Kernel>;
using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;

enum class Given { normals, nothing };

inline void add(Cloud& cloud, const scenes::Vec& p, const scenes::Vec& n)
{
  cloud.emplace_back(Kernel::Point_3(p.x, p.y, p.z), Kernel::Vector_3(n.x, n.y, n.z));
}

inline Cloud to_cloud(const scenes::Scene& scene)
{
  Cloud cloud;
  cloud.reserve(scene.points.size());
  for(std::size_t i = 0; i < scene.points.size(); ++i)
    add(cloud, scene.points[i], scene.normals.empty() ? scenes::Vec{0, 0, 0} : scene.normals[i]);
  return cloud;
}

// First scaled, then shifted. Powers of two scale exactly.
inline Cloud transformed(const Cloud& cloud, double scale, const Kernel::Vector_3& shift = {0, 0, 0})
{
  Cloud result;
  for(const auto& item : cloud)
    result.emplace_back(CGAL::ORIGIN + scale * (item.first - CGAL::ORIGIN) + shift, item.second);
  return result;
}

inline scenes::Options scene_options(std::size_t points, double noise = 0, double outliers = 0)
{
  return {points, noise, outliers};
}

inline Parameters make_parameters(double maximum_distance, std::size_t minimum_region_size)
{
  Parameters p;
  p.maximum_distance = p.maximum_offset = maximum_distance;
  p.minimum_region_size = minimum_region_size;
  return p;
}

// Each point is a surfel.
inline Parameters points_only(double maximum_distance, std::size_t minimum_region_size)
{
  Parameters p = make_parameters(maximum_distance, minimum_region_size);
  p.surfel_size = 0;
  return p;
}

template <class Tag = CGAL::Sequential_tag>
Shapes detect(const Cloud& cloud, const Parameters& parameters, Given given = Given::normals)
{
  const auto list = CGAL::Tandem::parameters::settings(parameters).point_map(First<Kernel>());
  return given == Given::normals ? CGAL::Tandem::detect_planes<Tag>(cloud, list.normal_map(Second<Kernel>()))
                                 : CGAL::Tandem::detect_planes<Tag>(cloud, list);
}

// Compiled once, in test_support.cpp.
extern template Shapes detect<CGAL::Sequential_tag>(const Cloud&, const Parameters&, Given);
#ifdef CGAL_LINKED_WITH_TBB
extern template Shapes detect<CGAL::Parallel_tag>(const Cloud&, const Parameters&, Given);
#endif

// What is wrong with a result, or nothing. is_valid_result() gives a reason exactly if it refuses it.
std::string violation(const Cloud& cloud, const Shapes& shapes, Given given = Given::normals);

// All that the package promises, whatever the scene is.
void check_valid(const Cloud& cloud, const Shapes& shapes, const std::string& name, Given given = Given::normals);

inline Shapes detect_valid(const std::string& name, const Cloud& cloud, const Parameters& parameters,
                           Given given = Given::normals)
{
  const Shapes shapes = detect(cloud, parameters, given);
  check_valid(cloud, shapes, name, given);
  return shapes;
}

inline void check_counts(const std::string& name, const Shapes& shapes, std::size_t number, std::size_t directions,
                         std::size_t planes)
{
  check_equal(shapes.number_of_shapes(), number, name + ": number of shapes");
  check_equal(shapes.number_of_parallel_groups(), directions, name + ": number of directions");
  check_equal(shapes.number_of_coplanar_groups(), planes, name + ": number of planes");
}

// The first position at which two lists differ, or a negative number.
template <class List>
long first_difference(const List& a, const List& b)
{
  const std::size_t common = (std::min)(a.size(), b.size());
  for(std::size_t i = 0; i < common; ++i)
    if(!(a[i] == b[i]))
      return long(i);
  return a.size() == b.size() ? -1 : long(common);
}

inline void check_same_planes(const Shapes& a, const Shapes& b, const std::string& name)
{
  const auto &p = a.data().coefficients, &q = b.data().coefficients;
  CHECK_AT(p.size() == q.size() && (p.empty() || std::memcmp(p.data(), q.data(), p.size() * sizeof p[0]) == 0),
           name + ": " + std::to_string(p.size()) + " and " + std::to_string(q.size()) +
             " planes, the first that differs is " + std::to_string(first_difference(p, q)));
  CHECK_AT(a.data().parallel_group == b.data().parallel_group, name);
  CHECK_AT(a.data().coplanar_group == b.data().coplanar_group, name);
  CHECK_AT(a.orthogonal_groups() == b.orthogonal_groups(), name);
}

// The same bits: labels, planes, relations.
inline void check_same(const Shapes& a, const Shapes& b, const std::string& name)
{
  const long at = first_difference(a.shape_indices(), b.shape_indices());
  CHECK_AT(at < 0, name + ": the labels differ, first of point " + std::to_string(at));
  check_same_planes(a, b, name);
}

// Iterates both and finishes them, after which the caller compares what they have found. A difference is reported with
// the round in which it comes up.
template <class Detection, class Expected>
void compare_rounds(Detection& detection, Expected& expected, const std::string& name)
{
  const int failures_before = failures();
  bool goes_on = true;
  for(int round = 0; goes_on && failures() == failures_before; ++round) {
    goes_on = expected.iterate();
    const std::string where = name + ", round " + std::to_string(round);
    CHECK_AT(detection.iterate() == goes_on, where + ": one of them has ended");
    check_same(detection.shapes(), expected.shapes(), where);
  }
  expected.finish();
  detection.finish();
}

inline void shuffle(Cloud& cloud, std::uint64_t seed)
{
  scenes::Random random(seed);
  for(std::size_t i = cloud.size(); i > 1; --i)
    std::swap(cloud[i - 1], cloud[random.bits() % i]);
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SUPPORT_H
