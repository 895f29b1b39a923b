// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Links against plain maps, on several back ends: the table that all cells fill at the same time, also where it is too
// small, and the links of a cloud, for which the first table may be too small.

#include "testing/body_fixture.h"
#include "testing/link_sets.h"

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_links)

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

// The links of the points of some shapes, and which of these points have no neighbor of another label.
struct Slow_links {
  std::map<std::uint64_t, std::uint32_t> edges; // by pair
  std::vector<std::uint8_t> state;

  template <class F>
  Slow_links(const Fixture& f, const Labels& label, std::uint8_t bits, F is_selected) : state(label.size(), bits)
  {
    for(std::uint32_t i = 0; i < label.size(); ++i) {
      const std::uint32_t s = label[i];
      if(s >= first_mark || !is_selected(s))
        continue;
      state[i] |= interior_bit;
      f.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = label[q];
        if(t != s)
          state[i] = bits;
        if(t != s && t < first_mark)
          ++edges[std::uint64_t((std::min)(s, t)) << 32 | (std::max)(s, t)];
      });
    }
  }
};

void check_links(const std::vector<Link>& links, const std::map<std::uint64_t, std::uint32_t>& expected,
                 const std::string& where)
{
  std::map<std::uint64_t, std::uint32_t> got;
  for(const Link& link : links)
    if(link.pair != Link::none)
      CHECK_AT(got.emplace(link.pair, link.count).second, where + ": a pair has two links");
  CHECK_AT(got == expected, where);
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
        Slow_links expected(f, label, tried_seed_bit,
                            [&](std::uint32_t s) { return which == Links::all || s % 3 == 0; });
        CHECK_AT(number != 64 || which != Links::all || label.size() <= 3000 || expected.edges.size() > 1024,
                 where + ": the first table is large enough");
        for(auto e = expected.edges.begin(); e != expected.edges.end();)
          e = e->second < tuning::moves::minimum_edges ? expected.edges.erase(e) : std::next(e);

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

// Of some shapes, in parts of cells, into a table that is large enough.
BOOST_AUTO_TEST_CASE(links_of_parts)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    const Slow_links expected(f, f.label, 0, [](std::uint32_t s) { return s % 4 != 1; });
    std::vector<std::uint8_t> is_selected;
    for(std::size_t s = 0; s < f.plane.size(); ++s)
      is_selected.push_back(s % 4 != 1);
    std::uint32_t size = 1;
    while(size < 2 * f.neighbor.size())
      size *= 2;
    for(std::uint32_t parts : {1u, 3u, 16u}) {
      std::vector<std::uint8_t> state(f.state.size(), 0);
      std::vector<Link> links(size);
      Labels label = f.label;
      std::uint32_t lost = 0;
      backend.template for_each_cell<Link_scratch>(
        f.cells.size() * parts,
        Collect_links<decltype(backend)>{
          f.cloud, f.parts_view(parts), label.data(), state.data(), is_selected.data(), {links.data(), size, &lost}});
      check_equal(lost, 0u, name + ": links that are lost");
      check_links(links, expected.edges, name);
      CHECK(expected.edges.size() > 3);
      check_lists(state, expected.state, name + ": interior points");
    }
  });
}

BOOST_AUTO_TEST_CASE(tables_of_links)
{
  on_body_backends([](auto backend, const std::string& name) {
    for(const std::string& wrong : Link_sets<decltype(backend)>(backend).run())
      fail(name + ": " + wrong);
  });
}

BOOST_AUTO_TEST_SUITE_END()
