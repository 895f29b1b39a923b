// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The state between rounds: labels are live shapes or marks, whose moments are those of the points, and whose planes
// are those that the points see. Each stage asks for what it reads of what follows from labels: where all of it is out
// of date, it neither reads it, which an assertion reports, nor has another result. scripts/seeded_faults.py --requests
// removes each request in turn, and expects this test to fail.

#include "testing/body_fixture.h"

#include <CGAL/Shape_regularization_tandem/Planar_shape_detection_3.h>

#include <algorithm>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_requests)

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

class Open_engine {
public:
  Open_engine(const std::string& scene, const scenes::Options& options, const Parameters& parameters)
    : cloud_(to_cloud(scenes::make_scene(scene, options))), in_(import(parameters)),
      engine_(backend_, in_, parameters, progress_)
  {}

  bool iterate() { return engine_.iterate(); }
  State& state() { return engine_.*reveal(State_of_engine()); }

private:
  Import import(const Parameters& parameters)
  {
    using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Second<Kernel>, CGAL::Sequential_tag>;
    Import in = read_points(backend_, cloud_, Item_reader<Traits>(Traits(), First<Kernel>(), Second<Kernel>()));
    choose_grid(in, parameters);
    return in;
  }

  Sequential_backend backend_;
  Cloud cloud_;
  Import in_;
  Progress progress_;
  Engine<Sequential_backend> engine_;
};

void check_state(const State& t, const std::string& where)
{
  const Surfels_view surfels = t.points.cloud.surfels();
  const Shape_table<Sequential_backend>& shapes = t.shapes;
  std::vector<Moments> sum(shapes.size);
  for(std::uint32_t i = 0; i < t.points.cloud.number_of_surfels(); ++i)
    for(std::uint32_t p = surfels.points(i).first; p < surfels.points(i).last && t.points.label()[i] < first_mark; ++p)
      sum.at(t.points.label()[i]).add(surfels.point[p], 1);
  for(std::uint32_t id = 0; id < shapes.size; ++id) {
    const Shape& shape = shapes.table()[id];
    CHECK_AT(are_equal(shape.moments, sum[id]), where + ": moments of shape " + std::to_string(id));
    CHECK_AT(!shape.is_live() || shapes.plane[id] == rounded(shape.plane),
             where + ": plane of shape " + std::to_string(id));
  }
  CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), where + ": deltas that were not taken");
}

BOOST_AUTO_TEST_CASE(state_after_rounds)
{
  int rounds = 0;
  for(const char* name : {"house", "village", "indoor", "staircase", "sphere", "chained"})
    for(std::size_t cell_size : {std::size_t(64), std::size_t(8192)})
      for(std::size_t minimum : {std::size_t(60), std::size_t(600)}) { // with 600, fragments are dissolved, too
        Parameters parameters = make_parameters(cell_size == 64 ? .01 : .03, minimum);
        parameters.cell_size = cell_size;
        Open_engine engine(name, scene_options(6000, .002, .1), parameters);
        State& state = engine.state();
        const int failures_before = failures();
        while(engine.iterate() && failures() == failures_before) // the last round only grows
          check_state(state, std::string(name) + ", round " + std::to_string(state.round));
        rounds += state.round;
      }
  CHECK_AT(rounds > 45, std::to_string(rounds) + " rounds in all");
}

using Link_buffer = Sequential_backend::Buffer<Link>;
using Stage = std::function<void(State&, Link_buffer&)>;

// Lists, fits and interior bits are out of date. The bits are wrong, too: of all points.
void spoil(State& t)
{
  t.shapes.change_moments();
  const Labels_view labels = t.points.change_labels(false);
  t.points.invalidate_interior();
  for(std::size_t i = 0; i < t.points.cloud.number_of_surfels(); ++i)
    if(labels.label[i] < first_mark)
      labels.state[i] |= interior_bit;
}

// What stages change: labels, planes and, ascending, links.
using Outcome = std::tuple<std::vector<std::uint32_t>, std::vector<double>, std::vector<std::uint64_t>>;

// Of a stage between two rounds, with the links between all shapes.
Outcome outcome(const Stage& stage, bool is_spoilt)
{
  Parameters parameters = make_parameters(.03, 60);
  parameters.cell_size = 300;
  Open_engine engine("part", scene_options(6000, .002, .1), parameters);
  engine.iterate();
  engine.iterate();
  State& t = engine.state();
  Link_buffer links = collect_links(t.points, t.shapes, Links::all, Phase::end);
  update_tables(t.points, t.shapes, tables::fits);
  if(is_spoilt)
    spoil(t);
  stage(t, links);
  std::vector<double> plane;
  for(std::size_t id = 0; id < t.shapes.size; ++id) {
    const Regular_plane& p = t.shapes.table()[id].plane;
    plane.insert(plane.end(), {p.normal.x, p.normal.y, p.normal.z, p.offset});
  }
  std::vector<std::uint64_t> pairs;
  for(const Link& link : to_vector(t.points.backend, links))
    pairs.push_back(link.pair);
  std::sort(pairs.begin(), pairs.end());
  return {to_vector(t.points.backend, t.points.label(), t.points.cloud.number_of_surfels()), plane, pairs};
}

void check_stage(const std::string& name, const Stage& stage)
{
  static const Outcome before = outcome([](State&, Link_buffer&) {}, false);
  const Outcome expected = outcome(stage, false), got = outcome(stage, true);
  CHECK_AT(expected != before, name + " changes nothing");
  CHECK_AT(std::get<0>(got) == std::get<0>(expected), name + ": labels");
  CHECK_AT(std::get<1>(got) == std::get<1>(expected), name + ": planes");
  CHECK_AT(std::get<2>(got) == std::get<2>(expected), name + ": links");
}

void merge_with_those_before(State& t)
{
  auto target = identity_targets(t.points.backend, t.shapes.size);
  for(std::size_t id = 0; id < target.size(); ++id)
    target[id] = std::uint32_t(id & ~std::size_t(1));
  merge_surfels(t.points, t.shapes, target);
}

BOOST_AUTO_TEST_CASE(requests_of_rounds)
{
  check_stage("growth", [](State& t, Link_buffer&) { grow_shapes(t.points, t.shapes, t.seeds, t.options); });
  check_stage("dropping", [](State& t, Link_buffer&) {
    drop_shapes(t.points, t.shapes, [](const Shape& s, std::size_t) { return s.moments.count < 200; });
  });
  check_stage("a merge of shapes with those before them", [](State& t, Link_buffer&) { merge_with_those_before(t); });
  check_stage("links of some shapes", [](State& t, Link_buffer& links) {
    for(std::size_t id = 0; id < t.shapes.size; ++id)
      t.shapes.table()[id].history.is_linked = id % 4 != 0;
    links = collect_links(t.points, t.shapes, Links::changed, Phase::loop);
  });
  check_stage("unions", [](State& t, Link_buffer& links) { merge_by_gain(t.points, t.shapes, t.options, links); });
  check_stage("regularization", [](State& t, Link_buffer&) {
    regularize_shapes(t.points, t.shapes, t.options, true, t.options.minimum_related_size);
  });
}

// Each shape has a plane of its own, which is far from its points.
Shape_relations shifted_planes(const State& t)
{
  Shape_relations r;
  for(std::uint32_t id = 0; id < t.shapes.size; ++id) {
    const Regular_plane& p = t.shapes.table()[id].plane;
    r.id.push_back(id);
    r.relations.plane_of.push_back(int(id));
    r.relations.planes.push_back({p.normal, p.offset + 3 * t.options.maximum_distance_steps});
  }
  return r;
}

BOOST_AUTO_TEST_CASE(requests_of_end_game)
{
  check_stage("misfits", [](State& t, Link_buffer&) {
    for(Shape& s : t.shapes.table())
      s.plane.offset += t.options.maximum_distance_steps;
    detach_misfits(t.points, t.shapes, t.options.growth.tolerance);
  });
  check_stage("local planes", [](State& t, Link_buffer&) { fit_planes(t.points, t.shapes, t.options); });
  check_stage("splits", [](State& t, Link_buffer&) {
    merge_with_those_before(t);
    t.points.change_labels(false); // lists are out of date
    t.options.minimum_region_size = 10;
    t.options.score = Score(10, t.points.cloud.k);
    const std::size_t size = t.shapes.size;
    split_shapes(t.points, t.shapes, t.options);
    CHECK(t.shapes.size > size);
  });
  check_stage("assignment",
              [](State& t, Link_buffer&) { Assignment<Sequential_backend>(t.points)(t.shapes, t.options); });
  check_stage("a raised score", [](State& t, Link_buffer&) {
    Assignment<Sequential_backend> assign(t.points);
    raise_score(t.points, t.shapes, t.options, assign);
  });
  check_stage("final regularization", [](State& t, Link_buffer&) {
    Assignment<Sequential_backend> assign(t.points);
    regularize_finally(t.points, t.shapes, t.options, assign);
  });
  check_stage("centered planes", [](State& t, Link_buffer&) {
    Shape_relations relations = shifted_planes(t);
    center_shapes(t.points, t.shapes, t.options, relations);
  });
}

BOOST_AUTO_TEST_SUITE_END()
