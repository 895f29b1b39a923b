// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What follows from labels, against plain loops on several back ends, which pass cells in parts: links and where they
// are, also where the first table of all cells is too small; the lists of the shapes of each cell; and the update of
// labels, which keeps moments, boxes and lists.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_labels)

using namespace CGAL::Tandem::internal;

using Labels = std::vector<std::uint32_t>;

// Half of the points have any shape, the others that of the points around; some are free, and some shapes have none.
Labels make_labels(std::uint32_t size, std::uint32_t shapes)
{
  std::mt19937 random(shapes);
  Labels label(size);
  for(std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t s = i < size / 2 ? std::uint32_t(random() % shapes) : i / 150 % shapes;
    label[i] = i % 13 == 0 || s % 41 == 40 ? free_label : s;
  }
  return label;
}

// By pair.
using Contacts = std::map<std::uint64_t, Contact>;

bool operator==(const Contact& a, const Contact& b)
{
  return a.links == b.links && std::equal(a.position, a.position + 3, b.position);
}

// The links of the points of some shapes, and which of these points have no neighbor of another label.
struct Slow_links {
  Contacts edges;
  std::vector<std::uint8_t> state;

  template <class F>
  Slow_links(const Fixture& f, const Labels& label, F is_selected) : state(label.size(), tried_seed_bit)
  {
    for(std::uint32_t i = 0; i < label.size(); ++i) {
      const std::uint32_t s = label[i];
      if(s >= first_mark || !is_selected(s))
        continue;
      state[i] |= interior_bit;
      f.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = label[q];
        if(t != s)
          state[i] = tried_seed_bit;
        if(t == s || t >= first_mark)
          return;
        edges[std::uint64_t((std::min)(s, t)) << 32 | (std::max)(s, t)].add(1, f.point[i]);
      });
    }
  }
};

void check_links(const std::vector<Link>& links, const Contacts& expected, const std::string& where)
{
  Contacts got;
  for(const Link& link : links)
    if(link.pair != Link::none)
      CHECK_AT(got.emplace(link.pair, link.contact).second, where + ": a pair has two links");
  const auto are_same = [](const auto& a, const auto& b) { return a.first == b.first && a.second == b.second; };
  CHECK_AT(got.size() == expected.size() && std::equal(got.begin(), got.end(), expected.begin(), are_same), where);
}

BOOST_AUTO_TEST_CASE(links_of_clouds)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    for(std::uint32_t number : {3u, 64u, 3000u})
      for(Links which : {Links::all, Links::changed}) {
        const std::string where = name + ": " + std::to_string(number) + " shapes";
        const Labels label = make_labels(f.cloud.size, number);
        std::vector<Shape> shape(number);
        for(std::uint32_t i = 0; i < label.size(); ++i)
          if(label[i] < first_mark)
            shape[label[i]].moments.add(f.point[i], 1);
        for(std::uint32_t s = 0; s < number; ++s)
          shape[s].history.is_linked = s % 3 != 0;
        Slow_links expected(f, label, [&](std::uint32_t s) { return which == Links::all || s % 3 == 0; });
        CHECK_AT(number != 64 || which != Links::all || label.size() <= 3000 || expected.edges.size() > 1024,
                 where + ": the first table is large enough");
        for(auto e = expected.edges.begin(); e != expected.edges.end();)
          e = e->second.links < tuning::moves::minimum_edges ? expected.edges.erase(e) : std::next(e);

        Labeled_cloud<decltype(backend)> points(backend);
        take_cloud(f, points);
        set_labels(points, label, std::vector<std::uint8_t>(label.size(), tried_seed_bit));
        auto shapes = make_table(backend, shape);
        const auto collect = [&] { return to_vector(backend, collect_links(points, shapes, which, Phase::loop)); };
        check_links(collect(), expected.edges, where);
        check_lists(to_vector(backend, points.state(), label.size()), expected.state, where + ", interior points");
        for(std::uint32_t s = 0; s < number; ++s)
          check_equal(shapes.table()[s].history.is_linked != 0, which == Links::changed || s % 3 != 0,
                      where + ", shapes that have changed");
        if(which == Links::changed) // of which there is none any more
          expected.edges.clear();
        check_links(collect(), expected.edges, where + ", without the interior points");
      }
  });
}

// Of few shapes a cell, and of more than fit into one.
BOOST_AUTO_TEST_CASE(lists)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    Labels many(f.label);
    for(std::size_t i = 0; i < many.size(); ++i)
      many[i] = i % 5 == 0 ? free_label : std::uint32_t(i);
    for(const Labels& label : {f.label, many}) {
      Labeled_cloud<decltype(backend)> points(backend);
      take_cloud(f, points);
      set_labels(points, label);
      Shape_table<decltype(backend)> shapes;
      update_tables(points, shapes, tables::lists);
      for(std::size_t c = 0; c < f.cells.size(); ++c) {
        const Cell_shapes& list = points.lists()[c];
        std::set<std::uint32_t> ids(label.begin() + f.cells[c].first, label.begin() + f.cells[c].last);
        ids.erase(ids.lower_bound(first_mark), ids.end());
        CHECK_AT(ids.size() > Cell_shapes::capacity
                   ? list.size > Cell_shapes::capacity
                   : list.size == ids.size() && listed(list) == std::multiset<std::uint32_t>(ids.begin(), ids.end()),
                 name + ": shapes of cell " + std::to_string(c));
      }
    }
  });
}

// Shapes go to others, or dissolve; of some, the points that do not fit the planes leave.
BOOST_AUTO_TEST_CASE(update)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    std::vector<Plane> plane = f.plane;
    Labels target, label = f.label, expected = label;
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
      f.cells.size(), Update_surfels<decltype(backend)>{f.cloud,
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
