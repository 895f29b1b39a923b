// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A shape whose points lie on two planes becomes two shapes where that gains: layers that one plane has swallowed,
// surfaces that bend, faces that meet at a small angle. The two planes are found in a sample of the points
// (Split_gain.h), and the links that a split would cut are counted; then each point goes to the nearer one. Changes
// labels, the table of shapes, and what the shapes note of it. See the manual, "Splits".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_SHAPES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_SHAPES_H

#include <CGAL/Tandem/internal/rounds/Shape_samples.h>
#include <CGAL/Tandem/internal/rounds/Split_gain.h>
#include <CGAL/Tandem/internal/rounds/assign.h>
#include <CGAL/Tandem/internal/shapes/Count_scratch.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Shapes that may gain by a split.
struct May_split {
  const Shape* shape;
  Split_gain gain;

  CGAL_TANDEM_HD bool operator()(std::uint32_t id) const { return shape[id].is_live() && gain.may_split(shape[id]); }
};

// The trials of a shape follow each other. A rank makes its share of them. By groups of lanes.
struct Try_splits {
  const Shape* shape;
  const std::uint32_t* id; // of the candidates
  const Sampled_point* point;
  const Range* range; // by shape
  Split_gain gain;
  Own_share own;
  Split* split; // by candidate, then by start

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = id[i / Split_gain::starts];
    const Point_sample sample = {point + range[s].first, range[s].size()};
    const Split result = own.has(i) ? gain.trial(shape[s], sample, int(i % Split_gain::starts)) : Split();
    Lane_group::single([&] { split[i] = result; });
  }
};

struct Numbered_split {
  std::uint64_t number;
  Split split;
};

struct Take_split {
  const Split* split;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return split[i].gain > 0; }
  CGAL_TANDEM_HD Numbered_split take(std::uint32_t i) const { return {i, split[i]}; }
};

struct Put_split {
  const Numbered_split* found;
  Split* split;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { split[found[i].number] = found[i].split; }
};

// The first of the best trials of each candidate goes to its first place.
struct Choose_split {
  Split* split;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    Split* const trial = split + i * Split_gain::starts;
    for(int start = 1; start < Split_gain::starts; ++start)
      if(trial[start].gain > trial[0].gain)
        trial[0] = trial[start];
  }
};

struct Links_run {
  std::uint32_t candidate = no_index;
  std::uint32_t links = 0;
};

// Counts the links between both parts of each candidate.
template <class Backend>
struct Count_cut {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* candidate_of; // by shape
  const Split* split;
  std::uint64_t* cut; // by candidate

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch&, std::uint32_t c) const
  {
    const auto is_split = [&](std::uint32_t s) {
      return candidate_of[s] != no_index && split[candidate_of[s] * Split_gain::starts].gain > 0;
    };
    if(!cells.may_have(block, c, is_split))
      return;
    const Range cell = cells[c];
    const auto add = [&](const Links_run& run) {
      if(run.links > 0)
        Backend::atomic_add(cut[run.candidate], std::uint64_t(run.links));
    };
    block.template accumulate<Links_run>(
      cell.size(),
      [&](std::uint32_t at, Links_run& run) {
        const std::uint32_t i = cell.first + at, s = label[i];
        if(s >= first_mark || !is_split(s))
          return;
        if(candidate_of[s] != run.candidate) {
          add(run);
          run = {candidate_of[s], 0};
        }
        run.links += links(i, split[run.candidate * Split_gain::starts]);
      },
      add);
  }

private:
  // From point i to points of the other part of its shape.
  CGAL_TANDEM_HD std::uint32_t links(std::uint32_t i, const Split& parts) const
  {
    const std::uint32_t* row = cloud.row(i);
    const bool is_second = is_nearer(parts.second, parts.first, cloud.point[i]);
    std::uint32_t result = 0;
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
      result += label[row[j]] == label[i] && is_nearer(parts.second, parts.first, cloud.point[row[j]]) != is_second;
    return result * cloud.surfels.edge_weight(i);
  }
};

struct Is_split {
  const Split* split;
  const std::uint64_t* cut;
  Score score;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const
  {
    const std::int64_t gain = split[i * Split_gain::starts].gain;
    return gain > 0 && gain + score.links(std::int64_t(cut[i])) > 0;
  }
};

// The new shapes are behind the others. They have no points yet.
struct Start_half {
  Shape* shape;
  Plane* plane;
  const std::uint32_t* id;
  const std::uint32_t* accepted; // candidates
  const Split* split;
  std::uint32_t* new_id; // by old id
  std::uint32_t first_new;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t old = id[accepted[i]], half = first_new + std::uint32_t(i);
    shape[half] = Shape();
    plane[old] = split[accepted[i] * Split_gain::starts].first;
    plane[half] = split[accepted[i] * Split_gain::starts].second;
    new_id[old] = half;
  }
};

// A point goes to the nearer plane, of equally near ones to the first.
struct Choose_half {
  const Grid_point* point;
  const std::uint32_t* label;
  const std::uint32_t* new_id; // by shape; no_index if it stays whole
  const Plane* plane;
  std::uint32_t* chosen;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = label[i], half = s < first_mark ? new_id[s] : no_index;
    chosen[i] = half != no_index && is_nearer(plane[half], plane[s], point[i]) ? half : s;
  }
};

// Room for so many shapes in the tables that are read after the loop.
template <class Backend>
void reserve_shapes(Backend& backend, Shape_table<Backend>& shapes, std::size_t size)
{
  if(size <= shapes.table().size())
    return;
  shapes.table() = extended<Shape>(backend, shapes.table(), size + size / 2);
  shapes.plane = extended<Plane>(backend, shapes.plane, size + size / 2);
}

// Splits by the accepted candidates.
template <class Backend>
struct Found_splits {
  typename Backend::template Buffer<std::uint32_t> id, accepted;
  typename Backend::template Buffer<Split> split;
};

template <class Backend>
Found_splits<Backend> find_splits(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  Backend& backend = points.backend;
  const Split_gain gain(options);
  Found_splits<Backend> found;
  found.id = backend.compact(shapes.size, May_split{shapes.fitted(), gain});
  if(found.id.size() == 0)
    return found;
  typename Backend::template Buffer<std::uint32_t>& id = found.id;
  auto bound = filled_buffer(backend, shapes.size, std::uint32_t(0));
  backend.for_each(id.size(), Bound_listed{shapes.fitted(), id.data(), Split_gain::sample_size, bound.data()});
  const Sorted_samples<Backend> sample =
    sorted_samples(backend, shapes.size,
                   collect_of_all<Keyed_point>(backend, points.ranks, points.cloud.number_of_points(),
                                               Take_sampled{points.cloud.view(), points.label(), bound.data()}));
  found.split.reset(id.size() * Split_gain::starts);
  for_each_by_group(backend, found.split.size(),
                    Try_splits{shapes.fitted(), id.data(), sample.point.data(), sample.range.data(), gain,
                               points.ranks.share(), found.split.data()});
  if constexpr(Ranks<Backend>::are_many) {
    const auto all =
      collect_of_all<Numbered_split>(backend, points.ranks, found.split.size(), Take_split{found.split.data()});
    backend.for_each(all.size(), Put_split{all.data(), found.split.data()});
  }
  backend.for_each(id.size(), Choose_split{found.split.data()});
  const auto candidate_of = places_of(backend, shapes.size, id);
  auto cut = filled_buffer(backend, id.size(), std::uint64_t(0));
  backend.template for_each_cell<Count_scratch>(
    points.number_of_parts(), Count_cut<Backend>{points.cloud.view(), points.listed_parts(), points.label(),
                                                 candidate_of.data(), found.split.data(), cut.data()});
  points.ranks.sum(cut.data(), cut.size());
  found.accepted = backend.compact(id.size(), Is_split{found.split.data(), cut.data(), options.score});
  return found;
}

template <class Backend>
void split_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  Backend& backend = points.backend;
  require(points, shapes, tables::fits | tables::lists);
  const Found_splits<Backend> found = find_splits(points, shapes, options);
  const std::size_t number = found.accepted.size(), first_new = shapes.size;
  if(number == 0)
    return;
  reserve_shapes(backend, shapes, first_new + number);
  auto new_id = filled_buffer(backend, first_new, no_index);
  backend.for_each(number,
                   Start_half{shapes.change_moments(), shapes.plane.data(), found.id.data(), found.accepted.data(),
                              found.split.data(), new_id.data(), std::uint32_t(first_new)});
  shapes.size = first_new + number;
  typename Backend::template Buffer<std::uint32_t> chosen(points.cloud.size());
  backend.for_each(chosen.size(), Choose_half{points.cloud.point.data(), points.label(), new_id.data(),
                                              shapes.plane.data(), chosen.data()});
  take_chosen(points, shapes, chosen.data());
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_SHAPES_H
