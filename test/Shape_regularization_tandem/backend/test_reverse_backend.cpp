// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A third back end of the host, added from outside of the package by a tag: it has the bits of the sequential one,
// although all of its loops run backwards.

#include "testing/Reverse_backend.h"
#include "testing/test_support.h"
#include "testing/work.h"

#include <CGAL/Tandem/internal/backend/concepts.h>

BOOST_AUTO_TEST_SUITE(test_reverse_backend)

using CGAL::Tandem::Reverse_tag;

static_assert(CGAL::Tandem::internal::Is_host_backend<CGAL::Tandem::internal::Reverse_backend>::value,
              "the back end is no model of the concept");

BOOST_AUTO_TEST_CASE(all_cases)
{
  std::size_t shapes = 0;
  for(const char* name : {"house", "indoor", "staircase"})
    for(Given given : {Given::normals, Given::nothing}) {
      const Cloud cloud = to_cloud(scenes::make_scene(name, scene_options(8000, .001, .1)));
      Parameters parameters = make_parameters(.02, 50);
      parameters.cell_size = 700;
      const Shapes expected = detect<CGAL::Sequential_tag>(cloud, parameters, given);
      const Shapes reverse = detect<Reverse_tag>(cloud, parameters, given);
      CHECK_AT(reverse.hash() == expected.hash(), name);
      CHECK_AT(reverse.statistics().backend == std::string("reverse"), name);
      check_same_work(reverse.statistics().work, expected.statistics().work, name);
      shapes += expected.number_of_shapes();
    }
  CHECK_AT(shapes > 30, std::to_string(shapes));
}

BOOST_AUTO_TEST_SUITE_END()
