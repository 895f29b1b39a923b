// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples of shapes have the points of least hash, on several back ends; and merged samples are that of the union, in any
// order, also where many shapes join one in the same round.

#include "testing/fragments.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_samples)

using namespace CGAL::Tandem::internal;

template <class Backend>
class Samples {
public:
  Samples(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  // As the only rank, and as one after others. Two shapes have no point, and one has nearly all.
  void run()
  {
    for(std::uint32_t first : {0u, 123456789u, 0xfffffff0u}) {
      test(f_.label, first);
      std::vector<std::uint32_t> label = f_.label;
      for(std::uint32_t i = 0; i < label.size(); ++i)
        label[i] = i % 50 == 0 ? free_label : i % 40 == 0 ? 2 : 1;
      test(label, first);
    }
  }

private:
  void test(const std::vector<std::uint32_t>& label, std::uint32_t first)
  {
    const std::size_t n = f_.plane.size() + 2;
    std::vector<std::vector<Sampled_point>> all(n);
    for(std::uint32_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark)
        all[label[i]].push_back({hash_of_position(first + i), f_.level_of(i), f_.point[i]});
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    points.cloud.first = first;
    set_labels(points, label);
    Shape_table<Backend> shapes = make_table(backend_, std::vector<Shape>(n));
    shapes.lose_moments();
    require(points, shapes, tables::moments);
    const auto samples = sample_shapes(points, shapes);
    std::size_t full = 0, large = 0;
    for(std::size_t s = 0; s < n; ++s) {
      const Shape_sample expected = least_of(all[s]), got = samples.data()[s];
      Shape_sample beginning = expected;
      beginning.size = (std::min)(got.size, expected.size);
      const std::string where = name_ + ", shape " + std::to_string(s) + " of " + std::to_string(all[s].size());
      CHECK_AT(are_equal(got, beginning), where + ": sample");
      if(all[s].size() <= Shape_sample::capacity)
        check_equal(got.size, std::uint32_t(all[s].size()), where + ": points of the sample of a small shape");
      large += all[s].size() > Shape_sample::capacity;
      full += got.size == Shape_sample::capacity;
    }
    check_equal(full, large, name_ + ": large shapes with 64 points");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

Grid_points random_points(int n, int low, std::mt19937& random)
{
  Grid_points points;
  for(int i = 0; i < n; ++i)
    points.push_back({low + int(random() % 1000), int(random() % 1000), int(random() % 20), upright});
  return points;
}

void test_merge(const std::vector<int>& sizes)
{
  std::mt19937 random(5);
  Grid_points all;
  std::vector<Shape_sample> part;
  for(int n : sizes) {
    const Grid_points points = random_points(n, 0, random);
    part.push_back(sample_of(points, std::uint32_t(all.size())));
    all.insert(all.end(), points.begin(), points.end());
  }
  const Shape_sample expected = sample_of(all);
  for(int repetition = 0; repetition < 20; ++repetition) {
    std::shuffle(part.begin(), part.end(), random);
    std::vector<Shape_sample> merged = part; // by pairs of neighbors, or all with the first one
    for(std::size_t step = 1; step < merged.size(); step *= 2)
      for(std::size_t i = 0; i + step < merged.size(); i += 2 * step)
        merge_sample(merged[i], merged[i + step]);
    CHECK_AT(are_equal(merged.front(), expected), "samples merged by pairs");
    merged = part;
    for(std::size_t i = 1; i < merged.size(); ++i)
      merge_sample(merged.front(), merged[i]);
    CHECK_AT(are_equal(merged.front(), expected), "samples merged one by one");
  }
}

// Many small fragments beside a large one, all exactly level. They join it in one round, and the second round finds no
// pair.
template <class Backend>
void test_many(Backend& backend, const std::string& name)
{
  constexpr int many = 300;
  std::mt19937 random(7);
  Fragments<Backend> fragments(backend, many + 1);
  Grid_points all;
  Link_list links;
  for(int i = 0; i <= many; ++i) {
    Grid_points points = random_points(i == 0 ? 2000 : 5 + i, 1000 * i, random);
    for(Grid_point& p : points)
      p.z = 0;
    fragments.add(points);
    all.insert(all.end(), points.begin(), points.end());
    if(i > 0)
      links.push_back({std::uint64_t(i), 3});
  }
  std::uint32_t rounds = 0;
  const Shape_unions<Backend> unions = unite(backend, fragments, links, &rounds);
  check_equal(unions.member.size(), std::size_t(many + 1), name + ": members");
  check_equal(rounds, 2u, name + ": rounds");
  CHECK_AT(are_equal(fragments.samples.data()[0], sample_of(all)), name + ": sample of a union of many");
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_with_levels_on_all_backends<Samples>();
  test_merge({0, 0});
  test_merge({0, 5, 0, 1});
  test_merge({1, 63, 64});
  test_merge({64, 65, 300, 2, 1, 1, 40, 0, 7});
  test_merge(std::vector<int>(200, 3));
  on_body_backends([](auto backend, const std::string& name) { test_many(backend, name); });
}

BOOST_AUTO_TEST_SUITE_END()
