// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A third back end of the host, added from outside of the package by a tag: it has the bits of the sequential one,
// although all of its loops run backwards. And as it counts these: not more of them than today, and not more passes over
// the points for more points. A change that makes more says why, and raises the bounds; one that makes fewer lowers them.

#include "testing/Reverse_backend.h"
#include "testing/test_support.h"

BOOST_AUTO_TEST_SUITE(test_reverse_backend)

using CGAL::Tandem::Reverse_tag;
using CGAL::Tandem::internal::Reverse_backend;

// Half a pass above the present numbers of items, and 5 % above those of loops. Loops over cells are passes over the
// points that are not among the items.
struct Bounds {
  Given given;
  double items, loops, cell_loops; // the first by point, the others by round
};

// Each point is a surfel, so that each pass is a whole one.
void check_passes(const Bounds& most)
{
  for(const std::size_t points : {30000, 120000}) {
    Reverse_backend::loops = Reverse_backend::items = Reverse_backend::cell_loops = 0;
    const Cloud cloud = to_cloud(scenes::make_scene("indoor", scene_options(points, .001, .1)));
    const Shapes shapes = detect<Reverse_tag>(cloud, points_only(.02, 60), most.given);
    const double rounds = double(shapes.statistics().number_of_rounds), items = double(Reverse_backend::items),
                 n = double(points), loops = double(Reverse_backend::loops) / rounds,
                 cell_loops = double(Reverse_backend::cell_loops) / rounds;
    const std::string found = std::to_string(points) + " points: " + std::to_string(items / n) + " items a point, " +
                              std::to_string(loops) + " loops and " + std::to_string(cell_loops) +
                              " over cells a round of " + std::to_string(rounds);
    std::cout << found << std::endl;
    CHECK_AT(shapes.number_of_shapes() > 10 && items / n <= most.items && loops <= most.loops &&
               cell_loops <= most.cell_loops,
             found);
  }
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  check_passes({Given::normals, 88.3, 177, 14.7});
  check_passes({Given::nothing, 126, 194, 16.3});
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
      shapes += expected.number_of_shapes();
    }
  CHECK_AT(shapes > 30, std::to_string(shapes));
}

BOOST_AUTO_TEST_SUITE_END()
