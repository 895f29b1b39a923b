// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points go to the adjacent shape where they are worth most, against plain loops on several back ends: which label each
// one chooses in a pass, what becomes of the shapes, and all passes, of which the later ones leave out most blocks.

#include "testing/Slow_assignment.h"
#include "testing/body_fixture.h"

#include <algorithm>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_assign)

using namespace CGAL::Tandem::internal;

// Every second shape has the plane of the one before it.
enum class Twins { none, of_two_planes, of_one_plane };

template <class Backend>
class Assignments {
public:
  Assignments(Backend& backend, const std::string& name, const Fixture& f)
    : backend_(backend), name_(name), f_(f), options_(Options())
  {
    options_.score = Score(60, f.cloud.k);
    options_.growth.tolerance = f.tolerance;
  }

  // As the only rank, and as one after others.
  void run()
  {
    for(std::uint32_t first : {0u, 0xfffffff1u})
      for(Twins twins : {Twins::none, Twins::of_two_planes, Twins::of_one_plane}) {
        first_ = first;
        is_of_one_plane_ = twins != Twins::of_two_planes;
        plane_ = f_.plane;
        label_ = f_.label;
        if(twins != Twins::none)
          make_twins();
        const Counts counts = test_choice();
        test_passes();
        if(f_.cloud.size >= 1000)
          CHECK_AT((twins != Twins::of_two_planes || counts.moves > 20) && counts.joins > 20 && counts.leaves > 20 &&
                     counts.waits > 20 &&
                     (twins == Twins::none || (counts.stays_in_plane > 0) == (twins == Twins::of_one_plane)),
                   name_ + ": a case is missing: " + std::to_string(counts.moves) + " moves, " +
                     std::to_string(counts.joins) + " join, " + std::to_string(counts.leaves) + " leave, " +
                     std::to_string(counts.stays_in_plane) + " of one plane");
      }
  }

private:
  // Which have one plane, and points of each other.
  void make_twins()
  {
    for(std::size_t s = 1; s < plane_.size(); s += 2)
      plane_[s] = plane_[s - 1];
    for(std::size_t i = 0; i < label_.size(); i += 3)
      if((label_[i] ^ 1) < plane_.size())
        label_[i] ^= 1;
  }

  // The first passes, where all blocks are visited.
  Counts test_choice()
  {
    const std::vector<Shape> shape = shapes_of(label_);
    Slow_assignment slow(f_, shape, plane_, options_, first_);
    const Labels before = slow.leave(label_);
    Labels expected = before;
    for(std::uint32_t passes = 1; passes <= 2; ++passes) {
      expected = slow.choose(expected, passes - 1);
      run_passes(shape, passes, before, expected);
      check_take(before, expected);
    }
    return slow.counts;
  }

  void run_passes(const std::vector<Shape>& shape, std::uint32_t passes, const Labels& before, const Labels& expected)
  {
    const std::string where = name_ + ", " + std::to_string(passes) + " passes";
    Labeled_cloud<Backend> points(backend_);
    Shape_table<Backend> shapes = start(points, shape, label_);
    typename Backend::template Buffer<Assigned_shape> assigned(shapes.size);
    for_each_shape(backend_, shapes,
                   Set_assigned{shapes.counted(), shapes.plane.data(), options_.score, assigned.data()});
    const Block_rows<Backend> rows(backend_, points.cloud);
    const std::size_t blocks = rows.row.size();
    auto chosen = filled_buffer(backend_, before.size(), no_index);
    auto next = filled_buffer(backend_, before.size(), no_index);
    auto outside = filled_buffer(backend_, blocks, Block_points(0));
    auto changed = filled_buffer(backend_, 2 * blocks, ~Block_points(0));
    typename Backend::template Buffer<Block_points> recent(blocks);
    auto border = filled_buffer(backend_, blocks, Block_points(0));
    auto has_changes = filled_buffer(backend_, tuning::moves::assignment_passes, std::uint32_t(0));
    backend_.for_each(before.size(),
                      Start_assignment<Backend>{points.cloud.view(), points.label(), assigned.data(), chosen.data(),
                                                next.data(), outside.data(), f_.tolerance});
    check_lists(to_vector(backend_, chosen), before, where + ": labels that fit");
    backend_.run_rounds(passes, blocks,
                        Assignment_passes<Backend>{points.cloud.view(),
                                                   assigned.data(),
                                                   blocks,
                                                   rows.row.data(),
                                                   rows.of_point.data(),
                                                   outside.data(),
                                                   recent.data(),
                                                   {changed.data(), changed.data() + blocks},
                                                   border.data(),
                                                   has_changes.data(),
                                                   {chosen.data(), next.data()},
                                                   options_.score,
                                                   f_.tolerance});
    check_lists(to_vector(backend_, passes % 2 == 0 ? chosen : next), expected, where + ": chosen labels");
  }

  // Labels that are chosen change labels and moments, once.
  void check_take(const Labels& before, const Labels& after)
  {
    const std::vector<Shape> shape = shapes_of(before);
    Labeled_cloud<Backend> points(backend_);
    Shape_table<Backend> shapes = start(points, shape, before);
    const auto chosen = to_buffer(backend_, after);
    for(const char* when : {" taken", " taken again"}) {
      take_chosen(points, shapes, chosen.data());
      check_lists(to_vector(backend_, points.label(), after.size()), after, name_ + ", labels" + when);
      check_shapes(shapes, shape, after, name_ + ", labels" + when);
    }
  }

  // All passes, from the first labels; from few points, whose shapes spread from block to block; and from labels of
  // which few change, in one of the halves, so that most blocks are not visited.
  void test_passes()
  {
    const Labels settled = check_passes(label_, name_);
    Labels label(label_.size(), free_label);
    for(std::size_t i = 0; i < label.size(); i += 500)
      label[i] = label_[i];
    check_passes(label, name_ + ", shapes spread");
    for(std::size_t first : {0u, 1u}) {
      label = settled;
      for(std::size_t i = first; i < label.size(); i += 301)
        if((label[i] ^ 1) < plane_.size())
          label[i] ^= 1;
      check_passes(label, name_ + ", few change");
    }
  }

  Labels check_passes(const Labels& before, const std::string& where)
  {
    const std::vector<Shape> shape = shapes_of(before);
    const Labels expected = Slow_assignment(f_, shape, plane_, options_, first_).assign(before);
    Labeled_cloud<Backend> points(backend_);
    Shape_table<Backend> shapes = start(points, shape, before);
    Assignment<Backend> assign(points);
    assign(shapes, options_);
    check_lists(to_vector(backend_, points.label(), expected.size()), expected, where + ": labels");
    check_shapes(shapes, shape, expected, where);
    const std::size_t missing = check_interior(points, expected, where);
    CHECK_AT(before != label_ || 4 * missing <= expected.size(), where + ": interior points are missing");
    // The same object again, from where it ended, then after others have changed labels and planes.
    const Labels next = assign_again(assign, points, shapes, expected, where + ", second call");
    Labels changed = next;
    for(std::size_t i = 0; i < changed.size(); i += 97)
      changed[i] = i % 2 == 0 ? free_label : before[i];
    const std::vector<Plane> planes = plane_;
    for(std::size_t s = 0; s < plane_.size(); s += 5)
      plane_[s].d += f_.tolerance.distance / 3;
    assign_again(assign, points, shapes, changed, where + ", third call");
    plane_ = planes;
    return expected;
  }

  Labels assign_again(Assignment<Backend>& assign, Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                      const Labels& before, const std::string& where)
  {
    const std::vector<Shape> shape = shapes_of(before);
    const Labels expected = Slow_assignment(f_, shape, plane_, options_, first_).assign(before);
    set_labels(points, before, f_.state);
    shapes = make_table(backend_, shape);
    shapes.plane = to_buffer(backend_, plane_);
    assign(shapes, options_);
    check_lists(to_vector(backend_, points.label(), expected.size()), expected, where + ": labels");
    check_interior(points, expected, where);
    return expected;
  }

  // No interior point has a neighbor in another shape. Returns how many others are not interior.
  std::size_t check_interior(Labeled_cloud<Backend>& points, const Labels& label, const std::string& where)
  {
    const std::vector<std::uint8_t> state = to_vector(backend_, points.state(), label.size());
    std::size_t missing = 0;
    for(std::uint32_t i = 0; i < label.size(); ++i) {
      bool has_other = false;
      f_.for_each_neighbor(i, [&](std::uint32_t j) { has_other |= label[j] < first_mark && label[j] != label[i]; });
      const bool is_interior = (state[i] & interior_bit) != 0;
      CHECK_AT(!has_other || !is_interior, where + ": interior bit of point " + std::to_string(i));
      missing += !has_other && !is_interior;
    }
    return missing;
  }

  std::vector<Shape> shapes_of(const Labels& label) const
  {
    std::vector<Shape> shape(plane_.size());
    for(std::size_t s = 0; s < shape.size(); ++s)
      shape[s].plane_number = !is_of_one_plane_ || s % 10 == 9 ? -1 : int(s / 2);
    for(std::uint32_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark) {
        shape[label[i]].moments.add(f_.point[i], 1, f_.level_of(i));
        shape[label[i]].box.add(f_.point[i]);
      }
    return shape;
  }

  Shape_table<Backend> start(Labeled_cloud<Backend>& points, const std::vector<Shape>& shape, const Labels& label)
  {
    take_cloud(f_, points);
    points.cloud.first = first_;
    set_labels(points, label, f_.state);
    Shape_table<Backend> shapes = make_table(backend_, shape);
    shapes.plane = to_buffer(backend_, plane_);
    return shapes;
  }

  // The moments of the points of the labels. Boxes hold the points of before, too.
  void check_shapes(const Shape_table<Backend>& shapes, const std::vector<Shape>& before, const Labels& label,
                    const std::string& where)
  {
    const std::vector<Shape> expected = shapes_of(label);
    for(std::size_t s = 0; s < before.size(); ++s) {
      const Shape &got = shapes.table()[s], &e = expected[s];
      const std::string at = where + ", shape " + std::to_string(s);
      CHECK_AT(are_equal(got.moments, e.moments), at + ": moments");
      for(int a = 0; a < 3 && got.is_live(); ++a)
        CHECK_AT(got.box.low[a] <= e.box.low[a] && got.box.high[a] >= e.box.high[a], at + ": box");
      CHECK_AT(!got.history.is_fitted() || are_equal(got.moments, before[s].moments), at + ": is not fitted any more");
    }
    CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), where + ": deltas that stay");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
  Options options_;
  std::uint32_t first_ = 0; // position of the first point in the cloud of all ranks
  std::vector<Plane> plane_;
  Labels label_;
  bool is_of_one_plane_ = false; // relations say so of twins
};

BOOST_AUTO_TEST_CASE(all_cases) { test_with_levels_on_all_backends<Assignments>(); }

BOOST_AUTO_TEST_SUITE_END()
