// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Offsets of parallel shapes along their direction (grid steps), clustered on the line by mean shift. See section 4.3
// of the paper. Nothing is changed; Coplanar_classes.h verifies the clusters.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_CLUSTER_OFFSETS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_CLUSTER_OFFSETS_H

#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/regularity/Mean_shift.h>

#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

// Sorted offsets: a query is a window, found by bisection. It visits offsets in rising order, equal ones in that of the
// input.
class Offset_index {
public:
  using Position = double;

  // The weighted mean, as differences from a value nearby: offsets far from the origin lose no bits.
  class Mean {
  public:
    explicit Mean(double start) : start(start) {}
    void add(double x, double w)
    {
      sum = std::fma(w, x - start, sum);
      weight += w;
    }
    double value() const { return weight > 0 ? start + sum / weight : start; }

  private:
    double start, sum = 0, weight = 0;
  };

  static double squared_distance(double a, double b) { return (a - b) * (a - b); }

  static double reach_of(double distance) { return distance * (1 + tuning::exactness::reach_margin); }

  Offset_index(const std::vector<double>& offsets, double radius) : radius(radius)
  {
    sorted.reserve(offsets.size());
    for(std::size_t i = 0; i < offsets.size(); ++i)
      sorted.push_back({offsets[i], i});
    if(!std::is_sorted(sorted.begin(), sorted.end())) // offsets of bins are
      std::sort(sorted.begin(), sorted.end());
  }

  // Calls f(i, squared distance) for the offsets within the radius.
  template <class Function>
  void near(double x, Function f) const
  {
    near(x, radius, f);
  }

  // The same within a smaller reach.
  template <class Function>
  void near(double x, double reach, Function f) const
  {
    auto i = std::lower_bound(sorted.begin(), sorted.end(), std::make_pair(x - reach, std::size_t(0)));
    for(; i != sorted.end() && i->first <= x + reach; ++i)
      f(i->second, squared_distance(x, i->first));
  }

  // Calls f(i, kernel(squared distance)) for the same.
  template <class Kernel, class Function>
  void weigh(double x, Kernel kernel, Function f) const
  {
    near(x, [&](std::size_t i, double q) { f(i, kernel(q)); });
  }

private:
  double radius;
  std::vector<std::pair<double, std::size_t>> sorted;
};

// Classes of offsets within the radius of a mode, as lists of positions in the input, by rising offset. Every position
// is in one of them: at the nearest mode (of equally near ones, the denser), or alone.
inline std::vector<std::vector<int>> cluster_offsets(const std::vector<double>& offsets,
                                                     const std::vector<double>& weights, double radius)
{
  // Close offsets are gathered in bins of a sixteenth of the radius. The cost of the mean shift then depends on the
  // number of different offsets. A wall with a thousand windows has few.
  std::vector<std::pair<double, int>> order;
  order.reserve(offsets.size());
  for(std::size_t i = 0; i < offsets.size(); ++i)
    order.push_back({offsets[i], int(i)});
  std::sort(order.begin(), order.end());
  std::vector<double> bin_offset, bin_weight;
  bin_offset.reserve(order.size());
  bin_weight.reserve(order.size());
  for(std::size_t i = 0, j; i < order.size(); i = j) {
    Offset_index::Mean mean(order[i].first);
    double weight = 0;
    for(j = i;
        j < order.size() && order[j].first - order[i].first <= radius / tuning::clustering::offset_bins_per_radius;
        ++j) {
      mean.add(order[j].first, weights[order[j].second]);
      weight += weights[order[j].second];
    }
    bin_offset.push_back(mean.value());
    bin_weight.push_back(weight);
  }
  const std::vector<double> modes = Mean_shift<Offset_index>(bin_offset, bin_weight, radius).modes(In_order());
  const Offset_index index(modes, radius);
  std::vector<std::vector<int>> classes(modes.size());
  for(const auto& o : order) {
    std::pair<double, std::size_t> nearest(-1.0, 0);
    index.near(o.first, [&](std::size_t m, double q) {
      if(nearest.first < 0 || std::make_pair(q, m) < nearest)
        nearest = {q, m};
    });
    if(nearest.first < 0)
      classes.push_back({o.second});
    else
      classes[nearest.second].push_back(o.second);
  }
  classes.erase(std::remove_if(classes.begin(), classes.end(), [](const std::vector<int>& c) { return c.empty(); }),
                classes.end());
  return classes;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_CLUSTER_OFFSETS_H
