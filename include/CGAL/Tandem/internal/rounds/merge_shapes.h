// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Touching shapes become one where that gains: see Union_gain. Without it slanted surfaces are cut into terraces.
// Changes the table of shapes, labels, states and lists of cells, and the links. Also: which shapes become one because
// they have the same plane.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_SHAPES_H

#include <CGAL/Tandem/internal/backend/Union_find.h>
#include <CGAL/Tandem/internal/rounds/Mutual_unions.h>
#include <CGAL/Tandem/internal/rounds/Shape_samples.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/shapes/links.h>
#include <CGAL/Tandem/internal/shapes/update_tables.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

namespace CGAL::Tandem::internal {

// --- Sets of shapes that become one: the largest stays, of equal ones that with the smallest id. Changes nothing.

// What a set of shapes becomes; the order of the members does not matter.
struct Stays {
  std::uint64_t size = ~std::uint64_t(0); // ~ of the points of the largest shape
  std::uint32_t id = no_index;
};

// Three loops over all shapes, since each needs all of the one before.
template <class Backend>
struct Join_member {
  enum Step { largest, smallest_id, join } step;
  const Shape* shape;
  const std::uint32_t* set; // leads to the root of the set
  Stays* stays;             // by root
  std::uint32_t* target;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    Stays& s = stays[root_of(set, std::uint32_t(id))];
    const std::uint64_t size = ~std::uint64_t(shape[id].moments.count);
    if(step == largest)
      Backend::atomic_min(s.size, size);
    else if(step == smallest_id && size == s.size)
      Backend::atomic_min(s.id, std::uint32_t(id));
    else if(step == join)
      target[id] = s.id;
  }
};

// The targets of the members of these sets; a shape that is alone stays.
template <class Backend>
Targets<Backend> join_members(Backend& backend, const Shape_table<Backend>& shapes, const std::uint32_t* set)
{
  using Body = Join_member<Backend>;
  Targets<Backend> target(shapes.size);
  auto stays = filled_buffer(backend, shapes.size, Stays());
  for(const auto step : {Body::largest, Body::smallest_id, Body::join})
    for_each_shape(backend, shapes, Body{step, shapes.counted(), set, stays.data(), target.data()});
  return target;
}

// --- Decides which shapes merge because they touch and have the same plane. Changes nothing: the caller merges shapes
// and points. See the manual, "Unions", last paragraph.

// Unites the shapes of a link that have one plane.
template <class Backend>
struct Unite_coplanar {
  const Shape* shape;
  const Link* link;
  std::uint32_t* set;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t a = link[i].first(), b = link[i].second();
    if(shape[a].plane_number >= 0 && shape[a].plane_number == shape[b].plane_number)
      Union_find<Shared_parents<Backend>>{{set}}.unite(a, b);
  }
};

// The targets of that merge. Planes are compared by their number in the relations, so equal ones are the same bits.
template <class Backend>
Targets<Backend> coplanar_targets(Backend& backend, const Shape_table<Backend>& shapes,
                                  const Buffer_of<Backend, Link>& links)
{
  Targets<Backend> set = identity_targets(backend, shapes.size);
  backend.for_each(links.size(), Unite_coplanar<Backend>{shapes.table().data(), links.data(), set.data()});
  return join_members(backend, shapes, set.data());
}

// --- The unions of touching shapes, by all ranks. Changes nothing but tables of its own, where the functors run.

struct Start_pair {
  const Link* link;
  Union_pair* pair;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    pair[i] = {link[i].first(), link[i].second(), Union_key(), 0, 0, link[i].contact};
  }
};

// The unions that have changed in a round.
template <class Backend>
struct Union_fits {
  Union_rounds<Backend> rounds;
  std::int32_t round;

  CGAL_TANDEM_HD bool has(std::size_t s) const { return rounds.root[s].changed == round; }
  CGAL_TANDEM_HD Fitted_moments& operator[](std::size_t s) const { return rounds.whole[rounds.root[s].place]; }
  CGAL_TANDEM_HD void set_made(std::size_t) const {}
};

// What the tests of a round say. A pair that is not among these has been rejected.
struct Accepted_pair {
  std::uint64_t pair, cost; // wide, so that all bytes are defined
};

template <class Backend>
struct Take_accepted {
  Union_rounds<Backend> rounds;
  std::int32_t round;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const
  {
    const Union_pair& p = rounds.pair[i];
    return p.tested == round && p.is_accepted() && rounds.homes.has_pair(i, p.first, p.second);
  }
  CGAL_TANDEM_HD Accepted_pair take(std::uint32_t i) const { return {i, rounds.pair[i].key.cost}; }
};

struct Put_accepted {
  Union_pair* pair;
  const Accepted_pair* accepted;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { pair[accepted[i].pair].key.cost = accepted[i].cost; }
};

// Marks the shapes of which all ranks need the samples now: that of a union whose parts have different homes, and that
// of the first shape of a pair of different homes, which no rank could test otherwise.
template <class Backend>
struct Mark_moved {
  Union_rounds<Backend> rounds;
  std::uint8_t* is_moved; // by root

  // Of a shape.
  CGAL_TANDEM_HD void operator()(std::size_t t) const
  {
    const std::uint32_t *home = rounds.homes.home, s = rounds.target[t];
    if(home[t] != home[s] && home[t] != Sample_homes::none)
      Backend::atomic_store(is_moved[s], std::uint8_t(1));
  }
};

template <class Backend>
struct Mark_apart {
  Mark_moved<Backend> mark;

  // Of a pair.
  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const Union_rounds<Backend>& rounds = mark.rounds;
    const std::uint32_t a = rounds.target[rounds.pair[i].first], b = rounds.target[rounds.pair[i].second];
    const std::uint32_t of_a = rounds.homes.home[a], of_b = rounds.homes.home[b];
    if(of_a != of_b && of_a != Sample_homes::all_ranks && of_b != Sample_homes::all_ranks)
      Backend::atomic_store(mark.is_moved[a], std::uint8_t(1));
  }
};

struct Sent_sample {
  std::uint32_t shape;
  Shape_sample sample;
};

// Those that this rank has alone, and of what has just joined a shape of all ranks, if it has points of less hash.
template <class Backend>
struct Take_moved {
  Mark_moved<Backend> mark;

  CGAL_TANDEM_HD bool has(std::uint32_t t) const
  {
    const Union_rounds<Backend>& rounds = mark.rounds;
    const Sample_homes& homes = rounds.homes;
    const std::uint32_t s = rounds.target[t];
    return homes.home[t] == homes.own.rank && mark.is_moved[s] &&
           (homes.home[s] != Sample_homes::all_ranks || has_least(rounds.sample[s], rounds.sample[t]));
  }
  CGAL_TANDEM_HD Sent_sample take(std::uint32_t t) const
  {
    Sent_sample sent = {t, Shape_sample()}; // what is behind the items is not defined in the table
    const Shape_sample& sample = mark.rounds.sample[t];
    sent.sample.size = sample.size;
    for(std::uint32_t i = 0; i < sample.size; ++i)
      sent.sample.item[i] = sample.item[i];
    return sent;
  }
};

struct Put_sample {
  const Sent_sample* sent;
  Shape_sample* sample; // by shape

  CGAL_TANDEM_HD void operator()(std::size_t i) const { sample[sent[i].shape] = sent[i].sample; }
};

template <class Backend>
struct Move_home {
  Mark_moved<Backend> mark;

  CGAL_TANDEM_HD void operator()(std::size_t t) const
  {
    std::uint32_t& home = mark.rounds.homes.home[t];
    if(mark.rounds.target[t] != t)
      home = Sample_homes::none;
    else if(mark.is_moved[t])
      home = Sample_homes::all_ranks;
  }
};

// After shapes have joined, before their samples are merged.
template <class Backend>
void share_samples(Backend& backend, const Ranks<Backend>& ranks, const Union_rounds<Backend>& rounds)
{
  auto is_moved = filled_buffer(backend, rounds.shapes, std::uint8_t(0));
  const Mark_moved<Backend> mark = {rounds, is_moved.data()};
  backend.for_each(rounds.shapes, mark);
  backend.for_each(rounds.pairs, Mark_apart<Backend>{mark});
  const auto sent = collect_of_all<Sent_sample>(backend, ranks, rounds.shapes, Take_moved<Backend>{mark});
  backend.for_each(sent.size(), Put_sample{sent.data(), rounds.sample});
  backend.for_each(rounds.shapes, Move_home<Backend>{mark});
}

template <class Backend>
void run_unions(Backend& backend, const Ranks<Backend>& ranks, std::size_t n, const Union_rounds<Backend>& rounds)
{
  if constexpr(!Ranks<Backend>::are_many)
    return backend.run_rounds(rounds.shapes, n, rounds);
  else {
    share_samples(backend, ranks, rounds);
    run_joint_rounds(backend, rounds.shapes, n, rounds, [&](int step, std::size_t round) {
      const std::int32_t mark = std::int32_t(round + 1);
      if(step == Union_rounds<Backend>::test) {
        const auto all =
          collect_of_all<Accepted_pair>(backend, ranks, rounds.pairs, Take_accepted<Backend>{rounds, mark});
        backend.for_each(all.size(), Put_accepted{rounds.pair, all.data()});
      } else if(step == Union_rounds<Backend>::fit)
        spread_fits(backend, ranks, rounds.shapes, Union_fits<Backend>{rounds, mark});
      else if(step == Union_rounds<Backend>::join) {
        if(to_vector(backend, rounds.joins + round % 2, 1).front() == 0)
          return true;
        share_samples(backend, ranks, rounds);
      }
      return false;
    });
  }
}

// The unions along the links. By id: what a shape has joined, in one or more steps up to the root of its union, and the
// root, with the place of the union in `whole`. `total`: the number of rounds, and that of the places.
template <class Backend>
struct Shape_unions {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<std::uint32_t> target;
  Buffer<Union_root> root;
  Buffer<Fitted_moments> whole;
  Buffer<std::uint32_t> total;
};

// samples: of the shapes with links; those of unions change. All live shapes have to be fitted. A pair may have several
// links. The sums of the shapes are zero before and afterwards.
template <class Backend>
Shape_unions<Backend> unite_shapes(const Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                                   const Union_gain& gain, Shape_samples<Backend>& samples,
                                   const Buffer_of<Backend, Link>& links)
{
  Backend& backend = points.backend;
  const std::size_t n = shapes.size;
  Shape_unions<Backend> unions;
  unions.target = identity_targets(backend, n);
  unions.root = filled_buffer(backend, n, Union_root());
  unions.whole.reset((std::min)(n, links.size())); // a union needs a link of its own
  Buffer_of<Backend, Union_pair> pair(links.size());
  auto joins = filled_buffer(backend, 2, std::uint32_t(0));
  unions.total = filled_buffer(backend, 2, std::uint32_t(0));
  backend.for_each(links.size(), Start_pair{links.data(), pair.data()});
  const Sample_homes homes = {points.ranks.own_items(), samples.home.data()};
  run_unions(backend, points.ranks, (std::max)(n, links.size()),
             Union_rounds<Backend>{gain, pair.data(), links.size(), n, shapes.fitted(), samples.sample.data(),
                                   unions.root.data(), unions.target.data(), start_deltas(backend, shapes, n),
                                   unions.whole.data(), joins.data(), unions.total.data(), homes});
  return unions;
}

struct Relabel_link {
  const std::uint32_t* target;
  Link* link;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    link[i].pair = unordered_pair(target[link[i].first()], target[link[i].second()]);
  }
};

template <class Backend>
struct Mark_linked {
  const Link* link;
  std::uint8_t* is_linked; // by shape

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    Backend::atomic_store(is_linked[link[i].first()], std::uint8_t(1));
    Backend::atomic_store(is_linked[link[i].second()], std::uint8_t(1));
  }
};

// Of a union, the largest shape stays, of equal ones that with the smallest id. The links then have the new ids. A pair
// may have several links, or become a pair of one shape with itself. Returns Shape_unions::total, empty without links: see are_any().
template <class Backend>
Buffer_of<Backend, std::uint32_t> merge_by_gain(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                                                const Stage_parameters& options, Buffer_of<Backend, Link>& links)
{
  if(links.size() == 0)
    return {};
  Backend& backend = points.backend;
  update_tables(points, shapes, tables::fits);
  auto is_linked = filled_buffer(backend, shapes.size, std::uint8_t(0));
  backend.for_each(links.size(), Mark_linked<Backend>{links.data(), is_linked.data()});
  auto samples = sample_shapes(points, shapes, Is_marked{is_linked.data()});
  auto unions = unite_shapes(points, shapes, Union_gain(options), samples, links);
  const Targets<Backend> target = join_members(backend, shapes, unions.target.data());
  merge_surfels(points, shapes, target);
  backend.for_each(links.size(), Relabel_link{target.data(), links.data()});
  return std::move(unions.total);
}

// Waits for the unions of merge_by_gain().
template <class Backend, class Total>
bool are_any(Backend& backend, const Total& unions)
{
  return unions.size() > 0 && to_vector(backend, unions).back() > 0;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_SHAPES_H
