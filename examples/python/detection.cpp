// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../cloud_warnings.h"
#include "detection.h"

#include <CGAL/Shape_regularization_tandem/cuda.h>
#include <CGAL/Shape_regularization_tandem/detect_planes.h>
#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>
#include <CGAL/Shape_regularization_tandem/is_valid_result.h>
#include <CGAL/Shape_regularization_tandem/regularize_planes.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/task_arena.h>
#endif

#include <algorithm>
#include <boost/iterator/transform_iterator.hpp>
#include <sstream>
#include <stdexcept>

namespace tandem_python {

using CGAL::Tandem::Callback;
using CGAL::Tandem::Parameters;

namespace {

// Throws for a value that would mean "to be estimated" in Parameters, and for a negative one, which would wrap around.
template <class T, class Given>
T above_zero(const char* name, const std::optional<Given>& given, T otherwise)
{
  if(given && !(*given > 0)) {
    std::ostringstream value;
    value << *given;
    throw CGAL::Tandem::Parameter_error(name, value.str(), "a number above 0");
  }
  return given ? T(*given) : otherwise;
}

// A length or size that is to be estimated is 0. The offset stays a parameter of its own: it may be 0.
Parameters parameters_of(const Settings& s)
{
  using namespace CGAL::Tandem;
  Parameters p;
  p.maximum_distance = above_zero("maximum_distance", s.maximum_distance, 0.);
  p.maximum_angle = s.maximum_angle.value_or(p.maximum_angle);
  p.angle_tolerance = s.angle_tolerance.value_or(p.angle_tolerance);
  p.minimum_region_size = above_zero("minimum_region_size", s.minimum_region_size, std::size_t(0));
  p.simplicity = s.simplicity.value_or(p.simplicity);
  p.regularity = s.regularity.value_or(p.regularity);
  p.fixed_regularity = s.fixed_regularity.value_or(p.fixed_regularity);
  p.surfel_size = s.surfel_size.value_or(p.surfel_size);
  p.k_neighbors = above_zero("k_neighbors", s.k_neighbors, p.k_neighbors);
  p.cell_size = above_zero("cell_size", s.cell_size, p.cell_size);
  p.regularize_parallelism = s.regularize_parallelism;
  p.regularize_orthogonality = s.regularize_orthogonality;
  p.regularize_coplanarity = s.regularize_coplanarity;
  p.fixed_directions = s.fixed_directions;
  p.regularize_axis_symmetry = s.symmetry_direction.has_value();
  p.symmetry_direction = s.symmetry_direction.value_or(p.symmetry_direction);
  return p;
}

template <class Tag>
Shapes detect_with(const Cloud& cloud, const Settings& s, const Callback& callback)
{
  return with_all_maps(cloud, [&](const auto& maps) {
    const auto all = maps.settings(parameters_of(s)).callback(callback);
    if(s.maximum_offset)
      return CGAL::Tandem::detect_planes<Tag>(rows_of(cloud), all.maximum_offset(*s.maximum_offset));
    return CGAL::Tandem::detect_planes<Tag>(rows_of(cloud), all);
  });
}

[[noreturn]] void throw_not_available(const std::string& backend, const std::string& why)
{
  throw std::runtime_error("the back end " + backend + " cannot be used: " + why + " (\"auto\" uses an available one)");
}

Shapes detect_on_backend(const Cloud& cloud, const Settings& s, const Callback& callback)
{
#ifdef CGAL_TANDEM_USE_CUDA
  if(s.backend == "auto")
    return detect_with<CGAL::Tandem::Cuda_if_available_tag>(cloud, s, callback);
  if(s.backend == "cuda" && CGAL::Tandem::cuda_available())
    return detect_with<CGAL::Tandem::Cuda_tag>(cloud, s, callback);
#endif
  if(s.backend == "cuda")
    throw_not_available(s.backend, CGAL::Tandem::cuda_device_report());
#ifdef CGAL_LINKED_WITH_TBB
  if(s.backend != "sequential")
    return detect_with<CGAL::Parallel_tag>(cloud, s, callback);
#else
  if(s.backend == "parallel")
    throw_not_available(s.backend, "this module was built without oneTBB");
#endif
  return detect_with<CGAL::Sequential_tag>(cloud, s, callback);
}

// A limit on the threads holds for this call only. It does not move to another thread, where signals would not be seen.
template <class F>
auto with_threads(const Settings& s, const F& f)
{
  [[maybe_unused]] const long long threads = above_zero("threads", s.threads, 0LL);
#ifdef CGAL_LINKED_WITH_TBB
  if(threads > 0) {
    const int most = tbb::this_task_arena::max_concurrency();
    tbb::task_arena arena(threads < most ? int(threads) : most);
    return arena.execute(f);
  }
#endif
  return f();
}

double mean_tolerance(const Cloud& cloud, double maximum_distance)
{
  if(cloud.tolerances == nullptr)
    return maximum_distance;
  double sum = 0;
  std::size_t count = 0;
  for(std::size_t i = 0; i < cloud.size; ++i)
    if(cloud.tolerances[i] > 0) {
      sum += (std::min)(cloud.tolerances[i], maximum_distance);
      ++count;
    }
  return count > 0 ? sum / double(count) : 0;
}

// Has all points.
struct One_process {
  double largest(double own) const { return own; }
  std::vector<long long> sums(const std::vector<long long>& own) const { return own; }
};

} // namespace

Shapes detect_planes(const Cloud& cloud, const Settings& s, const Callback& callback)
{
  return with_threads(s, [&] { return detect_on_backend(cloud, s, callback); });
}

std::vector<std::string> warnings(const Cloud& cloud, const Settings& s, const Shapes& shapes)
{
  const auto point = [map = Point_map{cloud.points}](std::size_t i) { return get(map, i); };
  const auto points = CGAL::make_range(boost::make_transform_iterator(Row(0), point),
                                       boost::make_transform_iterator(Row(cloud.size), point));
  const tandem_examples::Asked_shapes asked = {mean_tolerance(cloud, shapes.parameters().maximum_distance),
                                               s.maximum_distance && cloud.tolerances == nullptr,
                                               "maximum_distance_map", ""};
  const auto noise = [&] {
    return with_maps(cloud, [&](const auto& maps) { return CGAL::Tandem::estimate_noise(rows_of(cloud), maps); });
  };
  return with_threads(s, [&] { return tandem_examples::cloud_warnings(points, shapes, asked, noise, One_process()); });
}

Parameters estimate_parameters(const Cloud& cloud)
{
  return with_maps(cloud, [&](const auto& maps) { return CGAL::Tandem::estimate_parameters(rows_of(cloud), maps); });
}

std::vector<double> estimate_local_distances(const Cloud& cloud)
{
  return with_maps(cloud,
                   [&](const auto& maps) { return CGAL::Tandem::estimate_local_distances(rows_of(cloud), maps); });
}

namespace {

// Reads and writes the coefficients themselves.
struct Plane_map {
  using key_type = Coefficients;
  using value_type = Kernel::Plane_3;
  using reference = value_type;
  using category = boost::read_write_property_map_tag;

  friend value_type get(const Plane_map&, const Coefficients& c) { return value_type(c[0], c[1], c[2], c[3]); }
  friend void put(const Plane_map&, Coefficients& c, const value_type& plane)
  {
    c = {plane.a(), plane.b(), plane.c(), plane.d()};
  }
};

struct Label_map {
  using key_type = std::size_t;
  using value_type = int;
  using reference = value_type;
  using category = boost::readable_property_map_tag;

  const std::int32_t* labels;

  friend value_type get(const Label_map& map, std::size_t i) { return map.labels[i]; }
};

} // namespace

// The result does not depend on the normals, nor on the number of threads.
CGAL::Tandem::Plane_relations regularize_planes(const Cloud& cloud, const std::int32_t* labels, const Settings& s,
                                                std::vector<Coefficients>& planes)
{
  const auto all = np::point_map(Point_map{cloud.points})
                     .plane_map(Plane_map())
                     .plane_index_map(Label_map{labels})
                     .maximum_angle(s.maximum_angle.value_or(25))
                     .maximum_offset(s.maximum_offset.value_or(.01))
                     .regularity(s.regularity.value_or(Parameters().regularity))
                     .regularize_parallelism(s.regularize_parallelism)
                     .regularize_orthogonality(s.regularize_orthogonality)
                     .regularize_coplanarity(s.regularize_coplanarity)
                     .fixed_directions(s.fixed_directions)
                     .symmetry_direction(s.symmetry_direction.value_or(Parameters().symmetry_direction))
                     .regularize_axis_symmetry(s.symmetry_direction.has_value());
  if(s.maximum_distance)
    return CGAL::Tandem::regularize_planes(planes, rows_of(cloud), all.maximum_distance(*s.maximum_distance));
  return CGAL::Tandem::regularize_planes(planes, rows_of(cloud), all);
}

std::string find_violation(const Cloud& cloud, const Shapes& shapes)
{
  std::string why;
  with_all_maps(cloud,
                [&](const auto& maps) { return CGAL::Tandem::is_valid_result(rows_of(cloud), shapes, maps, &why); });
  return why;
}

std::vector<std::string> backends()
{
  std::vector<std::string> names = {"sequential"};
#ifdef CGAL_LINKED_WITH_TBB
  names.push_back("parallel");
#endif
  if(CGAL::Tandem::cuda_available())
    names.push_back("cuda");
  return names;
}

} // namespace tandem_python
