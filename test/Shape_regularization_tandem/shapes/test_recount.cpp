// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moments, boxes and lists from the labels, against plain loops on several back ends.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_recount)

using namespace CGAL::Tandem::internal;

template <class Backend>
class Recount {
public:
  Recount(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    for(std::uint32_t parts : {1u, 3u, 16u})
      test_sums(parts);
    test_recount();
  }

private:
  // Cells are in parts.
  void test_sums(std::uint32_t parts)
  {
    std::vector<Shared_moments> sum(f_.plane.size()), expected(f_.plane.size());
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
      if(f_.label[i] < first_mark)
        add_point(expected[f_.label[i]], f_.point[i], 1, f_.level_of(i));
    backend_.template for_each_cell<Moment_table>(
      f_.cells.size() * parts, Sum_moments<Backend>{f_.cloud, f_.parts_view(parts), {f_.label.data()}, sum.data()});
    check_moments(sum, expected, name_ + ": sums");
  }

  // Moments and boxes that were wrong are those of the labels, also of shapes that have no point any more.
  void test_recount()
  {
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, f_.label);
    std::vector<Shape> shape(f_.plane.size() + 3);
    std::vector<Shared_moments> expected(shape.size());
    for(Shape& s : shape) {
      s.moments.add({1 << 28, 5, 6, no_normal}, 1);
      s.box.add(Grid_point{1 << 28, 5, 6, no_normal});
    }
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
      if(f_.label[i] < first_mark)
        add_point(expected[f_.label[i]], f_.point[i], 1, f_.level_of(i));
    Shape_table<Backend> shapes = make_table(backend_, shape);
    shapes.lose_moments();
    require(points, shapes, tables::moments | tables::lists);
    for(std::size_t s = 0; s < shape.size(); ++s)
      if(expected[s].count == 0) // the box of no points does not matter
        expected[s].box = shapes.table()[s].box;
    check_moments(shapes, expected, name_ + ": shapes that are counted again");
    CHECK_AT(!shapes.table()[shape.size() - 1].is_live(), name_ + ": a shape without points");
    const std::uint32_t overflown = Cell_shapes::capacity + 1; // or more
    for(std::size_t c = 0; c < f_.cells.size(); ++c)
      check_equal((std::min)(points.lists()[c].size, overflown), (std::min)(f_.lists[c].size, overflown),
                  name_ + ": lists of cells");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

BOOST_AUTO_TEST_CASE(all_cases) { test_with_levels_on_all_backends<Recount>(); }

BOOST_AUTO_TEST_SUITE_END()
