// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components of equal labels, and the points of small ones, against plain loops on several back ends.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/finish/end_game.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_components)

using namespace CGAL::Tandem::internal;

// By repeated propagation of the smallest position.
std::vector<std::uint32_t> slow_components(const Fixture& f)
{
  const std::uint32_t n = f.cloud.size;
  std::vector<std::uint32_t> expected(n);
  for(std::uint32_t i = 0; i < n; ++i)
    expected[i] = i;
  for(bool is_changed = true; is_changed;) {
    is_changed = false;
    for(std::uint32_t r = 0; r < n; ++r) {
      std::map<std::uint32_t, std::uint32_t> least; // by label, over the point and its neighbors
      auto look = [&](std::uint32_t q) {
        if(f.label[q] < first_mark) {
          std::uint32_t& smallest = least.emplace(f.label[q], expected[q]).first->second;
          smallest = (std::min)(smallest, expected[q]);
        }
      };
      auto take = [&](std::uint32_t q) {
        if(f.label[q] < first_mark && expected[q] != least[f.label[q]]) {
          expected[q] = least[f.label[q]];
          is_changed = true;
        }
      };
      look(r);
      f.for_each_neighbor(r, look);
      take(r);
      f.for_each_neighbor(r, take);
    }
  }
  return expected;
}

// Points of components of less than three points become free; before that, interior bits are cleared, and no others.
BOOST_AUTO_TEST_CASE(components)
{
  for(const Fixture& f : fixtures()) {
    const std::uint32_t n = f.cloud.size;
    const std::vector<std::uint32_t> expected = slow_components(f);
    on_body_backends([&](auto backend, const std::string& of) {
      const std::string name = of + ", " + f.name;
      std::vector<std::uint32_t> component(n);
      Labeled_cloud<decltype(backend)> points(backend);
      const std::size_t cell_size = take_cloud(f, points);
      find_border(points);
      find_components(points, cell_size, f.label.data(), component.data());
      check_lists(component, expected, name + ": components");

      std::vector<std::uint32_t> label = f.label, without_small = f.label;
      std::vector<std::uint8_t> state(n, interior_bit | tried_seed_bit);
      std::map<std::uint32_t, std::uint32_t> size; // by root
      for(std::uint32_t i = 0; i < n; ++i)
        size[component[i]] += f.label[i] < first_mark;
      for(std::uint32_t i = 0; i < n; ++i)
        if(without_small[i] < first_mark && size[component[i]] < 3)
          without_small[i] = free_label;
      Seams<decltype(backend)> seams(backend, points.ranks);
      const auto sizes =
        component_sizes(points, {points.cloud.surfels(), label.data(), nullptr}, component.data(), seams);
      backend.for_each(n, Clear_interior{state.data()});
      backend.for_each(n, Free_small_components{component.data(), sizes.data(), 3, label.data()});
      check_lists(label, without_small, name + ": labels without small components");
      CHECK_AT(label != f.label, name + ": no component is small");
      check_lists(state, std::vector<std::uint8_t>(n, tried_seed_bit), name + ": states without small components");
    });
  }
}

BOOST_AUTO_TEST_SUITE_END()
