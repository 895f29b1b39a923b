// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's detectors of planes, and its regularization of their results.

#include "Contestant.h"
#include "testing/fit_plane.h"
#include "scenes/scene_normals.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_regularization/regularize_planes.h>
#include <CGAL/property_map.h>
#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1050600000
#define CGAL_TANDEM_HAS_ITEMS_IN_REGION_GROWING
#include <CGAL/Shape_detection/Region_growing/Point_set.h>
#else
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#endif

#include <tuple>

namespace CGAL::Tandem::benchmark {

namespace {

// Region growing, as the manual of CGAL has it, behind one function for both of its interfaces: that until 5.5 and that
// from 5.6 on.
using Kernel = Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_range = std::vector<Point_with_normal>;
using Regions = std::vector<std::vector<std::size_t>>; // positions in the range

namespace on_points = Shape_detection::Point_set;

// An item stands for a point: its position, or, from 5.6 on, an iterator.
#ifdef CGAL_TANDEM_HAS_ITEMS_IN_REGION_GROWING
using Item = Point_range::const_iterator;

// What an item refers to.
template <class Value, Value Point_with_normal::*member>
struct Item_map {
  using key_type = Item;
  using value_type = Value;
  using reference = const Value&;
  using category = boost::lvalue_property_map_tag;
  friend reference get(const Item_map&, const Item& item) { return (*item).*member; }
};
using Point_map = Item_map<Kernel::Point_3, &Point_with_normal::first>;
using Normal_map = Item_map<Kernel::Vector_3, &Point_with_normal::second>;
using Neighbor_query = on_points::K_neighbor_query<Kernel, Item, Point_map>;

std::size_t position(const Point_range& range, Item item) { return std::size_t(item - range.begin()); }
Item item_at(const Point_range& range, std::size_t position) { return range.begin() + std::ptrdiff_t(position); }

Neighbor_query make_neighbor_query(const Point_range& range, unsigned k)
{
  return Neighbor_query(range, parameters::k_neighbors(k).point_map(Point_map()));
}
#else
using Item = std::size_t;
using Point_map = First_of_pair_property_map<Point_with_normal>;
using Normal_map = Second_of_pair_property_map<Point_with_normal>;
using Neighbor_query = on_points::K_neighbor_query<Kernel, Point_range, Point_map>;

std::size_t position(const Point_range&, Item item) { return item; }
Item item_at(const Point_range&, std::size_t position) { return position; }

Neighbor_query make_neighbor_query(const Point_range& range, unsigned k) { return Neighbor_query(range, k); }
#endif

// Each neighborhood computed once: a stronger peer than users have.
class Cached_neighbors {
public:
  Cached_neighbors(const Point_range& range, const Neighbor_query& query, unsigned k)
    : range_(range), k_(k), rows_(range.size() * k)
  {
    std::vector<Item> row;
    for(std::size_t i = 0; i < range.size(); ++i) {
      row.clear();
      query(item_at(range, i), row);
      row.resize(k, item_at(range, i));
      for(std::size_t j = 0; j < k; ++j)
        rows_[i * k + j] = std::uint32_t(position(range, row[j]));
    }
  }

  void operator()(Item item, std::vector<Item>& neighbors) const
  {
    neighbors.clear();
    const std::size_t first = position(range_, item) * k_;
    for(std::size_t j = first; j < first + k_; ++j)
      neighbors.push_back(item_at(range_, rows_[j]));
  }

private:
  const Point_range& range_;
  std::size_t k_;
  std::vector<std::uint32_t> rows_;
};

template <class Neighbors>
Regions grow_regions(const Point_range& range, Neighbors& neighbors, const Task& task)
{
#ifdef CGAL_TANDEM_HAS_ITEMS_IN_REGION_GROWING
  using Region = on_points::Least_squares_plane_fit_region<Kernel, Item, Point_map, Normal_map>;
  using Sorting = on_points::Least_squares_plane_fit_sorting<Kernel, Item, Neighbors, Point_map, Normal_map>;
  Sorting sorting(range, neighbors, parameters::point_map(Point_map()).normal_map(Normal_map()));
  sorting.sort();
  Region region(parameters::maximum_distance(task.maximum_distance)
                  .maximum_angle(task.maximum_angle_deg)
                  .minimum_region_size(task.minimum_region_size));
  Shape_detection::Region_growing<Neighbors, Region> growing(range, sorting.ordered(), neighbors, region);
  std::vector<std::pair<Kernel::Plane_3, std::vector<Item>>> found;
  growing.detect(std::back_inserter(found));
  Regions regions;
  for(const auto& shape : found) {
    regions.emplace_back();
    for(const Item& item : shape.second)
      regions.back().push_back(position(range, item));
  }
#else
  using Region = on_points::Least_squares_plane_fit_region<Kernel, Point_range, Point_map, Normal_map>;
  using Sorting = on_points::Least_squares_plane_fit_sorting<Kernel, Point_range, Neighbors, Point_map>;
  Sorting sorting(range, neighbors);
  sorting.sort();
  Region region(range, task.maximum_distance, task.maximum_angle_deg, task.minimum_region_size);
  using Seeds = typename Sorting::Seed_map;
  Shape_detection::Region_growing<Point_range, Neighbors, Region, Seeds> growing(range, neighbors, region,
                                                                                 sorting.seed_map());
  Regions regions;
  growing.detect(std::back_inserter(regions));
#endif
  return regions;
}

Regions region_growing(const Point_range& range, const Task& task, bool is_cached)
{
  Neighbor_query query = make_neighbor_query(range, task.k_neighbors);
  if(!is_cached)
    return grow_regions(range, query, task);
  Cached_neighbors cached(range, query, task.k_neighbors);
  return grow_regions(range, cached, task);
}

using Ransac_item = std::tuple<Kernel::Point_3, Kernel::Vector_3, std::uint32_t>;
using Ransac_range = std::vector<Ransac_item>;
using Ransac_point_map = Nth_of_tuple_property_map<0, Ransac_item>;
using Ransac_normal_map = Nth_of_tuple_property_map<1, Ransac_item>;
using Ransac_traits =
  Shape_detection::Efficient_RANSAC_traits<Kernel, Ransac_range, Ransac_point_map, Ransac_normal_map>;
using Ransac = Shape_detection::Efficient_RANSAC<Ransac_traits>;
using Ransac_plane = Shape_detection::Plane<Ransac_traits>;

// The points as CGAL's detectors want them: relative to the center, since they lose shapes far from the origin.
struct Input {
  explicit Input(const Ply_cloud& cloud) : center(extent_of(cloud.points).center)
  {
    points.reserve(cloud.points.size());
    for(const Vec& p : cloud.points)
      points.push_back(p - center);
  }

  // Without normals where they are to be estimated, which is part of the work.
  template <class Range, class Make>
  Range range(const Ply_cloud& cloud, const Task& task, Make make) const
  {
    Range result;
    result.reserve(points.size());
    for(std::size_t i = 0; i < points.size(); ++i) {
      const Vec &p = points[i], n = estimates_normals(cloud, task) ? Vec{0, 0, 0} : unit(cloud.normals[i]);
      result.push_back(make(Kernel::Point_3(p.x, p.y, p.z), Kernel::Vector_3(n.x, n.y, n.z), i));
    }
    return result;
  }

  Vec center;
  std::vector<Vec> points;
};

// Begins the run: normal_of(i) is where the normal of a point goes.
template <class Normal>
Run estimate_normals(const Input& in, const Ply_cloud& cloud, const Task& task, Meter& meter, Normal normal_of)
{
  Run run;
  if(!estimates_normals(cloud, task))
    return run;
  run.normals = scenes::pca_normals(in.points);
  for(std::size_t i = 0; i < in.points.size(); ++i) {
    const Vec n = unit(run.normals[i]);
    normal_of(i) = Kernel::Vector_3(n.x, n.y, n.z);
  }
  run.normal_seconds = meter.lap();
  return run;
}

void move(std::vector<Plane>& planes, const Vec& by)
{
  for(Plane& plane : planes)
    plane.offset -= dot(plane.normal, by);
}

Plane normalized(const Kernel::Plane_3& p)
{
  const Vec n{p.a(), p.b(), p.c()};
  return {(1 / length(n)) * n, p.d() / length(n)};
}

template <bool is_cached>
Run growing_step(const Ply_cloud& cloud, const Task& task, const Run&)
{
  const Input in(cloud);
  Point_range range = in.range<Point_range>(
    cloud, task, [](const auto& p, const auto& n, std::size_t) { return Point_with_normal(p, n); });
  Meter meter;
  Run run = estimate_normals(
    in, cloud, task, meter, [&](std::size_t i) -> auto& { return range[i].second; });
  const Regions regions = region_growing(range, task, is_cached);
  run.detection.label.assign(range.size(), -1);
  for(std::size_t s = 0; s < regions.size(); ++s)
    for(std::size_t i : regions[s])
      run.detection.label[i] = std::int32_t(s);
  run.detection.planes = fit_planes(in.points, run.detection.label, regions.size());
  run.detection_seconds = meter.lap();
  move(run.detection.planes, in.center);
  return finished(run, meter);
}

Ransac::Parameters ransac_parameters(const Task& task)
{
  Ransac::Parameters p;
  p.probability = 0.01;
  p.min_points = task.minimum_region_size;
  p.epsilon = task.maximum_distance;
  p.cluster_epsilon = task.cluster_epsilon;
  p.normal_threshold = std::cos(task.maximum_angle_deg * 0.017453292519943295);
  return p;
}

// On a range that carries the position of each item, since the detector reorders it.
Run ransac_step(const Ply_cloud& cloud, const Task& task, const Run&)
{
  const Input in(cloud);
  Ransac_range range = in.range<Ransac_range>(
    cloud, task, [](const auto& p, const auto& n, std::size_t i) { return Ransac_item(p, n, std::uint32_t(i)); });
  Meter meter;
  Run run = estimate_normals(
    in, cloud, task, meter, [&](std::size_t i) -> auto& { return std::get<1>(range[i]); });
  get_default_random() = Random(task.seed);
  Ransac detector;
  detector.set_input(range);
  detector.add_shape_factory<Ransac_plane>();
  detector.detect(ransac_parameters(task));
  run.detection.label.assign(range.size(), -1);
  for(const auto& shape : detector.shapes()) {
    for(std::size_t i : shape->indices_of_assigned_points())
      run.detection.label[std::get<2>(range[i])] = std::int32_t(run.detection.planes.size());
    const Kernel::Plane_3 plane = *dynamic_cast<Ransac_plane*>(shape.get());
    run.detection.planes.push_back(normalized(plane));
  }
  run.detection_seconds = meter.lap();
  move(run.detection.planes, in.center);
  return finished(run, meter);
}

template <bool uses_symmetry>
Run regularize_step(const Ply_cloud& cloud, const Task& task, const Run& base)
{
  Run run = base;
  const Vec center = extent_of(cloud.points).center;
  move(run.detection.planes, -1.0 * center);
  std::vector<Kernel::Point_3> points;
  for(const Vec& p : cloud.points)
    points.emplace_back(p.x - center.x, p.y - center.y, p.z - center.z);
  std::vector<Kernel::Plane_3> planes;
  for(const Plane& p : run.detection.planes)
    planes.emplace_back(p.normal.x, p.normal.y, p.normal.z, p.offset);
  std::vector<int> index(run.detection.label.begin(), run.detection.label.end());
  Meter meter;
  if(!planes.empty())
    Shape_regularization::Planes::regularize_planes(planes, Identity_property_map<Kernel::Plane_3>(), points,
                                                    Identity_property_map<Kernel::Point_3>(),
                                                    CGAL::parameters::plane_index_map(make_property_map(index))
                                                      .regularize_axis_symmetry(uses_symmetry)
                                                      .maximum_angle(task.angle_tolerance_deg)
                                                      .maximum_offset(task.maximum_distance));
  run.regularization_seconds = meter.lap();
  std::transform(planes.begin(), planes.end(), run.detection.planes.begin(), normalized);
  move(run.detection.planes, center);
  return finished(run, meter);
}

// A detector, followed by regularize_planes without and with its symmetry.
void add_regularized(std::vector<Contestant>& list, Contestant base, const std::string& name)
{
  base.base = base.name;
  const std::string description = base.description;
  base.name = name + "+regularize";
  base.description = description + " + regularize_planes";
  base.step = regularize_step<false>;
  list.push_back(base);
  base.name = name + "+symmetry";
  base.description = description + " + regularize_planes, symmetric";
  base.step = regularize_step<true>;
  list.push_back(base);
}

} // namespace

std::vector<Contestant> cgal_contestants()
{
  std::vector<Contestant> list;
  list.push_back(make_contestant("growing", "region growing", growing_step<false>));
  list.push_back(make_contestant("growing-cached", "region growing (cached)", growing_step<true>));
  add_regularized(list, list.back(), "growing");
  list.push_back(make_contestant("ransac", "Efficient RANSAC", ransac_step));
  list.back().is_random = true;
  add_regularized(list, list.back(), "ransac");
  return list;
}

} // namespace CGAL::Tandem::benchmark
