// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "result_score.h"
#include "testing/count_links.h"

#include <CGAL/Shape_regularization_tandem/is_valid_result.h>
#include <CGAL/Simple_cartesian.h>

namespace CGAL::Tandem::benchmark {

using internal::Shapes_data;

namespace {

// The labels without points that violate the tolerances.
std::vector<std::int32_t> fitting_labels(const Scored_cloud& cloud, const Detection& detection)
{
  const Fidelity fidelity(cloud.tolerances);
  std::vector<std::int32_t> label = detection.label;
  for(std::size_t i = 0; i < label.size(); ++i)
    if(label[i] >= 0 && !fidelity.fits(detection.planes[std::size_t(label[i])], cloud.points, cloud.normals, i))
      label[i] = -1;
  return label;
}

internal::Score_counts count(const Scored_cloud& cloud, const Detection& fitting)
{
  internal::Score_counts counts;
  internal::Cloud_view graph = {};
  graph.neighbor = cloud.graph.neighbor.data();
  graph.size = std::uint32_t(fitting.label.size());
  graph.k = int(cloud.graph.k);
  const double units = double(internal::Score::tolerance_units);
  const std::vector<std::uint32_t> label(fitting.label.begin(), fitting.label.end()); // -1 becomes free_label
  for(std::size_t i = 0; i < fitting.label.size(); ++i) {
    internal::count_links(graph, std::uint32_t(i), label.data(), counts);
    if(fitting.label[i] < 0)
      continue;
    const double d = distance(fitting.planes[std::size_t(fitting.label[i])], cloud.points[i]);
    const double fraction = (std::min)(d / cloud.tolerances.maximum_distance, 1.);
    counts.fit += internal::Score::weight_at(std::uint64_t(std::lround(fraction * units)));
  }
  return counts;
}

// Numbers the groups of shapes that are equal in pairs, by their first shapes.
template <class Same>
std::vector<int> group(std::size_t shapes, const Same& are_same)
{
  std::vector<int> group(shapes);
  std::vector<std::size_t> first;
  for(std::size_t s = 0; s < shapes; ++s) {
    const auto found = std::find_if(first.begin(), first.end(), [&](std::size_t f) { return are_same(f, s); });
    group[s] = int(found - first.begin());
    if(found == first.end())
      first.push_back(s);
  }
  return group;
}

void relate(const Scored_cloud& cloud, const std::vector<Plane>& planes, Shapes_data& data)
{
  const Extent extent = extent_of(cloud.points);
  const Plane_relations relations(planes, extent.diagonal, extent.center);
  data.parallel_group = group(planes.size(), [&](auto s, auto t) { return relations.are_parallel(s, t); });
  data.coplanar_group = group(planes.size(), [&](auto s, auto t) { return relations.are_coplanar(s, t); });
  const std::vector<int> first = internal::representatives(data.parallel_group);
  for(std::size_t a = 0; a < first.size(); ++a)
    for(std::size_t b = a + 1; b < first.size(); ++b)
      if(relations.are_orthogonal(std::size_t(first[a]), std::size_t(first[b])))
        data.orthogonal_groups.emplace_back(int(a), int(b));
}

// The k nearest neighbors of each imported point, as imported points, without surfels.
template <class Backend>
std::vector<std::uint32_t> import_neighbors(Backend& backend, const internal::Import& in, std::size_t k)
{
  using namespace internal;
  const std::uint32_t n = std::uint32_t(in.size());
  std::vector<std::uint32_t> neighbor(n * k), result(n * k);
  if(n == 0)
    return result;
  const auto order =
    sort_along_curve(backend, {in.point.data(), n}, make_code_frame(in.low, in.high),
                     make_tie_order([&](std::uint32_t i, std::uint32_t j) { return in.precedes(i, j); }, Nothing()));
  std::vector<Grid_point> point(n);
  for(std::uint32_t i = 0; i < n; ++i)
    point[i] = in.point[order.view().index(i)];
  find_neighbors(backend, point.data(), n, int(k), neighbor.data());
  for(std::uint32_t i = 0; i < n; ++i)
    for(std::size_t j = 0; j < k; ++j) {
      const std::uint32_t q = neighbor[i * k + j];
      result[order.view().index(i) * k + j] = q == no_index ? no_index : std::uint32_t(order.view().index(q));
    }
  return result;
}

} // namespace

Neighbor_graph neighbor_graph(const std::vector<Vec>& points, std::size_t k, double maximum_distance)
{
  using Point = Simple_cartesian<double>::Point_3;
  std::vector<Point> range;
  for(const Vec& p : points)
    range.emplace_back(p.x, p.y, p.z);
  const auto np = CGAL::parameters::point_map(Identity_property_map<Point>());
  Neighbor_graph graph{k, std::vector<std::uint32_t>(points.size() * k, no_neighbor)};
  internal::with_traits<CGAL::Parallel_if_available_tag>(range, np, [&](const auto& traits) {
    auto backend = traits.backend();
    internal::Import in = internal::read_points(backend, range, internal::reader_of(range, np, traits));
    choose_grid(in, maximum_distance);
    in.point.reset(in.size());
    backend.for_each(in.size(), place_on_grid(in, in.point.data()));
    const auto neighbor = import_neighbors(backend, in, k);
    for(std::size_t i = 0; i < in.size(); ++i)
      for(std::size_t j = 0; j < k && neighbor[i * k + j] != internal::no_index; ++j)
        graph.neighbor[in.item_of(i) * k + j] = std::uint32_t(in.item_of(neighbor[i * k + j]));
  });
  return graph;
}

Result_score evaluate_score(const Scored_cloud& cloud, const Detection& detection)
{
  const Detection fitting = {fitting_labels(cloud, detection), detection.planes};
  Shapes_data data;
  data.parameters.minimum_region_size = cloud.minimum_region_size;
  data.parameters.k_neighbors = cloud.graph.k;
  data.size = shape_sizes(fitting);
  data.coefficients.resize(data.size.size());
  relate(cloud, detection.planes, data);
  measure_relations(data, count(cloud, fitting));
  return data.statistics.score;
}

} // namespace CGAL::Tandem::benchmark
