// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planes through clutter: their points have many neighbors off the plane.

#ifndef CGAL_TANDEM_INTERNAL_CLUTTER_H
#define CGAL_TANDEM_INTERNAL_CLUTTER_H

#include <CGAL/Tandem/internal/Tandem_state.h>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Neighbor_counts {
  std::uint64_t all = 0;  // neighbors of the points of a shape, but those of other crisp shapes
  std::uint64_t near = 0; // ... within epsilon of its plane, whatever their shape
  std::uint64_t own = 0;  // ... that belong to it
};

template <class Backend>
struct Count_neighbors {
  Cloud_view cloud;
  const std::uint32_t* label;
  const Plane* plane;           // by shape, as are these
  const std::uint8_t* is_crisp; // its points are close to its plane, unlike those of planes through clutter
  Neighbor_counts* counts;
  std::int64_t distance;

  // Points [first, last); a run of points of one shape is added at once.
  void operator()(std::size_t first, std::size_t last) const
  {
    Neighbor_counts run;
    for(std::size_t i = first; i < last; ++i) {
      const std::uint32_t s = label[i];
      if(s < first_mark)
        count(std::uint32_t(i), s, run);
      if(run.all > 0 && (i + 1 == last || label[i + 1] != s)) {
        Backend::atomic_add(counts[s].all, run.all);
        Backend::atomic_add(counts[s].near, run.near);
        Backend::atomic_add(counts[s].own, run.own);
        run = Neighbor_counts();
      }
    }
  }

private:
  void count(std::uint32_t i, std::uint32_t s, Neighbor_counts& run) const
  {
    const std::uint32_t* row = cloud.row(i);
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const bool is_own = label[row[j]] == s;
      const std::uint32_t other = label[row[j]];
      const bool is_neutral = !is_own && other < first_mark && is_crisp[other]; // the other side of a thin plate, say
      run.all += !is_neutral;
      run.own += is_own;
      run.near += is_own || (!is_neutral && is_near(plane[s], cloud.point[row[j]], distance));
    }
  }
};

// Largest rms, in epsilons, of the distances of a crisp shape.
constexpr double crisp_rms = 0.4;

// rms: of the distances to the plane, in epsilons. The bounds are measured: planes
// through outliers have .40 to .75 of the neighbors near them, faces .89 and more.
inline bool is_clutter(const Neighbor_counts& c, double rms)
{
  const double all = c.all > 0 ? double(c.all) : 1;
  const double near = double(c.near) / all, own = double(c.own) / all;
  return near < .55 || (own < .4 && near < .75) || (rms > .5 && near < .77);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CLUTTER_H
