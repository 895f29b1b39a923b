// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points go to the adjacent shape where they are worth most: labels, shapes and interior bits after all passes, of
// which the later ones leave out most blocks, against plain loops over tables of all candidates of each point.

#include "testing/body_fixture.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_assign)

using namespace CGAL::Tandem::internal;

using Labels = std::vector<std::uint32_t>;

// Every second shape has the plane of the one before it.
enum class Twins { none, of_two_planes, of_one_plane };

struct Call {
  std::vector<Plane> plane;
  Labels before, after;
};

// Points, by what they do.
enum Kind { moves, joins, leaves, waits, stays_in_plane, is_tied, kinds };
using Counts = std::array<std::size_t, kinds>;

// The definition. Each pass looks at all points.
class Slow_assignment {
public:
  Fixture f;
  const std::uint32_t first; // position of the first point in the cloud of all ranks
  Stage_parameters options = Stage_parameters();

  Slow_assignment(const Fixture& fixture, std::uint32_t first_position, Twins twins, Counts& counts)
    : f(fixture), first(first_position), is_of_one_plane_(twins != Twins::of_two_planes), counts_(counts)
  {
    options.score = Score(60, f.cloud.k);
    options.growth.tolerance = f.tolerance;
    for(std::size_t s = 1; twins != Twins::none && s < f.plane.size(); s += 2)
      f.plane[s] = f.plane[s - 1];
  }

  std::vector<Shape> shapes_of(const Labels& label) const
  {
    Fixture labeled = f;
    labeled.label = label;
    std::vector<Shape> shape = labeled.shapes_of_labels(f.plane.size());
    for(std::size_t s = 0; s < shape.size(); ++s) {
      shape[s].plane_number = !is_of_one_plane_ || s % 10 == 9 ? -1 : int(s / 2);
      shape[s].history.is_fitted = true;
    }
    return shape;
  }

  Call assign(const Labels& before)
  {
    shape_ = shapes_of(before);
    note_bonuses();
    Labels label = before;
    for(std::uint32_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark && !f.fits(label[i], i)) {
        label[i] = free_label;
        ++counts_[leaves];
      }
    for(std::uint32_t pass = 0; pass < tuning::moves::assignment_passes; ++pass) {
      Labels chosen;
      for(std::uint32_t i = 0; i < label.size(); ++i)
        chosen.push_back(choose(label, i, pass));
      label.swap(chosen);
    }
    return {f.plane, before, label};
  }

  // The next call is that of another assignment.
  void forget() { plane_.clear(); }

private:
  // Of one point more than a shape had at the beginning of the call in which its plane was new.
  void note_bonuses()
  {
    bonus_.resize(f.plane.size());
    for(std::size_t s = 0; s < f.plane.size(); ++s) {
      const std::int64_t points = shape_[s].moments.count;
      if(plane_.empty() || !(plane_[s] == f.plane[s]))
        bonus_[s] = points > 0 ? options.score.point_bonus(points) : 0;
    }
    plane_ = f.plane;
  }

  // The weight of the point, half a point for all of its links, and the bonus: of what it exceeds that of the own
  // shape, as much as the surface of both is continuous.
  std::int64_t worth(const Labels& label, std::uint32_t i, std::uint32_t s) const
  {
    std::int64_t links = 0;
    f.for_each_neighbor(i, [&](std::uint32_t j) { links += label[j] == s; });
    const std::int64_t distance = signed_distance(f.plane[s], f.point[i]);
    const std::int64_t result = Score::weight(f.tolerance_of(i), distance) + links * (Score::unit / 2) / f.cloud.k;
    if(label[i] >= first_mark)
      return result + bonus_[s];
    const std::int64_t continuity = continuity_at(f.plane[label[i]], f.plane[s], f.point[i], f.tolerance_of(i));
    return result + (bonus_[s] - bonus_[label[i]]) * continuity / Score::unit;
  }

  std::uint32_t choose(const Labels& label, std::uint32_t i, std::uint32_t pass)
  {
    const std::uint32_t own = label[i];
    const bool has_shape = own < first_mark;
    const bool is_odd = (std::uint64_t(first + i) * 0x9e3779b97f4a7c15u) >= std::uint64_t(1) << 63;
    if(has_shape && is_odd != (pass % 2 == 1)) {
      ++counts_[waits];
      return own;
    }
    std::map<std::uint32_t, std::int64_t> candidate;
    f.for_each_neighbor(i, [&](std::uint32_t j) {
      const std::uint32_t t = label[j];
      if(t >= first_mark || t == own || !f.fits(t, i))
        return;
      const bool is_same =
        has_shape && shape_[own].plane_number >= 0 && shape_[own].plane_number == shape_[t].plane_number;
      counts_[stays_in_plane] += is_same;
      if(!is_same)
        candidate[t] = worth(label, i, t);
    });
    if(has_shape)
      candidate[own] = worth(label, i, own);
    std::uint32_t best = own;
    std::int64_t most = std::numeric_limits<std::int64_t>::min();
    for(const auto& c : candidate) { // by rising id
      counts_[is_tied] += c.second == most;
      if(c.second > most) {
        best = c.first;
        most = c.second;
      }
    }
    counts_[moves] += has_shape && best != own;
    counts_[joins] += !has_shape && best < first_mark;
    return best;
  }

  const bool is_of_one_plane_; // relations say so of twins
  Counts& counts_;
  std::vector<Shape> shape_;        // before the first pass
  std::vector<Plane> plane_;        // of the last call
  std::vector<std::int64_t> bonus_; // by shape
};

// From these labels, again from where it ended, then after others have changed labels and planes.
std::vector<Call> three_calls(Slow_assignment& slow, const Labels& before)
{
  slow.forget();
  std::vector<Call> calls = {slow.assign(before)};
  calls.push_back(slow.assign(calls[0].after));
  Labels changed = calls[1].after;
  for(std::size_t i = 0; i < changed.size(); i += 97)
    changed[i] = i % 2 == 0 ? free_label : before[i];
  const std::vector<Plane> plane = slow.f.plane;
  for(std::size_t s = 0; s < plane.size(); s += 5)
    slow.f.plane[s].d += slow.f.tolerance.distance / 3;
  calls.push_back(slow.assign(changed));
  slow.f.plane = plane;
  return calls;
}

// The moments of the points of the labels. Boxes hold the points of before, too.
void check_shapes(const std::vector<Shape>& got, const std::vector<Shape>& before, const std::vector<Shape>& expected,
                  const std::string& where)
{
  for(std::size_t s = 0; s < got.size(); ++s) {
    const std::string at = where + ", shape " + std::to_string(s);
    CHECK_AT(are_equal(got[s].moments, expected[s].moments), at + ": moments");
    for(int a = 0; a < 3 && got[s].is_live(); ++a)
      CHECK_AT(got[s].box.low[a] <= expected[s].box.low[a] && got[s].box.high[a] >= expected[s].box.high[a],
               at + ": box");
    CHECK_AT(!got[s].history.is_fitted || are_equal(got[s].moments, before[s].moments), at + ": is fitted");
  }
}

// No interior point has a neighbor in another shape. Returns how many others are not interior.
std::size_t check_interior(const Fixture& f, const std::vector<std::uint8_t>& state, const Labels& label,
                           const std::string& where)
{
  std::size_t missing = 0;
  for(std::uint32_t i = 0; i < label.size(); ++i) {
    bool has_other = false;
    f.for_each_neighbor(i, [&](std::uint32_t j) { has_other |= label[j] < first_mark && label[j] != label[i]; });
    const bool is_interior = (state[i] & interior_bit) != 0;
    CHECK_AT(!has_other || !is_interior, where + ": interior bit of point " + std::to_string(i));
    missing += !has_other && !is_interior;
  }
  return missing;
}

// By one object.
template <class Backend>
void check_calls(Backend& backend, const Slow_assignment& slow, const std::vector<Call>& calls, const std::string& name)
{
  Labeled_cloud<Backend> points(backend);
  take_cloud(slow.f, points);
  points.cloud.first = slow.first;
  Assignment<Backend> assign(points);
  for(std::size_t c = 0; c < calls.size(); ++c) {
    const std::string where = name + ", call " + std::to_string(c);
    const std::vector<Shape> before = slow.shapes_of(calls[c].before);
    set_labels(points, calls[c].before, slow.f.state);
    Shape_table<Backend> shapes = make_table(backend, before);
    shapes.plane = to_buffer(backend, calls[c].plane);
    assign(shapes, slow.options);
    check_lists(to_vector(backend, points.label(), calls[c].after.size()), calls[c].after, where + ": labels");
    check_shapes(to_vector(backend, shapes.table()), before, slow.shapes_of(calls[c].after), where);
    CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), where + ": deltas that stay");
    const auto state = to_vector(backend, points.state(), slow.f.state.size());
    const std::size_t missing = check_interior(slow.f, state, calls[c].after, where);
    CHECK_AT(calls[0].before != slow.f.label || c > 0 || 4 * missing <= state.size(), where + ": few interior points");
  }
}

// All passes, from the first labels; from few points, whose shapes spread from block to block; and from labels of
// which few change, in one of the halves, so that most blocks are not visited.
void check_assignments(Slow_assignment& slow, Twins twins)
{
  const auto flipped = [&](Labels labels, std::size_t from, std::size_t step) {
    for(std::size_t i = from; i < labels.size(); i += step)
      if((labels[i] ^ 1) < slow.f.plane.size())
        labels[i] ^= 1;
    return labels;
  };
  std::vector<std::vector<Call>> all = {
    three_calls(slow, twins == Twins::none ? slow.f.label : flipped(slow.f.label, 0, 3))}; // points of each other
  Labels few(slow.f.label.size(), free_label);
  for(std::size_t i = 0; i < few.size(); i += 500)
    few[i] = all[0][0].before[i];
  all.push_back(three_calls(slow, few));
  for(std::size_t from : {0u, 1u})
    all.push_back(three_calls(slow, flipped(all[0][0].after, from, 301)));
  on_body_backends([&](auto backend, const std::string& name) {
    for(std::size_t i = 0; i < all.size(); ++i)
      check_calls(backend, slow, all[i], name + ", " + slow.f.name + ", labels " + std::to_string(i));
  });
}

// As the only rank, and as one after others. Of equal shapes a point chooses that of the smaller id.
BOOST_AUTO_TEST_CASE(assignments)
{
  for(const Fixture& f : fixtures()) {
    Counts counts = {};
    for(const auto& [first, twins] :
        {std::make_pair(0u, Twins::none), std::make_pair(0xfffffff1u, Twins::of_two_planes),
         std::make_pair(5u, Twins::of_one_plane)}) {
      Slow_assignment slow(f, first, twins, counts);
      check_assignments(slow, twins);
    }
    for(std::size_t kind = 0; kind < kinds && f.cloud.size > 1000; ++kind)
      CHECK_AT(counts[kind] > 20, f.name + ", kind " + std::to_string(kind) + ": " + std::to_string(counts[kind]));
  }
}

BOOST_AUTO_TEST_SUITE_END()
