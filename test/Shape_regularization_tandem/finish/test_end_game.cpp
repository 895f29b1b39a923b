// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What detections end with. Relations must not drop faces of hardly more than the minimum size. Planes lie in the
// middle of their points. Planes through clutter are no shapes: their balance against plain loops on several back ends.
// The score between stages, likewise, and whether it rises.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/finish/end_game.h>
#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>

#include <string>
#include <tuple>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_end_game)

using namespace CGAL::Tandem::internal;

constexpr double epsilon = .02;

// A floor, and small faces over it that are nearly parallel to it: it would take so many of their points that they fall
// below the minimum size.
BOOST_AUTO_TEST_CASE(small_faces)
{
  const std::size_t floor_size = 20000, face_size = 104;
  const int columns = 6;
  const double width = .6, turn = 1.8 * epsilon / width;
  scenes::Random random(1);
  Cloud cloud;
  for(std::size_t i = 0; i < floor_size; ++i)
    cloud.emplace_back(Kernel::Point_3(columns * random.uniform(), columns * random.uniform(), 0),
                       Kernel::Vector_3(0, 0, 1));
  for(int face = 0; face < columns * columns; ++face)
    for(std::size_t i = 0; i < face_size; ++i) {
      const double x = width * random.uniform(), y = width * random.uniform();
      const double z = 10 * epsilon + turn * x + .3 * epsilon * random.gaussian();
      cloud.emplace_back(Kernel::Point_3(face % columns + x, face / columns + y, z), Kernel::Vector_3(-turn, 0, 1));
    }
  const Shapes shapes = detect(cloud, make_parameters(epsilon, 100));
  check_equal(shapes.number_of_shapes(), std::size_t(1 + columns * columns), "a floor and small faces over it");
}

// A plane lies in the middle of all points of its shapes; without any it stays.
BOOST_AUTO_TEST_CASE(center_of_planes)
{
  Shape_relations relations;
  Relations& r = relations.relations;
  const Vector up = {0, 0, 1};
  r.planes = {{up, 10}, {up, 30}, {up, 40}};
  std::vector<Shape_summary> shapes;
  for(const auto& [plane, points, z] : {std::make_tuple(0, 100., 11.), std::make_tuple(0, 300., 7.),
                                        std::make_tuple(0, 0., 1e6), std::make_tuple(1, 0., 5.)}) {
    r.plane_of.push_back(plane);
    relations.id.push_back(std::uint32_t(1 + 3 * shapes.size()));
    shapes.push_back({});
    shapes.back().id = relations.id.back();
    shapes.back().fit.scatter.count = points;
    shapes.back().fit.scatter.centroid = {5, 6, z};
  }
  shapes.erase(shapes.begin() + 2); // shapes that are gone have no summary
  center_planes(shapes, relations);
  CHECK(r.planes[0].offset == 8 && r.planes[1].offset == 30 && r.planes[2].offset == 40 && r.planes[0].normal.z == 1);
}

// Small components become free before: the plane is in the middle of the points that the shape keeps.
BOOST_AUTO_TEST_CASE(center_of_large_components)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    if(!f.level.empty())
      return; // tolerances are weights
    Labeled_cloud<decltype(backend)> points(backend);
    Stage_parameters options = Stage_parameters();
    options.minimum_region_size = 3;
    options.growth.cell_size = take_cloud(f, points);
    find_border(points);
    options.growth.tolerance = f.tolerance;
    set_labels(points, f.label);
    auto shapes = make_table(backend, f.shapes_of_labels(f.plane.size()));
    shapes.plane = to_buffer(backend, f.plane);
    Shape_relations relations;
    for(std::uint32_t s = 0; s < f.plane.size(); ++s) {
      relations.id.push_back(s);
      relations.relations.plane_of.push_back(int(s));
      relations.relations.planes.push_back({{0, 0, 1}, 0});
    }
    separate_components(points, shapes, options, false);
    std::vector<double> sum(f.plane.size(), 0), count(f.plane.size(), 0);
    std::size_t freed = 0;
    for(std::uint32_t i = 0; i < f.cloud.size; ++i) {
      const std::uint32_t s = points.label()[i];
      CHECK_AT(s == f.label[i] || s >= first_mark, name + ": a point has another shape");
      freed += s != f.label[i];
      if(s < first_mark) {
        sum[s] += f.point[i].z;
        ++count[s];
      }
    }
    CHECK_AT(f.cloud.size < 100 || freed > 0, name + ": no small component");
    set_labels(points, f.label);
    shapes.table() = to_buffer(backend, f.shapes_of_labels(f.plane.size()));
    center_shapes(points, shapes, options, relations);
    for(std::size_t s = 0; s < sum.size(); ++s)
      CHECK_AT(count[s] == 0 || std::fabs(sum[s] / count[s] - relations.relations.planes[s].offset) < 1e-3,
               name + ": plane of shape " + std::to_string(s));
  });
}

// k times the weight of each point, minus 3/2 of what its neighbors of other labels beyond epsilon of its plane
// count: free ones 1, others by how far they are from their own planes.
std::vector<std::int64_t> slow_balances(const Fixture& f, const std::vector<std::uint32_t>& points)
{
  constexpr std::int64_t one = 4096;
  const auto weight = [&](std::uint32_t s, std::uint32_t i) {
    return Score::weight(f.tolerance_of(i), signed_distance(f.plane[s], f.point[i]));
  };
  std::vector<std::int64_t> balance(f.plane.size(), 0);
  for(std::uint32_t i = 0; i < f.cloud.size; ++i) {
    const std::uint32_t s = f.label[i];
    if(s >= first_mark)
      continue;
    balance[s] += points[i] * f.cloud.k * weight(s, i);
    f.for_each_neighbor(i, [&](std::uint32_t q) {
      const std::uint32_t t = f.label[q];
      if(t != s && f.distance(s, q) > std::uint64_t(f.tolerance_of(i).distance))
        balance[s] -= points[i] * ((t >= first_mark ? one : 6 * (one - weight(t, q))) * 3 / 2);
    });
  }
  return balance;
}

// By its definition, in double. Free points may have one of two marks.
std::vector<double> slow_score(const Fixture& f, std::int64_t minimum_size)
{
  double fit = 0, links = 0, size = 0, price = 0;
  std::vector<double> points(f.plane.size(), 0);
  for(std::uint32_t i = 0; i < f.cloud.size; ++i) {
    const std::uint32_t s = f.label[i];
    f.for_each_neighbor(i, [&](std::uint32_t q) {
      const bool is_free = s >= first_mark, leads_to_free = f.label[q] >= first_mark;
      links -= is_free && leads_to_free ? 0 : is_free || leads_to_free ? 1.5 : s != f.label[q] ? .5 : 0;
    });
    if(s >= first_mark)
      continue;
    ++points[s];
    const double d = double(f.distance(s, i)) / double(f.tolerance_of(i).distance);
    fit += d < 1 ? 1 - d * d : 0;
  }
  for(const double n : points)
    if(n > 0) {
      size += Parameters().simplicity * n * std::log2(n / double(minimum_size));
      price -= .3 * double(minimum_size);
    }
  return {fit, links / f.cloud.k, size, price};
}

Stage_parameters stages_of(const Fixture& f, std::int64_t minimum_size)
{
  Stage_parameters options;
  options.growth.tolerance = f.tolerance;
  options.score = Score(std::uint64_t(minimum_size), f.cloud.k);
  return options;
}

BOOST_AUTO_TEST_CASE(score_of_labels)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    const std::int64_t minimum_size = 20;
    Labeled_cloud<decltype(backend)> labeled(backend);
    take_cloud(f, labeled);
    set_labels(labeled, f.label, f.state);
    auto shapes = make_table(backend, f.shapes_of_labels(f.plane.size()));
    shapes.plane = to_buffer(backend, f.plane);
    const Score_terms got = measure_score(labeled, shapes, stages_of(f, minimum_size)).terms;
    const std::vector<double> expected = slow_score(f, minimum_size);
    const std::int64_t terms[] = {got.fit, got.links, got.size, got.price};
    for(std::size_t t = 0; t < expected.size(); ++t)
      CHECK_AT(std::fabs(double(terms[t]) / 4096 - expected[t]) <= 1e-3 * double(f.cloud.size),
               name + ": term " + std::to_string(t) + " is " + std::to_string(terms[t] / 4096) + " instead of " +
                 std::to_string(expected[t]));
    CHECK_AT(got.freedom == 0, name);
  });
}

// A stage without a move, one that takes points to shapes that they do not fit, and one that takes them back.
BOOST_AUTO_TEST_CASE(watch_of_the_score)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    if(f.cloud.size < 100)
      return;
    const Stage_parameters options = stages_of(f, 1); // some shapes have few points
    Labeled_cloud<decltype(backend)> labeled(backend);
    take_cloud(f, labeled);
    std::vector<std::uint32_t> right = f.label;
    for(std::uint32_t i = 0; i < f.cloud.size; ++i)
      if(right[i] < first_mark && 4 * f.distance(right[i], i) > std::uint64_t(f.tolerance_of(i).distance))
        right[i] = free_label;
    std::vector<std::uint32_t> wrong = right;
    for(std::uint32_t i = 0; i < f.cloud.size; i += 16)
      if(right[i] < first_mark)
        wrong[i] = (right[i] + 1) % std::uint32_t(f.plane.size());
    const auto rises = [&](const std::vector<std::uint32_t>& from, const std::vector<std::uint32_t>& to) {
      set_labels(labeled, from, f.state);
      Fixture g = f;
      g.label = from;
      auto shapes = make_table(backend, g.shapes_of_labels(f.plane.size()));
      shapes.plane = to_buffer(backend, f.plane);
      Score_watch<decltype(backend)> watch(labeled, shapes, options);
      watch.begin();
      take_chosen(labeled, shapes, to_buffer(backend, to).data());
      return watch.rises();
    };
    CHECK_AT(rises(right, right), name + ": no move");
    CHECK_AT(!rises(right, wrong) && rises(wrong, right), name + ": points go to wrong shapes, and back");
  });
}

// Of surfels that stand for up to three points, with planes that fit some shapes badly; and what becomes of shapes with
// negative balances.
BOOST_AUTO_TEST_CASE(balances)
{
  for(const Fixture& fixture : fixtures()) {
    Fixture f = fixture;
    const std::uint32_t n = f.cloud.size;
    std::vector<std::uint32_t> points, first = {0};
    for(std::uint32_t i = 0; i < n; ++i) {
      points.push_back(1 + i % 3);
      first.push_back(first.back() + points.back());
      if(f.label[i] < first_mark && f.label[i] % 4 == 1 && i % 4 != 0)
        f.label[i] = free_label; // so that these shapes have free neighbors
    }
    for(std::size_t s = 0; s < f.plane.size(); ++s)
      f.plane[s].d += f.tolerance.distance / 10 * std::int64_t(s % 11);
    f.lists = f.list_shapes(f.label);
    Cloud_view cloud = f.cloud;
    cloud.surfels.first = first.data();
    const auto expected = slow_balances(f, points), of_points = slow_balances(f, std::vector<std::uint32_t>(n, 1));
    std::vector<std::uint32_t> label = f.label;
    std::size_t freed = 0;
    for(std::uint32_t& s : label)
      if(s < first_mark && of_points[s] < 0) {
        s = free_label;
        ++freed;
      }
    CHECK_AT(n < 100 || (freed > 0 && label.size() > freed), f.name + ": no shape is clutter");
    on_body_backends([&](auto backend, const std::string& of) {
      const std::string name = of + ", " + f.name;
      std::vector<std::int64_t> got(expected.size(), 0);
      backend.template for_each_cell<No_scratch>(
        2 * f.cells.size(),
        Sum_balances<decltype(backend)>{
          cloud, {f.cells.data(), f.lists.data(), 2}, f.label.data(), f.plane.data(), got.data(), f.tolerance});
      check_lists(got, expected, name + ": balances");
      Labeled_cloud<decltype(backend)> labeled(backend);
      take_cloud(f, labeled);
      set_labels(labeled, f.label, f.state);
      auto shapes = make_table(backend, f.shapes_of_labels(f.plane.size()));
      shapes.plane = to_buffer(backend, f.plane);
      free_clutter(labeled, shapes, f.tolerance);
      check_lists(to_vector(backend, labeled.label(), n), label, name + ": labels");
      for(std::size_t s = 0; s < shapes.size; ++s)
        CHECK_AT(of_points[s] >= 0 || !shapes.table()[s].is_live(), name + ": clutter that stays");
    });
  }
}

// A cube of points at random, with normals along an axis, and a face through it. Every layer of the cube, 25 of them,
// has enough points for a shape; half of them are dropped.
BOOST_AUTO_TEST_CASE(clutter_shapes)
{
  const std::size_t on_face = 10000, in_cube = 20000;
  Cloud cloud;
  scenes::Random random(5);
  for(std::size_t i = 0; i < on_face + in_cube; ++i) {
    const double z = i < on_face ? .5 + .2 * epsilon * random.gaussian() : random.uniform();
    cloud.emplace_back(Kernel::Point_3(random.uniform(), random.uniform(), z), Kernel::Vector_3(0, 0, 1));
  }
  const Shapes shapes = detect_valid("clutter shapes", cloud, make_parameters(epsilon, 200));
  CHECK_AT(shapes.number_of_shapes() <= 13, std::to_string(shapes.number_of_shapes()));
  CHECK_AT(shapes.size(0) > on_face * 9 / 10, std::to_string(shapes.size(0)) + " points of the face");
}

BOOST_AUTO_TEST_SUITE_END()
