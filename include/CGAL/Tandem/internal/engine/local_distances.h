// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tolerance for each point, from the noise about it. See the manual, "Estimated Parameters".

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_LOCAL_DISTANCES_H
#define CGAL_TANDEM_INTERNAL_ENGINE_LOCAL_DISTANCES_H

#include <CGAL/Tandem/internal/engine/complete_parameters.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace CGAL::Tandem::internal {

// The noise at a position: that of the nearest patches, weighted by the inverse distance.
inline double noise_at(const Patch_tree& tree, const Vector& p)
{
  const Patch_tree::Found found = tree.nearest(p, tuning::estimation::mixed_patches);
  double sum = 0, weights = 0;
  for(int j = 0; j < found.count; ++j) {
    const auto [squared_distance, i] = found.item[std::size_t(j)];
    if(squared_distance == 0)
      return tree.patches()[i].noise;
    const double weight = 1 / std::sqrt(squared_distance);
    sum = fused(weight, tree.patches()[i].noise, sum);
    weights += weight;
  }
  return sum / weights;
}

// The tolerance of each item of the range, in its order; NaN for those that are ignored. The estimate for all points is
// scaled by the noise about a point, against that of the cloud, with a margin where the noise varies.
template <class Backend>
std::vector<double> estimate_local_distances(Backend& backend, const Import& in)
{
  using namespace tuning::estimation;
  std::vector<double> distance(in.number_of_items, std::numeric_limits<double>::quiet_NaN());
  if(in.total.points == 0)
    return distance;
  const Cloud_measure m = measure_cloud(backend, in);
  const double estimate = (m.varies ? local_margin : 1) * estimate_maximum_distance(in, m);
  const bool is_local = has_noise(m);
  const double high = m.varies ? m.high_noise : m.largest_noise;
  const double most = is_local ? (std::min)(high / m.noise, largest_local_factor) : 1;
  const Patch_tree tree(is_local ? smoothed(backend, Patch_tree(m.patch)) : std::vector<Patch_noise>());
  backend.for_each_on_host(in.size(), [&](std::size_t i) {
    const double ratio = is_local ? noise_at(tree, in.position(i)) / m.noise : 1;
    distance[in.item_of(i)] = bounded_length(estimate * (std::min)((std::max)(ratio, 1 / largest_local_factor), most));
  });
  return distance;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ENGINE_LOCAL_DISTANCES_H
