// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concepts of the back ends are complete and strict: the engine compiles with the archetypes, which have nothing
// but what concepts.h lists, the back ends of the host are models, and what lacks one operation is none.

#include "testing/checks.h"

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/backend/Serial_block.h>
#include <CGAL/Tandem/internal/backend/archetypes.h>
#include <CGAL/Tandem/internal/engine/Engine.h>
#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#endif

#include <cstdio>
#include <string>

// All that the engine calls, in one process and in one of many.
template class CGAL::Tandem::internal::Engine<CGAL::Tandem::internal::archetypes::Backend>;
template class CGAL::Tandem::internal::Engine<CGAL::Tandem::internal::archetypes::Rank_backend>;

BOOST_AUTO_TEST_SUITE(test_concepts)

using namespace CGAL::Tandem::internal;

static_assert(Is_block<archetypes::Block>::value && Is_block<Serial_block>::value, "models of Block");
static_assert(Is_backend<archetypes::Backend>::value && !Is_host_backend<archetypes::Backend>::value, "the archetype");
static_assert(Is_host_backend<Sequential_backend>::value, "the sequential back end");
static_assert(Is_ranks<Ranks<Sequential_backend>, Sequential_backend>::value, "one process");
static_assert(Ranks<archetypes::Rank_backend>::are_many, "the archetype of ranks");
#ifdef CGAL_LINKED_WITH_TBB
static_assert(Is_host_backend<Tbb_backend>::value, "the parallel back end");
#endif

// An operation is hidden by a member of the same name that cannot be called.
struct Nothing_callable {};

#define TANDEM_WITHOUT(concept, model, operation)                                                                      \
  struct model##_without_##operation : archetypes::model {                                                             \
    Nothing_callable operation;                                                                                        \
  };                                                                                                                   \
  static_assert(!concept<model##_without_##operation>::value, #operation " is not required")

TANDEM_WITHOUT(Is_block, Block, lookahead);
TANDEM_WITHOUT(Is_block, Block, for_each);
TANDEM_WITHOUT(Is_block, Block, for_each_neighbor);
TANDEM_WITHOUT(Is_block, Block, find_first);
TANDEM_WITHOUT(Is_block, Block, find);
TANDEM_WITHOUT(Is_block, Block, min);
TANDEM_WITHOUT(Is_block, Block, single);
TANDEM_WITHOUT(Is_block, Block, accumulate);
TANDEM_WITHOUT(Is_block, Block, load);
TANDEM_WITHOUT(Is_block, Block, fetch_min);
TANDEM_WITHOUT(Is_block, Block, add);
TANDEM_WITHOUT(Is_block, Block, append);
TANDEM_WITHOUT(Is_block, Block, exchange_if);
TANDEM_WITHOUT(Is_block, Block, count_pair);
TANDEM_WITHOUT(Is_block, Block, add_moments);
TANDEM_WITHOUT(Is_block, Block, add_box);
TANDEM_WITHOUT(Is_backend, Backend, name);
TANDEM_WITHOUT(Is_backend, Backend, concurrency);
TANDEM_WITHOUT(Is_backend, Backend, make_buffer);
TANDEM_WITHOUT(Is_backend, Backend, to_host);
TANDEM_WITHOUT(Is_backend, Backend, wait);
TANDEM_WITHOUT(Is_backend, Backend, for_each);
TANDEM_WITHOUT(Is_backend, Backend, for_each_cell);
TANDEM_WITHOUT(Is_backend, Backend, sort);
TANDEM_WITHOUT(Is_backend, Backend, sort_ranges);
TANDEM_WITHOUT(Is_backend, Backend, compact);
TANDEM_WITHOUT(Is_backend, Backend, collect);
TANDEM_WITHOUT(Is_backend, Backend, sum);
TANDEM_WITHOUT(Is_backend, Backend, run_rounds);
TANDEM_WITHOUT(Is_backend, Backend, for_each_on_host);
TANDEM_WITHOUT(Is_backend, Backend, atomic_add);
TANDEM_WITHOUT(Is_backend, Backend, atomic_min);
TANDEM_WITHOUT(Is_backend, Backend, atomic_max);
TANDEM_WITHOUT(Is_backend, Backend, atomic_load);
TANDEM_WITHOUT(Is_backend, Backend, atomic_exchange_if);

#define TANDEM_RANKS_WITHOUT(operation)                                                                                \
  struct Ranks_without_##operation : Ranks<archetypes::Rank_backend> {                                                 \
    using Ranks<archetypes::Rank_backend>::Ranks;                                                                      \
    Nothing_callable operation;                                                                                        \
  };                                                                                                                   \
  static_assert(!Is_ranks<Ranks_without_##operation, archetypes::Rank_backend>::value, #operation " is not required")

struct All_of_ranks : Ranks<archetypes::Rank_backend> {
  using Ranks<archetypes::Rank_backend>::Ranks;
};
static_assert(Is_ranks<All_of_ranks, archetypes::Rank_backend>::value, "a class that inherits all is a model");
TANDEM_RANKS_WITHOUT(are_many);
TANDEM_RANKS_WITHOUT(share);
TANDEM_RANKS_WITHOUT(together);
TANDEM_RANKS_WITHOUT(total);
TANDEM_RANKS_WITHOUT(sum);
TANDEM_RANKS_WITHOUT(gather);
TANDEM_RANKS_WITHOUT(connect);
TANDEM_RANKS_WITHOUT(ghosts);
TANDEM_RANKS_WITHOUT(number);
TANDEM_RANKS_WITHOUT(refresh);
TANDEM_RANKS_WITHOUT(to_owners);

struct Other_buffer : archetypes::Backend {
  template <class T>
  using Buffer = Nothing_callable;
};
struct Other_sort_table : archetypes::Backend {
  using Sort_table = Nothing_callable;
};
static_assert(!Is_backend<Other_buffer>::value && !Is_backend<Other_sort_table>::value, "tables");

// Operations that lack an argument, or return what is on the host.
struct Without_grain : archetypes::Backend {
  template <class F>
  void for_each(std::size_t, F)
  {}
};
struct Collects_on_host : archetypes::Backend {
  template <class T, class F>
  Host_buffer<T> collect(std::size_t, F)
  {
    return {};
  }
};
struct Sums_to_buffer : archetypes::Backend {
  template <int N, class F>
  archetypes::Buffer<std::int64_t> sum(std::size_t, F)
  {
    return {};
  }
};
struct Without_large_exchange : archetypes::Backend {
  static std::uint32_t atomic_exchange_if(std::uint32_t& target, std::uint32_t, std::uint32_t) { return target; }
};
static_assert(!Is_backend<Without_grain>::value && !Is_backend<Collects_on_host>::value &&
                !Is_backend<Sums_to_buffer>::value && !Is_backend<Without_large_exchange>::value,
              "operations");

struct Without_pieces : Sequential_backend {
  Nothing_callable for_each_piece;
};
static_assert(Is_backend<Without_pieces>::value && !Is_host_backend<Without_pieces>::value, "for_each_piece");

// The archetype replaces the stages that need memory of the host; who replaces nothing has no flag set.
static_assert(Stage_overrides<archetypes::Backend>::groups_points &&
                !Stage_overrides<archetypes::Backend>::expects_cells,
              "overrides of the archetype");
static_assert(!Stage_overrides<Sequential_backend>::finds_neighbors &&
                !Stage_overrides<Sequential_backend>::groups_points,
              "the sequential back end replaces no stage");

BOOST_AUTO_TEST_CASE(all_cases)
{
  // The engine of the archetype can be called, and finds nothing in a cloud without points.
  archetypes::Backend backend;
  Import in;
  CGAL::Tandem::Parameters parameters;
  parameters.maximum_distance = 1;
  parameters.minimum_region_size = 3;
  Progress progress;
  Engine<archetypes::Backend> engine(backend, in, parameters, progress);
  BOOST_TEST(!engine.iterate());
  BOOST_TEST(engine.name() == std::string("archetype"));
}

BOOST_AUTO_TEST_SUITE_END()
