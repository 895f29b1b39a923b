// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components of equal labels, and the shapes that they become, against plain loops on several back ends.

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

// Of those of at least three points, the largest of each shape keeps its id; the others have new ids, by falling size,
// then by position. The points of the others become free.
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

      std::map<std::uint32_t, std::uint32_t> size, id; // by root
      for(std::uint32_t i = 0; i < n; ++i)
        size[component[i]] += f.label[i] < first_mark;
      std::set<std::pair<int, std::uint32_t>> large; // the largest first
      for(const auto& [root, points_of_root] : size)
        if(points_of_root >= 3)
          large.emplace(-int(points_of_root), root);
      Stage_parameters options = Stage_parameters();
      options.minimum_region_size = 3;
      options.growth.cell_size = cell_size;
      const Labels_of_points labels = {points.cloud.surfels(), f.label.data(), nullptr};
      std::vector<std::pair<int, std::uint32_t>> got;
      for(const Component& c : large_components(points, options, labels, component.data()))
        got.emplace_back(-int(c.size), c.root);
      CHECK_AT(std::equal(got.begin(), got.end(), large.begin(), large.end()), name + ": large components");
      std::set<std::uint32_t> with_id;
      std::uint32_t number = std::uint32_t(f.plane.size());
      for(const auto& l : large)
        id[l.second] = with_id.insert(f.label[l.second]).second ? f.label[l.second] : number++;
      std::vector<std::uint32_t> separate = f.label;
      for(std::uint32_t i = 0; i < n; ++i)
        if(f.label[i] < first_mark)
          separate[i] = id.count(component[i]) == 0 ? +free_label : id[component[i]];
      CHECK_AT(n < 100 || (number > f.plane.size() && separate != f.label), name + ": no component is apart");
      set_labels(points, f.label);
      auto shapes = make_table(backend, f.shapes_of_labels(f.plane.size()));
      shapes.plane = to_buffer(backend, f.plane);
      separate_components(points, shapes, options, true);
      check_lists(to_vector(backend, points.label(), n), separate, name + ": separate components");
      check_equal(shapes.size, number, name + ": number of shapes");
      std::vector<Shared_moments> sums(number);
      for(std::uint32_t i = 0; i < n; ++i)
        if(separate[i] < first_mark)
          add_point(sums[separate[i]], f.point[i], 1, f.level_of(i));
      for(std::uint32_t s = 0; s < number; ++s) {
        const Moments &got = shapes.table()[s].moments, expected_sum = sums[s].moments();
        CHECK_AT(are_equal(got, expected_sum), name + ": moments of shape " + std::to_string(s));
      }
    });
  }
}

BOOST_AUTO_TEST_SUITE_END()
