// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine uses nothing but what the concepts of the back ends list: it compiles with the archetypes, which have only that.

#include "archetypes.h"
#include "testing/checks.h"

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/engine/Engine.h>

#include <string>

// All that the engine calls, in one process and in one of many.
template class CGAL::Tandem::internal::Engine<CGAL::Tandem::internal::archetypes::Backend>;
template class CGAL::Tandem::internal::Engine<CGAL::Tandem::internal::archetypes::Rank_backend>;

BOOST_AUTO_TEST_SUITE(test_concepts)

using namespace CGAL::Tandem::internal;

static_assert(Ranks<archetypes::Rank_backend>::are_many, "the archetype of ranks");

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
