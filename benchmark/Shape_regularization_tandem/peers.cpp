// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's detectors on a cloud, optionally followed by CGAL's regularize_planes,
// written as labels and planes, so that `evaluate` judges them like any other.

#include "detection_files.h"
#include "fit_plane.h"
#include "ply_cloud.h"
#include "../../test/Shape_regularization_tandem/scene_normals.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#include <CGAL/Shape_regularization/regularize_planes.h>
#include <CGAL/version.h>

#include <boost/program_options.hpp>

#include <chrono>
#include <ctime>
#include <iostream>
#include <tuple>

#if CGAL_VERSION_NR >= 1050600000
#error "The peers are measured with the interface of region growing before CGAL 5.6."
#endif

namespace po = boost::program_options;
using namespace CGAL::Tandem::benchmark;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Range = std::vector<Point_with_normal>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;

struct Request {
  std::string method, cloud, labels, planes, plain_labels, plain_planes;
  double epsilon, alpha_deg, beta_deg, cluster_epsilon;
  std::size_t minimum;
  unsigned k;
  bool regularizes, uses_symmetry, is_cleaned;
};

class Stopwatch {
public:
  double wall() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double cpu() const { return double(std::clock() - cpu_) / CLOCKS_PER_SEC; }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  std::clock_t cpu_ = std::clock();
};

using Knn = CGAL::Shape_detection::Point_set::K_neighbor_query<Kernel, Range, Point_map>;

// Each neighborhood computed once: a stronger peer than users have.
class Cached_neighbors {
public:
  Cached_neighbors(const Range& range, const Knn& query, unsigned k) : k_(k), rows_(range.size() * k)
  {
    std::vector<std::size_t> row;
    for(std::size_t i = 0; i < range.size(); ++i) {
      row.clear();
      query(i, row);
      row.resize(k, i);
      std::copy(row.begin(), row.end(), rows_.begin() + std::ptrdiff_t(i * k));
    }
  }

  void operator()(std::size_t i, std::vector<std::size_t>& neighbors) const
  {
    auto first = rows_.begin() + std::ptrdiff_t(i * k_);
    neighbors.assign(first, first + std::ptrdiff_t(k_));
  }

private:
  std::size_t k_;
  std::vector<std::uint32_t> rows_;
};

template <class Neighbor_query>
std::vector<std::vector<std::size_t>> grow(const Range& range, Neighbor_query& neighbors, const Request& r)
{
  namespace on_points = CGAL::Shape_detection::Point_set;
  using Region = on_points::Least_squares_plane_fit_region<Kernel, Range, Point_map, Normal_map>;
  using Sorting = on_points::Least_squares_plane_fit_sorting<Kernel, Range, Neighbor_query, Point_map>;
  Sorting sorting(range, neighbors);
  sorting.sort();
  Region region(range, r.epsilon, r.alpha_deg, r.minimum);
  using Seeds = typename Sorting::Seed_map;
  using Region_growing = CGAL::Shape_detection::Region_growing<Range, Neighbor_query, Region, Seeds>;
  Region_growing growing(range, neighbors, region, sorting.seed_map());
  std::vector<std::vector<std::size_t>> regions;
  growing.detect(std::back_inserter(regions));
  return regions;
}

Detection region_growing(const Range& range, const std::vector<Vec>& points, const Request& r)
{
  Knn query(range, r.k);
  std::vector<std::vector<std::size_t>> regions;
  if(r.method == "rg-cached") {
    Cached_neighbors cached(range, query, r.k);
    regions = grow(range, cached, r);
  } else
    regions = grow(range, query, r);
  Detection detection;
  detection.label.assign(range.size(), -1);
  for(std::size_t s = 0; s < regions.size(); ++s)
    for(std::size_t i : regions[s])
      detection.label[i] = std::int32_t(s);
  detection.planes = fit_planes(points, detection.label, regions.size());
  return detection;
}

Plane normalized(const Kernel::Plane_3& p)
{
  Vec n{p.a(), p.b(), p.c()};
  double l = length(n);
  return {(1 / l) * n, p.d() / l};
}

// On a copy with the position of each item, since the detector reorders its input.
using Item = std::tuple<Kernel::Point_3, Kernel::Vector_3, std::uint32_t>;
using Ransac_traits =
  CGAL::Shape_detection::Efficient_RANSAC_traits<Kernel, std::vector<Item>, CGAL::Nth_of_tuple_property_map<0, Item>,
                                                 CGAL::Nth_of_tuple_property_map<1, Item>>;
using Ransac = CGAL::Shape_detection::Efficient_RANSAC<Ransac_traits>;
using Ransac_plane = CGAL::Shape_detection::Plane<Ransac_traits>;

Detection ransac(const Range& range, const Request& r)
{
  std::vector<Item> items;
  for(std::size_t i = 0; i < range.size(); ++i)
    items.emplace_back(range[i].first, range[i].second, std::uint32_t(i));
  CGAL::get_default_random() = CGAL::Random(0);
  Ransac detector;
  detector.set_input(items);
  detector.add_shape_factory<Ransac_plane>();
  Ransac::Parameters parameters;
  parameters.probability = 0.01;
  parameters.min_points = r.minimum;
  parameters.epsilon = r.epsilon;
  parameters.cluster_epsilon = r.cluster_epsilon == 0 ? r.epsilon : r.cluster_epsilon; // negative: its own default
  parameters.normal_threshold = std::cos(r.alpha_deg * 0.017453292519943295);
  detector.detect(parameters);
  Detection detection;
  detection.label.assign(range.size(), -1);
  for(const auto& shape : detector.shapes()) {
    for(std::size_t i : shape->indices_of_assigned_points())
      detection.label[std::get<2>(items[i])] = std::int32_t(detection.planes.size());
    Kernel::Plane_3 plane = *dynamic_cast<Ransac_plane*>(shape.get());
    detection.planes.push_back(normalized(plane));
  }
  return detection;
}

void regularize(const Range& range, const Request& r, Detection& detection)
{
  std::vector<Kernel::Plane_3> planes;
  for(const Plane& p : detection.planes)
    planes.emplace_back(p.normal.x, p.normal.y, p.normal.z, p.offset);
  std::vector<int> index(detection.label.begin(), detection.label.end());
  CGAL::Shape_regularization::Planes::regularize_planes(
    planes, CGAL::Identity_property_map<Kernel::Plane_3>(), range, Point_map(),
    CGAL::parameters::plane_index_map(CGAL::make_property_map(index))
      .regularize_axis_symmetry(r.uses_symmetry)
      .maximum_angle(r.beta_deg)
      .maximum_offset(r.epsilon));
  std::transform(planes.begin(), planes.end(), detection.planes.begin(), normalized);
}

// Removes the points that violate epsilon or alpha of their final plane, then the
// shapes that have become too small: what the detector has under the tolerances it was given.
void clean(const Ply_cloud& cloud, const Request& r, Detection& detection)
{
  double least_cosine = std::cos(r.alpha_deg * 0.017453292519943295);
  for(std::size_t i = 0; i < cloud.points.size(); ++i) {
    if(detection.label[i] < 0)
      continue;
    const Plane& plane = detection.planes[std::size_t(detection.label[i])];
    if(distance(plane, cloud.points[i]) > r.epsilon || cosine(plane, cloud.normals[i]) < least_cosine)
      detection.label[i] = -1;
  }
  std::vector<std::size_t> size = shape_sizes(detection);
  std::vector<std::int32_t> renamed(size.size(), -1);
  std::vector<Plane> kept;
  for(std::size_t s = 0; s < size.size(); ++s)
    if(size[s] >= r.minimum) {
      renamed[s] = std::int32_t(kept.size());
      kept.push_back(detection.planes[s]);
    }
  for(std::int32_t& label : detection.label)
    label = label < 0 ? -1 : renamed[std::size_t(label)];
  detection.planes = kept;
}

// The detection in the caller's coordinates, cleaned if asked for.
Detection finished(const Ply_cloud& cloud, const Vec& center, const Request& r, Detection detection)
{
  for(Plane& plane : detection.planes)
    plane.offset -= dot(plane.normal, center);
  if(r.is_cleaned)
    clean(cloud, r, detection);
  return detection;
}

void write(const Detection& detection, const std::string& labels, const std::string& planes)
{
  write_labels(labels, detection.label);
  write_planes(planes, detection.planes);
}

Request parse(int argc, char** argv)
{
  Request r;
  po::options_description visible("peers rg|rg-cached|ransac CLOUD.ply --maximum-distance D [options]"), all;
  visible.add_options()("help", "this text")("labels", po::value(&r.labels)->required(), "output: one int32 per point")(
    "planes", po::value(&r.planes)->required(),
    "output: one line a b c d per shape")("maximum-distance", po::value(&r.epsilon)->required(), "epsilon")(
    "maximum-angle", po::value(&r.alpha_deg)->default_value(25),
    "alpha, degrees")("angle-tolerance", po::value(&r.beta_deg)->default_value(8), "for regularize_planes, degrees")(
    "minimum-region-size", po::value(&r.minimum)->default_value(200),
    "points")("k-neighbors", po::value(&r.k)->default_value(20), "for region growing")(
    "cluster-epsilon", po::value(&r.cluster_epsilon)->default_value(0),
    "for RANSAC; 0: epsilon, -1: 1 % of the diagonal")("regularize", po::bool_switch(&r.regularizes),
                                                       "regularize_planes afterwards")(
    "plain-labels", po::value(&r.plain_labels),
    "with --regularize: also the labels without it")("plain-planes", po::value(&r.plain_planes), "and the planes")(
    "symmetry", po::bool_switch(&r.uses_symmetry),
    "with its axis symmetry")("cleaned", po::bool_switch(&r.is_cleaned), "drop violating points, then small regions");
  all.add(visible).add_options()("method", po::value(&r.method)->required())("cloud", po::value(&r.cloud)->required());
  po::positional_options_description positions;
  positions.add("method", 1).add("cloud", 1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(all).positional(positions).run(), values);
  if(values.count("help")) {
    std::cout << visible;
    std::exit(0);
  }
  po::notify(values);
  if(r.method != "rg" && r.method != "rg-cached" && r.method != "ransac")
    throw std::invalid_argument("unknown method: " + r.method);
  return r;
}

void run(const Request& r)
{
  Ply_cloud cloud = read_ply(r.cloud);
  if(!cloud.has_normals())
    cloud.normals = CGAL::Tandem::scenes::pca_normals(cloud.points);
  // Relative to the center: the peers lose shapes far from the origin.
  Vec center = extent_of(cloud.points).center;
  std::vector<Vec> points;
  Range range;
  for(std::size_t i = 0; i < cloud.points.size(); ++i) {
    points.push_back(cloud.points[i] - center);
    Vec p = points.back(), n = unit(cloud.normals[i]);
    range.emplace_back(Kernel::Point_3(p.x, p.y, p.z), Kernel::Vector_3(n.x, n.y, n.z));
  }
  Stopwatch detecting;
  Detection detection = r.method == "ransac" ? ransac(range, r) : region_growing(range, points, r);
  std::cout << r.method << " wall " << detecting.wall() << " cpu " << detecting.cpu();
  if(!r.plain_labels.empty() && !r.plain_planes.empty())
    write(finished(cloud, center, r, detection), r.plain_labels, r.plain_planes);
  if(r.regularizes) {
    Stopwatch regularizing;
    regularize(range, r, detection);
    std::cout << " regularize " << regularizing.wall();
  }
  detection = finished(cloud, center, r, detection);
  write(detection, r.labels, r.planes);
  std::cout << " shapes " << detection.planes.size() << "\n";
}

} // namespace

int main(int argc, char** argv)
try {
  run(parse(argc, argv));
  return 0;
} catch(const std::exception& e) {
  std::cerr << "peers: " << e.what() << "\n";
  return 1;
}
