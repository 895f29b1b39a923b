// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tandem on each of its back ends, through its public interface.

#include "Contestant.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>
#include <CGAL/Simple_cartesian.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <iomanip>
#include <type_traits>

namespace CGAL::Tandem::benchmark {

namespace {

using Kernel = Simple_cartesian<double>;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = First_of_pair_property_map<Point_with_normal>;
using Normal_map = Second_of_pair_property_map<Point_with_normal>;
using Shapes = Planar_shapes_3<Kernel>;

Parameters parameters_of(const Task& task)
{
  Parameters p;
  p.maximum_distance = task.maximum_distance;
  p.maximum_angle = task.maximum_angle_deg;
  p.angle_tolerance = task.angle_tolerance_deg;
  p.minimum_region_size = task.minimum_region_size;
  p.k_neighbors = task.k_neighbors;
  p.simplicity = task.simplicity;
  p.regularity = task.regularity;
  p.regularity_period = task.regularity_period;
  p.regularize_parallelism = p.regularize_orthogonality = p.regularize_coplanarity = task.regularizes;
  return p;
}

template <class Tag>
Shapes detect(const std::vector<Point_with_normal>& range, const Task& task, bool estimates)
{
  const auto np =
    Tandem::parameters::settings(parameters_of(task)).maximum_offset(task.maximum_distance).point_map(Point_map());
  return estimates ? detect_planes<Tag>(range, np) : detect_planes<Tag>(range, np.normal_map(Normal_map()));
}

Run run_of(const Shapes& shapes, bool has_estimated)
{
  Run run;
  run.detection.label.assign(shapes.shape_indices().begin(), shapes.shape_indices().end());
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const auto& c = shapes.coefficients(s);
    run.detection.planes.push_back({{c[0], c[1], c[2]}, c[3]});
  }
  for(std::size_t i = 0; has_estimated && i < shapes.number_of_points(); ++i) {
    const Kernel::Vector_3 n = shapes.estimated_normal(i);
    run.normals.push_back({n.x(), n.y(), n.z()});
  }
  std::ostringstream hash;
  hash << std::hex << std::setw(16) << std::setfill('0') << shapes.hash();
  run.hash = hash.str();
  return run;
}

template <class Tag>
Run detect_step(const Ply_cloud& cloud, const Task& task, const Run&)
{
#ifdef CGAL_LINKED_WITH_TBB
  const std::size_t all = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, task.threads ? task.threads : all);
#endif
  const auto range = points_with_normals<Kernel>(cloud.points, cloud.normals);
  const bool estimates = estimates_normals(cloud, task);
  if(std::is_same<Tag, Cuda_tag>::value)
    detect<Tag>(range, task, estimates); // the first call sets up the device, which is not the method's time
  Meter meter;
  const Shapes shapes = detect<Tag>(range, task, estimates);
  const double seconds = meter.lap(), processor = meter.processor();
  const std::size_t bytes = meter.peak_bytes();
  Run run = run_of(shapes, estimates);
  run.normal_seconds = shapes.statistics().times.normals;
  run.detection_seconds = seconds - run.normal_seconds;
  run.user = processor;
  run.peak_bytes = bytes;
  run.finished = true;
  return run;
}

template <class Tag>
Contestant make_tandem(const std::string& name, const std::string& description)
{
  Contestant c = make_contestant(name, description, detect_step<Tag>);
  c.is_tandem = true;
  return c;
}

} // namespace

// One line for each back end that is compiled in.
std::vector<Contestant> tandem_contestants()
{
  std::vector<Contestant> list;
#ifdef CGAL_TANDEM_USE_CUDA
  list.push_back(make_tandem<Cuda_tag>("tandem-cuda", "Tandem, CUDA"));
#endif
#ifdef CGAL_LINKED_WITH_TBB
  list.push_back(make_tandem<Parallel_tag>("tandem", "Tandem"));
#endif
  list.push_back(make_tandem<Sequential_tag>("tandem-sequential", "Tandem, sequential"));
  return list;
}

} // namespace CGAL::Tandem::benchmark
