// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// After each round the table of shapes and the labels of the points agree:
// labels are live shapes or marks, counts, sums and boxes are those of the points, which see the planes of the shapes.

#undef NDEBUG

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/Planar_shape_detection_3.h>

#include <map>

using namespace CGAL::Tandem::internal;
using State = Tandem_state<Sequential_backend>;

// The state is private; an explicit instantiation may name it nevertheless.
struct State_of_engine {
  using type = State Engine<Sequential_backend>::*;
  friend type reveal(State_of_engine);
};

template <class Tag, typename Tag::type Member>
struct Reveal {
  friend typename Tag::type reveal(Tag) { return Member; }
};

template struct Reveal<State_of_engine, &Engine<Sequential_backend>::state_>;

struct Sums {
  Moments moments;
  Box box;
};

std::map<std::uint32_t, Sums> sums_of_labels(const State& t)
{
  std::map<std::uint32_t, Sums> sums;
  for(std::uint32_t i = 0; i < t.points.cloud.size(); ++i)
    if(t.points.label[i] < first_mark) {
      Sums& s = sums[t.points.label[i]];
      s.moments.add(t.points.cloud.point[i], 1);
      s.box.add(t.points.cloud.point[i]);
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
  CHECK_AT(std::is_sorted(t.shapes.live.begin(), t.shapes.live.end(), std::less_equal<std::uint32_t>()), where);
  check_equal(t.shapes.live.size(), sums.size(), where + ": live shapes");
  std::size_t assigned = 0;
  for(const auto& s : sums) {
    const std::string shape = where + ", shape " + std::to_string(s.first);
    if(!std::binary_search(t.shapes.live.begin(), t.shapes.live.end(), s.first)) {
      CHECK_AT(false, shape + " has " + std::to_string(s.second.moments.count) + " points, but is not live");
      continue;
    }
    CHECK_AT(is_same(t.shapes[s.first].moments, s.second.moments), shape + ": moments");
    CHECK_AT(contains(t.shapes[s.first].box, s.second.box), shape + ": box");
    CHECK_AT(is_same(t.shapes.plane[s.first], rounded(t.shapes[s.first].plane)), shape + ": plane");
    assigned += std::size_t(s.second.moments.count);
  }
  check_equal(t.shapes.assigned, assigned, where + ": assigned points");
  for(std::uint32_t id = 0; id < t.shapes.size(); ++id)
    CHECK_AT(sums.count(id) > 0 || t.shapes[id].moments.count == 0, where + ", dead shape " + std::to_string(id));
  for(const Shared_moments& delta : t.shapes.delta)
    CHECK_AT(delta.count == 0, where + ": deltas that were not taken");
}

// Most shapes go out of use, between two passes of growth: the others get new ids, and stay what they are.
void check_new_ids(State& t, const std::string& where)
{
  drop_shapes(t.points, t.shapes, [](const Shape&, std::uint32_t id) { return id % 4 != 0; });
  Host_buffer<Shape_delta> none;
  number_shapes(t.points, t.shapes, t.shapes.size(), none);
  CHECK_AT(t.shapes.size() <= 2 * t.shapes.live.size(), where + ": " + std::to_string(t.shapes.size()) + " ids");
  check_state(t, where);
}

// Returns the number of rounds.
int test(const std::string& name, const scenes::Options& options, Parameters parameters)
{
  using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Second<Kernel>, CGAL::Sequential_tag>;
  Sequential_backend backend;
  const Cloud cloud = to_cloud(scenes::make_scene(name, options));
  Import in = read_points(backend, cloud, Item_reader<Traits>(Traits(), First<Kernel>(), Second<Kernel>()));
  choose_grid(in, parameters.maximum_distance);
  Engine<Sequential_backend> engine(backend, in, parameters);
  State& state = engine.*reveal(State_of_engine());
  const int failures_before = failures();
  for(bool goes_on = true; goes_on && failures() == failures_before;) {
    goes_on = engine.iterate();
    check_state(state, name + ", round " + std::to_string(state.round));
  }
  const int rounds = state.round;
  check_new_ids(state, name + ", new ids");
  return rounds;
}

int main()
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
  return report();
}
