// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Square fragments of roofs and of level ground side by side, with samples of their points, their links, and their
// unions, of which the tables are checked.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_FRAGMENTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_FRAGMENTS_H

#include "body_fixture.h"
#include "same_bits.h"

#include <CGAL/Tandem/internal/rounds/Shape_samples.h>
#include <CGAL/Tandem/internal/rounds/merge_shapes.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr int columns = 60, rows = 50, width = 1000; // of square fragments, in grid steps
constexpr double maximum_distance = 60;

const std::uint32_t upright = encode_normal({0, 0, 1});

inline Options union_options(std::int64_t minimum_size = 100)
{
  Options o = Options();
  o.score = Score(minimum_size, 12);
  o.maximum_distance = maximum_distance;
  o.squared_cosine = cosine_deg(25) * cosine_deg(25);
  o.growth.tolerance = make_tolerance(maximum_distance, cosine_deg(25));
  return o;
}

const Union_gain criterion(union_options());

using Grid_points = std::vector<Grid_point>;

// The least hashes of all these.
inline Shape_sample least_of(std::vector<Sampled_point> all)
{
  std::sort(all.begin(), all.end(), [](const Sampled_point& a, const Sampled_point& b) { return a.hash < b.hash; });
  Shape_sample sample = Shape_sample();
  for(; sample.size < all.size() && sample.size < Shape_sample::capacity; ++sample.size)
    sample.item[sample.size] = all[sample.size];
  return sample;
}

// Points in the order of their positions, all of one tolerance.
inline Shape_sample sample_of(const Grid_points& points, std::uint32_t first_position = 0, std::uint8_t level = 0)
{
  std::vector<Sampled_point> all;
  for(const Grid_point& p : points)
    all.push_back({hash_of_position(first_position++), level, p});
  return least_of(all);
}

inline bool are_equal(const Shape_sample& a, const Shape_sample& b)
{
  return a.size == b.size && std::equal(a.item, a.item + a.size, b.item, [](const auto& p, const auto& q) {
           return p.hash == q.hash && p.level == q.level && p.point.x == q.point.x && p.point.y == q.point.y &&
                  p.point.z == q.point.z;
         });
}

// Shapes, each with a sample.
template <class Backend>
struct Fragments {
  Shape_table<Backend> shapes;
  Shape_samples<Backend> samples;

  Fragments(Backend& backend, std::size_t capacity)
  {
    shapes.table() = filled_buffer(backend, capacity, Shape());
    samples.reset(capacity);
  }

  void add(const Grid_points& points)
  {
    Shape& shape = shapes.table()[shapes.size];
    for(const Grid_point& p : points)
      shape.moments.add(p, 1);
    refit(shape);
    samples.data()[shapes.size++] = sample_of(points, positions_);
    positions_ += std::uint32_t(points.size());
  }

private:
  std::uint32_t positions_ = 0; // those of the points of all fragments
};

// Level ground is exactly flat, so all costs are 0 there, and sizes and ids decide.
constexpr int level = -1;

// Roofs of three slopes and a few steps, so that some neighbors have one plane, some nearly, some not: the more
// uneven, the fewer.
inline std::int32_t height(int x, int y, int unevenness, std::mt19937& random)
{
  if(unevenness == level)
    return 300 * (y / (5 * width));
  const int slope = x < 20 * width ? x / 8 : x < 40 * width ? 2500 - (x - 20 * width) / 10 : 500;
  const int step = 70 * (y / (5 * width)) + unevenness * (37 * (x / width % 7) + 61 * (y / width % 5));
  return slope + step + int(random() % 60);
}

using Link_list = std::vector<Link>;

template <class Backend>
Fragments<Backend> make_fragments(Backend& backend, int unevenness)
{
  std::mt19937 random(3);
  Fragments<Backend> fragments(backend, columns * rows);
  for(int id = 0; id < columns * rows; ++id) {
    Grid_points points;
    const int size = unevenness == level ? 20 + 30 * int(random() % 3) * int(random() % 3) : 20 + int(random() % 200);
    for(int i = 0; i < size; ++i) {
      const int x = id % columns * width + int(random() % width), y = id / columns * width + int(random() % width);
      points.push_back({x, y, height(x, y, unevenness, random), upright});
    }
    fragments.add(points);
  }
  return fragments;
}

// Between neighbors in rows, columns and one diagonal, in random order.
inline Link_list make_links(unsigned seed)
{
  Link_list links;
  for(std::uint32_t id = 0; id < columns * rows; ++id)
    for(const std::uint32_t other : {id + 1, id + columns, id + columns + 1})
      if(other < columns * rows && (other == id + columns || id % columns + 1 < columns))
        links.push_back({std::uint64_t(id) << 32 | other, 1 + id % 5});
  std::shuffle(links.begin(), links.end(), std::mt19937(seed));
  return links;
}

template <class Backend>
Shape_unions<Backend> unite(Backend& backend, Fragments<Backend>& fragments, const Link_list& links,
                            std::uint32_t* rounds = nullptr)
{
  Shape_table<Backend>& shapes = fragments.shapes;
  shapes.set_fitted();
  Shape_unions<Backend> unions =
    unite_shapes(backend, Ranks<Backend>(backend), shapes, {criterion, fragments.samples}, to_buffer(backend, links));
  if(rounds != nullptr)
    *rounds = to_vector(backend, unions.total).front();
  CHECK(std::is_sorted(unions.member.begin(), unions.member.end(), std::less_equal<std::uint32_t>()));
  for(const Shared_moments& d : shapes.delta)
    CHECK(d.count == 0 && d.sum[0] == 0 && d.low[5] == 0 && d.high[5] == 0);
  std::map<std::uint32_t, int> members;
  for(const std::uint32_t id : unions.member)
    ++members[root_of(unions.target.data(), id)];
  for(const auto& m : members)
    CHECK(m.second > 1 && std::binary_search(unions.member.begin(), unions.member.end(), m.first));
  for(std::uint32_t id = 0; id < shapes.size; ++id)
    CHECK(std::binary_search(unions.member.begin(), unions.member.end(), id) || unions.target[id] == id);
  return unions;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_FRAGMENTS_H
