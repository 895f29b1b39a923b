// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detects the planes of a point cloud file. detect_planes --help explains the options.
// Exit code 0: success; 1: the data or the machine; 2: the command line.

#include "Output_files.h"
#include "fail.h"
#include "input/read_cloud.h"
#include "output/write_las.h"
#include "output/write_mesh.h"
#include "program_options.h"
#include "progress.h"
#include "signals.h"
#include "view/write_view.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>
#include <CGAL/Shape_regularization_tandem/cuda.h>
#include <CGAL/Shape_regularization_tandem/version.h>

#include <CGAL/Real_timer.h>
#include <CGAL/pca_estimate_normals.h>
#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

namespace program {

// A number below 0 is outside of the ranges of the library, as 0 is.
std::size_t count_of(const std::optional<long long>& given, std::size_t otherwise)
{
  return given ? std::size_t((std::max)(*given, 0LL)) : otherwise;
}

// From what the library says about a parameter, "NAME is VALUE, allowed is RANGE", what to say about the option.
Usage_error option_error(const std::string& message, const Options& o)
{
  const std::string is = " is ", allowed = ", allowed is ";
  const std::size_t value_at = message.find(is), range_at = message.find(allowed);
  if(value_at == message.npos || range_at == message.npos)
    return Usage_error(message);
  std::string option = "--" + message.substr(0, value_at);
  std::replace(option.begin(), option.end(), '_', '-');
  std::string value = message.substr(value_at + is.size(), range_at - value_at - is.size());
  const std::pair<const char*, std::optional<long long>> counts[] = {
    {"--minimum-region-size", o.minimum_region_size}, {"--k-neighbors", o.k_neighbors}, {"--cell-size", o.cell_size}};
  for(const auto& [name, given] : counts)
    if(option == name && given)
      value = std::to_string(*given);
  return Usage_error(option + is + value + ", must be in " + message.substr(range_at + allowed.size()));
}

// What was given, checked. A length or size that is to be estimated is 0.
CGAL::Tandem::Parameters parameters_of(const Options& o)
{
  CGAL::Tandem::Parameters p;
  p.maximum_angle = o.maximum_angle.value_or(p.maximum_angle);
  p.angle_tolerance = o.angle_tolerance.value_or(p.angle_tolerance);
  p.k_neighbors = count_of(o.k_neighbors, p.k_neighbors);
  p.cell_size = count_of(o.cell_size, p.cell_size);
  p.regularize_parallelism = o.regularize_parallelism;
  p.regularize_orthogonality = o.regularize_orthogonality;
  p.regularize_coplanarity = o.regularize_coplanarity;
  p.fixed_directions = o.fixed_directions;
  if(o.symmetry_direction) {
    p.regularize_axis_symmetry = true;
    p.symmetry_direction = *o.symmetry_direction;
  }
  CGAL::Tandem::Parameters checked = p;
  checked.maximum_distance = o.maximum_distance.value_or(1);
  checked.maximum_offset = o.maximum_offset.value_or(1);
  checked.minimum_region_size = count_of(o.minimum_region_size, 3);
  try {
    CGAL::Tandem::check_parameters(checked);
  } catch(const std::invalid_argument& e) {
    throw option_error(e.what(), o);
  }
  p.maximum_distance = o.maximum_distance.value_or(0);
  p.minimum_region_size = count_of(o.minimum_region_size, 0);
  return p;
}

void check_backend(const Options& o)
{
  if(o.backend == "cuda" && !CGAL::Tandem::cuda_available())
    throw std::runtime_error("the back end cuda cannot be used: " + CGAL::Tandem::cuda_device_report() +
                             " (--backend auto takes what there is)");
#ifndef CGAL_LINKED_WITH_TBB
  if(o.backend == "parallel")
    throw std::runtime_error("the parallel back end needs oneTBB: this program was built without it");
#endif
}

// The plain PCA of K neighbors, for comparisons. Points at infinity have no place in a kd-tree.
void estimate_normals_by_pca(Point_set& points, unsigned int k)
{
  using Item = std::pair<Kernel::Point_3, Kernel::Vector_3>;
  std::vector<Item> finite;
  for(Point_set::Index i : points)
    if(is_finite(points.point(i)))
      finite.emplace_back(points.point(i), CGAL::NULL_VECTOR);
  CGAL::pca_estimate_normals<CGAL::Parallel_if_available_tag>(
    finite, k,
    CGAL::parameters::point_map(CGAL::First_of_pair_property_map<Item>())
      .normal_map(CGAL::Second_of_pair_property_map<Item>()));
  points.add_normal_map();
  auto next = finite.begin();
  for(Point_set::Index i : points)
    points.normal(i) = is_finite(points.point(i)) ? (next++)->second : Kernel::Vector_3(CGAL::NULL_VECTOR);
}

void prepare_normals(Point_set& points, const Options& o, Run& run)
{
  run.normals = points.has_normal_map() ? "given" : "estimated";
  if(!o.estimate_normals)
    return;
  points.remove_normal_map();
  run.normals = "estimated";
  if(*o.estimate_normals == by_library)
    return;
  CGAL::Real_timer timer;
  timer.start();
  estimate_normals_by_pca(points, unsigned(*o.estimate_normals));
  run.normals = "by PCA of " + std::to_string(*o.estimate_normals) + " neighbors";
  run.normal_seconds = timer.time();
}

template <class Tag>
Shapes detect(const Point_set& points, const Options& o, Progress_line& progress)
{
  namespace np = CGAL::Tandem::parameters;
  const std::function<bool(double)> callback = [&](double share) {
    if(is_interrupted())
      throw Interrupted();
    progress.show(share);
    return true;
  };
  const auto all = np::settings(parameters_of(o)).callback(callback);
  if(o.maximum_offset)
    return CGAL::Tandem::detect_planes<Tag>(points, all.maximum_offset(*o.maximum_offset));
  return CGAL::Tandem::detect_planes<Tag>(points, all);
}

// Only the points tell whether a given distance is too small for them.
Shapes detect_on_backend(const Point_set& points, const Options& o)
try {
  Progress_line progress(!o.is_quiet, "estimating parameters");
#ifdef CGAL_TANDEM_USE_CUDA
  if(o.backend == "cuda")
    return detect<CGAL::Tandem::Cuda_tag>(points, o, progress);
  if(o.backend == "auto")
    return detect<CGAL::Tandem::Cuda_if_available_tag>(points, o, progress);
#endif
#ifdef CGAL_LINKED_WITH_TBB
  if(o.backend != "sequential")
    return detect<CGAL::Parallel_tag>(points, o, progress);
#endif
  return detect<CGAL::Sequential_tag>(points, o, progress);
} catch(const std::range_error& e) {
  const std::string message = e.what(), parameter = "maximum_distance";
  throw std::runtime_error(message.compare(0, parameter.size(), parameter) == 0
                             ? "--maximum-distance" + message.substr(parameter.size())
                             : message);
}

// What the back end that was chosen in the end ran on.
void name_device(const Shapes& shapes, const Options& o, Run& run)
{
  if(shapes.statistics().backend == "cuda")
    run.device = CGAL::Tandem::cuda_device_report();
#ifdef CGAL_LINKED_WITH_TBB
  if(shapes.statistics().backend != "parallel")
    return;
  run.threads = tbb::this_task_arena::max_concurrency();
  if(o.threads)
    run.threads = (std::min)(run.threads, int(*o.threads));
#else
  static_cast<void>(o);
#endif
}

// Reads the inputs, and prints what may be wrong with them.
Input_notes read_inputs(const Options& o, Point_set& points, Run& run)
{
  CGAL::Real_timer timer;
  timer.start();
  Input_notes notes;
  {
    const Progress_line progress(!o.is_quiet, "reading");
    notes = read_clouds(o.inputs, input_settings(o.inputs, o.columns, o.classes), points);
  }
  run.read_seconds = timer.time();
  for(const std::string& path : o.inputs)
    run.input += (run.input.empty() ? "" : ", ") + path;
  run.notes = notes.lines;
  for(const std::string& warning : notes.warnings)
    std::cerr << "detect_planes: warning: " << warning << std::endl;
  return notes;
}

void check_standard_output(const std::string& rest)
{
  if(!std::cout.flush())
    throw std::runtime_error("standard output cannot be written" + rest);
}

void run(const Options& o)
{
  parameters_of(o); // bad values must not wait for a large file
  check_backend(o);
  if(output_extension(o.output) == ".laz")
    check_laszip(o.output);
  if(!o.mesh.empty())
    check_mesh_method(o);
  if(!o.view.empty() && !has_view())
    throw Usage_error("--view: this program was built without three.js; install libjs-three and build again");
#ifdef CGAL_LINKED_WITH_TBB
  std::unique_ptr<tbb::global_control> limit;
  if(o.threads)
    limit =
      std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, std::size_t(*o.threads));
#endif
  Run run;
  Point_set points;
  const Input_notes notes = read_inputs(o, points, run);
  Output_files files(o);
  prepare_normals(points, o, run);

  const Shapes shapes = detect_on_backend(points, o);
  name_device(shapes, o, run);
  {
    const Progress_line progress(!o.is_quiet, "writing");
    files.write(points, notes, shapes, run);
  }
  if(!o.is_quiet)
    print_summary(std::cout, shapes, run);
  check_standard_output(files.is_empty() ? "" : "; the files are complete");
}

} // namespace program

int main(int argc, char* argv[])
{
  program::catch_signals();
  try {
    const program::Command_line command_line = program::parse(argc, argv);
    if(command_line.options.wants_help)
      std::cout << command_line.help;
    else if(command_line.options.wants_version)
      std::cout << "detect_planes (Tandem) " << CGAL_TANDEM_VERSION << "\n";
    else
      program::run(command_line.options);
    program::check_standard_output("");
    return 0;
  } catch(const program::Usage_error& e) {
    return program::fail(2, e.what(), " (detect_planes --help lists the options)");
  } catch(const std::bad_alloc&) {
    return program::fail(1, "not enough memory");
  } catch(const std::exception& e) {
    return program::fail(1, e.what());
  }
}
