// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points go to the largest shape that explains them: the choice, and what becomes of points and shapes, against plain loops
// on several back ends.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/finish/reassign.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::Tandem::internal;

template <class Backend>
class Reassigned_points {
public:
  Reassigned_points(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f)
  {}

  void run()
  {
    for(bool marks_interior : {false, true})
      test_reassignment(marks_interior);
    test_take_chosen();
    test_take_chosen_of_shapes();
  }

private:
  // The distance of two planes along their normals, where they are nearest to a point.
  std::int64_t distance_of_planes(std::uint32_t s, std::uint32_t t, std::uint32_t i) const
  {
    const Plane &a = f_.plane[s], &b = f_.plane[t];
    const double cosine = double(a.nx) * b.nx + double(a.ny) * b.ny + double(a.nz) * b.nz;
    const std::int64_t e = signed_distance(a, f_.point[i]), f = signed_distance(b, f_.point[i]);
    return std::abs(cosine < 0 ? e + f : e - f);
  }

  // The largest of the shapes that are no layers beside the nearest one. Interior points stay, and points become
  // interior if that is asked for.
  void test_reassignment(bool marks_interior)
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<Shape> shape(f_.plane.size());
    std::vector<std::uint8_t> may_lose, state(n, 0);
    for(std::size_t s = 0; s < shape.size(); ++s) {
      shape[s].moments.count = std::int64_t(s * 7 % 10);
      may_lose.push_back(s % 3 != 0);
    }
    for(std::uint32_t i = 0; i < n; i += 9)
      state[i] = interior_bit | tried_seed_bit;
    std::vector<std::uint8_t> expected_state = state;
    std::vector<std::uint32_t> chosen(n), expected = f_.label;
    for(std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t own = f_.label[i];
      bool is_inside = own < first_mark;
      std::set<std::uint32_t> shapes = {own};
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = f_.label[q];
        is_inside = is_inside && t == own;
        if(t < first_mark && f_.fits(t, i))
          shapes.insert(t);
      });
      if(marks_interior && is_inside)
        expected_state[i] |= interior_bit;
      if(own >= first_mark || !may_lose[own] || i % 9 == 0)
        continue;
      std::set<std::pair<std::int64_t, std::uint32_t>> nearest, choice;
      for(std::uint32_t t : shapes)
        nearest.emplace(f_.distance(t, i), t);
      const std::int64_t epsilon = f_.tolerance.distance, least = nearest.begin()->first;
      for(std::uint32_t t : shapes)
        if(std::int64_t(f_.distance(t, i)) <= least + epsilon / 4 ||
           10 * distance_of_planes(nearest.begin()->second, t, i) <= 9 * epsilon)
          choice.emplace(-shape[t].moments.count, t);
      expected[i] = choice.begin()->second;
    }
    std::vector<std::int64_t> size;
    for(const Shape& s : shape)
      size.push_back(s.moments.count);
    backend_.for_each(n, Choose_largest{f_.cloud, f_.label.data(), state.data(), f_.plane.data(), size.data(),
                                        may_lose.data(), chosen.data(), f_.tolerance, marks_interior});
    check_lists(chosen, expected, name_ + ": reassignment");
    check_lists(state, expected_state, name_ + ": states after a reassignment");
    CHECK_AT(n < 100 || chosen != f_.label, name_ + ": nothing is reassigned");
  }

  // Every third point goes to the next shape.
  void test_take_chosen()
  {
    const std::uint32_t shapes = std::uint32_t(f_.plane.size());
    std::vector<std::uint32_t> label = f_.label, chosen = label;
    std::vector<std::uint8_t> state(label.size(), interior_bit | tried_seed_bit), expected_state = state;
    std::vector<Shared_moments> change(shapes), expected(shapes);
    for(std::uint32_t i = 0; i < f_.cloud.size; i += 3)
      if(label[i] < first_mark && shapes > 1) {
        chosen[i] = (label[i] + 1) % shapes;
        expected_state[i] = tried_seed_bit;
        add_point(expected[label[i]], f_.point[i], -1);
        add_point(expected[chosen[i]], f_.point[i], 1);
      }
    backend_.template for_each_cell<Moment_table>(
      f_.cells.size(),
      Apply_chosen<Backend>{f_.cloud, f_.cells.data(), chosen.data(), {label.data(), state.data()}, change.data()});
    check_lists(label, chosen, name_ + ": labels that were chosen");
    check_lists(state, expected_state, name_ + ": states of points that change");
    check_moments(change, expected, name_ + ": points that change");
  }

  // The same points, with the table of shapes. Boxes do not shrink; then nothing changes any more.
  void test_take_chosen_of_shapes()
  {
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, f_.label, f_.state);
    std::vector<std::uint32_t> chosen = f_.label;
    std::vector<Shape> shape = f_.shapes_of_labels(f_.plane.size());
    std::vector<Shared_moments> expected(shape.size());
    std::vector<char> is_other(shape.size(), 0);
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = f_.label[i];
      if(s >= first_mark)
        continue;
      expected[s].box.add(f_.point[i]);
      chosen[i] = i % 3 == 0 ? (s + 1) % std::uint32_t(shape.size()) : s;
      add_point(expected[chosen[i]], f_.point[i], 1);
      if(chosen[i] != s)
        is_other[s] = is_other[chosen[i]] = 1;
    }
    for(Shape& s : shape)
      s.history.set_fitted(true);
    Shape_table<Backend> shapes = make_table(backend_, shape);
    const bool is_any = chosen != f_.label;
    check_equal(take_chosen(points, shapes, chosen.data()), is_any, name_ + ": whether any label has changed");
    check_lists(to_vector(backend_, points.label(), chosen.size()), chosen, name_ + ": chosen labels");
    check_moments(shapes, expected, name_ + ": shapes of chosen labels");
    for(std::size_t s = 0; s < shape.size(); ++s)
      check_equal(shapes.table()[s].history.is_fitted(), is_other[s] == 0, name_ + ": shapes to be fitted");
    CHECK_AT(!take_chosen(points, shapes, chosen.data()), name_ + ": labels that are chosen already");
    check_moments(shapes, expected, name_ + ": shapes of the same labels");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

int main()
{
  test_on_all_backends<Reassigned_points>();
  return report();
}
