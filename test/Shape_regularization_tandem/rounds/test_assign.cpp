// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points go to the adjacent shape where they are worth most, against plain loops on several back ends: which label each
// one chooses, what becomes of the shapes, and several passes.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace CGAL::Tandem::internal;

using Labels = std::vector<std::uint32_t>;

struct Counts { // of points, by what they do
  std::size_t moves = 0, joins = 0, leaves = 0, waits = 0, stays_in_plane = 0;
};

// The definition, by tables of all candidates of a point.
class Slow_assignment {
public:
  Slow_assignment(const Fixture& f, const std::vector<Shape>& shape, const std::vector<Plane>& plane,
                  const Options& options, std::uint32_t first)
    : f_(f), plane_(plane), score_(options.score), tolerance_(options.growth.tolerance), first_(first)
  {
    for(const Shape& s : shape)
      plane_number_.push_back(s.plane_number);
  }

  Labels choose(const Labels& label, int pass)
  {
    points_.assign(plane_.size(), 0);
    for(std::uint32_t s : label)
      if(s < first_mark)
        ++points_[s];
    Labels chosen;
    for(std::uint32_t i = 0; i < label.size(); ++i)
      chosen.push_back(choose(label, i, pass));
    return chosen;
  }

  Counts counts;

private:
  bool fits(std::uint32_t s, std::uint32_t i) const { return internal_fits(plane_[s], f_.point[i]); }
  bool internal_fits(const Plane& s, const Grid_point& p) const
  {
    return CGAL::Tandem::internal::fits(s, p, tolerance_);
  }

  // The weight of the point, half a point for all of its links, and the bonus for one point more.
  std::int64_t worth(const Labels& label, std::uint32_t i, std::uint32_t s) const
  {
    std::int64_t links = 0;
    f_.for_each_neighbor(i, [&](std::uint32_t j) { links += label[j] == s; });
    const std::int64_t distance = signed_distance(plane_[s], f_.point[i]);
    return Score::weight({1, tolerance_.distance}, distance) + links * (Score::unit / 2) / f_.cloud.k +
           score_.point_bonus(points_[s]);
  }

  std::uint32_t choose(const Labels& label, std::uint32_t i, int pass)
  {
    const std::uint32_t own = label[i];
    const bool has_shape = own < first_mark, stays = has_shape && fits(own, i);
    const bool is_odd = (std::uint64_t(first_ + i) * 0x9e3779b97f4a7c15u) >= std::uint64_t(1) << 63;
    if(stays && is_odd != (pass % 2 == 1)) {
      ++counts.waits;
      return own;
    }
    std::map<std::uint32_t, std::int64_t> candidate;
    f_.for_each_neighbor(i, [&](std::uint32_t j) {
      const std::uint32_t t = label[j];
      if(t >= first_mark || t == own || !fits(t, i))
        return;
      const bool is_same = stays && plane_number_[own] >= 0 && plane_number_[own] == plane_number_[t];
      counts.stays_in_plane += is_same;
      if(!is_same)
        candidate[t] = worth(label, i, t);
    });
    if(stays)
      candidate[own] = worth(label, i, own);
    std::uint32_t best = has_shape ? free_label : own;
    for(const auto& c : candidate) // by rising id
      if(best >= first_mark || c.second > candidate[best])
        best = c.first;
    counts.moves += stays && best != own;
    counts.joins += !has_shape && best < first_mark;
    counts.leaves += has_shape && !stays;
    return best;
  }

  const Fixture& f_;
  std::vector<Plane> plane_;
  std::vector<int> plane_number_;
  Score score_;
  Tolerance tolerance_;
  std::uint32_t first_;
  std::vector<std::int64_t> points_; // by shape
};

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
        std::vector<Plane> plane = f_.plane;
        std::vector<Shape> shape = f_.shapes_of_labels(plane.size());
        for(std::size_t s = 0; s < shape.size(); ++s)
          shape[s].plane_number = twins == Twins::of_two_planes || s % 10 == 9 ? -1 : int(s / 2);
        if(twins != Twins::none)
          for(std::size_t s = 1; s < plane.size(); s += 2)
            plane[s] = plane[s - 1];
        Counts counts;
        test_choice(shape, plane, first, counts);
        test_passes(shape, plane, first);
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
  // Each pass by itself, from the labels of the fixture.
  void test_choice(const std::vector<Shape>& shape, const std::vector<Plane>& plane, std::uint32_t first,
                   Counts& counts)
  {
    for(int pass = 0; pass < 2; ++pass) {
      const std::string where = name_ + ", pass " + std::to_string(pass);
      Slow_assignment slow(f_, shape, plane, options_, first);
      const Labels expected = slow.choose(f_.label, pass);
      counts = slow.counts;
      Labeled_cloud<Backend> points(backend_);
      Shape_table<Backend> shapes = start(points, shape, plane, first);
      typename Backend::template Buffer<Assigned_shape> assigned(shapes.size);
      typename Backend::template Buffer<std::uint32_t> chosen(points.cloud.size());
      for_each_shape(backend_, shapes,
                     Set_assigned{shapes.counted(), shapes.plane.data(), options_.score, assigned.data()});
      backend_.for_each(chosen.size(), Assign_point{points.cloud.view(), points.label(), assigned.data(), chosen.data(),
                                                    options_.score, f_.tolerance, std::uint32_t(pass)});
      check_lists(to_vector(backend_, chosen), expected, where + ": chosen labels");
      check_lists(to_vector(backend_, points.label(), f_.label.size()), f_.label, where + ": labels before");
      const auto taken = to_buffer(backend_, expected);
      check_equal(take_chosen(points, shapes, taken.data()), expected != f_.label, where + ": whether any moves");
      check_shapes(points, shapes, shape, expected, where);
      CHECK_AT(!take_chosen(points, shapes, taken.data()), where + ": the same labels again");
      check_shapes(points, shapes, shape, expected, where + " again");
    }
  }

  // All passes, until no label changes.
  void test_passes(const std::vector<Shape>& shape, const std::vector<Plane>& plane, std::uint32_t first)
  {
    for(int passes : {1, 2, 4, 100}) {
      const std::string where = name_ + ", " + std::to_string(passes) + " passes";
      Slow_assignment slow(f_, shape, plane, options_, first);
      Labels expected = f_.label;
      int idle = 0;
      for(int pass = 0; pass < passes && idle < 2; ++pass) {
        const Labels chosen = slow.choose(expected, pass);
        idle = chosen != expected ? 0 : idle + 1;
        expected = chosen;
      }
      CHECK_AT(passes < 100 || idle == 2, where + ": labels still change");
      Labeled_cloud<Backend> points(backend_);
      Shape_table<Backend> shapes = start(points, shape, plane, first);
      assign(points, shapes, options_, passes);
      check_shapes(points, shapes, shape, expected, where);
      for(std::uint32_t i = 0; i < expected.size(); ++i)
        CHECK_AT(expected[i] >= first_mark || fits(plane[expected[i]], f_.point[i], f_.tolerance),
                 where + ": a point that does not fit its shape");
    }
  }

  Shape_table<Backend> start(Labeled_cloud<Backend>& points, const std::vector<Shape>& shape,
                             const std::vector<Plane>& plane, std::uint32_t first)
  {
    take_cloud(f_, points);
    points.cloud.first = first;
    set_labels(points, f_.label, f_.state);
    Shape_table<Backend> shapes = make_table(backend_, shape);
    shapes.plane = to_buffer(backend_, plane);
    return shapes;
  }

  // Labels, and the moments of their points. Boxes hold the points of before, too.
  void check_shapes(const Labeled_cloud<Backend>& points, const Shape_table<Backend>& shapes,
                    const std::vector<Shape>& before, const Labels& label, const std::string& where)
  {
    check_lists(to_vector(backend_, points.label(), label.size()), label, where + ": labels");
    std::vector<Moments> moments(before.size());
    std::vector<Box> box(before.size());
    for(std::uint32_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark) {
        moments[label[i]].add(f_.point[i], 1);
        box[label[i]].add(f_.point[i]);
      }
    for(std::size_t s = 0; s < before.size(); ++s) {
      const Shape& got = shapes.table()[s];
      const std::string at = where + ", shape " + std::to_string(s);
      CHECK_AT(are_equal(got.moments, moments[s]), at + ": moments");
      for(int a = 0; a < 3 && got.is_live(); ++a)
        CHECK_AT(got.box.low[a] <= box[s].low[a] && got.box.high[a] >= box[s].high[a], at + ": box");
      CHECK_AT(!got.history.is_fitted() || are_equal(got.moments, before[s].moments), at + ": is not fitted any more");
    }
    CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), where + ": deltas that stay");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
  Options options_;
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
      Cloud_view cloud = {point.data(), neighbor.data(), 3, 2};
      for(std::uint32_t pass : {0u, 1u}) {
        Labels chosen(3);
        Assign_point{cloud, label.data(), shape.data(), chosen.data(), Score(10, 2), tolerance, pass}(0);
        const bool is_considered = own == free_label || pass == 0; // the hash of 0 is 0
        check_equal(chosen[0], is_considered ? 3u : own, "ties");
      }
    }
}

int main()
{
  test_ties();
  test_on_all_backends<Assignments>();
  return report();
}
