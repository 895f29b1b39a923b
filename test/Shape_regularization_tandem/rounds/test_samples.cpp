// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples of shapes have the points of least hash, on several back ends; and the sample of a union is that of all points,
// also where many shapes join one in the same round. test_mutual_unions has unions of few.

#include "testing/fragments.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_samples)

using namespace CGAL::Tandem::internal;

// As the only rank, and as one after others. Of the labels, and where two shapes have no point, and one has nearly all.
BOOST_AUTO_TEST_CASE(samples)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    const std::size_t n = f.plane.size() + 2;
    for(std::uint32_t first : {0u, 0xfffffff0u})
      for(bool is_large : {false, true}) {
        std::vector<std::uint32_t> label = f.label;
        for(std::uint32_t i = 0; is_large && i < label.size(); ++i)
          label[i] = i % 50 == 0 ? free_label : i % 40 == 0 ? 2 : 1;
        std::vector<std::vector<Sampled_point>> all(n);
        for(std::uint32_t i = 0; i < label.size(); ++i)
          if(label[i] < first_mark)
            all[label[i]].push_back({hash_of_position(first + i), f.level_of(i), f.point[i]});
        Labeled_cloud<decltype(backend)> points(backend);
        take_cloud(f, points);
        points.cloud.first = first;
        set_labels(points, label);
        auto shapes = make_table(backend, std::vector<Shape>(n));
        shapes.lose_moments();
        require(points, shapes, tables::moments);
        const auto got = sample_shapes(points, shapes);
        for(std::size_t s = 0; s < n; ++s) {
          const std::string where = name + ", shape " + std::to_string(s) + " of " + std::to_string(all[s].size());
          CHECK_AT(are_equal(got.data()[s], least_of(all[s])), where);
        }
      }
  });
}

// Many small fragments beside a large one, all exactly level. They join it in one round, and the second round finds no
// pair.
BOOST_AUTO_TEST_CASE(union_of_many)
{
  constexpr int many = 300;
  on_body_backends([](auto backend, const std::string& name) {
    std::mt19937 random(7);
    Fragments<decltype(backend)> fragments(backend, many + 1);
    Grid_points all;
    Link_list links;
    for(int i = 0; i <= many; ++i) {
      Grid_points points;
      for(int j = i == 0 ? 2000 : 5 + i; j > 0; --j)
        points.push_back({1000 * i + int(random() % 1000), int(random() % 1000), 0, upright});
      fragments.add(points);
      all.insert(all.end(), points.begin(), points.end());
      if(i > 0)
        links.push_back({std::uint64_t(i), 3});
    }
    std::uint32_t rounds = 0;
    const auto unions = unite(backend, fragments, links, &rounds);
    check_equal(unions.member.size(), std::size_t(many + 1), name + ": members");
    check_equal(rounds, 2u, name + ": rounds");
    CHECK_AT(are_equal(fragments.samples.data()[0], sample_of(all)), name + ": sample");
  });
}

BOOST_AUTO_TEST_SUITE_END()
