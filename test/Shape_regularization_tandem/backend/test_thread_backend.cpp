// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole method on a third back end of the host, Thread_backend: it has the bits of the sequential one, for any number
// of threads, although all of its loops run backwards. Under ThreadSanitizer this is the search for data races. And as it
// counts its loops: not more of them than today, and not more passes over the points for more points. A change that makes
// more says why, and raises the bounds; one that makes fewer lowers them.

#include "testing/Thread_backend.h"
#include "testing/test_support.h"

BOOST_AUTO_TEST_SUITE(test_thread_backend)

using CGAL::Tandem::Thread_tag;
using CGAL::Tandem::internal::Thread_backend;

BOOST_AUTO_TEST_CASE(bits)
{
  std::size_t shapes = 0;
  for(const char* name : {"house", "indoor", "staircase"})
    for(Given given : {Given::normals, Given::nothing}) {
      const Cloud cloud = to_cloud(scenes::make_scene(name, scene_options(8000, .001, .1)));
      Parameters parameters = make_parameters(.02, 50);
      parameters.cell_size = 512;
      const Shapes expected = detect(cloud, parameters, given);
      shapes += expected.number_of_shapes();
      for(unsigned threads : {1u, 3u, 8u}) {
        Thread_backend::default_threads = threads;
        const Shapes found = detect<Thread_tag>(cloud, parameters, given);
        const std::string where = name + (", " + std::to_string(threads)) + " threads";
        check_same(found, expected, where);
        CHECK_AT(found.hash() == expected.hash(), where);
        CHECK_AT(found.statistics().backend == std::string("threads"), where);
      }
    }
  CHECK_AT(shapes > 30, std::to_string(shapes));
}

// Half a pass above the present numbers of items, by point, and 5 % above those of loops. Loops over cells are
// passes over the points that are not among the items. Each point is a surfel, so that each pass is a whole one.
BOOST_AUTO_TEST_CASE(passes)
{
  Thread_backend::default_threads = 1;
  struct Bounds {
    Given given;
    double items, loops, cell_loops;
  };
  for(const Bounds& most : {Bounds{Given::normals, 105.5, 809, 80}, Bounds{Given::nothing, 157.9, 1194, 101}})
    for(const std::size_t points : {30000, 120000}) {
      Thread_backend::loops = Thread_backend::items = Thread_backend::cell_loops = 0;
      const Cloud cloud = to_cloud(scenes::make_scene("indoor", scene_options(points, .001, .1)));
      const Shapes shapes = detect<Thread_tag>(cloud, points_only(.02, 60), most.given);
      const double rounds = double(shapes.statistics().number_of_rounds),
                   items = double(Thread_backend::items) / double(points), loops = double(Thread_backend::loops),
                   cell_loops = double(Thread_backend::cell_loops);
      const std::string found = std::to_string(points) + " points: " + std::to_string(items) + " items a point, " +
                                std::to_string(loops) + " loops and " + std::to_string(cell_loops) + " over cells in " +
                                std::to_string(rounds) + " rounds";
      std::cout << found << std::endl;
      CHECK_AT(shapes.number_of_shapes() > 10 && items <= most.items && loops <= most.loops &&
                 cell_loops <= most.cell_loops,
               found);
    }
}

BOOST_AUTO_TEST_SUITE_END()
