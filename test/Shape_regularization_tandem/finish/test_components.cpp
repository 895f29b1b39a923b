// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components of equal labels, and the points of small ones, against plain loops on several back ends.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/finish/end_game.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_components)

using namespace CGAL::Tandem::internal;

// By repeated propagation of the smallest position among the equal labels of a point and its neighbors.
std::vector<std::uint32_t> slow_components(const Fixture& f)
{
  std::vector<std::uint32_t> smallest(f.cloud.size);
  std::iota(smallest.begin(), smallest.end(), 0u);
  for(bool is_changed = true; is_changed;) {
    is_changed = false;
    for(std::uint32_t i = 0; i < f.cloud.size; ++i) {
      std::map<std::uint32_t, std::vector<std::uint32_t>> members = {{f.label[i], {i}}}; // by label
      f.for_each_neighbor(i, [&](std::uint32_t q) { members[f.label[q]].push_back(q); });
      for(const auto& m : members) {
        std::uint32_t least = no_index;
        for(std::uint32_t q : m.second)
          least = (std::min)(least, smallest[q]);
        for(std::uint32_t q : m.second)
          if(m.first < first_mark && smallest[q] != least) {
            smallest[q] = least;
            is_changed = true;
          }
      }
    }
  }
  return smallest;
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
      std::set<std::pair<int, std::uint32_t>> large; // the largest first
      for(std::uint32_t i = 0; i < n; ++i)
        if(without_small[i] < first_mark && size[component[i]] < 3)
          without_small[i] = free_label;
        else if(without_small[i] < first_mark)
          large.emplace(-int(size[component[i]]), component[i]);
      Border_components<decltype(backend)> borders(backend, points.ranks);
      const Labels_of_points labels = {points.cloud.surfels(), label.data(), nullptr};
      std::vector<std::pair<int, std::uint32_t>> got;
      for(const Component& c : large_components(points, 3, labels, component.data(), borders))
        got.emplace_back(-int(c.size), c.root);
      CHECK_AT(std::equal(got.begin(), got.end(), large.begin(), large.end()), name + ": large components");
      const auto sizes = component_sizes(points, labels, component.data(), borders);
      backend.for_each(n, Clear_interior{state.data()});
      backend.for_each(n, Free_small_components{component.data(), sizes.data(), 3, label.data()});
      check_lists(label, without_small, name + ": labels without small components");
      CHECK_AT(label != f.label, name + ": no component is small");
      check_lists(state, std::vector<std::uint8_t>(n, tried_seed_bit), name + ": states without small components");
    });
  }
}

BOOST_AUTO_TEST_SUITE_END()
