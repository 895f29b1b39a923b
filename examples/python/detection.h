// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the Python module calls, without types of Python. Clouds are rows of three doubles in the caller's memory.

#ifndef TANDEM_PYTHON_DETECTION_H
#define TANDEM_PYTHON_DETECTION_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>
#include <CGAL/Tandem/Plane_relations.h>

#include <CGAL/Iterator_range.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>
#include <boost/iterator/counting_iterator.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tandem_python {

namespace np = CGAL::Tandem::parameters;
using Kernel = CGAL::Simple_cartesian<double>;

using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;
using Coefficients = std::array<double, 4>;

// The memory is read only while a function runs.
struct Cloud {
  const double* points = nullptr;
  const double* normals = nullptr;    // null: they are estimated
  const double* tolerances = nullptr; // null: all points have the same
  std::size_t size = 0;
  const double* viewpoints = nullptr; // null: not known
  std::size_t viewpoint_step = 0;     // from that of a point to the next one: 0 where all have the same, else 3
};

// What is not given is left to the library.
struct Settings {
  std::optional<double> maximum_distance, maximum_angle, angle_tolerance, maximum_offset, simplicity, regularity,
    fixed_regularity, surfel_size;
  std::optional<long long> minimum_region_size, k_neighbors, cell_size, threads;
  bool regularize_parallelism = true, regularize_orthogonality = true, regularize_coplanarity = true;
  std::vector<std::array<double, 3>> fixed_directions;
  std::optional<std::array<double, 3>> symmetry_direction;
  std::string backend = "auto";
};

// Criteria; those that are not given hold for all shapes.
struct Selection {
  std::optional<long long> largest;
  std::optional<double> near_angle;
  std::optional<std::array<double, 3>> near_direction, orthogonal_direction;
};

// What is not given is that of the shapes.
struct Labeling {
  std::optional<double> maximum_distance, maximum_angle, reach;
  Cloud shape_points; // of the detection; null: planes have no end
};

// --- Models as arrays have them: positions of three vertices for each triangle, and runs of one array after the other,
// with the place where each run starts and, at the end, where a next one would.

using Indices = std::vector<std::int32_t>;

// The loops of a polygon are a run of loops, a loop is a run of vertices.
struct Polygon_tables {
  std::vector<Kernel::Point_3> vertices;
  Indices triangles, triangle_shape, loop_vertices, loop_starts = {0}, polygon_starts = {0}, polygon_shape;
};

struct Line_tables {
  std::vector<Kernel::Point_3> vertices;
  Indices segments, segment_shapes, corners, corner_shapes, corner_starts = {0};
};

// What closed_surface() is asked for. A footprint has its outer boundary first.
struct Surface_settings {
  using Ring = std::vector<std::array<double, 2>>;

  std::optional<long long> planes, components;
  std::optional<std::array<double, 3>> upward;
  std::optional<double> base;
  std::vector<std::vector<Ring>> footprints;
};

struct Surface_tables {
  std::vector<Kernel::Point_3> vertices;
  Indices triangles, triangle_face, face_vertices, face_starts = {0}, face_plane;
  std::vector<double> face_supported;
  double supported = 0;
  std::size_t number_of_points = 0, number_of_planes = 0, number_of_omitted_planes = 0;
};

// --- Clouds as ranges with property maps

// The points of a cloud are the numbers of its rows ...
using Row = boost::counting_iterator<std::size_t>;
using Cloud_rows = CGAL::Iterator_range<Row>;

inline Cloud_rows rows_of(const Cloud& cloud) { return Cloud_rows(Row(0), Row(cloud.size)); }

// ... and this property map makes points or vectors of them.
template <class Geometry>
struct Row_map {
  using key_type = std::size_t;
  using value_type = Geometry;
  using reference = value_type;
  using category = boost::readable_property_map_tag;

  const double* values;
  std::size_t step = 3; // 0: all rows are the same

  friend value_type get(const Row_map& map, std::size_t i)
  {
    const double* v = map.values + map.step * i;
    return value_type(v[0], v[1], v[2]);
  }
};
using Point_map = Row_map<Kernel::Point_3>;
using Normal_map = Row_map<Kernel::Vector_3>;

// Calls f with the named parameters for the maps of the points and of their viewpoints, where they are known ...
template <class F>
auto with_viewpoints(const Cloud& cloud, const F& f)
{
  const auto points = np::point_map(Point_map{cloud.points});
  return cloud.viewpoints != nullptr ? f(points.viewpoint_map(Point_map{cloud.viewpoints, cloud.viewpoint_step}))
                                     : f(points);
}

// ... for the maps of the points and normals of the cloud ...
template <class F>
auto with_maps(const Cloud& cloud, const F& f)
{
  const auto points = np::point_map(Point_map{cloud.points});
  return cloud.normals != nullptr ? f(points.normal_map(Normal_map{cloud.normals})) : f(points);
}

// ... and with that of tolerances.
template <class F>
auto with_all_maps(const Cloud& cloud, const F& f)
{
  return with_maps(cloud, [&](const auto& maps) {
    return cloud.tolerances != nullptr ? f(maps.maximum_distance_map(CGAL::make_property_map(cloud.tolerances)))
                                       : f(maps);
  });
}

// --- Functions, which throw what the library throws

// An exception of the callback ends the detection and is passed on.
Shapes detect_planes(const Cloud& cloud, const Settings& settings, const CGAL::Tandem::Callback& callback);

// What is wrong with the cloud or the shapes that were detected in it: a sentence each, in which parameters have the names
// of options of the program.
std::vector<std::string> warnings(const Cloud& cloud, const Settings& settings, const Shapes& shapes);

CGAL::Tandem::Parameters estimate_parameters(const Cloud& cloud);

// One for each point, NaN for those that are not valid.
std::vector<double> estimate_local_distances(const Cloud& cloud);

// Changes the planes. There is a label for each point of the cloud, whose normals are not used.
CGAL::Tandem::Plane_relations regularize_planes(const Cloud& cloud, const std::int32_t* labels,
                                                const Settings& settings, std::vector<Coefficients>& planes);

// Of each shape, from the points that it was detected in. This and the next ones throw std::invalid_argument where these
// have changed.
std::vector<CGAL::Tandem::Shape_facts> shape_facts(const Cloud& cloud, const Shapes& shapes);

Polygon_tables polygons(const Cloud& cloud, const Shapes& shapes, bool one_for_each_plane);

Line_tables lines(const Cloud& cloud, const Shapes& shapes);

// Upward is the direction of the detection, if none is given.
Surface_tables closed_surface(const Cloud& cloud, const Shapes& shapes, const Surface_settings& settings,
                              const CGAL::Tandem::Callback& callback);

// Empty if the shapes have all that is guaranteed.
std::string find_violation(const Cloud& cloud, const Shapes& shapes);

// Those that can be used on this machine.
std::vector<std::string> backends();

Shapes select_shapes(const Shapes& shapes, const std::vector<long long>& indices);

// The points are those of the detection, which are read for areas, extents and veils.
Shapes select_shapes(const Shapes& shapes, const Cloud& points, const Selection& selection);

// The normals of the cloud count where there are some.
std::vector<std::int32_t> label_points(const Shapes& shapes, const Cloud& cloud, const Labeling& labeling);

} // namespace tandem_python

#endif // TANDEM_PYTHON_DETECTION_H
