// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relations hold on while little changes: shapes keep the bits of their planes, whatever their ids are, but those
// that are new or have changed by themselves; and they are found anew when more has changed.

#undef NDEBUG

#include "testing/same_bits.h"
#include "testing/test_support.h"

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <random>

using namespace CGAL::Tandem::internal;

// Walls of two directions, each a little turned, in steps of the grid.
class Walls {
public:
  static constexpr int large = 20, points = 5000;

  Walls() : cloud(backend_) // which is empty: no point rejects anything
  {
    options.maximum_distance = 1500;
    options.regularity.angle_tolerance_deg = 8;
    options.regularity.maximum_offset = options.regularity.maximum_distance = 1500;
    options.minimum_regular_size = 10;
    options.minimum_related_size = 40;
    options.regularity_period = 1;
    for(int w = 0; w < large; ++w)
      add_wall(points);
  }

  // Returns its id.
  std::uint32_t add_wall(int n)
  {
    const std::uint32_t id = std::uint32_t(shapes.size), wall = std::uint32_t(offset_.size());
    std::vector<Shape> all = to_vector(backend_, shapes.table().data(), shapes.size);
    all.emplace_back();
    take_shapes(all);
    offset_.push_back(int(wall) * 20000);
    tilt_.push_back(int(random_() % 41) - 20); // thousandths
    add_points(id, wall, n);
    return id;
  }

  // Points of a wall that belong to the shape of that id.
  void add_points(std::uint32_t id, std::uint32_t wall, int n)
  {
    Shape& shape = shapes.table()[id];
    for(int i = 0; i < n; ++i) {
      const int u = int(random_() % 40000), v = int(random_() % 40000);
      const int w = offset_[wall] + u * tilt_[wall] / 1000 + int(random_() % 200);
      const Grid_point p = wall % 2 ? Grid_point{w, u, v, no_normal} : Grid_point{u, w, v, no_normal};
      shape.moments.add(p, 1);
      shape.box.add(p);
    }
    refit(shape);
  }

  void remove(std::uint32_t id) { shapes.table()[id].moments = Moments(); }

  // As where most ids have gone out of use.
  void renumber() { take_shapes(live()); }

  Shape_relations regularize(bool is_last, const Shape_relations& before)
  {
    Sample_memory<Sequential_backend> memory;
    return regularize_shapes(cloud, shapes, options, {0, is_last, memory}, before);
  }

  Regular_planes planes() const
  {
    Regular_planes result;
    for(const Shape& shape : live())
      result.push_back(shape.plane);
    return result;
  }

  // By rising id.
  std::vector<Shape> live() const
  {
    std::vector<Shape> result;
    std::copy_if(shapes.table().begin(), shapes.table().end(), std::back_inserter(result),
                 [](const Shape& shape) { return shape.is_live(); });
    return result;
  }

private:
  void take_shapes(const std::vector<Shape>& all)
  {
    shapes.size = all.size();
    shapes.table() = to_buffer(backend_, all);
  }

  Sequential_backend backend_;
  std::mt19937 random_{9};
  std::vector<int> offset_, tilt_; // by wall

public:
  Labeled_cloud<Sequential_backend> cloud;
  Shape_table<Sequential_backend> shapes;
  Options options = Options();
};

// The tables agree with the shapes. Those without an entry have no plane of the relations.
void check_tables(const Shape_table<Sequential_backend>& shapes, const Shape_relations& r, const std::string& where)
{
  CHECK_AT(r.relations.plane_of.size() == r.id.size() && r.relations.direction_of.size() == r.id.size(), where);
  std::vector<int> plane_number(shapes.size, -1);
  for(std::size_t i = 0; i < r.id.size(); ++i) {
    const Regular_plane& plane = r.relations.planes.at(std::size_t(r.relations.plane_of[i]));
    const Shape& shape = shapes.table()[r.id[i]];
    plane_number[r.id[i]] = r.relations.plane_of[i];
    CHECK_AT(is_same(plane, shape.plane), where + ": plane");
    check_equal(shape.entry, int(i), where + ": entry");
    CHECK_AT(plane.normal == r.relations.directions.at(std::size_t(r.relations.direction_of[i])),
             where + ": direction");
  }
  for(std::size_t id = 0; id < shapes.size; ++id)
    check_equal(shapes.table()[id].plane_number, plane_number[id], where + ": number of the plane");
}

std::size_t number_of_directions(const Regular_planes& planes)
{
  std::map<std::tuple<double, double, double>, int> directions;
  for(const Regular_plane& p : planes)
    ++directions[std::make_tuple(p.normal.x, p.normal.y, p.normal.z)];
  return directions.size();
}

// Few points more, other ids, shapes that change by themselves or are new; then so much that all is found anew. Returns
// the id of a wall that is too small for relations in the loop.
std::uint32_t check_loop(Walls& walls)
{
  const Shape_table<Sequential_backend>& shapes = walls.shapes;
  const std::uint32_t small = walls.add_wall(60), other = walls.add_wall(50);
  Shape_relations r = walls.regularize(false, {});
  check_tables(shapes, r, "found");
  Regular_planes before = walls.planes();
  CHECK(number_of_directions(before) < 6);

  walls.add_points(3, 3, 100); // a thousandth of all points
  CHECK(!is_same(shapes.table()[3].local, before[3]));
  r = walls.regularize(false, r);
  check_tables(shapes, r, "few points more");
  CHECK(are_same(walls.planes(), before));

  walls.remove(small);
  walls.renumber();
  before.erase(before.begin() + std::ptrdiff_t(small));
  r = walls.regularize(false, r);
  check_tables(shapes, r, "other ids");
  CHECK(are_same(walls.planes(), before));

  const std::uint32_t same = other - 1; // its id now
  walls.add_points(same, other, 20);    // much for it, little for all
  const std::uint32_t fresh = walls.add_wall(45), tiny = walls.add_wall(39);
  r = walls.regularize(false, r);
  check_tables(shapes, r, "others change");
  CHECK(r.id.size() == walls.live().size() - 1 && r.id.back() == fresh);
  for(std::uint32_t id : {same, fresh})
    CHECK(shapes.table()[id].plane.normal == canonical(shapes.table()[id].fit.normal));
  CHECK(is_same(shapes.table()[tiny].plane, shapes.table()[tiny].local));
  before.resize(Walls::large);
  Regular_planes after = walls.planes();
  after.resize(Walls::large);
  CHECK(are_same(after, before));

  walls.add_points(3, 3, 1000);
  walls.add_points(7, 7, 1200);
  walls.add_points(9, 9, 1200);
  walls.add_points(11, 11, 1100); // less than five percent in all
  r = walls.regularize(false, r);
  check_tables(shapes, r, "more points");
  Regular_planes kept = walls.planes();
  kept.resize(Walls::large);
  CHECK(are_same(kept, before));

  walls.add_points(4, 4, 800); // more than five percent in all
  r = walls.regularize(false, r);
  check_tables(shapes, r, "found anew");
  after = walls.planes();
  CHECK(number_of_directions(after) < 7);
  after.resize(Walls::large);
  CHECK(!are_same(after, before));
  return tiny;
}

// The end game starts on its own, and holds what it has found, also a shape that has changed much by itself.
void check_end_game(Walls& walls, std::uint32_t tiny)
{
  const Shape_table<Sequential_backend>& shapes = walls.shapes;
  const Shape_relations last = walls.regularize(true, {});
  check_tables(shapes, last, "last");
  CHECK(last.id.size() == walls.live().size());
  const Regular_planes before = walls.planes();
  walls.add_points(5, 5, 2500); // less than three percent
  walls.add_points(tiny, tiny + 1, 10);
  const std::uint32_t late = walls.add_wall(45);
  check_tables(shapes, walls.regularize(true, last), "last again");
  CHECK(shapes.table()[late].plane.normal == canonical(shapes.table()[late].fit.normal));
  Regular_planes after = walls.planes();
  after.resize(before.size());
  CHECK(are_same(after, before));
  walls.add_points(6, 6, 1500); // more than three percent in all
  check_tables(shapes, walls.regularize(true, last), "last anew");
  after = walls.planes();
  after.resize(before.size());
  CHECK(!are_same(after, before));
}

int main()
{
  Walls walls;
  check_end_game(walls, check_loop(walls));
  return report();
}
