// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layers a little more than epsilon apart can end as one shape. Its plane lies in the middle, or is slanted and bridges
// two strips. All points are within epsilon. But along their mean normal the distances have two peaks, and few between;
// or the mean normal leans too much. Such a shape takes the plane of the higher peak, which no other shape shares.
// Labels do not change: apply_planes() detaches the points of the other layer. See the manual, "Layers".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_LAYERS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_LAYERS_H

#include <CGAL/Tandem/internal/rounds/Joint_fit_criterion.h>
#include <CGAL/Tandem/internal/rounds/Misfit_counter.h>
#include <CGAL/Tandem/internal/rounds/Shape_relations.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Fewer histograms are the work of one thread.
constexpr std::size_t few_histograms = 16;

// Fills the histograms of a cell. Distances are in 2^-28 grid steps and cover [-2, 2) epsilon; what is farther is
// not counted. Additions are atomic, since many cells share a histogram.
template <class Backend>
struct Count_distances {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* histogram_of; // by shape, no_index if not examined
  const Plane* plane;                // by histogram
  std::uint32_t* histogram;          // tuning::layers::bins each
  std::int64_t epsilon;              // in the same unit

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch&, std::uint32_t c) const
  {
    if(!cells.shapes[c].may_have(block, [&](std::uint32_t s) { return histogram_of[s] != no_index; }))
      return;
    const Range cell = cells[c];
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t s = label[cell.first + at];
      if(s >= first_mark || histogram_of[s] == no_index)
        return;
      const std::uint32_t h = histogram_of[s];
      const std::int64_t from_first = signed_distance(plane[h], cloud.point[cell.first + at]) + 2 * epsilon;
      const std::int64_t bin = from_first / (epsilon / tuning::layers::bins_per_distance);
      if(bin >= 0 && bin < tuning::layers::bins)
        Backend::atomic_add(histogram[h * tuning::layers::bins + std::uint32_t(bin)], 1u);
    });
  }
};

// Histograms of the distances of points to a plane, for some shapes. The plane passes through the centroid.
struct Distance_histograms {
  std::vector<std::uint32_t> of;    // by shape: its histogram, or no_index
  std::vector<Plane> plane;         // by histogram
  std::vector<std::uint32_t> count; // tuning::layers::bins for each
};

template <class Backend>
void count_distances(Labeled_cloud<Backend>& points, std::int64_t epsilon, Distance_histograms& histograms)
{
  Backend& backend = points.backend;
  const auto index = backend.read_access(histograms.of);
  const auto plane = backend.read_access(histograms.plane);
  auto counts = backend.read_write_access(histograms.count);
  backend.template for_each_cell<Count_scratch>(
    points.number_of_cells(), Count_distances<Backend>{points.cloud.view(), points.cells_view(), points.label.data(),
                                                       index.data(), plane.data(), counts.data(), epsilon});
  counts.copy_back();
}

// Where the smoothed histogram has its highest peak, in epsilons; of equal peaks the first one. 0 unless it is clearly
// higher than the middle, or the shape is known to be crooked. No bin has its center at 0, so 0 means no layer.
inline double find_layer(const std::uint32_t* histogram, bool is_crooked)
{
  using namespace tuning::layers;
  const auto density = [&](int bin) {
    std::int64_t sum = 0;
    const int first = (std::max)(0, bin - kernel_size + 1), last = (std::min)(bins - 1, bin + kernel_size - 1);
    for(int b = first; b <= last; ++b)
      sum += kernel[b < bin ? bin - b : b - bin] * std::int64_t(histogram[b]);
    return sum;
  };
  const std::int64_t middle = (density(bins / 2 - 1) + density(bins / 2)) / 2;
  std::int64_t highest = 0;
  int peak = 0;
  for(int bin = 0; bin < bins; ++bin)
    if(density(bin) > highest) {
      highest = density(bin);
      peak = bin;
    }
  return is_crooked || peak_height.is_reached(highest, middle) ? (peak + 0.5) / bins_per_distance - 2 : 0;
}

// Whether the normals of the points lean to one side of this plane.
struct Lean_query {
  std::uint32_t mask; // of the sample
  Plane plane;
};

// The sum of the normals of a sample of each shape. Each is turned to the side of the plane, since signs are arbitrary.
// Components are below 2^15, so integers of 64 bits never overflow.
template <class Backend>
struct Sum_normals {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* query_of; // by shape, no_index if not examined
  const Lean_query* query;
  std::int64_t* sum; // by query, 3 each

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch&, std::uint32_t c) const
  {
    if(!cells.shapes[c].may_have(block, [&](std::uint32_t s) { return query_of[s] != no_index; }))
      return;
    const Range cell = cells[c];
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      const std::uint32_t q = label[i] < first_mark ? query_of[label[i]] : no_index;
      if(q == no_index || (i & query[q].mask) != 0)
        return;
      const Int_vector m = decode_normal(cloud.point[i].normal);
      const std::int64_t side = normal_product(query[q].plane, m) < 0 ? -1 : 1;
      Backend::atomic_add(sum[3 * q], side * m.x);
      Backend::atomic_add(sum[3 * q + 1], side * m.y);
      Backend::atomic_add(sum[3 * q + 2], side * m.z);
    });
  }
};

// Three sums for each query, in the order of the queries.
template <class Backend>
std::vector<std::int64_t> sum_normals(Labeled_cloud<Backend>& points, const std::vector<std::uint32_t>& query_of,
                                      const std::vector<Lean_query>& query)
{
  Backend& backend = points.backend;
  std::vector<std::int64_t> sum(3 * query.size(), 0);
  const auto index = backend.read_access(query_of);
  const auto queries = backend.read_access(query);
  auto sums = backend.read_write_access(sum);
  backend.template for_each_cell<Count_scratch>(
    points.number_of_cells(), Sum_normals<Backend>{points.cloud.view(), points.cells_view(), points.label.data(),
                                                   index.data(), queries.data(), sums.data()});
  sums.copy_back();
  return sum;
}

// The entries of shapes that are large enough, and have grown by a tenth since they were examined last. So a shape is
// examined a few times, not in each round.
template <class Backend>
std::vector<std::size_t> entries_to_examine(Backend& backend, const Shape_table<Backend>& shapes, const Ids& ids)
{
  std::vector<char> is_chosen(ids.size());
  backend.for_each_on_host(ids.size(), [&](std::size_t i) {
    const Shape& shape = shapes[ids[i]];
    is_chosen[i] = shape.moments.count >= tuning::merging::reliable_normal_size &&
                   tuning::layers::examined_growth.is_reached(shape.moments.count, shape.layered_count);
  });
  std::vector<std::size_t> entries;
  for(std::size_t i = 0; i < ids.size(); ++i)
    if(is_chosen[i])
      entries.push_back(i);
  return entries;
}

// The mean normals of the points of these entries, which count as examined from now on.
template <class Backend>
std::vector<Vector> mean_normals(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Ids& ids,
                                 const std::vector<std::size_t>& entries)
{
  std::vector<std::uint32_t> query_of(shapes.size(), no_index);
  for(std::size_t q = 0; q < entries.size(); ++q)
    query_of[ids[entries[q]]] = std::uint32_t(q);
  std::vector<Lean_query> query(entries.size());
  points.backend.for_each_on_host(entries.size(), [&](std::size_t q) {
    Shape& shape = shapes[ids[entries[q]]];
    query[q] = {sample_mask(shape), rounded(shape.plane)};
    shape.layered_count = shape.moments.count;
  });
  const std::vector<std::int64_t> sum = sum_normals(points, query_of, query);
  std::vector<Vector> mean(entries.size());
  points.backend.for_each_on_host(entries.size(), [&](std::size_t q) {
    const std::int64_t* s = sum.data() + 3 * q;
    mean[q] = unit({double(s[0]), double(s[1]), double(s[2])});
  });
  return mean;
}

// A shape that may be two layers.
struct Suspect {
  std::size_t entry;
  Regular_plane plane; // along the mean normal of its points
};

// Shapes whose mean normal leans, or whose distances are large. Only they get histograms.
template <class Backend>
std::vector<Suspect> suspicious_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Ids& ids,
                                       double epsilon)
{
  std::vector<Suspect> suspects;
  const std::vector<std::size_t> entries = entries_to_examine(points.backend, shapes, ids);
  if(entries.empty())
    return suspects;
  const std::vector<Vector> mean = mean_normals(points, shapes, ids, entries);
  const double maximum = tuning::layers::suspicious_rms * epsilon;
  std::vector<char> is_suspicious(entries.size());
  points.backend.for_each_on_host(entries.size(), [&](std::size_t q) {
    const Shape& shape = shapes[ids[entries[q]]];
    const double squares = excess(shape.scatter, shape.fit, shape.plane) + shape.fit.smallest;
    is_suspicious[q] = length(cross(mean[q], shape.plane.normal)) > tuning::layers::suspicious_lean ||
                       squares > maximum * maximum * shape.scatter.count;
  });
  for(std::size_t q = 0; q < entries.size(); ++q)
    if(is_suspicious[q])
      suspects.push_back({entries[q], plane_through(mean[q], shapes[ids[entries[q]]].scatter.centroid)});
  return suspects;
}

// Shapes of two layers exchange their relations for the plane of one of them. After the regularity step, as its planes
// are tested.
template <class Backend>
void split_layers(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                  Shape_relations& r)
{
  std::vector<Suspect> suspects = suspicious_shapes(points, shapes, r.id, options.maximum_distance);
  if(suspects.empty())
    return;
  Distance_histograms histograms;
  histograms.of.assign(shapes.size(), no_index);
  histograms.count.assign(suspects.size() * tuning::layers::bins, 0);
  for(std::size_t h = 0; h < suspects.size(); ++h) {
    histograms.of[r.id[suspects[h].entry]] = std::uint32_t(h);
    histograms.plane.push_back(rounded(suspects[h].plane));
  }
  count_distances(points, options.growth.tolerance.distance, histograms);
  std::vector<double> layer(suspects.size());
  points.backend.for_each_on_host(
    suspects.size(),
    [&](std::size_t h) {
      const Shape& shape = shapes[r.id[suspects[h].entry]];
      const bool is_crooked =
        shape.moments.count >= tuning::layers::minimum_size &&
        length(cross(suspects[h].plane.normal, shape.local.normal)) > tuning::layers::certain_lean;
      layer[h] = find_layer(histograms.count.data() + h * tuning::layers::bins, is_crooked);
    },
    few_histograms);
  for(std::size_t h = 0; h < suspects.size(); ++h) {
    if(layer[h] == 0)
      continue;
    Regular_plane& plane = suspects[h].plane;
    plane.offset = std::fma(layer[h], options.maximum_distance, plane.offset);
    shapes[r.id[suspects[h].entry]].plane = plane;
    set_own_plane(r.relations, suspects[h].entry, plane);
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_LAYERS_H
