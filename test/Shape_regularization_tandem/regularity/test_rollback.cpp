// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relations that points reject: shapes that keep their own fits, are tried again, or join a direction at the end.

#undef NDEBUG

#include "testing/rectangles.h"

#include <string>
#include <vector>

using namespace CGAL::Tandem::internal;

namespace {

void test_rollback()
{
  Shape_fits shapes;
  for(const Rectangle& r : tilted_box(5))
    shapes.push_back(make_shape(r));
  const Relations r = run(shapes, 0);
  check_tables(r, 6, "rollback");
  for(int i = 0; i < 6; ++i) {
    check_equal(r.is_rolled_back[i], 1, "rolled back, shape " + std::to_string(i));
    check(is_same(r.directions[r.direction_of[i]], canonical(shapes[i].fit.normal)), "keeps its local fit, shape", i);
  }
  check_equal(double(r.directions.size()), 6, "directions after rollback");

  // a fifth of the points may misfit, not more
  constexpr double allowed = tuning::verification::misfit_share;
  for(double share : {allowed, allowed + 0.001}) {
    Verify verify{shapes, 0};
    verify.share = [&](int i) { return i == 3 ? share : 0.0; };
    const Relations limit = regularize(shapes, std::vector<char>(6, 0), all_on(), verify);
    check_equal(limit.is_rolled_back[3], share > allowed, "rollback of shape 3");
    check_equal(limit.direction_of[2] == limit.direction_of[3], share <= allowed, "shape 3 is parallel to 2");
    check_equal(limit.direction_of[0], limit.direction_of[1], "shapes 0 and 1 stay parallel");
    check(verify.calls <= 7, "calls of verify", verify.calls, 7);
  }

  std::vector<char> is_excluded(6, 0);
  is_excluded[4] = 1;
  Verify verify{shapes};
  const Relations e = regularize(shapes, is_excluded, all_on(), verify);
  check(is_same(e.directions[e.direction_of[4]], canonical(shapes[4].fit.normal)), "an excluded shape keeps its fit");
  check_equal(e.is_rolled_back[4], 0, "an excluded shape is not rolled back");
  check_equal(double(e.directions.size()), 4, "directions with an excluded shape");
}

// Two large shapes and a small one turned by 4.3 degrees, which adds .87 epsilon: too much
// for a group, not for a leftover, as long as few points object.
void test_leftovers()
{
  auto directions = [](bool is_last, double share, double tilted_count) {
    Regularity_options o = all_on();
    o.is_last = is_last;
    const Shape_fits s = {
      make_shape({{0, 0, 1}, {0, 0, 0}}), make_shape({{0, 0, 1}, {0, 0, 50 * epsilon}}),
      make_shape({polar(0, 85.7), {90 * epsilon, 0, 0}, 20 * epsilon, 20 * epsilon, 0.2 * epsilon, tilted_count})};
    Verify verify{s, 1e-6};
    verify.share = [=](int) { return share; };
    const Relations r = regularize(s, std::vector<char>(3, 0), o, verify);
    check_tables(r, 3, "leftovers");
    check(is_same(r.directions[r.direction_of[0]], canonical(s[0].fit.normal)), "the large group is not turned");
    return double(r.directions.size());
  };
  check_equal(directions(false, 0.35, 400), 2, "directions while shapes grow");
  check_equal(directions(true, 0.35, 400), 1, "directions at the end");
  check_equal(directions(true, 0.45, 400), 2, "directions, too many points object");
  check_equal(directions(true, 0.35, 1900), 2, "directions, not worth a third of a mean shape");
}

// In the loop few rejected shapes keep their local planes, in the last step all are tried again.
void test_few_rejected()
{
  const auto have_one_direction = [](int rejected, bool is_last) {
    std::vector<Rectangle> rectangles;
    for(int i = 0; i < 130; ++i)
      rectangles.push_back({i < rejected ? polar(0, 84 - .1 * i) : Vector{0, 0, 1}, {i * 100 * epsilon, 0, 0}});
    Regularity_options o = all_on();
    o.is_last = is_last;
    const Relations r = run(rectangles, sine_deg(3), 1e30, o);
    check_tables(r, rectangles.size(), "few rejected");
    check(r.direction_of[1] != r.direction_of[rejected], "few rejected: not the others' direction");
    return r.direction_of[0] == r.direction_of[1];
  };
  check(!have_one_direction(2, false), "two of 130 rejected, in the loop");
  check(have_one_direction(3, false), "three of 130 rejected, in the loop");
  check(have_one_direction(2, true), "two of 130 rejected, in the last step");
}

// The one in the middle is not joined with the first, but then with the last: a rejected pair is not tried again.
void test_rejected_neighbors()
{
  std::vector<Rectangle> rectangles;
  for(int i = 0; i < 197; ++i)
    rectangles.push_back({{0, 0, 1}, {0, 0, (i + 100) * 100 * epsilon}});
  const int first = int(rectangles.size()), middle = first + 1, last = first + 2;
  for(const double offset : {0., .6, 1.})
    rectangles.push_back({{0, 0, 1}, {0, 0, offset * epsilon}});
  Regularity_options o = all_on();
  o.is_last = false;
  const Relations r = run(rectangles, 2, .25 * epsilon, o);
  check_tables(r, rectangles.size(), "rejected neighbors");
  check(r.plane_of[first] != r.plane_of[middle], "the first and the middle one have two planes");
  check(r.plane_of[middle] == r.plane_of[last], "the middle and the last one have one plane");
}

} // namespace

int main()
{
  test_rollback();
  test_leftovers();
  test_few_rejected();
  test_rejected_neighbors();
  return report();
}
