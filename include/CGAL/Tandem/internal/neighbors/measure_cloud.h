// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Spacing and noise of a cloud, from a sample, to estimate parameters that are not set. See the manual, "Estimated
// Parameters".

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_MEASURE_CLOUD_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_MEASURE_CLOUD_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/neighbors/Patch_curve.h>
#include <CGAL/Tandem/internal/neighbors/sample_cells.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- What measure_cloud.h finds.

// Noise and spacing about a place of a surface.
struct Patch_noise {
  Vector position;
  double noise;
  double spacing;
};

// Noise and spacing of a cloud, in units of the coordinates; zeros where there is no surface.
struct Cloud_measure {
  double extent = 0;        // of the points, without those far from all others
  double spacing = 0;       // median
  double places = 0;        // number of points, without copies
  double noise = 0;         // the quantile that counts
  double rms_noise = 0;     // the root mean square over the surfaces
  double largest_noise = 0; // the noise of the noisiest tenth
  double low_noise = 0;     // from there
  double high_noise = 0;    // to there: over neighboring patches with the same residual over several radii
  bool varies = false;      // whether that is much, and neighboring ones have the same
  double exact = 0;         // ratio of the smallest neighborhoods that lie on a plane, while larger ones do not
  double sheets = 0;        // ratios of the patches: with another surface next to them, and
  double bends = 0;         // of surfaces that bend
  std::vector<Patch_noise> patch;
};

// --- The nearest patches of any position, by a k-d tree. It does not depend on the order of the patches but for those at one
// position.

// A balanced tree in the order of the table: the node of [first, last) is its middle.
class Patch_tree {
public:
  static constexpr int maximum_found = 16;

  // The nearest ones, ascending by squared distance, then by place in the table.
  struct Found {
    std::array<std::pair<double, std::uint32_t>, std::size_t(maximum_found)> item;
    int count = 0, wanted;

    explicit Found(int k) : item(), wanted(k) {}

    double limit() const { return count < wanted ? HUGE_VAL : item[std::size_t(count - 1)].first; }

    void add(const std::pair<double, std::uint32_t>& candidate)
    {
      if(count == wanted && !(candidate < item[std::size_t(count - 1)]))
        return;
      int i = count < wanted ? count++ : count - 1;
      for(; i > 0 && candidate < item[std::size_t(i - 1)]; --i)
        item[std::size_t(i)] = item[std::size_t(i - 1)];
      item[std::size_t(i)] = candidate;
    }
  };

  explicit Patch_tree(std::vector<Patch_noise> patch) : patch_(std::move(patch)), axis_(patch_.size())
  {
    build(0, patch_.size());
  }

  const std::vector<Patch_noise>& patches() const { return patch_; }

  // The k nearest patches, or all of fewer.
  Found nearest(const Vector& p, int k) const
  {
    Found found((std::min)(k, maximum_found));
    search(p, 0, patch_.size(), found);
    return found;
  }

private:
  static double component(const Vector& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

  void build(std::size_t first, std::size_t last)
  {
    if(last - first < 2)
      return;
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for(std::size_t i = first; i < last; ++i)
      for(int c = 0; c < 3; ++c) {
        low[c] = (std::min)(low[c], component(patch_[i].position, c));
        high[c] = (std::max)(high[c], component(patch_[i].position, c));
      }
    int axis = 0;
    for(int c = 1; c < 3; ++c)
      if(high[c] - low[c] > high[axis] - low[axis])
        axis = c;
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return patch_.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(first), at(middle), at(last), [&](const Patch_noise& a, const Patch_noise& b) {
      const double u = component(a.position, axis), v = component(b.position, axis);
      return u < v || (u == v && key(a) < key(b));
    });
    axis_[middle] = std::uint8_t(axis);
    build(first, middle);
    build(middle + 1, last);
  }

  static std::array<double, 4> key(const Patch_noise& p) { return {p.position.x, p.position.y, p.position.z, p.noise}; }

  void search(const Vector& p, std::size_t first, std::size_t last, Found& found) const
  {
    if(first == last)
      return;
    const std::size_t middle = first + (last - first) / 2;
    const Vector d = p - patch_[middle].position;
    found.add({dot(d, d), std::uint32_t(middle)});
    const double offset = component(d, axis_[middle]);
    const bool is_low = offset < 0;
    search(p, is_low ? first : middle + 1, is_low ? middle : last, found);
    if(offset * offset <= found.limit())
      search(p, is_low ? middle + 1 : first, is_low ? last : middle, found);
  }

  std::vector<Patch_noise> patch_;
  std::vector<std::uint8_t> axis_;
};

// --- The noise as a field over the surfaces: smoothed, and whether it varies for certain, as that of a depth camera does with
// the range. Then neighboring patches agree, and distant ones do not; vegetation and clutter differ between neighbors, too.

// The noise of each patch becomes the median of the nearest ones.
template <class Backend>
std::vector<Patch_noise> smoothed(Backend& backend, const Patch_tree& tree)
{
  std::vector<Patch_noise> patch = tree.patches();
  backend.for_each_on_host(patch.size(), [&](std::size_t i) {
    const Patch_tree::Found found = tree.nearest(patch[i].position, tuning::estimation::smoothed_patches);
    std::vector<double> noise;
    noise.reserve(std::size_t(found.count));
    for(int j = 0; j < found.count; ++j)
      noise.push_back(tree.patches()[found.item[std::size_t(j)].second].noise);
    patch[i].noise = quantile(noise, .5);
  });
  return patch;
}

// Whether two values of the noise are the same but for chance.
inline bool is_same_noise(double a, double b)
{
  constexpr double factor = tuning::estimation::same_noise;
  return a <= factor * b && b <= factor * a;
}

// Whether the square of the spacing, too, varies between smoothed patches with little and with much noise, as where both
// grow with the range.
inline bool is_noise_sparse(const std::vector<Patch_noise>& patches, double low_noise, double high_noise)
{
  std::vector<double> quiet, noisy;
  for(const Patch_noise& p : patches)
    (p.noise / low_noise > high_noise / p.noise ? noisy : quiet).push_back(p.spacing);
  const double ratio = quantile(noisy, .5) / quantile(quiet, .5);
  return ratio * ratio > tuning::estimation::varied_noise;
}

// Sets the range of the smoothed noise of patches, and whether it varies: far more of them differ from the median of all
// than from that of their neighbors, and the noisy ones are sparse.
template <class Backend>
void measure_variation(Backend& backend, std::vector<Patch_noise> patches, Cloud_measure& m)
{
  using namespace tuning::estimation;
  const Patch_tree tree(std::move(patches));
  const std::vector<Patch_noise> smoothed_patch = smoothed(backend, tree);
  std::vector<double> noise, smooth;
  std::int64_t differ = 0, differ_nearby = 0;
  for(const Patch_noise& p : tree.patches())
    noise.push_back(p.noise);
  const double median = quantile(noise, .5);
  for(const Patch_noise& s : smoothed_patch) {
    const double own = tree.patches()[smooth.size()].noise;
    differ += !is_same_noise(own, median);
    differ_nearby += !is_same_noise(own, s.noise);
    smooth.push_back(s.noise);
  }
  m.low_noise = quantile(smooth, low_noise_quantile);
  m.high_noise = quantile(smooth, 1 - low_noise_quantile);
  m.varies = m.high_noise > varied_noise * m.low_noise && !differ_in_place.is_exceeded(differ_nearby, differ) &&
             is_noise_sparse(smoothed_patch, m.low_noise, m.high_noise);
}

template <class Backend>
std::vector<Patch_measure> measure_patches(Backend& backend, const std::vector<Plane_level>& levels)
{
  const std::size_t size = tuning::estimation::patch_size;
  std::vector<Patch_measure> measure(levels.empty() ? 0 : (levels[0].plane.size() + size - 1) / size);
  backend.for_each_piece(measure.size(), 64, [&](std::size_t first, std::size_t last) {
    Patch_curve curve(levels);
    for(std::size_t i = first; i < last; ++i)
      measure[i] = curve.follow(i);
  });
  return measure;
}

// What shows a surface only over far larger radii than others do is clutter.
inline void drop_clutter(std::vector<Patch_measure>& patches)
{
  std::vector<double> first;
  for(const Patch_measure& p : patches)
    if(p.noise_steps >= 0)
      first.push_back(double(p.first));
  const auto last = std::size_t(quantile(first, .5)) + tuning::estimation::late_levels;
  for(Patch_measure& p : patches)
    if(p.first > last)
      p.noise_steps = -1;
}

// The statistics of the patches. step: of the grid on which they were measured.
inline Cloud_measure summarize(const std::vector<Patch_measure>& patches, double step)
{
  using namespace tuning::estimation;
  std::vector<double> noise, spacing, spacing_in_space, places_per_point;
  std::size_t exact = 0, measured = 0, sheets = 0, bends = 0;
  double squares = 0;
  for(const Patch_measure& p : patches) {
    if(p.noise_steps < 0) {
      spacing_in_space.push_back(p.spacing_steps);
      continue;
    }
    noise.push_back(p.noise_steps);
    squares = fused(p.noise_steps, p.noise_steps, squares);
    spacing.push_back(p.spacing_steps);
    places_per_point.push_back(p.places_per_point);
    exact += p.exact;
    measured += p.measured;
    sheets += p.has_sheets;
    bends += p.bends;
  }
  Cloud_measure m;
  m.spacing = step * quantile(spacing.empty() ? spacing_in_space : spacing, .5);
  m.places = noise.empty() ? 1 : quantile(places_per_point, .5);
  m.noise = step * quantile(noise, noise_quantile);
  m.largest_noise = step * quantile(noise, .9);
  m.rms_noise = step * std::sqrt(squares / (std::max)(double(noise.size()), 1.));
  const auto ratio = [](std::size_t part, std::size_t all) { return all > 0 ? double(part) / double(all) : 0; };
  m.exact = ratio(exact, measured);
  m.sheets = ratio(sheets, noise.size());
  m.bends = ratio(bends, noise.size());
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
  m = summarize(patches, grid.step);
  m.extent = box.extent();
  m.places *= double(in.total.points) / sample.points_per_point;
  if(m.spacing == 0) // too few places, or all on a line
    m.spacing = m.extent / std::sqrt(m.places);
  std::vector<Patch_noise> flat;
  for(std::size_t i = 0; i < patches.size(); ++i)
    if(patches[i].noise_steps >= 0) {
      const Grid_point& p = sample.point[(std::min)(i * patch_size + patch_size / 2, sample.point.size() - 1)];
      m.patch.push_back({{fused(p.x, grid.step, grid.origin.x), fused(p.y, grid.step, grid.origin.y),
                          fused(p.z, grid.step, grid.origin.z)},
                         patches[i].noise_steps * grid.step,
                         patches[i].spacing_steps * grid.step});
      if(patches[i].is_flat())
        flat.push_back(m.patch.back());
    }
  measure_variation(backend, std::move(flat), m);
  return m;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_MEASURE_CLOUD_H
