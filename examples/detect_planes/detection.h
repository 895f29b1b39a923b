// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shapes of a cloud: detected as the command line says, on the back end that was chosen, or those of planes that are
// known.

#ifndef DETECT_PLANES_DETECTION_H
#define DETECT_PLANES_DETECTION_H

#include "../cloud_warnings.h"
#include "check_options.h"
#include "input/read_cloud.h"
#include "output/writers.h"
#include "ranks/Processes.h"

#include <CGAL/Shape_regularization_tandem/cuda.h>
#include <CGAL/Shape_regularization_tandem/detect_planes.h>
#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>
#include <CGAL/Shape_regularization_tandem/shapes_of_planes.h>
#include <CGAL/Shape_regularization_tandem/upward_direction.h>
#include <CGAL/Tandem/Parameters.h>

#include <CGAL/Real_timer.h>
#include <CGAL/pca_estimate_normals.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

namespace program {

// --- The tolerance of each point, where points have their own: a property of the cloud.

using Tolerance_map = Point_set::Property_map<double>;

inline bool has_tolerance_of_each_point(const Options& o)
{
  return !o.tolerance_column.empty() || o.noise || o.has_local_distances;
}

// Where the tolerances come from.
inline std::string source_of_tolerances(const Options& o)
{
  if(!o.tolerance_column.empty())
    return "column " + o.tolerance_column;
  if(o.noise)
    return "noise " + o.noise_text;
  return o.has_local_distances ? "auto-local" : o.maximum_distance ? "given" : "estimated";
}

// Points that were seen from one place.
struct View {
  std::size_t first, last;
  Kernel::Point_3 from;
};

// Of the points of an input, if the places are known: that of the option, else those of the file. Writers that know none
// put the default into PCD files.
inline std::vector<View> views_of(const Options& o, const Input_part& part, bool takes_default)
{
  std::vector<View> views;
  for(const Viewpoint& v : o.viewpoint ? std::vector<Viewpoint>{{*o.viewpoint}} : part.notes.viewpoints)
    if(!v.is_default || takes_default) {
      if(!views.empty())
        views.back().last = part.first + v.first;
      views.push_back({part.first + v.first, part.last, {v.place[0], v.place[1], v.place[2]}});
    }
  return views;
}

// Whether a place is no farther from the points than they extend. Otherwise it stands for a side, as above a tile, and not
// for a sensor.
inline bool is_of_sensor(const std::array<double, 3>& place, const Input_cloud& cloud, const Processes& processes)
{
  Box box = tandem_examples::box_of(cloud.points.points(), processes).box;
  for(const Input_part& part : cloud.parts)
    box += part.notes.box;
  const auto away = [&](int c) { return (std::max)({box.min(c) - place[c], place[c] - box.max(c), 0.}); };
  return std::hypot(away(0), away(1), away(2)) <= std::hypot(box.x_span(), box.y_span(), box.z_span());
}

// Puts the places beside the points; returns whether there are any.
inline bool note_viewpoints(const Options& o, const Processes& processes, Input_cloud& cloud)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if(o.viewpoint && !is_of_sensor(*o.viewpoint, cloud, processes))
    return false;
  bool are_any = false;
  for(const Input_part& part : cloud.parts)
    for(const View& view : views_of(o, part, false)) {
      are_any = true;
      const auto places = cloud.points.add_property_map(viewpoint_name, Kernel::Point_3(nan, nan, nan)).first;
      for(Point_set::Index i : part_of(cloud.points, view.first, view.last))
        places[i] = view.from;
    }
  return are_any;
}

// Of the column the reader has made the property already; where a rank has no points, it is empty. Those of auto-local
// come with the detection.
inline void prepare_tolerances(const Options& o, Input_cloud& cloud)
{
  if(!has_tolerance_of_each_point(o))
    return;
  Tolerance_map tolerances = cloud.points.add_property_map<double>(tolerance_name, 0.).first;
  if(!o.noise)
    return;
  for(const Input_part& part : cloud.parts) {
    if(part.first == part.last)
      continue;
    const std::vector<View> views = views_of(o, part, false);
    if(views.empty())
      throw_error(o.inputs[part.input],
                  (!part.notes.viewpoints.empty()
                     ? ": the VIEWPOINT is 0 0 0 1 0 0 0, which stands for an unknown place"
                     : ": does not tell the place of the sensor"),
                  "; --noise needs that place: pass --viewpoint X,Y,Z (0,0,0 if it is the origin)");
    for(const View& view : views)
      for(Point_set::Index i : part_of(cloud.points, view.first, view.last)) {
        const Kernel::Vector_3 v = cloud.points.point(i) - view.from;
        const double range =
          std::sqrt(std::fma(v.x(), v.x(), std::fma(v.y(), v.y(), v.z() * v.z()))); // on all compilers
        tolerances[i] = CGAL::Tandem::distance_of_noise((*o.noise)(range));
      }
  }
}

// No tolerance exceeds the maximum distance. The sum of all is one of integers, so that it does not depend on the ranks.
inline Tolerance_facts tolerance_facts(const Point_set& points, const Options& o, const Shapes& shapes,
                                       const Processes& processes)
{
  const double maximum_distance = shapes.parameters().maximum_distance;
  Tolerance_facts facts;
  facts.source = source_of_tolerances(o);
  facts.note = o.estimate_note.empty() ? shapes.statistics().estimate_note : o.estimate_note;
  facts.is_of_each_point = has_tolerance_of_each_point(o);
  facts.smallest = facts.mean = facts.largest = maximum_distance;
  if(!facts.is_of_each_point)
    return facts;
  const Tolerance_map tolerances = *find_property<double>(points, tolerance_name);
  constexpr int sum_bits = 30;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  long long count = 0, sum = 0;
  for(Point_set::Index i : points)
    if(is_finite(points.point(i)) && tolerances[i] > 0) {
      const double tolerance = (std::min)(tolerances[i], maximum_distance);
      smallest = (std::min)(smallest, tolerance);
      largest = (std::max)(largest, tolerance);
      sum += std::llround(std::ldexp(tolerance / maximum_distance, sum_bits));
      ++count;
    }
  smallest = -processes.largest(-smallest);
  facts.largest = processes.largest(largest);
  const std::vector<long long> sums = processes.sums({count, sum});
  facts.smallest = sums[0] > 0 ? smallest : 0;
  facts.mean = sums[0] > 0 ? maximum_distance * std::ldexp(double(sums[1]) / double(sums[0]), -sum_bits) : 0;
  return facts;
}

// --- The parameters, and the detection with them.

// A number below 0 is outside of the ranges of the library, as 0 is.
inline std::size_t count_of(const std::optional<long long>& given, std::size_t otherwise)
{
  return given ? std::size_t((std::max)(*given, 0LL)) : otherwise;
}

// What the library says about a parameter, of the option.
inline std::string option_message(const CGAL::Tandem::Parameter_error& e, const Options& o)
{
  std::string option = "--" + e.name(), value = e.value();
  std::replace(option.begin(), option.end(), '_', '-');
  const std::pair<const char*, std::optional<long long>> counts[] = {
    {"--minimum-region-size", o.minimum_region_size}, {"--k-neighbors", o.k_neighbors}, {"--cell-size", o.cell_size}};
  for(const auto& [name, given] : counts)
    if(option == name && given)
      value = std::to_string(*given);
  return option + " is " + value + ", allowed is " + e.range();
}

// What was given, checked. A length or size that is to be estimated is 0.
inline CGAL::Tandem::Parameters parameters_of(const Options& o)
{
  CGAL::Tandem::Parameters p;
  p.maximum_angle = o.maximum_angle.value_or(p.maximum_angle);
  p.angle_tolerance = o.angle_tolerance.value_or(p.angle_tolerance);
  p.simplicity = o.simplicity.value_or(p.simplicity);
  p.regularity = o.regularity.value_or(p.regularity);
  p.surfel_size = o.surfel_size.value_or(p.surfel_size);
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
  if(o.is_upright && o.up) {
    p.fixed_directions.push_back(*o.up);
    p.fixed_regularity = 2;
    p.regularize_axis_symmetry = true;
    p.symmetry_direction = o.symmetry_direction.value_or(*o.up);
  }
  CGAL::Tandem::Parameters checked = p;
  checked.maximum_distance = o.maximum_distance.value_or(1);
  checked.maximum_offset = o.maximum_offset.value_or(1);
  checked.minimum_region_size = count_of(o.minimum_region_size, 3);
  try {
    CGAL::Tandem::check_parameters(checked);
  } catch(const CGAL::Tandem::Parameter_error& e) {
    throw Usage_error(option_message(e, o));
  }
  p.maximum_distance = o.maximum_distance.value_or(o.estimated_distance);
  p.minimum_region_size = count_of(o.minimum_region_size, 0);
  return p;
}

// With the tolerances of the points, where they have their own.
template <class Tag, class Named_parameters>
Shapes detect_with(const Point_set& points, const Named_parameters& np)
{
  if(const auto tolerances = find_property<double>(points, tolerance_name))
    return CGAL::Tandem::detect_planes<Tag>(points, np.maximum_distance_map(*tolerances));
  return CGAL::Tandem::detect_planes<Tag>(points, np);
}

// Estimates one distance for all points; returns what is to be said of it.
template <class Tag>
CGAL::Tandem::Distance_estimate estimate_distance(const Point_set& points, Options& o)
{
  CGAL::Tandem::Distance_estimate estimate;
  const auto list = CGAL::Tandem::parameters::settings(parameters_of(o));
  o.estimated_distance = CGAL::Tandem::estimate_parameters<Tag>(points, list, &estimate).maximum_distance;
  return estimate;
}

template <class Tag>
void estimate_tolerances(const Point_set& points, const Options& o)
{
  Tolerance_map tolerances = *find_property<double>(points, tolerance_name);
  const std::vector<double> estimated =
    CGAL::Tandem::estimate_local_distances<Tag>(points, CGAL::Tandem::parameters::settings(parameters_of(o)));
  auto next = estimated.begin();
  for(Point_set::Index i : points)
    tolerances[i] = *next++;
}

template <class Tag>
Shapes detect(const Point_set& points, const Options& o, Progress_line& progress)
{
  namespace np = CGAL::Tandem::parameters;
  const std::function<bool(double)> callback = [&](double fraction) {
    check_signals();
    progress.show_stage(fraction);
    return true;
  };
  if(o.has_local_distances)
    estimate_tolerances<Tag>(points, o);
  const auto all = np::settings(parameters_of(o)).callback(callback);
  if(o.maximum_offset)
    return detect_with<Tag>(points, all.maximum_offset(*o.maximum_offset));
  return detect_with<Tag>(points, all);
}

// While it lives, oneTBB has at most so many threads; 0: one for each processor.
class Thread_limit {
public:
#ifdef CGAL_LINKED_WITH_TBB
  explicit Thread_limit(int most) : number(tbb::this_task_arena::max_concurrency())
  {
    if(most <= 0)
      return;
    control.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(most));
    number = (std::min)(number, most);
  }

  int threads() const { return number; }

private:
  std::optional<tbb::global_control> control;
  int number;
#else
  explicit Thread_limit(int) {}
  int threads() const { return 1; }
#endif
};

// --- Finds what the program, as it is built, or this machine cannot do, before any work.

inline void check_program(const Options& o, const Processes& processes)
{
  parameters_of(o);
  if(processes.are_many())
    check_ranks(o);
  // What is not built is bad usage, as a device that is not there is none.
  refuse_if(!is_in(o.backend, built_with().backends()), "--backend ", o.backend, " needs ",
            o.backend == "cuda" ? "CUDA" : "oneTBB", ": this program was built without it");
  if(o.backend == "cuda" && !CGAL::Tandem::cuda_available())
    throw_error("the back end cuda cannot be used: ", CGAL::Tandem::cuda_device_report(),
                " (--backend auto uses a back end that is available)");
  refuse_if(output_extension(o.output) == ".laz" && !has_laszip, o.output,
            ": LAZ needs LASzip; write .las and compress it with laszip, or build Tandem with it");
  refuse_if(!o.view.empty() && !has_view,
            "--view: this program was built without three.js; install libjs-three and build again");
}

// --- Planes from a file, as --planes writes them, or from the columns a, b, c, d of a table with a line of names.

using Plane_columns = std::array<std::size_t, 4>; // of a, b, c, d

inline CGAL::Tandem::Coefficients plane_of(const Text_row& row, const Cells& cells, const Plane_columns& columns)
{
  CGAL::Tandem::Coefficients plane;
  for(std::size_t c = 0; c < 4; ++c) {
    const std::string_view cell = cells[columns[c]];
    const std::optional<double> number = parse_number(cell);
    if(!number || !std::isfinite(*number))
      fail_at_row(row.number, "has '", cell.substr(0, 40), "' where a finite number is expected");
    plane[c] = *number;
  }
  const double largest = (std::max)({std::fabs(plane[0]), std::fabs(plane[1]), std::fabs(plane[2])});
  if(largest == 0)
    fail_at_row(row.number, "has a null vector as normal");
  if(!std::isfinite(plane[3] / largest))
    fail_at_row(row.number, "has a plane whose distance from the origin is not finite");
  return plane;
}

// The first row may have names instead of numbers.
inline void read_known_planes(Options& o)
try {
  if(o.planes_from.empty())
    return;
  File_source file(o.planes_from);
  Input_buffer bytes(file);
  Text_lines lines(bytes);
  Plane_columns columns = {0, 1, 2, 3};
  std::size_t values = 0; // of each row
  while(lines.next_filled()) {
    const Text_row& row = lines.row();
    const Cells cells = values_of(row.text);
    if(is_comment(row.text))
      continue;
    if(values == 0 && !std::all_of(cells.begin(), cells.end(), parse_number)) {
      for(std::size_t c = 0; c < 4; ++c) {
        const auto is_name = [c](std::string_view cell) {
          return plain_name(cell) == std::string("abcd").substr(c, 1);
        };
        columns[c] = std::size_t(std::find_if(cells.begin(), cells.end(), is_name) - cells.begin());
        if(columns[c] == cells.size())
          fail_at_row(row.number, "has neither four numbers 'a b c d' nor names of columns with a, b, c and d");
      }
      values = cells.size();
      continue;
    }
    values = values == 0 ? 4 : values;
    if(cells.size() != values)
      fail_at_row(row.number, "has ", cells.size(), " values instead of ", values);
    o.known_planes.push_back(plane_of(row, cells, columns));
  }
  if(o.known_planes.empty())
    throw std::runtime_error("has no planes");
} catch(const std::runtime_error& e) {
  throw_error("--planes-from ", o.planes_from, ": ", e.what());
}

// --- The normals that the detection gets: those of the input, or none, or others than those of the library.

// The plain PCA of K neighbors, for comparisons. Points at infinity have no place in a kd-tree.
inline void estimate_normals_by_pca(Point_set& points, unsigned int k)
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

inline void prepare_normals(Point_set& points, const Options& o, Run& run)
{
  run.normals = points.has_normal_map() ? "given" : o.known_planes.empty() ? "estimated" : "none";
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

// ---

// An automatic distance is estimated here, once. Where the noise varies, it is one for each point.
inline void choose_tolerances(const Point_set& points, const Processes& processes, Options& o)
{
  if(o.maximum_distance || has_tolerance_of_each_point(o))
    return;
  const CGAL::Tandem::Distance_estimate estimate = processes.are_many()
                                                     ? processes.estimate_distance(points, o)
                                                     : estimate_distance<CGAL::Parallel_if_available_tag>(points, o);
  o.estimate_note = estimate.note;
  if(estimate.noise_varies) {
    o.has_local_distances = true;
    o.estimated_distance = 0; // the tolerances bound it
    o.estimate_note += " Each point has its own tolerance; --maximum-distance D sets one for all points.";
  }
}

template <class Tag>
Shapes label_with(const Point_set& points, const Options& o)
{
  if(o.has_local_distances)
    estimate_tolerances<Tag>(points, o);
  const auto all = CGAL::Tandem::parameters::settings(parameters_of(o));
  if(const auto tolerances = find_property<double>(points, tolerance_name))
    return CGAL::Tandem::shapes_of_planes<Tag>(o.known_planes, points, all.maximum_distance_map(*tolerances));
  return CGAL::Tandem::shapes_of_planes<Tag>(o.known_planes, points, all);
}

// Only the points tell whether a given distance is too small for them.
inline Shapes detect_on_backend(const Point_set& points, const Options& o, Processes& processes)
try {
  Progress_line progress(!o.is_quiet && processes.is_first(), "estimating parameters");
  if(!o.known_planes.empty())
    return o.backend == "sequential" ? label_with<CGAL::Sequential_tag>(points, o)
                                     : label_with<CGAL::Parallel_if_available_tag>(points, o);
  if(processes.are_many())
    return processes.detect(points, o, progress);
  if constexpr(has_cuda) {
    if(o.backend == "cuda")
      return detect<CGAL::Tandem::Cuda_tag>(points, o, progress);
    if(o.backend == "auto")
      return detect<CGAL::Tandem::Cuda_if_available_tag>(points, o, progress);
  }
  return o.backend == "sequential" ? detect<CGAL::Sequential_tag>(points, o, progress)
                                   : detect<CGAL::Parallel_if_available_tag>(points, o, progress);
} catch(const CGAL::Tandem::Parameter_error& e) {
  throw std::runtime_error(option_message(e, o));
}

// Of the whole run, on all ranks.
inline std::vector<std::string> all_warnings(const Point_set& points, const Shapes& shapes, const Options& o,
                                             const Processes& processes, const Run& run)
{
  const tandem_examples::Asked_shapes asked = {run.tolerance.mean,
                                               o.maximum_distance && !run.tolerance.is_of_each_point,
                                               "--tolerance-column, --noise",
                                               o.planes_from,
                                               {!o.estimate_normals, run.veil_points}};
  return tandem_examples::cloud_warnings(
    points.points(), shapes, asked, [&] { return CGAL::Tandem::estimate_noise(points); }, processes);
}

// The shapes tell the direction upward, where it is not given. --upright needs it before there are shapes: it takes the
// expected one, and where shapes tell of another one, that of a detection without --upright, as this turns shapes.
inline Shapes detect_upward(const Point_set& points, Options& o, Processes& processes, Run& run)
{
  if(o.up) {
    run.up.direction = *o.up;
    return detect_on_backend(points, o, processes);
  }
  const Box box = tandem_examples::box_of(points.points(), processes).box;
  const auto center = [&box](int c) { return (box.min(c) + box.max(c)) / 2; };
  const auto expected = CGAL::Tandem::expected_upward_direction({center(0), center(1), center(2)});
  o.up = expected;
  Shapes shapes = detect_on_backend(points, o, processes);
  run.up = CGAL::Tandem::upward_direction(shapes, expected);
  if(o.is_upright && run.up.direction != expected) {
    run.up_seconds = shapes.statistics().times.total;
    o.is_upright = false;
    shapes = detect_on_backend(points, o, processes);
    run.up_seconds += shapes.statistics().times.total;
    run.up = CGAL::Tandem::upward_direction(shapes, expected);
    o.is_upright = true;
    o.up = run.up.direction;
    shapes = detect_on_backend(points, o, processes);
  }
  run.up_source = run.up.is_found ? "found" : "assumed";
  o.up = run.up.direction;
  return shapes;
}

} // namespace program

#endif // DETECT_PLANES_DETECTION_H
