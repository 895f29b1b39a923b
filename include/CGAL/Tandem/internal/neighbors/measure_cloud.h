// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Spacing and noise of a cloud, from a sample, to estimate parameters that are not set. See the manual, "Estimated
// Parameters".

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_MEASURE_CLOUD_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_MEASURE_CLOUD_H

#include <CGAL/Tandem/internal/neighbors/Patch_curve.h>
#include <CGAL/Tandem/internal/neighbors/noise_field.h>
#include <CGAL/Tandem/internal/neighbors/sample_cells.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// What is found of one patch.
struct Patch_measure {
  double noise = -1, spacing = 0; // in grid steps; -1: no surface
  double places_per_point = 1;
  std::size_t first = 0, exact = 0, measured = 0;
  bool has_sheets = false, bends = false, is_flat = false;
};

template <class Backend>
std::vector<Patch_measure> measure_patches(Backend& backend, const std::vector<Plane_level>& levels)
{
  const std::size_t size = tuning::estimation::patch_size;
  std::vector<Patch_measure> measure(levels.empty() ? 0 : (levels[0].plane.size() + size - 1) / size);
  backend.for_each_piece(measure.size(), 64, [&](std::size_t first, std::size_t last) {
    Patch_curve curve(levels);
    for(std::size_t i = first; i < last; ++i) {
      curve.follow(i);
      measure[i] = {curve.noise(),      curve.spacing(), curve.places_per_point(),
                    curve.first(),      curve.exact(),   curve.measured(),
                    curve.has_sheets(), curve.bends(),   curve.is_flat()};
    }
  });
  return measure;
}

// What shows a surface only over far larger radii than others do is clutter.
inline void drop_clutter(std::vector<Patch_measure>& patches)
{
  std::vector<double> first;
  for(const Patch_measure& p : patches)
    if(p.noise >= 0)
      first.push_back(double(p.first));
  const auto last = std::size_t(quantile(first, .5)) + tuning::estimation::late_levels;
  for(Patch_measure& p : patches)
    if(p.first > last)
      p.noise = -1;
}

// The statistics of the patches, in grid steps.
inline Cloud_measure summarize(const std::vector<Patch_measure>& patches)
{
  using namespace tuning::estimation;
  std::vector<double> noise, spacing, spacing_in_space, places_per_point;
  std::size_t exact = 0, measured = 0, sheets = 0, bends = 0;
  for(const Patch_measure& p : patches) {
    if(p.noise < 0) {
      spacing_in_space.push_back(p.spacing);
      continue;
    }
    noise.push_back(p.noise);
    spacing.push_back(p.spacing);
    places_per_point.push_back(p.places_per_point);
    exact += p.exact;
    measured += p.measured;
    sheets += p.has_sheets;
    bends += p.bends;
  }
  Cloud_measure m;
  m.spacing = quantile(spacing.empty() ? spacing_in_space : spacing, .5);
  m.places = noise.empty() ? 1 : quantile(places_per_point, .5);
  m.noise = quantile(noise, noise_quantile);
  m.largest_noise = quantile(noise, .9);
  const auto share = [](std::size_t part, std::size_t all) { return all > 0 ? double(part) / double(all) : 0; };
  m.exact = share(exact, measured);
  m.sheets = share(sheets, noise.size());
  m.bends = share(bends, noise.size());
  return m;
}

// The measure of an import, in the units of its coordinates. It works on a grid of its own, since epsilon is not known
// yet.
template <class Backend>
Cloud_measure measure_cloud(Backend& backend, const Import& in)
{
  using namespace tuning::estimation;
  const Coordinate_box box = box_of_most(backend, in);
  Cloud_measure m;
  m.extent = (std::max)(box.extent(), 0.);
  if(!(m.extent > smallest_length))
    return m;
  const Grid grid = make_grid(box, std::ldexp(m.extent, measured_distance_bits)); // up to 2^27 steps
  const Cell_sample sample = sample_cells(backend, points_in_box(backend, in, grid, box));
  std::vector<Patch_measure> patches = measure_patches(backend, measure_planes(backend, sample.point));
  drop_clutter(patches);
  m = summarize(patches);
  m.extent = box.extent();
  m.places *= double(in.total.points) / sample.points_per_point;
  if(m.spacing == 0) // too few places, or all on a line
    m.spacing = m.extent / (grid.step * std::sqrt(m.places));
  for(double* length : {&m.spacing, &m.noise, &m.largest_noise})
    *length *= grid.step;
  std::vector<Patch_noise> flat;
  for(std::size_t i = 0; i < patches.size(); ++i)
    if(patches[i].noise >= 0) {
      const Grid_point& p = sample.point[(std::min)(i * patch_size + patch_size / 2, sample.point.size() - 1)];
      m.patch.push_back({{std::fma(p.x, grid.step, grid.origin.x), std::fma(p.y, grid.step, grid.origin.y),
                          std::fma(p.z, grid.step, grid.origin.z)},
                         patches[i].noise * grid.step});
      if(patches[i].is_flat)
        flat.push_back(m.patch.back());
    }
  measure_variation(backend, std::move(flat), m);
  return m;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_MEASURE_CLOUD_H
