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

template <class Backend>
class Components {
public:
  Components(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run() { test_components(); }

private:
  // By repeated propagation of the smallest position.
  void test_components()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::uint32_t> component(n), expected(n);
    for(std::uint32_t i = 0; i < n; ++i)
      expected[i] = i;
    for(bool is_changed = true; is_changed;) {
      is_changed = false;
      for(std::uint32_t r = 0; r < n; ++r) {
        std::map<std::uint32_t, std::uint32_t> least; // by label, over the point and its neighbors
        auto look = [&](std::uint32_t q) {
          if(f_.label[q] < first_mark) {
            std::uint32_t& smallest = least.emplace(f_.label[q], expected[q]).first->second;
            smallest = (std::min)(smallest, expected[q]);
          }
        };
        auto take = [&](std::uint32_t q) {
          if(f_.label[q] < first_mark && expected[q] != least[f_.label[q]]) {
            expected[q] = least[f_.label[q]];
            is_changed = true;
          }
        };
        look(r);
        f_.for_each_neighbor(r, look);
        take(r);
        f_.for_each_neighbor(r, take);
      }
    }
    Labeled_cloud<Backend> points(backend_);
    const std::size_t cell_size = take_cloud(f_, points);
    find_border(points);
    find_components(points, cell_size, f_.label.data(), component.data());
    check_lists(component, expected, name_ + ": components");
    test_small_components(points, component);
  }

  // Points of components of less than three points become free; before that, interior bits are cleared, and no others.
  void test_small_components(Labeled_cloud<Backend>& points, const std::vector<std::uint32_t>& component)
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::uint32_t> label = f_.label, expected = f_.label;
    std::vector<std::uint8_t> state(n, interior_bit | tried_seed_bit);
    std::map<std::uint32_t, std::uint32_t> size; // by root
    for(std::uint32_t i = 0; i < n; ++i)
      size[component[i]] += f_.label[i] < first_mark;
    for(std::uint32_t i = 0; i < n; ++i)
      if(expected[i] < first_mark && size[component[i]] < 3)
        expected[i] = free_label;
    Seams<Backend> seams(backend_, points.ranks);
    const auto sizes =
      component_sizes(points, {points.cloud.surfels(), label.data(), nullptr}, component.data(), seams);
    backend_.for_each(n, Clear_interior{state.data()});
    backend_.for_each(n, Free_small_components{component.data(), sizes.data(), 3, label.data()});
    check_lists(label, expected, name_ + ": labels without small components");
    CHECK_AT(label != f_.label, name_ + ": no component is small");
    check_lists(state, std::vector<std::uint8_t>(n, tried_seed_bit), name_ + ": states without small components");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

BOOST_AUTO_TEST_CASE(all_cases) { test_on_all_backends<Components>(); }

BOOST_AUTO_TEST_SUITE_END()
