// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// After each round the table of shapes and the labels of the points agree:
// labels are live shapes or marks, counts, sums and boxes are those of the points, which see the planes of the shapes.
// Where most ids are out of use, shapes get new ones and stay what they are.

#include "testing/Open_engine.h"
#include "testing/test_support.h"

#include <map>

BOOST_AUTO_TEST_SUITE(test_state)

using namespace CGAL::Tandem::internal;
struct Sums {
  Moments moments;
  Box box;
};

std::map<std::uint32_t, Sums> sums_of_labels(const State& t)
{
  const Surfels_view surfels = t.points.cloud.surfels();
  std::map<std::uint32_t, Sums> sums;
  for(std::uint32_t i = 0; i < t.points.cloud.size(); ++i)
    if(t.points.label()[i] < first_mark) {
      Sums& s = sums[t.points.label()[i]];
      const Range points = surfels.points(i);
      for(std::uint32_t p = points.first; p < points.last; ++p) {
        s.moments.add(surfels.point[p], 1);
        s.box.add(surfels.point[p]);
      }
    }
  return sums;
}

bool is_same(const Moments& a, const Moments& b)
{
  return a.count == b.count && std::equal(a.sum, a.sum + 3, b.sum) && std::equal(a.product, a.product + 6, b.product);
}

// Boxes only grow.
bool contains(const Box& outer, const Box& inner)
{
  for(int a = 0; a < 3; ++a)
    if(inner.low[a] < outer.low[a] || inner.high[a] > outer.high[a])
      return false;
  return true;
}

bool is_same(const Plane& a, const Plane& b) { return a.nx == b.nx && a.ny == b.ny && a.nz == b.nz && a.d == b.d; }

void check_state(const State& t, const std::string& where)
{
  const std::map<std::uint32_t, Sums> sums = sums_of_labels(t);
  const Shape_table<Sequential_backend>& shapes = t.shapes;
  for(std::size_t size : {shapes.table().size(), shapes.plane.size(), shapes.steps.size(), shapes.is_restarted.size()})
    CHECK_AT(size >= shapes.size, where + ": a table is too small");
  std::size_t assigned = 0;
  for(const auto& s : sums) {
    const std::string shape = where + ", shape " + std::to_string(s.first);
    if(s.first >= shapes.size || !shapes.table()[s.first].is_live()) {
      CHECK_AT(false, shape + " has " + std::to_string(s.second.moments.count) + " points, but is not live");
      continue;
    }
    CHECK_AT(is_same(shapes.table()[s.first].moments, s.second.moments), shape + ": moments");
    CHECK_AT(contains(shapes.table()[s.first].box, s.second.box), shape + ": box");
    CHECK_AT(is_same(shapes.plane[s.first], rounded(shapes.table()[s.first].plane)), shape + ": plane");
    assigned += std::size_t(s.second.moments.count);
  }
  const Shape_counts counts = count_live(t.points.backend, shapes);
  check_equal(counts.points, assigned, where + ": assigned points");
  check_equal(counts.shapes, sums.size(), where + ": live shapes");
  for(std::uint32_t id = 0; id < shapes.size; ++id)
    CHECK_AT(sums.count(id) > 0 || is_same(shapes.table()[id].moments, Moments()),
             where + ", dead shape " + std::to_string(id));
  for(const Shared_moments& delta : shapes.delta)
    CHECK_AT(!is_any(delta) && is_same(delta.moments(), Moments()), where + ": deltas that were not taken");
}

struct Live {
  std::vector<Shape> shape;
  std::vector<Plane> plane;
};

Live live_shapes(const Shape_table<Sequential_backend>& shapes)
{
  Live live;
  for(std::size_t id = 0; id < shapes.size; ++id)
    if(shapes.table()[id].is_live()) {
      live.shape.push_back(shapes.table()[id]);
      live.plane.push_back(shapes.plane[id]);
    }
  return live;
}

// Most shapes go out of use, between two passes of growth: the others get new ids in the same order, and stay what they
// are, but for their ages.
void check_new_ids(State& t, const std::string& where)
{
  Shape_table<Sequential_backend>& shapes = t.shapes;
  const Shape* const first = shapes.table().data();
  drop_shapes(t.points, shapes, [first](const Shape& shape) { return (&shape - first) % 4 != 0; });
  check_state(t, where + ", most are dropped");
  const Live before = live_shapes(shapes);
  const std::size_t size = shapes.size;
  check_equal(take_growth(t.points, shapes, shapes.size), 0u, where + ": new points");
  check_state(t, where);
  check_equal(shapes.size, 2 * before.shape.size() < size ? before.shape.size() : size, where + ": ids");
  const Live after = live_shapes(shapes);
  check_equal(after.shape.size(), before.shape.size(), where + ": live shapes");
  for(std::size_t i = 0; i < before.shape.size() && i < after.shape.size(); ++i) {
    const Shape &a = after.shape[i], &b = before.shape[i];
    CHECK_AT(is_same(a.moments, b.moments) && is_same(after.plane[i], before.plane[i]) &&
               a.plane_number == b.plane_number,
             where + ": the order of the shapes");
    CHECK_AT(a.age == b.age + 1 && !a.is_active, where + ": age");
  }
}

// Returns the number of rounds.
int test(const std::string& name, const scenes::Options& options, const Parameters& parameters)
{
  Open_engine engine(name, options, parameters);
  State& state = engine.state();
  const int failures_before = failures();
  for(bool goes_on = true; goes_on && failures() == failures_before;) {
    goes_on = engine.iterate();
    check_state(state, name + ", round " + std::to_string(state.round));
  }
  const int rounds = state.round;
  check_new_ids(state, name + ", new ids");
  return rounds;
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  int rounds = 0;
  for(const char* name : {"house", "village", "indoor", "part", "staircase", "sphere", "chained"})
    for(std::size_t cell_size : {std::size_t(64), std::size_t(300), std::size_t(8192)})
      for(std::size_t minimum : {std::size_t(60), std::size_t(600)}) // with 600, fragments are dissolved, too
        for(double epsilon : {.01, .03}) {
          Parameters parameters = make_parameters(epsilon, minimum);
          parameters.cell_size = cell_size;
          rounds += test(name, scene_options(6000, .002, .1), parameters);
        }
  CHECK_AT(rounds > 300, std::to_string(rounds) + " rounds in all");
}

BOOST_AUTO_TEST_SUITE_END()
