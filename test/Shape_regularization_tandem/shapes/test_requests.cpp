// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each stage asks for what it reads of what follows from labels: where all of it is out of date, it neither reads it,
// which an assertion reports, nor has another result. scripts/check_requests.sh removes each request in turn, and
// expects this test to fail.

#include "testing/Open_engine.h"
#include "testing/test_support.h"

#include <functional>

BOOST_AUTO_TEST_SUITE(test_requests)

using namespace CGAL::Tandem::internal;

using Link_buffer = Sequential_backend::Buffer<Link>;
using Stage = std::function<void(State&, Link_buffer&)>;

// Lists, moments, fits and interior bits are out of date. The bits are wrong, too: of all points.
void spoil(State& t)
{
  t.shapes.lose_moments();
  const Labels_view labels = t.points.change_labels(false);
  t.points.lose_interior();
  for(std::size_t i = 0; i < t.points.cloud.size(); ++i)
    if(labels.label[i] < first_mark)
      labels.state[i] |= interior_bit;
}

// What stages change.
struct Outcome {
  std::vector<std::uint32_t> label;
  std::vector<double> plane;
  std::vector<std::uint64_t> link; // ascending

  bool operator==(const Outcome& o) const { return label == o.label && plane == o.plane && link == o.link; }
};

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
  require(t.points, t.shapes, tables::fits);
  if(is_spoilt)
    spoil(t);
  stage(t, links);
  Outcome result;
  result.label = to_vector(t.points.backend, t.points.label(), t.points.cloud.size());
  for(std::size_t id = 0; id < t.shapes.size; ++id) {
    const Regular_plane& p = t.shapes.table()[id].plane;
    result.plane.insert(result.plane.end(), {p.normal.x, p.normal.y, p.normal.z, p.offset});
  }
  for(const Link& link : to_vector(t.points.backend, links))
    result.link.push_back(link.pair);
  std::sort(result.link.begin(), result.link.end());
  return result;
}

void test(const std::string& name, const Stage& stage)
{
  static const Outcome before = outcome([](State&, Link_buffer&) {}, false);
  const Outcome expected = outcome(stage, false), got = outcome(stage, true);
  CHECK_AT(!(expected == before), name + " changes nothing");
  CHECK_AT(got.label == expected.label, name + ": labels");
  CHECK_AT(got.plane == expected.plane, name + ": planes");
  CHECK_AT(got.link == expected.link, name + ": links");
}

BOOST_AUTO_TEST_CASE(test_rounds)
{
  test("growth", [](State& t, Link_buffer&) { grow_shapes(t.points, t.shapes, t.seeds, t.options.growth); });
  test("dropping", [](State& t, Link_buffer&) { drop_small(t.points, t.shapes, 200); });
  test("a merge of shapes with those before them", [](State& t, Link_buffer&) {
    auto target = identity_targets(t.points.backend, t.shapes.size);
    for(std::size_t id = 0; id < target.size(); ++id)
      target[id] = std::uint32_t(id & ~std::size_t(1));
    merge_points(t.points, t.shapes, target);
  });
  test("links of some shapes", [](State& t, Link_buffer& links) {
    for(std::size_t id = 0; id < t.shapes.size; ++id)
      t.shapes.table()[id].history.set_linked(id % 4 != 0);
    links = collect_links(t.points, t.shapes, Links::changed, Phase::loop);
  });
  test("unions", [](State& t, Link_buffer& links) { merge_by_gain(t.points, t.shapes, t.options, links); });
  test("regularization", [](State& t, Link_buffer&) {
    regularize_shapes(t.points, t.shapes, t.options, {true, t.options.minimum_related_size});
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
    r.relations.planes.push_back({p.normal, p.offset + 3 * t.options.maximum_distance});
  }
  return r;
}

BOOST_AUTO_TEST_CASE(test_end_game)
{
  test("misfits", [](State& t, Link_buffer&) {
    for(Shape& s : t.shapes.table())
      s.plane.offset += t.options.maximum_distance;
    detach_misfits(t.points, t.shapes, t.options.growth.tolerance);
  });
  test("local planes", [](State& t, Link_buffer&) { fit_planes(t.points, t.shapes); });
  test("splits", [](State& t, Link_buffer&) {
    const Labels_view labels = t.points.change_labels(false);
    t.shapes.lose_moments();
    for(std::size_t i = 0; i < t.points.cloud.size(); ++i)
      if(labels.label[i] < first_mark)
        labels.label[i] &= ~1u; // with the shape before it
    t.options.minimum_region_size = 10;
    t.options.score = Score(10, t.points.cloud.k);
    const std::size_t size = t.shapes.size;
    split_shapes(t.points, t.shapes, t.options);
    CHECK(t.shapes.size > size);
  });
  test("assignment", [](State& t, Link_buffer&) { Assignment<Sequential_backend>(t.points)(t.shapes, t.options); });
  test("a raised score", [](State& t, Link_buffer&) {
    Assignment<Sequential_backend> assign(t.points);
    raise_score(t.points, t.shapes, t.options, assign);
  });
  test("final regularization", [](State& t, Link_buffer&) {
    Assignment<Sequential_backend> assign(t.points);
    regularize_finally(t.points, t.shapes, t.options, assign);
  });
  test("centered planes", [](State& t, Link_buffer&) {
    Shape_relations relations = shifted_planes(t);
    center_shapes(t.points, t.shapes, t.options, relations);
  });
}

BOOST_AUTO_TEST_SUITE_END()
