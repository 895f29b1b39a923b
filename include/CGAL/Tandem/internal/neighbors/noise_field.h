// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The noise as a field over the surfaces: smoothed, and whether it varies for certain, as that of a depth camera does with
// the range. Then neighboring patches agree, and distant ones do not; vegetation and clutter differ between neighbors, too.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_NOISE_FIELD_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_NOISE_FIELD_H

#include <CGAL/Tandem/internal/neighbors/Patch_curve.h>
#include <CGAL/Tandem/internal/neighbors/Patch_tree.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

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

// Sets the range of the smoothed noise of patches, and whether it varies: far more of them differ from the median of all
// than from that of their neighbors.
template <class Backend>
void measure_variation(Backend& backend, std::vector<Patch_noise> patches, Cloud_measure& m)
{
  using namespace tuning::estimation;
  const Patch_tree tree(std::move(patches));
  std::vector<double> noise, smooth;
  std::int64_t differ = 0, differ_nearby = 0;
  for(const Patch_noise& p : tree.patches())
    noise.push_back(p.noise);
  const double median = quantile(noise, .5);
  for(const Patch_noise& s : smoothed(backend, tree)) {
    const double own = tree.patches()[smooth.size()].noise;
    differ += !is_same_noise(own, median);
    differ_nearby += !is_same_noise(own, s.noise);
    smooth.push_back(s.noise);
  }
  m.low_noise = quantile(smooth, low_noise_quantile);
  m.high_noise = quantile(smooth, 1 - low_noise_quantile);
  m.varies = m.high_noise > varied_noise * m.low_noise && !differ_in_place.is_exceeded(differ_nearby, differ);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_NOISE_FIELD_H
