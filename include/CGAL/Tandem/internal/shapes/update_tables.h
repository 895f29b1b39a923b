// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What follows from the labels, and is made again where labels have changed since: lists of cells, fits of shapes,
// interior bits. A stage says at its beginning what it reads; tables that are out of date cannot be read.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_TABLES_H
#define CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_TABLES_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>

namespace CGAL::Tandem::internal {

// --- Fits of moments that all ranks have. A fit costs an eigenvalue problem, so each rank makes its own items, and
// gets the others. Changes nothing but these fits.

// The fits of the own items, and the scatter of all moments, which costs less than to send it.
template <class Fits>
struct Make_fit {
  Fits fits;
  Own_items own;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(!fits.has(i))
      return;
    fits[i].scatter = make_scatter(fits[i].moments);
    if(!own.has(i))
      return;
    set_fit(fits[i], fit_plane(fits[i].scatter));
    if(own.ranks == 1)
      fits.set_made(i);
  }
};

struct Numbered_fit {
  std::uint64_t number; // wide, so that all bytes are defined
  Fit fit;
};

template <class Fits>
struct Take_fit {
  Fits fits;
  Own_items own;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return own.has(i) && fits.has(i); }
  CGAL_TANDEM_HD Numbered_fit take(std::uint32_t i) const { return {i, fits[i].fit}; }
};

template <class Fits>
struct Put_fit {
  Fits fits;
  const Numbered_fit* of_all;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::size_t number = std::size_t(of_all[i].number);
    set_fit(fits[number], of_all[i].fit);
    fits.set_made(number);
  }
};

// After the own items have been made: the fits of all ranks.
template <class Backend, class Fits>
void spread_fits(Backend& backend, const Ranks<Backend>& ranks, std::size_t n, const Fits& fits)
{
  if constexpr(Ranks<Backend>::are_many) {
    const auto all = collect_of_all<Numbered_fit>(backend, ranks, n, Take_fit<Fits>{fits, ranks.own_items()});
    backend.for_each(all.size(), Put_fit<Fits>{fits, all.data()});
  }
}

// fits.has(i): one is to be made for fits[i] of the n moments; fits.set_made(i): it has been made.
template <class Backend, class Fits>
void make_fits(Backend& backend, const Ranks<Backend>& ranks, std::size_t n, const Fits& fits)
{
  backend.for_each(n, Make_fit<Fits>{fits, ranks.own_items()}, shapes_per_thread);
  spread_fits(backend, ranks, n, fits);
}

// --- What follows from the labels.

// A hash set of shapes with linear probing; twice the capacity of a list keeps probes short.
struct List_scratch {
  static constexpr std::uint32_t slots = 2 * Cell_shapes::capacity;
  std::uint32_t shape[slots];
};

// The shape that a lane has met last. Neighbors on the curve mostly share their shape, which is then looked up once.
struct Last_shape {
  std::uint32_t shape = no_index;
};

// Makes the list of a cell from the labels of its surfels. Lanes append in any order: only membership is read.
struct List_shapes {
  const Range* cells;
  const std::uint32_t* label; // by position
  Cell_shapes* list;          // by cell

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, List_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    Cell_shapes& shapes = list[c];
    block.single([&] { shapes.size = 0; });
    block.for_each(List_scratch::slots, [&](std::uint32_t i) { scratch.shape[i] = no_index; });
    block.template accumulate<Last_shape>(
      cell.size(),
      [&](std::uint32_t at, Last_shape& last) {
        const std::uint32_t s = label[cell.first + at];
        if(s >= first_mark || s == last.shape)
          return;
        last.shape = s;
        if(!is_new(block, scratch, s))
          return;
        const std::uint32_t place = block.append(shapes.size);
        if(place < Cell_shapes::capacity)
          shapes.shape[place] = s;
      },
      [](const Last_shape&) {});
  }

private:
  // True for exactly one lane of each shape: the exchange succeeds once. Where the set is full, every shape counts as
  // new, as the list has overflown by then.
  template <class Block>
  CGAL_TANDEM_HD static bool is_new(Block& block, List_scratch& scratch, std::uint32_t s)
  {
    for(std::uint32_t probe = 0; probe < List_scratch::slots; ++probe) {
      const std::uint32_t old = block.exchange_if(scratch.shape[(s + probe) % List_scratch::slots], no_index, s);
      if(old == no_index || old == s)
        return old == no_index;
    }
    return true;
  }
};

template <class Backend>
void list_shapes(Labeled_cloud<Backend>& points)
{
  points.backend.template for_each_cell<List_scratch>(
    points.number_of_cells(), List_shapes{points.cells.data(), points.label(), points.make_lists()});
}

// Replaces the shapes of a list by their targets; those with a mark leave it. Merged shapes may be listed twice. A list
// that has overflown stays so: it stands for all shapes. `labels`, shared by the lanes, has room for a list.
template <class Block>
CGAL_TANDEM_HD void relabel_list(Block& block, Cell_shapes& list, const std::uint32_t* target, std::uint32_t* labels)
{
  const std::uint32_t size = list.size;
  if(size > Cell_shapes::capacity)
    return;
  block.for_each(size, [&](std::uint32_t i) { labels[i] = target[list.shape[i]]; });
  block.single([&] { list.size = 0; });
  block.for_each(size, [&](std::uint32_t i) {
    if(labels[i] < first_mark)
      list.shape[block.append(list.size)] = labels[i];
  });
}

// For cells without labeled surfels.
struct Clear_lists {
  Cell_shapes* lists;

  CGAL_TANDEM_HD void operator()(std::size_t c) const { lists[c].size = 0; }
};

// The fits of shapes whose points have changed.
struct Changed_shapes {
  Shape* shape;

  CGAL_TANDEM_HD bool has(std::size_t id) const { return shape[id].is_live() && !shape[id].history.is_fitted; }
  CGAL_TANDEM_HD Fitted_moments& operator[](std::size_t id) const { return shape[id]; }
  CGAL_TANDEM_HD void set_made(std::size_t id) const { shape[id].history.is_fitted = true; }
};

template <class Backend>
void fit_shapes(const Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes)
{
  make_fits(points.backend, points.ranks, shapes.size, Changed_shapes{shapes.counted()});
  shapes.set_fitted();
}

// An interior surfel is skipped, since all of its neighbors have had its label. Neighbors may have another one since.
struct Clear_interior {
  std::uint8_t* state;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { state[i] &= std::uint8_t(~interior_bit); }
};

// The states of the surfels, with interior bits of this phase.
template <class Backend>
std::uint8_t* states_of(Labeled_cloud<Backend>& points, Phase phase)
{
  if(points.begin_phase(phase))
    points.backend.for_each(points.cloud.number_of_surfels(), Clear_interior{points.state()});
  return points.state();
}

// What a stage reads, as bits.
namespace tables {
constexpr unsigned lists = 1, fits = 2;
}

// Makes of these what is out of date.
template <class Backend>
void update_tables(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, unsigned needed)
{
  if((needed & tables::fits) && !shapes.has_fits())
    fit_shapes(points, shapes);
  if((needed & tables::lists) && !points.has_lists())
    list_shapes(points);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_TABLES_H
