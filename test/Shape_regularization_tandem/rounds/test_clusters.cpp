// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joint-fit clusters: links that are tried at the same time give what they give one
// after the other, on all back ends. What is rejected without a fit would have been rejected with it.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/rounds/Clusters.h>

#include <algorithm>
#include <random>
#include <set>

using namespace CGAL::Tandem::internal;

constexpr int columns = 60, rows = 50, width = 1000; // of square fragments, in grid steps
constexpr double maximum_distance = 60;

// Roofs of three slopes and a few steps, so that some neighbors have one plane, some nearly, some not: the more
// uneven, the fewer.
std::int32_t height(int x, int y, int unevenness, std::mt19937& random)
{
  const int slope = x < 20 * width ? x / 8 : x < 40 * width ? 2500 - (x - 20 * width) / 10 : 500;
  const int step = 70 * (y / (5 * width)) + unevenness * (37 * (x / width % 7) + 61 * (y / width % 5));
  return slope + step + int(random() % 60);
}

template <class Backend>
void make_fragments(Backend& backend, Shape_table<Backend>& shapes, int unevenness, std::int32_t shift = 0)
{
  std::mt19937 random(3);
  shapes.shape.resize(backend, columns * rows);
  for(int id = 0; id < columns * rows; ++id) {
    Shape& shape = shapes[std::size_t(id)];
    for(int i = 0; i < 20 + int(random() % 200); ++i) {
      const int x = id % columns * width + int(random() % width), y = id / columns * width + int(random() % width);
      shape.moments.add({x + shift, y + shift, height(x, y, unevenness, random) + shift, no_normal}, 1);
    }
    refit(shape);
    shapes.live.push_back(std::uint32_t(id));
  }
}

// Between neighbors in rows, columns and one diagonal, in random order.
Link_list make_links()
{
  Link_list links;
  for(std::uint32_t id = 0; id < columns * rows; ++id)
    for(const std::uint32_t other : {id + 1, id + columns, id + columns + 1})
      if(other < columns * rows && (other == id + columns || id % columns + 1 < columns))
        links.push_back({std::uint64_t(id) << 32 | other, 1});
  std::shuffle(links.begin(), links.end(), std::mt19937(5));
  return links;
}

// What is to be found: more clusters than `few` and fewer than `many`, in so many steps. Without rejections ahead, or if no
// chains became one, it would take more.
struct Scene {
  int unevenness;
  std::size_t few, many;
  std::uint32_t minimum_steps, maximum_steps;
};

struct Outcome {
  std::vector<std::uint32_t> root;
  Regular_planes plane;
  std::uint32_t steps;
};

template <class Backend>
Outcome unite(Backend& backend, int unevenness, std::size_t few)
{
  Shape_table<Backend> shapes;
  make_fragments(backend, shapes, unevenness);
  Clusters<Backend> clusters(backend, shapes, {.95, maximum_distance}, few);
  Outcome outcome;
  outcome.steps = clusters.unite_along(make_links());
  for(const std::uint32_t id : shapes.live) {
    outcome.root.push_back(clusters.root(id));
    outcome.plane.push_back(clusters.whole(clusters.root(id)).local);
    CHECK(clusters.is_merged(id) || clusters.root(id) == id);
  }
  return outcome;
}

template <class Backend>
void check(Backend& backend, const Scene& scene, const Outcome& expected, const std::string& name)
{
  const Outcome outcome = unite(backend, scene.unevenness, 0);
  const bool is_right = outcome.steps >= scene.minimum_steps && outcome.steps <= scene.maximum_steps;
  CHECK_AT(is_right, name + ": steps " + std::to_string(outcome.steps));
  CHECK_AT(outcome.root == expected.root, name);
  const auto is_same = [](const Regular_plane& a, const Regular_plane& b) {
    return a.normal == b.normal && a.offset == b.offset;
  };
  CHECK_AT(std::equal(outcome.plane.begin(), outcome.plane.end(), expected.plane.begin(), is_same), name + ": planes");
}

void check_apart(std::int32_t shift)
{
  Sequential_backend backend;
  Shape_table<Sequential_backend> shapes;
  make_fragments(backend, shapes, 0, shift);
  const Joint_fit_criterion test = {.95, maximum_distance};
  int rejected = 0, apart = 0;
  for(const Link& link : make_links()) {
    const Shape &a = shapes[link.first()], &b = shapes[link.second()];
    Fitted_moments joint;
    const bool is_rejected = !test.fit(a, b, joint), is_apart = test.are_apart(a, b);
    rejected += is_rejected;
    apart += is_apart;
    CHECK(!is_apart || (is_rejected && !test.is_tolerable(a, b.local) && !test.is_tolerable(b, a.local)));
    check_equal(test(a, b, joint), !is_rejected, "with and without the shortcut");
  }
  CHECK_AT(rejected > 200 && 2 * apart > rejected, std::to_string(apart) + " of " + std::to_string(rejected));
}

// The eigenvalues of a turned diagonal matrix are known.
void check_eigenvalues()
{
  const Vector u = unit({1, 2, 3}), v = unit(cross(u, {1, 0, 0})), w = cross(u, v);
  const auto along = [](double s, const Vector& n) {
    return Symmetric_matrix{s * n.x * n.x, s * n.x * n.y, s * n.x * n.z, s * n.y * n.y, s * n.y * n.z, s * n.z * n.z};
  };
  const Symmetric_matrix m = along(2, u) + along(5, v) + along(7e3, w);
  CHECK(has_eigenvalues_above(m, 1.999));
  for(const double value : {2.001, 4., 6., 7.1e3})
    CHECK_AT(!has_eigenvalues_above(m, value), std::to_string(value));
  CHECK(!has_eigenvalues_above({0, 0, 0, 0, 0, 0}, 0));
}

void check_scene(const Scene& scene)
{
  Sequential_backend sequential;
  const Outcome expected = unite(sequential, scene.unevenness, std::size_t(-1));
  check_equal(expected.steps, 0u, "one after the other");
  const std::set<std::uint32_t> roots(expected.root.begin(), expected.root.end());
  CHECK_AT(roots.size() > scene.few && roots.size() < scene.many, std::to_string(roots.size()));
  check(sequential, scene, expected, "sequential");
  for(unsigned threads = 2; threads <= 8; threads *= 2) {
    Thread_backend backend(threads);
    check(backend, scene, expected, std::to_string(threads) + " threads");
  }
  for(unsigned seed = 1; seed <= 3; ++seed) {
    Shuffled_backend backend(seed);
    check(backend, scene, expected, "shuffled " + std::to_string(seed));
  }
}

int main()
{
  check_eigenvalues();
  check_apart(0);
  check_apart(1 << 30);
  constexpr std::size_t all = columns * rows;
  for(const Scene& scene : {Scene{0, 20, all / 3, 3, 10},
                            {1, all / 10, all / 3, 3, 16},
                            {2, all / 3, all, 3, 8},
                            {4, all - 1, all + 1, 1, 1}})
    check_scene(scene);
  return report();
}
