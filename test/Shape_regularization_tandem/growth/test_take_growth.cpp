// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a pass of growth makes of the table of shapes, on several back ends: shapes that grow, start, or go out of use.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/growth/grow_shapes.h>

#include <algorithm>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_take_growth)

using namespace CGAL::Tandem::internal;

// Shapes with few or many ids out of use, and those that start in the pass. Each live one has some point before, and
// every fifth one gets no other.
struct Grown_shapes {
  static constexpr std::uint32_t size = 60, ids = 101;

  bool is_sparse;
  std::vector<Shape> shape; // before the pass, as the planes; some of the room may not be used
  std::vector<Plane> plane;
  std::vector<Shared_moments> delta;
  std::vector<std::uint32_t> label;
  std::size_t new_points = 0;

  Grown_shapes(const Fixture& f, bool is_sparse, std::uint32_t room)
    : is_sparse(is_sparse), shape(room), plane(room, marked_plane(99999)), delta(ids), label(f.label)
  {
    for(std::uint32_t id = 0; id < size; ++id) {
      shape[id].age = int(id % 11);
      shape[id].is_active = id % 2 == 0;
      shape[id].history.set_fitted(true);
      shape[id].history.set_linked(true);
      if(is_live(id))
        shape[id].moments.add({std::int32_t(id), 1, 2, no_normal}, 1);
      plane[id] = marked_plane(id);
    }
    for(std::uint32_t i = 0; i < label.size(); ++i) {
      const std::uint32_t id = i % ids;
      label[i] = is_live(id) || (id >= size && id % 4 == 2) ? id : f.label[i] >= first_mark ? f.label[i] : free_label;
      if(label[i] == id && id % 5 != 0) {
        add_point(delta[id], f.point[i], 1);
        ++new_points;
      } else if(label[i] == id && id >= size)
        label[i] = locked_label;
    }
  }

  static Plane marked_plane(std::uint32_t id) { return {0, 0, 0, id}; }

  bool is_live(std::uint32_t id) const { return id < size && (id % 3 == 1) == is_sparse; }

  // By new id: the id before.
  std::vector<std::uint32_t> old_ids() const
  {
    std::vector<std::uint32_t> old;
    for(std::uint32_t id = 0; id < ids; ++id)
      if(id < size ? is_live(id) || !is_sparse : is_any(delta[id]))
        old.push_back(id);
    return old;
  }
};

template <class Backend>
class Growth_passes {
public:
  Growth_passes(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    for(bool is_sparse : {false, true})
      for(bool has_room : {false, true})
        test(Grown_shapes(f_, is_sparse, has_room ? 500 : Grown_shapes::size));
  }

private:
  // Without room the tables have to grow.
  void test(const Grown_shapes& before)
  {
    const std::size_t room = before.shape.size();
    const std::string where =
      name_ + (before.is_sparse ? ": growth of few shapes" : ": growth of shapes") + ", room " + std::to_string(room);
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, before.label);
    Shape_table<Backend> shapes = make_table(backend_, before.shape);
    shapes.size = before.size;
    shapes.plane = to_buffer(backend_, before.plane);
    shapes.steps = filled_buffer(backend_, room, std::uint16_t(999));
    shapes.is_restarted = filled_buffer(backend_, room, std::uint8_t(1));
    shapes.delta = to_buffer(backend_, before.delta);
    check_equal(take_growth(points, shapes, before.ids), before.new_points, where + ": new points");
    const std::vector<std::uint32_t> old = before.old_ids();
    check_equal(shapes.size, old.size(), where + ": ids");
    CHECK_AT((std::min)({shapes.table().size(), shapes.plane.size(), shapes.steps.size(),
                         shapes.is_restarted.size()}) >= old.size(),
             where + ": room of the tables");
    std::vector<std::uint32_t> new_id(before.ids, no_index);
    for(std::uint32_t i = 0; i < old.size() && shapes.size == old.size(); ++i) {
      new_id[old[i]] = i;
      check_shape(shapes, i, before, old[i], where + ", shape " + std::to_string(old[i]));
    }
    std::vector<std::uint32_t> label = before.label;
    for(std::uint32_t& l : label)
      l = l < first_mark ? new_id[l] : l;
    check_lists(to_vector(backend_, points.label(), label.size()), label, where + ": labels");
    CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), where + ": deltas that stay");
  }

  void check_shape(const Shape_table<Backend>& shapes, std::uint32_t id, const Grown_shapes& all, std::uint32_t old,
                   const std::string& at)
  {
    const bool is_new = old >= all.size, is_active = is_any(all.delta[old]);
    Shape before = is_new ? Shape() : all.shape[old];
    before.moments += all.delta[old].moments();
    const Shape& s = shapes.table()[id];
    CHECK_AT(are_equal(s.moments, before.moments), at + ": moments");
    CHECK_AT(s.box.low[0] == all.delta[old].box.low[0] && s.box.high[2] == all.delta[old].box.high[2], at + ": box");
    check_equal(shapes.plane[id].d, is_new ? Plane().d : all.marked_plane(old).d, at + ": plane");
    check_equal(int(shapes.is_restarted[id]), 0, at + ": restart");
    const bool is_out_of_use = !is_new && !all.is_live(old);
    check_equal(s.age, before.age + !is_out_of_use, at + ": age");
    check_equal(int(shapes.steps[id]),
                is_out_of_use ? 0 : (std::min)(1 << (std::min)(s.age, 30), tuning::growth::maximum_steps),
                at + ": steps");
    if(!is_out_of_use)
      CHECK_AT((s.is_active != 0) == is_active && s.history.is_fitted() == !is_active &&
                 s.history.is_linked() == !is_active,
               at + ": changes");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

BOOST_AUTO_TEST_CASE(all_cases) { test_on_all_backends<Growth_passes>(); }

BOOST_AUTO_TEST_SUITE_END()
