// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layers a little more than epsilon apart can end as one shape: a plane in the
// middle, or a slanted one that bridges two strips. All points are within epsilon,
// but along the normal of the points themselves their distances have two peaks,
// and few between; or the points' normals say that the plane is wrong. Such a shape
// takes the higher peak, and detaches the other.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_LAYERS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_LAYERS_H

#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Of the distances to the plane, over [-2, 2] epsilon.
constexpr int histogram_bins = 64;
// Fewer of them are left to one thread.
constexpr std::size_t few_histograms = 16;

template <class Backend>
struct Count_distances {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* histogram_of; // by shape, no_index if not asked
  const Plane* plane;                // by histogram
  std::uint32_t* histogram;          // histogram_bins each
  std::int64_t epsilon;

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
      const std::int64_t bin = (signed_distance(plane[h], cloud.point[cell.first + at]) + 2 * epsilon) / (epsilon / 16);
      if(bin >= 0 && bin < histogram_bins)
        Backend::atomic_add(histogram[h * histogram_bins + std::uint32_t(bin)], 1u);
    });
  }
};

template <class Backend>
void count_distances(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& histogram_of,
                     const std::vector<Plane>& planes, std::vector<std::uint32_t>& histogram)
{
  const auto index = t.backend.read_access(histogram_of);
  const auto plane = t.backend.read_access(planes);
  auto counts = t.backend.read_write_access(histogram);
  t.backend.template for_each_cell<Count_scratch>(
    t.number_of_cells, Count_distances<Backend>{t.cloud, t.cells_view(), t.label.data(), index.data(), plane.data(),
                                                counts.data(), t.options.growth.tolerance.distance});
  counts.copy_back();
}

// Where the smoothed histogram has its highest peak, in epsilons; 0 unless that is
// clearly higher than the middle, or the shape is known to be crooked.
inline double find_layer(const std::uint32_t* histogram, bool is_crooked)
{
  // A Gaussian of sigma = epsilon / 6, at the distance of 0, 1, 2 ... bins. (A wider one
  // hides the gap between layers of noise that are 1.1 epsilon apart.)
  static const std::int64_t weight[8] = {1000, 932, 755, 531, 325, 172, 80, 32};
  auto density = [&](int bin) {
    std::int64_t sum = 0;
    for(int b = (std::max)(0, bin - 7); b <= (std::min)(histogram_bins - 1, bin + 7); ++b)
      sum += weight[b < bin ? bin - b : b - bin] * std::int64_t(histogram[b]);
    return sum;
  };
  const std::int64_t middle = (density(histogram_bins / 2 - 1) + density(histogram_bins / 2)) / 2;
  std::int64_t highest = 0;
  int peak = 0;
  for(int bin = 0; bin < histogram_bins; ++bin)
    if(density(bin) > highest) {
      highest = density(bin);
      peak = bin;
    }
  return is_crooked || highest * 2 >= middle * 3 ? (peak + 0.5) / 16 - 2 : 0;
}

struct Lean_query {
  std::uint32_t mask; // of the sample
  Plane plane;
};

// The sum of the normals of a sample of each shape, each turned to the side of the plane.
template <class Backend>
struct Sum_normals {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* query_of; // by shape, no_index if not asked
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

template <class Backend>
std::vector<std::int64_t> sum_normals(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& query_of,
                                      const std::vector<Lean_query>& query)
{
  std::vector<std::int64_t> sum(3 * query.size(), 0);
  const auto index = t.backend.read_access(query_of);
  const auto queries = t.backend.read_access(query);
  auto sums = t.backend.read_write_access(sum);
  t.backend.template for_each_cell<Count_scratch>(
    t.number_of_cells,
    Sum_normals<Backend>{t.cloud, t.cells_view(), t.label.data(), index.data(), queries.data(), sums.data()});
  sums.copy_back();
  return sum;
}

// A shape may be two layers if its points' normals lean by more than about 4 degrees
// to one side of its plane (the sine), or their distances are spread (rms, in epsilons).
constexpr double suspicious_lean = 0.07;
constexpr double suspicious_rms = 0.45;
// By more than about 6 degrees to the best plane through them: it bridges layers,
// whether or not noise fills the gap between them.
constexpr double certain_lean = 0.1;
constexpr std::int64_t crooked_size = 100; // the normals of fewer points, at edges, may lean by themselves

// The planes, along the mean normals of the points, about which the distances of
// suspicious shapes are to be counted; the entries of `r` that they belong to.
template <class Backend>
std::vector<std::size_t> suspicious_shapes(Tandem_state<Backend>& t, const Shape_relations& r, Regular_planes& planes)
{
  std::vector<char> is_selected(r.id.size());
  t.backend.for_each_on_host(r.id.size(), [&](std::size_t i) {
    const Shape& shape = t.shapes[r.id[i]];
    is_selected[i] =
      shape.moments.count >= reliable_normal_size && shape.moments.count * 10 >= shape.layered_count * 11;
  });
  std::vector<std::uint32_t> query_of(t.shapes.size(), no_index);
  std::vector<std::size_t> selected;
  for(std::size_t i = 0; i < r.id.size(); ++i)
    if(is_selected[i]) {
      query_of[r.id[i]] = std::uint32_t(selected.size());
      selected.push_back(i);
    }
  std::vector<Lean_query> query(selected.size());
  t.backend.for_each_on_host(selected.size(), [&](std::size_t q) {
    Shape& shape = t.shapes[r.id[selected[q]]];
    query[q] = {sample_mask(shape), rounded(shape.plane)};
    shape.layered_count = shape.moments.count;
  });
  std::vector<std::size_t> entries;
  if(selected.empty())
    return entries;
  const std::vector<std::int64_t> sum = sum_normals(t, query_of, query);
  const double maximum = suspicious_rms * t.options.maximum_distance;
  std::vector<Vector> mean(selected.size());
  std::vector<char> is_suspicious(selected.size());
  t.backend.for_each_on_host(selected.size(), [&](std::size_t q) {
    const Shape& shape = t.shapes[r.id[selected[q]]];
    const std::int64_t* s = sum.data() + 3 * q;
    mean[q] = unit({double(s[0]), double(s[1]), double(s[2])});
    const double squares = excess(shape.scatter, shape.fit, shape.plane) + shape.fit.smallest;
    is_suspicious[q] =
      length(cross(mean[q], shape.plane.normal)) > suspicious_lean || squares > maximum * maximum * shape.scatter.count;
  });
  for(std::size_t q = 0; q < selected.size(); ++q)
    if(is_suspicious[q]) {
      entries.push_back(selected[q]);
      planes.push_back(plane_through(mean[q], t.shapes[r.id[selected[q]]].scatter.centroid));
    }
  return entries;
}

template <class Backend>
void split_layers(Tandem_state<Backend>& t, Shape_relations& r)
{
  Regular_planes planes;
  const std::vector<std::size_t> entries = suspicious_shapes(t, r, planes);
  if(entries.empty())
    return;
  std::vector<std::uint32_t> histogram_of(t.shapes.size(), no_index), histogram(entries.size() * histogram_bins, 0);
  std::vector<Plane> integer_planes;
  for(std::size_t h = 0; h < entries.size(); ++h) {
    histogram_of[r.id[entries[h]]] = std::uint32_t(h);
    integer_planes.push_back(rounded(planes[h]));
  }
  count_distances(t, histogram_of, integer_planes, histogram);
  std::vector<double> layer(entries.size());
  t.backend.for_each_on_host(
    entries.size(),
    [&](std::size_t h) {
      const Shape& shape = t.shapes[r.id[entries[h]]];
      const bool is_crooked =
        shape.moments.count >= crooked_size && length(cross(planes[h].normal, shape.local.normal)) > certain_lean;
      layer[h] = find_layer(histogram.data() + h * histogram_bins, is_crooked);
    },
    few_histograms);
  for(std::size_t h = 0; h < entries.size(); ++h) {
    if(layer[h] == 0)
      continue;
    planes[h].offset = std::fma(layer[h], t.options.maximum_distance, planes[h].offset);
    t.shapes[r.id[entries[h]]].plane = planes[h];
    set_own_plane(r.relations, entries[h], planes[h]); // it has left its relations
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_LAYERS_H
