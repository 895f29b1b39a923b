// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lists of the shapes of each cell, against plain loops on several back ends: how they are made, cells in parts that
// have them, and the update of labels, which keeps them.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_cell_lists)

using namespace CGAL::Tandem::internal;

template <class Backend>
class Cell_lists {
public:
  Cell_lists(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    test_lists();
    for(std::uint32_t parts : {1u, 3u, 16u})
      test_parts(parts);
    test_update();
  }

private:
  // Of few shapes a cell, and of more than fit into a list.
  void test_lists()
  {
    std::vector<std::uint32_t> many(f_.label);
    for(std::size_t i = 0; i < many.size(); ++i)
      many[i] = i % 5 == 0 ? free_label : std::uint32_t(i);
    for(const std::vector<std::uint32_t>& label : {f_.label, many}) {
      std::vector<Cell_shapes> list(f_.cells.size());
      backend_.template for_each_cell<List_scratch>(f_.cells.size(),
                                                    List_shapes{f_.cells.data(), label.data(), list.data()});
      for(std::size_t c = 0; c < list.size(); ++c) {
        std::set<std::uint32_t> expected(label.begin() + f_.cells[c].first, label.begin() + f_.cells[c].last);
        expected.erase(expected.lower_bound(first_mark), expected.end());
        const std::size_t size = list[c].size;
        const std::set<std::uint32_t> got(list[c].shape,
                                          list[c].shape + (std::min)(size, std::size_t(Cell_shapes::capacity)));
        const bool is_complete = size == expected.size() && got == expected;
        const bool has_overflown = size > Cell_shapes::capacity && expected.size() > Cell_shapes::capacity;
        CHECK_AT(is_complete || has_overflown, name_ + ": shapes of cell " + std::to_string(c));
      }
    }
  }

  // The parts of a cell are consecutive and about equal, and have the shapes of the cell.
  void test_parts(std::uint32_t parts)
  {
    const std::string where = name_ + ": cells in " + std::to_string(parts) + " parts";
    const Cells_view view = f_.parts_view(parts);
    Serial_block block;
    std::uint32_t next = 0;
    for(std::uint32_t c = 0; c < f_.cells.size(); ++c) {
      const Cell_shapes& list = f_.lists[c];
      for(std::uint32_t p = c * parts; p < (c + 1) * parts; ++p) {
        const std::uint32_t size = f_.cells[c].size();
        CHECK_AT(view[p].first == next && view[p].size() >= size / parts && view[p].size() <= size / parts + 1, where);
        next = view[p].last;
        for(std::uint32_t s : {0u, 3u, 1000000u}) {
          const bool is_listed =
            list.size > Cell_shapes::capacity || std::count(list.shape, list.shape + list.size, s) > 0;
          check_equal(view.may_have(block, p, [&](std::uint32_t shape) { return shape == s; }), is_listed,
                      where + ", their shapes");
        }
      }
      check_equal(next, f_.cells[c].last, where + ": the last one of a cell");
    }
  }

  void test_update()
  {
    const std::vector<Plane> plane = f_.moved_planes();
    std::vector<std::uint32_t> target, label = f_.label, expected = label;
    std::vector<std::uint8_t> is_checked, state = f_.state;
    for(std::uint32_t s = 0; s < plane.size(); ++s) {
      target.push_back(s % 5 == 0 ? free_label : s % 5 == 1 ? 2 : s);
      is_checked.push_back(s % 2);
    }
    std::vector<Shared_moments> loss(plane.size()), expected_loss(plane.size());
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t old = label[i], s = old < first_mark ? target[old] : old;
      expected[i] = s;
      if(s < first_mark && is_checked[old] && !fits(plane[s], f_.point[i], f_.tolerance)) {
        expected[i] = state[i] & detached_bit ? locked_label : free_label;
        add_point(expected_loss[s], f_.point[i], -1);
      }
    }
    std::vector<Cell_shapes> lists = f_.lists;
    lists[0].size = Cell_shapes::capacity + 1; // of all shapes, maybe: stays so
    backend_.template for_each_cell<Update_scratch>(
      f_.cells.size(), Update_points<Backend>{f_.cloud,
                                              f_.cells.data(),
                                              lists.data(),
                                              {label.data(), state.data()},
                                              {target.data(), is_checked.data(), plane.data(), f_.tolerance},
                                              loss.data()});
    check_lists(label, expected, name_ + ": update");
    CHECK_AT(lists[0].size == Cell_shapes::capacity + 1, name_ + ": a list that has overflown");
    for(std::size_t c = 1; c < lists.size(); ++c) {
      std::multiset<std::uint32_t> relabeled;
      for(std::uint32_t i = 0; i < f_.lists[c].size; ++i)
        if(target[f_.lists[c].shape[i]] < first_mark)
          relabeled.insert(target[f_.lists[c].shape[i]]);
      CHECK_AT(f_.lists[c].size <= Cell_shapes::capacity &&
                 relabeled == std::multiset<std::uint32_t>(lists[c].shape, lists[c].shape + lists[c].size),
               name_ + ": list of cell " + std::to_string(c) + " after an update");
    }
    check_moments(loss, expected_loss, name_ + ": update");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

BOOST_AUTO_TEST_CASE(all_cases) { test_on_all_backends<Cell_lists>(); }

BOOST_AUTO_TEST_SUITE_END()
