// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What follows from labels, against plain loops on several back ends: moments, boxes, the lists of the shapes of each
// cell, cells in parts that have them, and the update of labels, which keeps them.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_recount)

using namespace CGAL::Tandem::internal;

using Ids = std::vector<std::uint32_t>;

std::vector<Shared_moments> sums_of_labels(const Fixture& f, std::size_t n)
{
  std::vector<Shared_moments> sum(n);
  for(std::uint32_t i = 0; i < f.cloud.size; ++i)
    if(f.label[i] < first_mark)
      add_point(sum[f.label[i]], f.point[i], 1, f.level_of(i));
  return sum;
}

BOOST_AUTO_TEST_CASE(sums_of_parts)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    for(std::uint32_t parts : {1u, 3u, 16u}) {
      std::vector<Shared_moments> sum(f.plane.size());
      backend.template for_each_cell<Moment_table>(
        f.cells.size() * parts,
        Sum_moments<decltype(backend)>{f.cloud, f.parts_view(parts), {f.label.data()}, sum.data()});
      check_moments(sum, sums_of_labels(f, sum.size()), name);
    }
  });
}

// Moments and boxes that were wrong are those of the labels, also of shapes that have no point any more.
BOOST_AUTO_TEST_CASE(wrong_sums)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    Labeled_cloud<decltype(backend)> points(backend);
    take_cloud(f, points);
    set_labels(points, f.label);
    std::vector<Shape> shape(f.plane.size() + 3);
    for(Shape& s : shape) {
      s.moments.add({1 << 28, 5, 6, no_normal}, 1);
      s.box.add(Grid_point{1 << 28, 5, 6, no_normal});
    }
    auto shapes = make_table(backend, shape);
    shapes.lose_moments();
    require(points, shapes, tables::moments | tables::lists);
    std::vector<Shared_moments> expected = sums_of_labels(f, shape.size());
    for(std::size_t s = 0; s < shape.size(); ++s)
      if(expected[s].count == 0) // the box of no points does not matter
        expected[s].box = shapes.table()[s].box;
    check_moments(shapes, expected, name);
    CHECK_AT(!shapes.table()[shape.size() - 1].is_live(), name + ": a shape without points");
    const std::uint32_t overflown = Cell_shapes::capacity + 1; // or more
    for(std::size_t c = 0; c < f.cells.size(); ++c)
      check_equal((std::min)(points.lists()[c].size, overflown), (std::min)(f.lists[c].size, overflown),
                  name + ": lists of cells");
  });
}

std::multiset<std::uint32_t> listed(const Cell_shapes& list)
{
  return std::multiset<std::uint32_t>(list.shape, list.shape + (std::min)(list.size, Cell_shapes::capacity));
}

// Of few shapes a cell, and of more than fit into a list.
BOOST_AUTO_TEST_CASE(lists)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    Ids many(f.label);
    for(std::size_t i = 0; i < many.size(); ++i)
      many[i] = i % 5 == 0 ? free_label : std::uint32_t(i);
    for(const Ids& label : {f.label, many}) {
      std::vector<Cell_shapes> list(f.cells.size());
      backend.template for_each_cell<List_scratch>(f.cells.size(),
                                                   List_shapes{f.cells.data(), label.data(), list.data()});
      for(std::size_t c = 0; c < list.size(); ++c) {
        std::set<std::uint32_t> expected(label.begin() + f.cells[c].first, label.begin() + f.cells[c].last);
        expected.erase(expected.lower_bound(first_mark), expected.end());
        const bool is_complete = list[c].size == expected.size() &&
                                 listed(list[c]) == std::multiset<std::uint32_t>(expected.begin(), expected.end());
        const bool has_overflown = list[c].size > Cell_shapes::capacity && expected.size() > Cell_shapes::capacity;
        CHECK_AT(is_complete || has_overflown, name + ": shapes of cell " + std::to_string(c));
      }
    }
  });
}

// The parts of a cell are consecutive and about equal, and have the shapes of the cell.
BOOST_AUTO_TEST_CASE(parts)
{
  for(const Fixture& f : fixtures())
    for(std::uint32_t parts : {1u, 3u, 16u}) {
      const std::string where = f.name + ": cells in " + std::to_string(parts) + " parts";
      const Cells_view view = f.parts_view(parts);
      Serial_block block;
      std::uint32_t next = 0;
      for(std::uint32_t c = 0; c < f.cells.size(); ++c) {
        const Cell_shapes& list = f.lists[c];
        for(std::uint32_t p = c * parts; p < (c + 1) * parts; ++p) {
          const std::uint32_t size = f.cells[c].size();
          CHECK_AT(view[p].first == next && view[p].size() >= size / parts && view[p].size() <= size / parts + 1,
                   where);
          next = view[p].last;
          for(std::uint32_t s : {0u, 3u, 1000000u})
            check_equal(view.may_have(block, p, [&](std::uint32_t shape) { return shape == s; }),
                        list.size > Cell_shapes::capacity || listed(list).count(s) > 0, where + ", their shapes");
        }
        check_equal(next, f.cells[c].last, where + ": the last one of a cell");
      }
    }
}

// Shapes go to others, or dissolve; of some, the points that do not fit the planes leave.
BOOST_AUTO_TEST_CASE(update)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    std::vector<Plane> plane = f.plane;
    Ids target, label = f.label, expected = label;
    std::vector<std::uint8_t> is_checked, state = f.state;
    for(std::uint32_t s = 0; s < plane.size(); ++s) {
      plane[s].d += f.tolerance.distance / 2;
      target.push_back(s % 5 == 0 ? free_label : s % 5 == 1 ? 2 : s);
      is_checked.push_back(s % 2);
    }
    std::vector<Shared_moments> loss(plane.size()), expected_loss(plane.size());
    for(std::uint32_t i = 0; i < f.cloud.size; ++i) {
      const std::uint32_t old = label[i], s = old < first_mark ? target[old] : old;
      expected[i] = s;
      if(s < first_mark && is_checked[old] && !fits(plane[s], f.point[i], f.tolerance_of(i))) {
        expected[i] = state[i] & detached_bit ? locked_label : free_label;
        add_point(expected_loss[s], f.point[i], -1, f.level_of(i));
      }
    }
    std::vector<Cell_shapes> lists = f.lists;
    lists[0].size = Cell_shapes::capacity + 1; // of all shapes, maybe: stays so
    backend.template for_each_cell<Update_scratch>(
      f.cells.size(), Update_points<decltype(backend)>{f.cloud,
                                                       f.cells.data(),
                                                       lists.data(),
                                                       {label.data(), state.data()},
                                                       {target.data(), is_checked.data(), plane.data(), f.tolerance},
                                                       loss.data()});
    check_lists(label, expected, name + ": labels");
    CHECK_AT(lists[0].size == Cell_shapes::capacity + 1, name + ": a list that has overflown");
    for(std::size_t c = 1; c < lists.size(); ++c) {
      std::multiset<std::uint32_t> relabeled;
      for(std::uint32_t s : listed(f.lists[c]))
        if(target[s] < first_mark)
          relabeled.insert(target[s]);
      CHECK_AT(f.lists[c].size <= Cell_shapes::capacity && lists[c].size == relabeled.size() &&
                 relabeled == listed(lists[c]),
               name + ": list of cell " + std::to_string(c));
    }
    check_moments(loss, expected_loss, name + ": loss");
  });
}

BOOST_AUTO_TEST_SUITE_END()
