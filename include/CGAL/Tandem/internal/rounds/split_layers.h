// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layers a little more than epsilon apart can end as one shape. Its plane lies in the middle, or is slanted and bridges
// two strips. All points are within epsilon. But along their mean normal the distances have two peaks, and few between;
// or the mean normal leans too much. Such a shape takes the plane of the higher peak, which no other shape shares.
// Labels do not change: apply_planes() detaches the points of the other layer. See the manual, "Layers".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_LAYERS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_LAYERS_H

#include <CGAL/Tandem/internal/base/tuning/merging.h>
#include <CGAL/Tandem/internal/rounds/Shape_relations.h>
#include <CGAL/Tandem/internal/rounds/Union_gain.h>
#include <CGAL/Tandem/internal/shapes/Count_scratch.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Which points of a shape are counted: those whose position has no bit of this mask, so all, every second one, every
// fourth one ... Positions follow the curve, so a sample is spread over the shape. The largest mask that still selects
// about sample_size points; 0, which selects all, below twice as many.
CGAL_TANDEM_HD inline std::uint32_t sample_mask(std::int64_t points)
{
  std::uint32_t mask = 0;
  while(points / (2 * (std::int64_t(mask) + 1)) >= tuning::layers::sample_size)
    mask = 2 * mask + 1;
  return mask;
}

// Shapes of which the points are examined, each with a plane. All tables are by place.
struct Examined_shapes {
  struct Test {
    std::uint32_t mask; // of the sample
    Plane plane;
  };

  std::vector<std::uint32_t> id;
  std::vector<Test> test;

  void add(std::uint32_t shape, const Test& t)
  {
    id.push_back(shape);
    test.push_back(t);
  }
};

// Fills the histograms of a cell. Distances are in 2^-28 grid steps and cover [-2, 2) epsilon; what is farther is
// not counted. Additions are atomic, since many cells share a histogram.
template <class Backend>
struct Count_distances {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* histogram_of; // by shape, no_index if not examined
  const Examined_shapes::Test* test; // by histogram
  std::uint64_t* histogram;          // tuning::layers::bins each
  std::int64_t epsilon;              // in the same unit

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch&, std::uint32_t c) const
  {
    if(!cells.may_have(block, c, [&](std::uint32_t s) { return histogram_of[s] != no_index; }))
      return;
    const Range cell = cells[c];
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t s = label[cell.first + at];
      if(s >= first_mark || histogram_of[s] == no_index)
        return;
      const std::uint32_t h = histogram_of[s];
      const std::int64_t from_first =
        signed_distance(test[h].plane, cloud.point[cell.first + at]) + tuning::layers::reach * epsilon;
      const std::int64_t bin = from_first / (epsilon / tuning::layers::bins_per_distance);
      if(bin >= 0 && bin < tuning::layers::bins)
        Backend::atomic_add(histogram[h * tuning::layers::bins + std::uint32_t(bin)], std::uint64_t(1));
    });
  }
};

// The histogram of a shape, smoothed at a bin.
CGAL_TANDEM_HD inline std::int64_t smoothed(const std::uint64_t* histogram, int bin)
{
  constexpr tuning::layers::Kernel kernel = tuning::layers::kernel;
  std::int64_t sum = kernel.weight[0] * std::int64_t(histogram[bin]);
  for(int distance = 1; distance < kernel.size; ++distance) {
    const std::int64_t before = bin >= distance ? std::int64_t(histogram[bin - distance]) : 0;
    const std::int64_t after = bin + distance < tuning::layers::bins ? std::int64_t(histogram[bin + distance]) : 0;
    sum += kernel.weight[distance] * (before + after);
  }
  return sum;
}

struct Smooth_histograms {
  const std::uint64_t* histogram;
  std::int64_t* density;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    constexpr std::size_t bins = tuning::layers::bins;
    density[i] = smoothed(histogram + i / bins * bins, int(i % bins));
  }
};

// Where a smoothed histogram has its highest peak, in epsilons; of equal peaks the first one. 0 unless it is clearly
// higher than the middle, or the shape is known to be crooked. No bin has its center at 0, so 0 means no layer.
CGAL_TANDEM_HD inline double find_layer(const std::int64_t* density, bool is_crooked)
{
  constexpr int bins = tuning::layers::bins;
  constexpr tuning::Share peak_height = tuning::layers::peak_height;
  const std::int64_t middle = (density[bins / 2 - 1] + density[bins / 2]) / 2;
  std::int64_t highest = 0;
  int peak = 0;
  for(int bin = 0; bin < bins; ++bin)
    if(density[bin] > highest) {
      highest = density[bin];
      peak = bin;
    }
  if(!is_crooked && !peak_height.is_reached(highest, middle))
    return 0;
  return (peak + 0.5) / tuning::layers::bins_per_distance - tuning::layers::reach;
}

struct Find_layer {
  const std::int64_t* density;
  const std::uint8_t* is_crooked;
  double* layer;

  CGAL_TANDEM_HD void operator()(std::size_t h) const
  {
    layer[h] = find_layer(density + h * tuning::layers::bins, is_crooked[h] != 0);
  }
};

// By shape: where its histogram has a layer, in epsilons from its plane, or 0. The crooked ones have one for certain.
template <class Backend>
std::vector<double> find_layers(Labeled_cloud<Backend>& points, std::size_t ids, std::int64_t epsilon,
                                const Examined_shapes& shapes, const std::vector<std::uint8_t>& is_crooked)
{
  Backend& backend = points.backend;
  const auto test = to_buffer(backend, shapes.test);
  const auto histogram_of = places_of(backend, ids, to_buffer(backend, shapes.id));
  const std::size_t n = test.size();
  auto counts = filled_buffer(backend, n * tuning::layers::bins, std::uint64_t(0));
  backend.template for_each_cell<Count_scratch>(
    points.number_of_parts(), Count_distances<Backend>{points.cloud.view(), points.listed_parts(), points.label(),
                                                       histogram_of.data(), test.data(), counts.data(), epsilon});
  points.ranks.sum(counts.data(), counts.size());
  const auto crooked = to_buffer(backend, is_crooked);
  typename Backend::template Buffer<std::int64_t> density(counts.size());
  typename Backend::template Buffer<double> layer(n);
  backend.for_each(density.size(), Smooth_histograms{counts.data(), density.data()});
  backend.for_each(n, Find_layer{density.data(), crooked.data(), layer.data()}, shapes_per_thread);
  return to_vector(backend, layer);
}

// The sum of the normals of a sample of each shape. Each is turned to the side of the plane, since signs are arbitrary.
// Components are below 2^15, so integers of 64 bits never overflow.
template <class Backend>
struct Sum_normals {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* query_of; // by shape, no_index if not examined
  const Examined_shapes::Test* query;
  std::int64_t* sum; // by query, 3 each

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch&, std::uint32_t c) const
  {
    if(!cells.may_have(block, c, [&](std::uint32_t s) { return query_of[s] != no_index; }))
      return;
    const Range cell = cells[c];
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      const std::uint32_t q = label[i] < first_mark ? query_of[label[i]] : no_index;
      if(q == no_index || ((i + cloud.first) & query[q].mask) != 0)
        return;
      const Int_vector m = decode_normal(cloud.point[i].normal);
      const std::int64_t side = normal_product(query[q].plane, m) < 0 ? -1 : 1;
      Backend::atomic_add(sum[3 * q], side * m.x);
      Backend::atomic_add(sum[3 * q + 1], side * m.y);
      Backend::atomic_add(sum[3 * q + 2], side * m.z);
    });
  }
};

// Three sums for each shape.
template <class Backend>
std::vector<std::int64_t> sum_normals(Labeled_cloud<Backend>& points, std::size_t ids, const Examined_shapes& shapes)
{
  Backend& backend = points.backend;
  const auto query = to_buffer(backend, shapes.test);
  const auto query_of = places_of(backend, ids, to_buffer(backend, shapes.id));
  auto sums = filled_buffer(backend, 3 * query.size(), std::int64_t(0));
  backend.template for_each_cell<Count_scratch>(
    points.number_of_parts(), Sum_normals<Backend>{points.cloud.view(), points.listed_parts(), points.label(),
                                                   query_of.data(), query.data(), sums.data()});
  points.ranks.sum(sums.data(), sums.size());
  return to_vector(backend, sums);
}

// A shape that may be two layers: its entry, and its plane along the mean normal of its points.
struct Suspect {
  std::size_t entry;
  Regular_plane plane;
};

// Whether the mean normal leans, or the distances to the plane are large.
inline bool is_suspicious(const Shape_fit& shape, const Regular_plane& plane, const Vector& mean, double epsilon)
{
  const double maximum = tuning::layers::suspicious_rms * epsilon;
  const double squares = excess(shape.scatter, shape.fit, plane) + shape.fit.smallest;
  return length(cross(mean, plane.normal)) > tuning::layers::suspicious_lean ||
         squares > maximum * maximum * shape.scatter.count;
}

// The suspicious ones of the shapes that are large enough, and have grown by a tenth since they were examined last. So
// a shape is examined a few times, not in each round.
template <class Backend>
std::vector<Suspect> suspicious_shapes(Labeled_cloud<Backend>& points, std::size_t ids, double epsilon,
                                       std::vector<Shape_summary>& shapes, const Relations& relations)
{
  std::vector<std::size_t> entries;
  Examined_shapes examined;
  const auto plane_of = [&](std::size_t entry) { return relations.planes[std::size_t(relations.plane_of[entry])]; };
  for(std::size_t i = 0; i < shapes.size(); ++i)
    if(shapes[i].points >= tuning::layers::reliable_normal_size &&
       tuning::layers::examined_growth.is_reached(shapes[i].points, shapes[i].examined_points)) {
      entries.push_back(i);
      examined.add(std::uint32_t(shapes[i].id), {sample_mask(shapes[i].points), rounded(plane_of(i))});
      shapes[i].examined_points = shapes[i].points;
    }
  std::vector<Suspect> suspects;
  if(entries.empty())
    return suspects;
  const std::vector<std::int64_t> sum = sum_normals(points, ids, examined);
  for(std::size_t q = 0; q < entries.size(); ++q) {
    const Shape_fit& fit = shapes[entries[q]].fit;
    const Vector mean = unit({double(sum[3 * q]), double(sum[3 * q + 1]), double(sum[3 * q + 2])});
    if(is_suspicious(fit, plane_of(entries[q]), mean, epsilon))
      suspects.push_back({entries[q], plane_through(mean, fit.scatter.centroid)});
  }
  return suspects;
}

// Shapes of two layers exchange their relations for the plane of one of them. After relations are found, as their
// planes are tested; before they are applied. `summaries`: of the shapes of the relations.
template <class Backend>
void split_layers(Labeled_cloud<Backend>& points, const Shape_table<Backend>& shapes, const Options& options,
                  std::vector<Shape_summary>& summaries, Shape_relations& r)
{
  std::vector<Suspect> suspects =
    suspicious_shapes(points, shapes.size, options.maximum_distance, summaries, r.relations);
  if(suspects.empty())
    return;
  Examined_shapes examined;
  std::vector<std::uint8_t> is_crooked;
  for(const Suspect& s : suspects) {
    const Shape_summary& shape = summaries[s.entry];
    examined.add(std::uint32_t(shape.id), {0, rounded(s.plane)});
    is_crooked.push_back(shape.points >= tuning::layers::minimum_size &&
                         length(cross(s.plane.normal, shape.fit.fit.normal)) > tuning::layers::certain_lean);
  }
  const std::vector<double> layer =
    find_layers(points, shapes.size, options.growth.tolerance.distance, examined, is_crooked);
  for(std::size_t h = 0; h < suspects.size(); ++h) {
    if(layer[h] == 0)
      continue;
    Regular_plane& plane = suspects[h].plane;
    plane.offset = std::fma(layer[h], options.maximum_distance, plane.offset);
    set_own_plane(r.relations, suspects[h].entry, plane);
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_LAYERS_H
