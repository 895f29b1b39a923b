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

using archetypes::Backend;
using archetypes::Block;
struct Rank_connection : Ranks<archetypes::Rank_backend> {
  using Ranks<archetypes::Rank_backend>::Ranks;
};

template <class T>
constexpr bool is_model()
{
  if constexpr(std::is_base_of<Block, T>::value)
    return Is_block<T>::value;
  else if constexpr(std::is_base_of<Backend, T>::value)
    return Is_backend<T>::value;
  else
    return Is_ranks<T, archetypes::Rank_backend>::value;
}
static_assert(is_model<Rank_connection>(), "a class that inherits all is a model");

// An operation is hidden by a member of the same name that cannot be called.
struct Nothing_callable {};

#define TANDEM_WITHOUT(model, operation)                                                                               \
  struct model##_without_##operation : model {                                                                         \
    using model::model;                                                                                                \
    Nothing_callable operation;                                                                                        \
  };                                                                                                                   \
  static_assert(!is_model<model##_without_##operation>(), #operation " is not required");
#define TANDEM_WITHOUT_EACH(r, model, operation) TANDEM_WITHOUT(model, operation)

BOOST_PP_SEQ_FOR_EACH(TANDEM_WITHOUT_EACH, Block,
                      BOOST_PP_VARIADIC_TO_SEQ(lookahead, for_each, for_each_neighbor, find_first, find, min, single,
                                               accumulate, load, fetch_min, add, append, exchange_if, count_pair,
                                               add_moments, add_box))
BOOST_PP_SEQ_FOR_EACH(TANDEM_WITHOUT_EACH, Backend,
                      BOOST_PP_VARIADIC_TO_SEQ(name, concurrency, make_buffer, to_host, wait, for_each, for_each_cell,
                                               sort, sort_ranges, compact, collect, sum, run_rounds, for_each_on_host,
                                               atomic_add, atomic_min, atomic_max, atomic_load, atomic_exchange_if))
BOOST_PP_SEQ_FOR_EACH(TANDEM_WITHOUT_EACH, Rank_connection,
                      BOOST_PP_VARIADIC_TO_SEQ(are_many, share, together, total, sum, gather, connect, ghosts, number,
                                               refresh, to_owners))

// Operations and tables of another kind, and operations that return what is on the host.
struct Other_buffer : Backend {
  template <class T>
  using Buffer = Nothing_callable;
};
struct Without_grain : Backend {
  template <class F>
  void for_each(std::size_t, F)
  {}
};
struct Collects_on_host : Backend {
  template <class T, class F>
  Host_buffer<T> collect(std::size_t, F)
  {
    return {};
  }
};
static_assert(!Is_backend<Other_buffer>::value && !Is_backend<Without_grain>::value &&
                !Is_backend<Collects_on_host>::value,
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

// The engine of the archetype can be called, and finds nothing in a cloud without points.
BOOST_AUTO_TEST_CASE(engine_of_the_archetype)
{
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
