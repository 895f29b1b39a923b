// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Calls that must not compile: each line with "error:" has one, which contains that text, and no other line has any.
// test_refused_calls.py compiles this. Items are of types of their own, since a check is reported once for a type.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Point_set_3.h>
#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Shape_regularization_tandem/closed_surface.h>
#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>
#include <CGAL/Shape_regularization_tandem/join_coplanar_shapes.h>
#include <CGAL/Shape_regularization_tandem/label_points.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/select_shapes.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>
#include <CGAL/Shape_regularization_tandem/shapes_of_planes.h>
#include <CGAL/property_map.h>

#include <list>
#include <string>
#include <utility>
#include <vector>

namespace Tandem = CGAL::Tandem;
namespace np = CGAL::Tandem::parameters;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Point_set = CGAL::Point_set_3<Point>;
using Cartesian_point = CGAL::Simple_cartesian<double>::Point_3;
using Shapes = Tandem::Planar_shapes_3<Kernel>;

template <int>
struct Own {
  double x = 0, y = 0, z = 0;
};

// A point, a normal and something else.
template <int n>
using Item = std::pair<Point, std::pair<Kernel::Vector_3, Own<n>>>;
template <int n>
using Items = std::vector<Item<n>>;
template <int n>
using First = CGAL::First_of_pair_property_map<Item<n>>;

template <class Range, class Point_map>
using Detection = Tandem::Planar_shape_detection_3<Tandem::Tandem_traits_3<Kernel, Range, Point_map>>;

template <class Key>
using Texts = CGAL::Constant_property_map<Key, std::string>;

void call_detect_planes(const std::vector<Point>& points, const Point_set& set)
{
  const auto shapes = Tandem::detect_planes(Items<1>()); // error: point_map(map)
  const Kernel::Plane_3 plane = shapes.plane(0);         // what is made of the result is no error
  Tandem::Planar_shapes_3<Kernel> copy = shapes;
  const auto others = Tandem::detect_planes(std::vector<Own<2>>(), np::cell_size(plane.a())); // error: point_map(map)
  const double a = others.plane(0).a() + others.statistics().coverage;
  Tandem::detect_planes(std::vector<Kernel::Point_2>(copy.size(0)));        // error: point_map(map)
  Tandem::detect_planes(Items<3>(), np::point_map(First<4>()));             // error: point_map(map)
  Tandem::detect_planes(Items<5>(), np::point_map(Texts<Item<5>>()));       // error: point_map(map)
  Tandem::detect_planes(Items<6>(), np::point_map(a));                      // error: point_map(map)
  Tandem::detect_planes(set, CGAL::parameters::point_map(Texts<Own<7>>())); // error: point_map(map)
  const CGAL::Simple_cartesian<float> kernel;
  Tandem::detect_planes(points, np::geom_traits(kernel));                              // error: point_map(map)
  Tandem::detect_planes(Items<8>(), np::point_map(First<8>()).normal_map(First<8>())); // error: normal_map(map)
  const auto texts = np::maximum_distance_map(Texts<Item<9>>()).point_map(First<9>());
  Tandem::detect_planes(Items<9>(), texts);            // error: maximum_distance_map(map)
  Tandem::detect_planes(std::list<Point>());           // error: needs random access iterators
  Tandem::detect_planes(Own<10>());                    // error: needs random access iterators
  Tandem::detect_planes(points, .05);                  // error: maximum_distance(0.05)
  Tandem::detect_planes(points, Tandem::Parameters()); // error: settings(p)
}

void call_detection()
{
  using Identity = CGAL::Identity_property_map<Item<11>>;
  Detection<Items<11>, Identity> one(Items<11>{}); // error: point_map(map)
  one.detect();
  using Pairs = std::vector<std::pair<Point, Own<12>>>;
  using Points = CGAL::First_of_pair_property_map<Pairs::value_type>;
  Detection<Pairs, Points> two(Pairs(), np::point_map(First<12>())); // error: is not the Point_map
  two.shapes();
}

void call_others(const Shapes& shapes)
{
  Tandem::estimate_parameters(Items<13>());                // error: point_map(map)
  Tandem::estimate_noise(Items<14>());                     // error: point_map(map)
  Tandem::estimate_local_distances(Items<15>());           // error: point_map(map)
  Tandem::is_valid_result(Items<16>(), shapes);            // error: point_map(map)
  Tandem::projected_points(Items<17>(), shapes);           // error: point_map(map)
  Tandem::polygons(shapes, Items<18>()).area(0);           // error: point_map(map)
  Tandem::closed_surface(shapes, Items<19>()).faces.at(0); // error: point_map(map)
}

void call_functions_of_results(const Shapes& shapes, const std::vector<Point>& points)
{
  Tandem::label_points(shapes, Items<21>()).at(0);                     // error: point_map(map)
  Tandem::label_points(shapes, points, np::shape_points(Items<22>())); // error: point_map(map)
  const auto list = np::shape_points(std::list<Cartesian_point>());
  Tandem::label_points(shapes, points, list);                               // error: needs random access iterators
  Tandem::shapes_of_planes({}, Items<23>()).plane(0);                       // error: point_map(map)
  Tandem::shape_facts(shapes, Items<24>()).at(0);                           // error: point_map(map)
  Tandem::select_shapes(shapes, Items<25>(), np::minimum_area(1)).plane(0); // error: point_map(map)
  Tandem::join_coplanar_shapes(shapes, Items<26>()).plane(0);               // error: point_map(map)
}

void call_regularize_planes(const std::vector<Point>& points, std::vector<Kernel::Plane_3> planes)
{
  const auto indices = np::plane_index_map(Tandem::Position_index_map());
  std::vector<std::pair<Kernel::Plane_3, int>> pairs;
  Tandem::regularize_planes(planes, points, np::regularity(.1)); // error: needs the named parameter plane_index_map
  Tandem::regularize_planes(planes, Items<20>(), indices);       // error: point_map(map)
  Tandem::regularize_planes(pairs, points, indices);             // error: plane_map(map)
  const auto no_indices = np::plane_index_map(Texts<std::size_t>());
  Tandem::regularize_planes(planes, points, no_indices); // error: plane_index_map(map)
}
