// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each surfel goes to the adjacent shape where it is worth most: see score/Score.h. Planes are fixed meanwhile. Changes
// labels of surfels, and moments and boxes of shapes. See the manual, "Assignment".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H

#include <CGAL/Tandem/internal/base/keys.h>
#include <CGAL/Tandem/internal/base/tuning/score.h>
#include <CGAL/Tandem/internal/cloud/Block_rows.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>

#include <utility>

namespace CGAL::Tandem::internal {

// --- Which label each surfel chooses in the passes of an assignment, and which surfels a pass has to look at. Changes
// tables of the assignment only. See the manual, "Assignment".

// What an assignment reads of a shape.
struct Assigned_shape {
  Plane plane;
  std::int64_t bonus;        // of one more point, by the size that it had when its plane moved last
  std::int64_t plane_number; // of the relations, -1: none

  CGAL_TANDEM_HD bool has_plane_of(const Assigned_shape& s) const
  {
    return plane == s.plane && plane_number == s.plane_number;
  }
};

// Some surfels, a bit each, by block.
using Block_surfels = std::uint64_t;
static_assert(Block_row::surfels == 64, "a block has a bit for each surfel");

CGAL_TANDEM_HD inline Block_surfels bit_of(std::uint32_t i) { return Block_surfels(1) << (i % Block_row::surfels); }

// When the label of a surfel, or of one of a block, changed last.
using Change_pass = std::uint8_t;

struct Change_passes {
  static constexpr Change_pass before = 2; // since the last assignment, or in its last two passes; 0: longer ago
  static constexpr std::uint32_t end = tuning::moves::assignment_passes;
  static_assert(end + 3 < 256, "a pass, and the one after the last, is noted in a byte");

  CGAL_TANDEM_HD static Change_pass in(std::uint32_t pass) { return Change_pass(pass + 3); }
  // Seen from a pass: in the two passes before it, or in the same one. Seen from the end, too.
  CGAL_TANDEM_HD static bool is_recent(Change_pass change, std::uint32_t pass) { return change > pass; }
};

// The passes of an assignment, as rounds. They may end when two have changed nothing. In each a surfel gets the label
// that is worth most, of its own and those of its neighbors that it fits. A free surfel joins any shape that it fits.
// Of the other surfels each pass considers one half, so that neighbors do not swap their shapes for ever. Shapes of one
// plane exchange no surfels, since the plane does not tell them apart. Labels are only read, so the order of surfels
// does not matter.
//
// The choice is that of before where no label around has changed in the last two passes, and either no shape around has
// changed since the surfel was considered, or its neighbors were of no other shape. So a pass visits few blocks. One
// that is not visited has the same labels in both tables. Whether a change of the same pass is seen does not matter: it
// only repeats a choice.
template <class Backend>
struct Assignment_passes {
  enum Step { visit, steps };

  Cloud_view cloud;
  const Assigned_shape* shape;
  std::size_t blocks;
  const Block_row* row;         // by block
  const Block_entries* entries; // by surfel
  const std::uint8_t* is_moved; // by block: has surfels of shapes that have changed since the last assignment
  Change_pass* change;          // by surfel
  Change_pass* block_change;    // by block; these three also of ghosts
  Block_surfels* border;        // by block: surfels that had a neighbor in another shape
  std::uint8_t* has_changes;    // by pass
  std::uint32_t* label[2];      // by surfel: pass p reads table p % 2 and writes the other one
  Score score;
  Tolerance tolerance;

  static_assert(tuning::moves::assignment_passes % 2 == 0, "the last pass writes the first table of labels");

  static constexpr std::size_t few(int) { return 64; }
  CGAL_TANDEM_HD bool is_last(std::size_t pass) const
  {
    return pass >= 2 && has_changes[pass - 1] == 0 && has_changes[pass - 2] == 0;
  }

  CGAL_TANDEM_HD void run(int, std::size_t pass, std::size_t lane, std::size_t lanes) const
  {
    for_items_of_group(
      lane, lanes, blocks * parts(), [](std::size_t) { return true; },
      [&](std::size_t at) { visit_part(std::uint32_t(at), std::uint32_t(pass)); });
  }

  // After the passes, sets the interior bits of the surfels of a block: of those without a neighbor in another shape
  // when they were last considered, unless one may have changed since. So links are searched at the others only.
  CGAL_TANDEM_HD void set_interior(std::uint32_t b, std::uint8_t* state) const
  {
    const Block_entries changed = changed_entries(b, Change_passes::end);
    for(std::uint32_t part = 0; part < parts(); ++part)
      for_each_surfel(b, part, [&](std::uint32_t i) {
        const bool is_interior = (border[b] & bit_of(i)) == 0 && (changed & entries[i]) == 0;
        state[i] = std::uint8_t((state[i] & ~interior_bit) | (is_interior ? interior_bit : 0));
      });
  }

  // After a pass, ghosts have the labels that their owners gave them.
  CGAL_TANDEM_HD void note_ghost(std::uint32_t i, std::uint32_t pass) const
  {
    if(label[0][i] != label[1][i])
      set_changed(i, pass);
  }

private:
  // Whether surfels may not have been considered with the present planes.
  CGAL_TANDEM_HD static bool has_new_planes(std::size_t pass) { return pass < 2; }

  // The entries of the row of a block with is_one(block).
  template <class Is_one>
  CGAL_TANDEM_HD Block_entries entries_with(std::uint32_t b, Is_one is_one) const
  {
    const std::uint32_t size = row[b].size;
    Block_entries result = size > Block_row::capacity ? Block_row::all : 0u;
    for(std::uint32_t i = 0; result != Block_row::all && i < size; i += Lane_group::size()) {
      const std::uint32_t own = i + Lane_group::rank();
      result |= Lane_group::bits(own < size && is_one(row[b].block[own])) << i;
    }
    return result;
  }

  // Those with labels that have changed lately.
  CGAL_TANDEM_HD Block_entries changed_entries(std::uint32_t b, std::uint32_t pass) const
  {
    return entries_with(
      b, [&](std::uint32_t c) { return Change_passes::is_recent(Backend::atomic_load(block_change[c]), pass); });
  }

  // So many parts of a block that each lane of a group has one surfel.
  CGAL_TANDEM_HD static constexpr std::uint32_t parts()
  {
    return Lane_group::size() > 1 ? Block_row::surfels / Lane_group::size() : 1;
  }

  CGAL_TANDEM_HD void visit_part(std::uint32_t at, std::uint32_t pass) const
  {
    const std::uint32_t b = at / parts();
    const Block_entries changed = changed_entries(b, pass);
    // One answer for all lanes, as those of the other part may change the border meanwhile.
    const bool has_border = Lane_group::bits(has_new_planes(pass) && Backend::atomic_load(border[b]) != 0) != 0;
    const Block_entries moved = has_border ? entries_with(b, [&](std::uint32_t c) { return is_moved[c] != 0; }) : 0u;
    if((changed | moved) == 0)
      return;
    for_each_surfel(b, at % parts(), [&](std::uint32_t i) { choose(i, pass, {changed, moved}); });
  }

  // The lanes of a group share the surfels of a part of a block.
  template <class F>
  CGAL_TANDEM_HD void for_each_surfel(std::uint32_t b, std::uint32_t part, F f) const
  {
    const Range surfels = surfels_of_block(b, cloud.size);
    const std::uint32_t first = surfels.first + part * Lane_group::size() + Lane_group::rank();
    for(std::uint32_t i = first; i < surfels.last; i += parts() * Lane_group::size())
      f(i);
  }

  // The blocks of a row with changes of labels, and of shapes.
  struct Changed_blocks {
    Block_entries labels, shapes;
  };

  CGAL_TANDEM_HD void choose(std::uint32_t i, std::uint32_t pass, const Changed_blocks& changed) const
  {
    const std::uint32_t s = label[pass % 2][i];
    // The first pass has seen the shapes around free surfels.
    const bool is_chosen = s < first_mark ? is_considered(i, pass) && is_concerned(i, pass, changed)
                                          : is_concerned(i, pass, {changed.labels, pass == 0 ? changed.shapes : 0u});
    const std::uint32_t t = is_chosen ? best_of(i, label[pass % 2]) : s;
    label[(pass + 1) % 2][i] = t;
    if(t == s)
      return;
    set_changed(i, pass);
    if(Backend::atomic_load(has_changes[pass]) == 0)
      Backend::atomic_store(has_changes[pass], std::uint8_t(1));
  }

  CGAL_TANDEM_HD void set_changed(std::uint32_t i, std::uint32_t pass) const
  {
    const Change_pass now = Change_passes::in(pass);
    Backend::atomic_store(change[i], now);
    Backend::atomic_store(block_change[i / Block_row::surfels], now);
  }

  // One half of the surfels in even passes, the other one in odd passes.
  CGAL_TANDEM_HD bool is_considered(std::uint32_t i, std::uint32_t pass) const
  {
    return (hash_of_pair(i + cloud.first) >> 63) == (pass & 1u);
  }

  CGAL_TANDEM_HD bool is_at_border(std::uint32_t i) const
  {
    return (Backend::atomic_load(border[i / Block_row::surfels]) & bit_of(i)) != 0;
  }

  CGAL_TANDEM_HD void set_at_border(std::uint32_t i, bool value) const
  {
    if(is_at_border(i) != value)
      Backend::atomic_add(border[i / Block_row::surfels], value ? bit_of(i) : Block_surfels(0) - bit_of(i));
  }

  // Whether it or a neighbor has changed its label lately; or it may prefer another shape by planes.
  CGAL_TANDEM_HD bool is_concerned(std::uint32_t i, std::uint32_t pass, const Changed_blocks& changed) const
  {
    if((changed.shapes & entries[i]) != 0 && is_at_border(i))
      return true;
    if((changed.labels & entries[i]) == 0)
      return false;
    if(Lane_group::size() > 1)
      return true; // lanes that run together choose as fast as they ask neighbors
    Change_pass last = Backend::atomic_load(change[i]);
    if(Change_passes::is_recent(last, pass))
      return true;
    const std::uint32_t* neighbor = cloud.row(i);
    for(int j = 0; j < cloud.k && neighbor[j] != no_index; ++j) {
      const Change_pass c = Backend::atomic_load(change[neighbor[j]]);
      last = c > last ? c : last; // no branch, which could not be predicted
    }
    return Change_passes::is_recent(last, pass);
  }

  // Of the own label and those of neighbors. Ties go to the smaller one.
  CGAL_TANDEM_HD std::uint32_t best_of(std::uint32_t i, const std::uint32_t* labels) const
  {
    std::uint32_t other[64]; // labels of neighbors in other shapes: k is at most 64
    std::int64_t links = 0;  // to the own one
    int n = 0;
    const std::uint32_t own = labels[i];
    cloud.for_each_neighbor(i, labels, [&](std::uint32_t t) {
      links += t == own;
      other[n] = t; // kept if it is another shape; no branches, which could not be predicted
      n += int(t < first_mark) & int(t != own);
    });
    set_at_border(i, n > 0);
    std::uint32_t best = own;
    if(n == 0)
      return own;
    const Grid_point& point = cloud.point[i];
    const Tolerance fit = cloud.tolerance_of(i, tolerance);
    std::int64_t most = 0;
    if(own < first_mark)
      most = worth(fit, signed_distance(shape[own].plane, point), links);
    while(n > 0) {
      const std::uint32_t t = other[n - 1];
      const int count = n;
      n = 0;
      for(int j = 0; j < count; ++j) { // those that are left
        const std::uint32_t next = other[j];
        other[n] = next;
        n += next != t;
      }
      if(are_of_one_plane(own, t))
        continue;
      const std::int64_t distance = signed_distance(shape[t].plane, point);
      if(distance > fit.distance || -distance > fit.distance)
        continue;
      const std::int64_t w = worth(fit, distance, count - n) + more_bonus(own, t, point, fit);
      if((best >= first_mark || w > most || (w == most && t < best)) &&
         is_aligned(shape[t].plane, point, fit.squared_cosine)) {
        most = w;
        best = t;
      }
    }
    return best;
  }

  CGAL_TANDEM_HD bool are_of_one_plane(std::uint32_t s, std::uint32_t t) const
  {
    return s < first_mark && shape[s].plane_number >= 0 && shape[s].plane_number == shape[t].plane_number;
  }

  // Of a surfel at a distance of the plane of a shape, with so many links to it.
  CGAL_TANDEM_HD std::int64_t worth(const Tolerance& fit, std::int64_t distance, std::int64_t links) const
  {
    return Score::weight(fit, distance) - score.links(links);
  }

  // What one more point is worth to shape t, more than to shape s, as far as their surface is continuous there.
  CGAL_TANDEM_HD std::int64_t more_bonus(std::uint32_t s, std::uint32_t t, const Grid_point& p,
                                         const Tolerance& fit) const
  {
    if(s >= first_mark)
      return shape[t].bonus;
    const std::int64_t more = shape[t].bonus - shape[s].bonus;
    return more * continuity_at(shape[s].plane, shape[t].plane, p, fit) / Score::unit;
  }
};

template <class Backend>
struct Set_interior {
  Assignment_passes<Backend> passes;
  std::uint8_t* state; // by surfel

  CGAL_TANDEM_HD void operator()(std::size_t b) const { passes.set_interior(std::uint32_t(b), state); }
};

template <class Backend>
struct Note_ghosts {
  Assignment_passes<Backend> passes;
  std::uint32_t pass;

  CGAL_TANDEM_HD void operator()(std::size_t g) const { passes.note_ghost(passes.cloud.size + std::uint32_t(g), pass); }
};

struct Set_assigned {
  const Shape* shape;
  const Plane* plane;
  Score score;
  const Assigned_shape* last; // those of the last assignment, so many
  std::size_t last_shapes;
  Assigned_shape* assigned;
  std::uint8_t* is_moved;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    const std::int64_t n = shape[id].moments.count;
    assigned[id] = {plane[id], n > 0 ? score.point_bonus(n) : 0, shape[id].plane_number};
    is_moved[id] = id >= last_shapes || !assigned[id].has_plane_of(last[id]);
    if(!is_moved[id])
      assigned[id].bonus = last[id].bonus;
  }
};

// The first labels: a surfel that does not fit its shape leaves it; one that the last assignment chose fits a shape
// that has not changed since. Notes which labels are others than those that it chose, and where shapes have changed.
template <class Backend>
struct Start_assignment {
  Cloud_view cloud;
  const std::uint32_t* label;
  const Assigned_shape* shape;
  const std::uint8_t* is_moved; // by shape
  std::uint32_t *chosen, *next; // by surfel
  Change_pass *change, *block_change;
  std::uint8_t* has_moved; // by block
  Tolerance tolerance;

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint32_t i = std::uint32_t(at);
    std::uint32_t s = label[i];
    const bool is_moved_shape = s < first_mark && is_moved[s];
    if(s < first_mark && (is_moved_shape || chosen[i] != s) && !cloud.fits(shape[s].plane, i, tolerance))
      s = free_label;
    const std::size_t b = i / Block_row::surfels;
    if(is_moved_shape)
      Backend::atomic_store(has_moved[b], std::uint8_t(1));
    const bool is_recent = chosen[i] != s || Change_passes::is_recent(change[i], Change_passes::end);
    change[i] = is_recent ? Change_passes::before : Change_pass(0);
    if(is_recent)
      Backend::atomic_store(block_change[b], Change_pass(Change_passes::before));
    chosen[i] = next[i] = s;
  }
};

// For each cell: writes the chosen labels, and sums what leaves each shape and what joins it. A surfel changes its
// cell's table only where its label changes. Integer sums, so the order does not matter.
template <class Backend>
struct Apply_chosen {
  Cloud_view cloud;
  const Range* cells;
  const std::uint32_t* chosen;
  Labels_view labels;
  Shared_moments* change; // by shape; points that leave have sign -1

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Moment_table& table, std::uint32_t c) const
  {
    const Range cell = cells[c];
    const Cell_sums changes = {cloud.surfels, cloud.point[cell.first], change};
    table.clear(block);
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      const std::uint32_t old = labels.label[i], s = chosen[i];
      if(old == s)
        return;
      labels.label[i] = s;
      if(old < first_mark)
        table.template add<Backend>(block, old, i, -1, changes);
      if(s < first_mark)
        table.template add<Backend>(block, s, i, 1, changes);
    });
    table.template flush<Backend>(block, changes);
  }
};

// Surfels take the chosen labels, by position. Moments follow; boxes may be too large, because what leaves does not
// shrink them. Shapes may become empty.
template <class Backend>
void take_chosen(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const std::uint32_t* chosen)
{
  Backend& backend = points.backend;
  const Labels_view labels = points.change_labels(false);
  points.invalidate_interior();
  backend.template for_each_cell<Moment_table>(
    points.number_of_cells(), Apply_chosen<Backend>{points.cloud.view(), points.cells.data(), chosen, labels,
                                                    start_deltas(backend, shapes, shapes.size)});
  points.refresh_labels();
  sum_deltas(backend, points.ranks, shapes);
  add_deltas(backend, shapes);
}

// Assignments of one cloud. Each remembers the labels that it has chosen, and which surfels had neighbors in other
// shapes. So the next one looks at those and at what has changed since, and chooses as if it looked at all surfels.
template <class Backend>
class Assignment {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  explicit Assignment(Labeled_cloud<Backend>& points)
    : points_(points), backend_(points.backend), block_(points.backend, points.cloud),
      chosen_(filled_buffer(backend_, points.cloud.size_with_ghosts(), no_index)),
      change_(filled_buffer(backend_, points.cloud.size_with_ghosts(), Change_passes::in(Change_passes::end))),
      border_(filled_buffer(backend_, block_.row.size(), Block_surfels(0)))
  {}

  // Planes are those of the table that is rounded for the tests of surfels.
  void operator()(Shape_table<Backend>& shapes, const Stage_parameters& options)
  {
    Buffer<Assigned_shape> assigned(shapes.size);
    Buffer<std::uint8_t> is_moved(shapes.size);
    for_each_shape(backend_, shapes,
                   Set_assigned{shapes.counted(), shapes.plane.data(), options.score, assigned_.data(),
                                assigned_.size(), assigned.data(), is_moved.data()});
    assigned_ = std::move(assigned);
    const Cloud_view cloud = points_.cloud.view();
    const std::size_t blocks = block_.row.size();
    Buffer<std::uint32_t> next(chosen_.size());
    const std::size_t with_ghosts = number_of_blocks(chosen_.size());
    auto block_change = filled_buffer(backend_, with_ghosts, Change_pass(0));
    auto has_moved = filled_buffer(backend_, with_ghosts, std::uint8_t(0));
    auto has_changes = filled_buffer(backend_, tuning::moves::assignment_passes, std::uint8_t(0));
    backend_.for_each(chosen_.size(),
                      Start_assignment<Backend>{cloud, points_.label(), assigned_.data(), is_moved.data(),
                                                chosen_.data(), next.data(), change_.data(), block_change.data(),
                                                has_moved.data(), options.growth.tolerance});
    const Assignment_passes<Backend> passes = {cloud,
                                               assigned_.data(),
                                               blocks,
                                               block_.row.data(),
                                               block_.of_surfel.data(),
                                               has_moved.data(),
                                               change_.data(),
                                               block_change.data(),
                                               border_.data(),
                                               has_changes.data(),
                                               {chosen_.data(), next.data()},
                                               options.score,
                                               options.growth.tolerance};
    run(passes);
    take_chosen(points_, shapes, chosen_.data());
    points_.begin_phase(Phase::end);
    for_each_by_group(backend_, blocks, Set_interior<Backend>{passes, points_.state()});
  }

private:
  void run(const Assignment_passes<Backend>& passes)
  {
    constexpr std::size_t maximum = tuning::moves::assignment_passes;
    const std::size_t blocks = block_.row.size();
    if constexpr(!Ranks<Backend>::are_many)
      backend_.run_rounds(maximum, blocks, passes);
    else
      run_joint_rounds(backend_, maximum, blocks, passes, [&](int step, std::size_t pass) {
        if(step == Assignment_passes<Backend>::visit) {
          points_.ranks.refresh(passes.label[(pass + 1) % 2], Rings::inner);
          backend_.for_each(points_.cloud.ghosts, Note_ghosts<Backend>{passes, std::uint32_t(pass)});
        }
        return false;
      });
  }

  Labeled_cloud<Backend>& points_;
  Backend& backend_;
  Block_rows<Backend> block_;
  Buffer<Assigned_shape> assigned_;
  Buffer<std::uint32_t> chosen_; // by surfel
  Buffer<Change_pass> change_;   // these two as in Assignment_passes
  Buffer<Block_surfels> border_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H
