// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A shape whose points lie on two planes becomes two shapes where that gains: layers that one plane has swallowed,
// surfaces that bend, faces that meet at a small angle. Pairs of planes are found in a sample of the points
// (Split_trials); those that gain by it are judged by all points and the links that they would cut. Then each surfel
// goes to the nearer one.
// Changes labels, the table of shapes, and what the shapes note of it. See the manual, "Splits".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_SHAPES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_SHAPES_H

#include <CGAL/Tandem/internal/rounds/Split_trials.h>
#include <CGAL/Tandem/internal/rounds/assign.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

namespace CGAL::Tandem::internal {

// Shapes that may gain by a split.
struct May_split {
  const Shape* shape;
  Split_trials trials;

  CGAL_TANDEM_HD bool operator()(std::uint32_t id) const { return shape[id].is_live() && trials.may_split(shape[id]); }
};

// The trials of a shape follow each other. A rank makes its own items; the others are null, so that the sums of all
// ranks are the trials of all. By groups of lanes.
struct Try_splits {
  const Shape* shape;
  const std::uint32_t* id; // of the candidates
  const Sampled_point* point;
  const Range* range; // by shape
  Split_trials trials;
  Sample_homes homes;
  Split* split; // by trial

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    Split result = {};
    const std::uint32_t s = id[i / Split_trials::starts];
    if(homes.has_item(i, s)) {
      const Point_sample sample = {point + range[s].first, range[s].size()};
      result = trials(shape[s], sample, int(i % Split_trials::starts));
    }
    Lane_group::single([&] { split[i] = result; });
  }
};

// Surfels of one candidate after each other, and what they add.
template <class Sum>
struct Trials_run {
  std::uint32_t candidate = no_index;
  Sum sum[Split_trials::starts] = {};
};

// The candidates of the surfels of a cell.
struct Candidates_view {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* candidate_of; // by shape; no_index if it is none
  const Split* split;                // by trial
  const std::uint8_t* left;          // by candidate, a bit for each trial
  const Plane* plane;                // by shape
  Tolerance tolerance;

  CGAL_TANDEM_HD bool is_left(std::uint32_t candidate, std::uint32_t t) const
  {
    return (left[candidate] >> t & 1u) != 0;
  }

  CGAL_TANDEM_HD std::uint32_t candidate(std::uint32_t i) const
  {
    return label[i] < first_mark ? candidate_of[label[i]] : no_index;
  }

  // f(i, run) for the surfels of candidates, and add(run) at the end of a run.
  template <class Sum, class Block, class F, class Add>
  CGAL_TANDEM_HD void accumulate(Block& block, std::uint32_t c, F f, Add add) const
  {
    using Run = Trials_run<Sum>;
    if(!cells.may_have(block, c, [&](std::uint32_t s) { return candidate_of[s] != no_index; }))
      return;
    const Range cell = cells[c];
    const auto end_run = [&](const Run& run) {
      for(std::uint32_t t = 0; run.candidate != no_index && t < Split_trials::starts; ++t)
        if(is_left(run.candidate, t))
          add(run.candidate * Split_trials::starts + t, run.sum[t]);
    };
    block.template accumulate<Run>(
      cell.size(),
      [&](std::uint32_t at, Run& run) {
        const std::uint32_t i = cell.first + at, own = candidate(i);
        if(own == no_index)
          return;
        if(own != run.candidate) {
          end_run(run);
          run = Run();
          run.candidate = own;
        }
        f(i, run);
      },
      end_run);
  }

  CGAL_TANDEM_HD std::int64_t weight(const Plane& p, std::uint32_t i) const
  {
    const Tolerance own = cloud.tolerance_of(i, tolerance);
    return fits(p, cloud.point[i], own) ? Score::weight(own, signed_distance(p, cloud.point[i])) : 0;
  }
};

// Trials are left that may gain by what is known of them, and candidates with such trials.
struct Leave_trials {
  std::int64_t price;       // of a shape
  const std::uint32_t* id;  // of the candidates
  const Split* split;       // these two by trial
  const std::int64_t* most; // bounds of the fit; null: not known
  std::uint8_t* left;       // by candidate, a bit for each trial
  std::uint32_t* candidate_of;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    unsigned result = 0;
    for(std::uint32_t t = 0; t < Split_trials::starts; ++t) {
      const std::size_t trial = i * Split_trials::starts + t;
      const bool is_left = most == nullptr ? split[trial].is_any() : most[trial] > price;
      result |= unsigned(is_left) << t;
    }
    left[i] = std::uint8_t(result);
    if(result == 0)
      candidate_of[id[i]] = no_index;
  }
};

// In which parts of its shape a surfel is: a bit for each trial that is left. Bounds the fit that a trial may gain: no
// surfel is worth more than on the nearer plane.
template <class Backend>
struct Choose_parts {
  Candidates_view view;
  std::uint8_t* parts;
  std::int64_t* most; // by trial

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, No_scratch&, std::uint32_t c) const
  {
    view.template accumulate<std::int64_t>(
      block, c, [&](std::uint32_t i, Trials_run<std::int64_t>& run) { choose(i, run); },
      [&](std::uint32_t t, std::int64_t sum) { Backend::atomic_add(most[t], sum); });
  }

private:
  CGAL_TANDEM_HD void choose(std::uint32_t i, Trials_run<std::int64_t>& run) const
  {
    const std::int64_t tolerance = view.cloud.tolerance_of(i, view.tolerance).distance;
    const std::int64_t points = view.cloud.surfels.points(i).size();
    const std::int64_t before = view.weight(view.plane[view.label[i]], i);
    unsigned result = 0;
    for(unsigned t = 0; t < Split_trials::starts; ++t)
      if(view.is_left(run.candidate, t)) {
        const Nearer_plane nearer(view.split[run.candidate * Split_trials::starts + t], view.cloud.point[i]);
        result |= unsigned(nearer.is_second) << t;
        run.sum[t] += points * (nearer.most(tolerance) - before);
      }
    parts[i] = std::uint8_t(result);
  }
};

// A byte for each bit, 0 or 1, to count the bits of up to 255 sets at once.
CGAL_TANDEM_HD inline std::uint64_t bytes_of_bits(std::uint8_t bits)
{
  constexpr std::uint64_t ones = 0x0101010101010101;
  return (((bits * ones) & 0x8040201008040201) + 0x7f * ones) >> 7 & ones;
}

// A surfel goes to the part where most of its neighbors of the same shape are; of equally many, it stays. Otherwise the
// noise of points between two layers would cut links everywhere.
struct Smooth_parts {
  Candidates_view view;
  const std::uint8_t* parts;
  std::uint8_t* smooth;

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint32_t i = std::uint32_t(at);
    unsigned result = parts[i];
    if(view.candidate(i) != no_index) {
      std::uint64_t second = 0; // neighbors in the second part, by bytes
      unsigned all = 0;
      const std::uint32_t* row = view.cloud.row(i);
      for(int j = 0; j < view.cloud.k && row[j] != no_index; ++j)
        if(view.label[row[j]] == view.label[i]) {
          second += bytes_of_bits(parts[row[j]]);
          ++all;
        }
      for(unsigned t = 0; t < Split_trials::starts; ++t) {
        const unsigned of_second = unsigned(second >> 8 * t & 255u);
        if(2 * of_second != all)
          result = (result & ~(1u << t)) | unsigned(2 * of_second > all) << t;
      }
    }
    smooth[i] = std::uint8_t(result);
  }
};

// Sums the accounts of the trials that are left, cell by cell.
template <class Backend>
struct Sum_accounts {
  Candidates_view view;
  const std::uint8_t* parts;
  Split_account* sum; // by trial

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, No_scratch&, std::uint32_t c) const
  {
    view.template accumulate<Split_account>(
      block, c, [&](std::uint32_t i, Trials_run<Split_account>& run) { account(i, run); },
      [&](std::uint32_t t, const Split_account& a) {
        Backend::atomic_add(sum[t].fit, a.fit);
        Backend::atomic_add(sum[t].second, a.second);
        Backend::atomic_add(sum[t].links, a.links);
      });
  }

private:
  CGAL_TANDEM_HD void account(std::uint32_t i, Trials_run<Split_account>& run) const
  {
    const Cloud_view& cloud = view.cloud;
    const std::int64_t points = cloud.surfels.points(i).size(), before = view.weight(view.plane[view.label[i]], i);
    std::uint64_t cut = 0; // links, by bytes
    const std::uint32_t* row = cloud.row(i);
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
      if(view.label[row[j]] == view.label[i])
        cut += bytes_of_bits(std::uint8_t(parts[i] ^ parts[row[j]]));
    for(std::uint32_t t = 0; t < Split_trials::starts; ++t) {
      if(!view.is_left(run.candidate, t))
        continue;
      const Split& split = view.split[run.candidate * Split_trials::starts + t];
      const bool is_second = (parts[i] >> t & 1u) != 0;
      Split_account& sum = run.sum[t];
      sum.fit += points * (view.weight(is_second ? split.second : split.first, i) - before);
      sum.second += is_second ? points : 0;
      sum.links += std::int64_t(cut >> 8 * t & 255u) * cloud.surfels.edge_weight(i);
    }
  }
};

// The first of the best trials of each candidate, with the plane of the larger part first, and what it gains.
struct Choose_split {
  Split_trials trials;
  const Shape* shape;
  const std::uint32_t* id; // of the candidates
  const Split* trial;      // these two by trial
  const Split_account* account;
  Split* split;       // by candidate
  std::int64_t* gain; // by candidate

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    std::size_t best = 0;
    for(std::size_t t = i * Split_trials::starts; t < (i + 1) * Split_trials::starts; ++t) {
      const std::int64_t g = trials.gain(account[t]);
      if(t % Split_trials::starts == 0 || g > gain[i]) {
        best = t;
        gain[i] = g;
      }
    }
    split[i] = trial[best];
    if(2 * account[best].second > shape[id[i]].moments.count)
      split[i] = {trial[best].second, trial[best].first};
  }
};

struct Accepted_split {
  std::uint32_t id;
  Split split;
};

// The candidates that gain.
struct Take_accepted_split {
  const std::uint32_t* id; // these by candidate
  const Split* split;
  const std::int64_t* gain;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return gain[i] > 0; }
  CGAL_TANDEM_HD Accepted_split take(std::uint32_t i) const { return {id[i], split[i]}; }
};

// The new shapes are behind the others.
struct Start_half {
  Plane* plane;
  const Accepted_split* accepted;
  std::uint32_t* new_id; // by old id
  std::uint32_t first_new;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t old = accepted[i].id, half = first_new + std::uint32_t(i);
    plane[old] = accepted[i].split.first;
    plane[half] = accepted[i].split.second;
    new_id[old] = half;
  }
};

// A surfel goes to the nearer plane, of equally near ones to the first.
struct Choose_half {
  const Grid_point* point;
  const std::uint32_t* label;
  const std::uint32_t* new_id; // by shape; no_index if it stays whole
  const Plane* plane;
  std::uint32_t* chosen;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = label[i], half = s < first_mark ? new_id[s] : no_index;
    chosen[i] = half != no_index && Nearer_plane({plane[s], plane[half]}, point[i]).is_second ? half : s;
  }
};

template <class Backend>
Buffer_of<Backend, Accepted_split> find_splits(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                                               const Stage_parameters& options)
{
  Backend& backend = points.backend;
  const Split_trials trials(options);
  const May_split may_split = {shapes.fitted(), trials};
  const auto id = backend.compact(shapes.size, may_split);
  if(id.size() == 0)
    return {};
  Sorted_samples<Backend> sample = sorted_samples(points, shapes, may_split, Split_trials::sample_size);
  Buffer_of<Backend, Split> trial(id.size() * Split_trials::starts);
  for_each_by_group(backend, trial.size(),
                    Try_splits{shapes.fitted(),
                               id.data(),
                               sample.point.data(),
                               sample.range.data(),
                               trials,
                               {points.ranks.own_items(), sample.home.data()},
                               trial.data()});
  points.ranks.sum(reinterpret_cast<std::uint64_t*>(trial.data()), trial.size() * sizeof(Split) / 8);
  auto candidate_of = places_of(backend, shapes.size, id);
  Buffer_of<Backend, std::uint8_t> left(id.size());
  const Candidates_view view = {
    points.cloud.view(), points.listed_parts(), points.label(),      candidate_of.data(),
    trial.data(),        left.data(),           shapes.plane.data(), options.growth.tolerance};
  const std::size_t n = points.cloud.number_of_surfels();
  auto parts = filled_buffer(backend, points.cloud.size_with_ghosts(), std::uint8_t(0));
  auto most = filled_buffer(backend, trial.size(), std::int64_t(0));
  auto account = filled_buffer(backend, trial.size(), Split_account());
  Buffer_of<Backend, std::uint8_t> smooth(parts.size());
  Leave_trials leave = {-options.score.price(), id.data(), trial.data(), nullptr, left.data(), candidate_of.data()};
  backend.for_each(id.size(), leave);
  leave.most = most.data();
  backend.template for_each_cell<No_scratch>(points.number_of_parts(),
                                             Choose_parts<Backend>{view, parts.data(), most.data()});
  points.ranks.sum(most.data(), most.size());
  points.ranks.refresh(parts.data(), Rings::inner);
  backend.for_each(id.size(), leave);
  backend.for_each(n, Smooth_parts{view, parts.data(), smooth.data()});
  points.ranks.refresh(smooth.data(), Rings::inner);
  backend.template for_each_cell<No_scratch>(points.number_of_parts(),
                                             Sum_accounts<Backend>{view, smooth.data(), account.data()});
  points.ranks.sum(reinterpret_cast<std::uint64_t*>(account.data()), account.size() * sizeof(Split_account) / 8);
  Buffer_of<Backend, Split> split(id.size());
  Buffer_of<Backend, std::int64_t> gain(id.size());
  backend.for_each(id.size(), Choose_split{trials, shapes.fitted(), id.data(), trial.data(), account.data(),
                                           split.data(), gain.data()});
  return backend.template collect<Accepted_split>(id.size(), Take_accepted_split{id.data(), split.data(), gain.data()});
}

template <class Backend>
void split_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options)
{
  Backend& backend = points.backend;
  update_tables(points, shapes, tables::fits | tables::lists);
  const auto accepted = find_splits(points, shapes, options);
  const std::size_t number = accepted.size();
  if(number == 0)
    return;
  const std::size_t first_new = add_shapes(backend, shapes, number);
  auto new_id = filled_buffer(backend, first_new, no_index);
  backend.for_each(number, Start_half{shapes.plane.data(), accepted.data(), new_id.data(), std::uint32_t(first_new)});
  Buffer_of<Backend, std::uint32_t> chosen(points.cloud.number_of_surfels());
  backend.for_each(chosen.size(), Choose_half{points.cloud.point.data(), points.label(), new_id.data(),
                                              shapes.plane.data(), chosen.data()});
  take_chosen(points, shapes, chosen.data());
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_SHAPES_H
