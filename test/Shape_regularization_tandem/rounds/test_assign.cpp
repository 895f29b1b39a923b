// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points go to the adjacent shape where they are worth most, against plain loops on several back ends: which label each
// one chooses in a pass, what becomes of the shapes, and all passes, of which the later ones leave out most blocks.

#undef NDEBUG

#include "testing/Slow_assignment.h"
#include "testing/body_fixture.h"

#include <algorithm>
#include <string>
#include <vector>

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

  // Each pass by itself, where all blocks are visited, from the first labels.
  Counts test_choice()
  {
    const std::vector<Shape> shape = shapes_of(label_);
    Counts counts;
    for(std::uint32_t pass = 0; pass < 2; ++pass) {
      const std::string where = name_ + ", pass " + std::to_string(pass);
      Slow_assignment slow(f_, shape, plane_, options_, first_);
      const Labels before = slow.leave(label_), expected = slow.choose(before, pass);
      counts = slow.counts;
      Labeled_cloud<Backend> points(backend_);
      Shape_table<Backend> shapes = start(points, shape, before);
      typename Backend::template Buffer<Assigned_shape> assigned(shapes.size);
      typename Backend::template Buffer<std::uint32_t> left(points.cloud.size()), chosen(left.size());
      for_each_shape(backend_, shapes,
                     Set_assigned{shapes.counted(), shapes.plane.data(), options_.score, assigned.data()});
      const auto label = to_buffer(backend_, label_);
      backend_.for_each(left.size(),
                        Leave_misfits{points.cloud.view(), label.data(), assigned.data(), left.data(), f_.tolerance});
      check_lists(to_vector(backend_, left), before, where + ": labels that fit");
      const std::size_t blocks = number_of_blocks(before.size());
      const auto is_visited = filled_buffer(backend_, blocks, std::uint8_t(1));
      const auto all = filled_buffer(backend_, blocks, ~Changed_points(0));
      auto changed = filled_buffer(backend_, blocks, Changed_points(0));
      backend_.for_each(chosen.size(), Assign_point<Backend>{points.cloud.view(),
                                                             left.data(),
                                                             assigned.data(),
                                                             is_visited.data(),
                                                             {all.data(), all.data()},
                                                             changed.data(),
                                                             chosen.data(),
                                                             options_.score,
                                                             f_.tolerance,
                                                             pass,
                                                             std::uint32_t(before.size())});
      check_lists(to_vector(backend_, chosen), expected, where + ": chosen labels");
      check_lists(to_vector(backend_, changed), changed_points(before, expected), where + ": changed points");
      check_take(before, expected);
    }
    return counts;
  }

  static std::vector<Changed_points> changed_points(const Labels& before, const Labels& after)
  {
    std::vector<Changed_points> changed(number_of_blocks(before.size()), 0);
    for(std::size_t i = 0; i < before.size(); ++i)
      if(before[i] != after[i])
        changed[i / 64] |= Changed_points(1) << i % 64;
    return changed;
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
    const Assignment<Backend> assign(points);
    assign(shapes, options_);
    check_lists(to_vector(backend_, points.label(), expected.size()), expected, where + ": labels");
    check_shapes(shapes, shape, expected, where);
    // The same object again, from where it ended.
    const std::vector<Shape> again = shapes_of(expected);
    const Labels next = Slow_assignment(f_, again, plane_, options_, first_).assign(expected);
    assign(shapes, options_);
    check_lists(to_vector(backend_, points.label(), next.size()), next, where + ": labels of the second call");
    return expected;
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

// A point with a neighbor in each of two shapes that have one plane and one bonus: the smaller id has it, whatever the
// order of the neighbors and the own label are.
void test_ties()
{
  const std::vector<Grid_point> point(3, {0, 0, 10, encode_normal({0, 0, 1})});
  const Tolerance tolerance = make_tolerance(100, cosine_deg(25));
  const Plane level = make_plane({0, 0, 1}, {0, 0, 0});
  const std::vector<Assigned_shape> shape(9, {level, 50, -1});
  for(std::uint32_t own : {3u, 7u, free_label})
    for(bool is_reversed : {false, true}) {
      const Labels label = {own, is_reversed ? 7u : 3u, is_reversed ? 3u : 7u};
      const Labels neighbor = {1, 2, 0, no_index, 0, no_index};
      Cloud_view cloud = {point.data(), neighbor.data(), 3, 2, {point.data(), nullptr, nullptr}};
      const std::uint8_t is_visited = 1;
      for(std::uint32_t pass : {0u, 1u}) {
        Labels chosen(3);
        const Changed_points all = ~Changed_points(0);
        Changed_points changed = 0;
        Assign_point<Sequential_backend>{cloud,    label.data(),  shape.data(), &is_visited, {&all, &all},
                                         &changed, chosen.data(), Score(10, 2), tolerance,   pass,
                                         3}(0);
        const bool is_considered = own == free_label || pass == 0; // the hash of 0 is 0
        check_equal(chosen[0], is_considered ? 3u : own, "ties");
        check_equal(changed, Changed_points(chosen[0] != own), "whether the label of a tie has changed");
      }
    }
}

// Blocks of which the first has neighbors in two, the second in itself, the third in too many. A label has changed in one
// of them, or in none, in the last pass or in the one before.
void test_marks()
{
  Block_row row[3] = {};
  row[0].add(0);
  row[0].add(1);
  row[1].add(1);
  for(std::uint32_t b = 0; b <= Block_row::capacity; ++b)
    row[2].add(b + 2);
  for(std::size_t place = 0; place < 4; ++place)
    for(bool is_last : {false, true}) {
      Changed_points none[20] = {}, some[20] = {};
      some[place] = Changed_points(1) << 40;
      const Recent_changes recent = {is_last ? some : none, is_last ? none : some};
      for(std::size_t b = 0; b < 3; ++b) {
        std::uint8_t is_visited[3] = {7, 7, 7};
        Changed_points changed[3] = {7, 7, 7};
        Mark_visited{row, recent, is_visited, changed}(b);
        const bool expected = b == 2 || (b == 0 && place < 2) || (b == 1 && place == 1);
        check_equal(int(is_visited[b]), int(expected),
                    "visit of block " + std::to_string(b) + " after a change in " + std::to_string(place));
        check_equal(changed[b], Changed_points(0), "changes of a pass that begins");
      }
    }
}

int main()
{
  test_marks();
  test_ties();
  test_with_levels_on_all_backends<Assignments>();
  return report();
}
