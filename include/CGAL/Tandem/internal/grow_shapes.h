// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One growth pass over all leaves, and what it changes in the table of shapes.

#ifndef CGAL_TANDEM_INTERNAL_GROW_SHAPES_H
#define CGAL_TANDEM_INTERNAL_GROW_SHAPES_H

#include <CGAL/Tandem/internal/leaf_shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr int most_growth_rounds = 256;

// A free border point proposes to join the nearest shape among those of its
// neighbors that it fits. Labels and planes do not change meanwhile.
struct Propose {
  Cloud_view cloud;
  const std::uint32_t* label;
  const Plane* plane;
  const std::uint32_t* border;
  std::uint32_t* proposal;
  Tolerance tolerance;

  CGAL_TANDEM_HD void operator()(std::size_t b) const
  {
    const std::uint32_t i = border[b];
    proposal[b] = no_index;
    if(label[i] != is_free)
      return;
    const std::uint32_t* row = cloud.row(i);
    std::int64_t least = 0;
    std::uint32_t last = is_free; // most neighbors that have a shape have the same one
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t s = label[row[j]];
      if(s >= first_mark || s == last || s == proposal[b])
        continue;
      last = s;
      if(!fits(plane[s], cloud.point[i], tolerance))
        continue;
      const std::int64_t e = signed_distance(plane[s], cloud.point[i]);
      const std::int64_t distance = e < 0 ? -e : e;
      if(proposal[b] == no_index || distance < least || (distance == least && s < proposal[b])) {
        proposal[b] = s;
        least = distance;
      }
    }
  }
};

template <class Backend>
struct Grow_cells {
  Cloud_view cloud;
  Shapes_view shapes;
  Labels_view labels;
  Growth_options options;
  const Cell_job* job;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Growth_scratch& scratch, std::uint32_t c) const
  {
    Cell_growth<Backend, Block>(block, scratch, job[c], cloud, shapes, labels, options).run();
  }
};

template <class Backend>
bool has_restarted(const Tandem_state<Backend>& t, std::size_t c)
{
  return !t.live.empty() && may_have(t.leaf_shapes[c], [&](std::uint32_t id) { return t.is_restarted[id] != 0; });
}

template <class Backend>
std::vector<Cell_job> make_jobs(Tandem_state<Backend>& t, std::vector<std::uint32_t>& new_ids)
{
  std::vector<Cell_job> jobs(t.cells.size());
  const std::uint32_t seeds = std::uint32_t(t.options.growth.seeds_in_flight);
  std::size_t wanted = 0;
  for(std::size_t c = 0; c < jobs.size(); ++c)
    wanted += t.seed_cursor[c] < t.seeds.count[c] ? seeds : 0;
  new_ids = spare_ids(t, wanted);
  const std::uint32_t* next = new_ids.data();
  for(std::size_t c = 0; c < jobs.size(); ++c) {
    const Range border = t.cell_border[c];
    jobs[c] = {t.cells[c],
               t.border.data() + border.first,
               t.proposal.data() + border.first,
               border.size(),
               t.seeds.seed.data() + t.cells[c].first,
               t.seeds.count[c],
               &t.seed_cursor[c],
               next,
               has_restarted(t, c)};
    next += t.seed_cursor[c] < t.seeds.count[c] ? seeds : 0;
  }
  return jobs;
}

// Adds what the shapes gained; the live shapes are then those with points.
template <class Backend>
void take_gain(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& new_ids)
{
  std::vector<std::uint32_t> candidates(t.live.size() + new_ids.size());
  std::merge(t.live.begin(), t.live.end(), new_ids.begin(), new_ids.end(), candidates.begin());
  t.live.clear();
  for(std::uint32_t id : candidates) {
    Shape& shape = t.shapes[id];
    Shared_moments& gain = t.gain[id];
    shape.gained = gain.count;
    if(gain.count != 0) {
      shape.moments += gain.moments();
      shape.box.add(gain.box);
      shape.is_dirty = shape.is_changed = true;
      t.assigned += std::size_t(gain.count);
      gain = Shared_moments();
    }
    shape.is_active = shape.gained > 0;
    ++shape.age;
    t.is_restarted[id] = 0;
    t.rounds[id] = std::uint16_t(shape.age < 9 ? 1 << shape.age : most_growth_rounds);
    if(shape.moments.count > 0)
      t.live.push_back(id);
  }
}

// Returns the number of points that were gained.
template <class Backend>
std::size_t grow_shapes(Tandem_state<Backend>& t)
{
  const std::size_t before = t.assigned;
  t.backend.for_each(t.border.size(), Propose{t.cloud, t.label.data(), t.plane.data(), t.border.data(),
                                              t.proposal.data(), t.options.growth.tolerance});
  std::vector<std::uint32_t> new_ids;
  const std::vector<Cell_job> jobs = make_jobs(t, new_ids);
  t.backend.template for_each_cell<Growth_scratch>(
    jobs.size(), Grow_cells<Backend>{t.cloud, t.shapes_view(), t.labels(), t.options.growth, jobs.data()});
  take_gain(t, new_ids);
  list_shapes(t);
  return t.assigned - before;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROW_SHAPES_H
