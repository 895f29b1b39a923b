// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of the bodies share: random points of the grid, sorted clouds with planes and labels, sums made the
// naive way, and a loop over back ends, of which one shuffles all that the concepts leave open.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BODY_FIXTURE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BODY_FIXTURE_H

#include "Shuffled_block.h"
#include "Thread_backend.h"
#include "test_support.h"

#include <CGAL/Tandem/internal/engine/prepare.h>
#include <CGAL/Tandem/internal/rounds/assign.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#endif

#include <set>

namespace CGAL::Tandem::internal {

// In [-2^bits, 2^bits).
inline std::int32_t random_coordinate(scenes::Random& random, int bits)
{
  const std::int64_t range = std::int64_t(1) << bits;
  return std::int32_t(std::int64_t(random.bits() % std::uint64_t(2 * range)) - range);
}

inline Grid_point random_point(scenes::Random& random, int bits)
{
  const scenes::Vec n = random.direction();
  return {random_coordinate(random, bits), random_coordinate(random, bits), random_coordinate(random, bits),
          encode_normal({n.x, n.y, n.z})};
}

// A sorted cloud, the true planes, and labels of which some are missing or wrong.
struct Fixture {
  std::string name;
  std::vector<Grid_point> point;
  std::vector<std::uint32_t> neighbor;
  std::vector<Range> cells;
  std::vector<Cell_shapes> lists; // of the labels below
  Cloud_view cloud;
  Tolerance tolerance;
  std::vector<Plane> plane;
  std::vector<std::uint32_t> label;
  std::vector<std::uint8_t> state;
  std::vector<std::uint8_t> level; // of tolerances of points; empty: all have that above

  std::uint8_t level_of(std::uint32_t i) const { return level.empty() ? std::uint8_t(0) : level[i]; }
  Tolerance tolerance_of(std::uint32_t i) const { return level.empty() ? tolerance : tolerance.at(level[i]); }
  bool fits(std::uint32_t s, std::uint32_t i) const { return internal::fits(plane[s], point[i], tolerance_of(i)); }

  std::vector<Cell_shapes> list_shapes(const std::vector<std::uint32_t>& labels) const
  {
    std::vector<Cell_shapes> result(cells.size());
    Sequential_backend().for_each_cell<List_scratch>(cells.size(),
                                                     List_shapes{cells.data(), labels.data(), result.data()});
    return result;
  }

  // Tolerances of points: most are those of the detection.
  void set_levels()
  {
    name += ", own tolerances";
    for(std::size_t i = 0; i < point.size(); ++i)
      level.push_back(std::uint8_t(i % 3 == 0 ? i % 23 : 0));
    cloud.level = cloud.surfels.level = level.data();
  }

  // So many shapes, with the points of their labels.
  std::vector<Shape> shapes_of_labels(std::size_t n) const { return shapes_of_labels(n, label); }

  std::vector<Shape> shapes_of_labels(std::size_t n, const std::vector<std::uint32_t>& label) const
  {
    std::vector<Shape> shape(n);
    for(std::uint32_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark) {
        shape[label[i]].moments.add(point[i], 1, level_of(i));
        shape[label[i]].box.add(point[i]);
      }
    return shape;
  }

  // f(neighbor) for each neighbor of i.
  template <class F>
  void for_each_neighbor(std::uint32_t i, F f) const
  {
    const std::uint32_t* row = cloud.row(i);
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
      f(row[j]);
  }

  std::uint64_t distance(std::uint32_t s, std::uint32_t i) const
  {
    const std::int64_t e = signed_distance(plane[s], point[i]);
    return std::uint64_t(e < 0 ? -e : e);
  }
};

// Gives it these points along the curve, and their neighbors. Returns their order.
inline std::vector<std::size_t> set_points(Fixture& f, const std::vector<Grid_point>& unsorted, int k,
                                           std::size_t cell_size)
{
  Sequential_backend backend;
  const Code_frame frame = make_code_frame(unsorted.data(), unsorted.size());
  auto sorted = sort_along_curve(backend, {unsorted.data(), unsorted.size()}, frame);
  f.cells = split_cells(backend, sorted, frame, cell_size);
  std::vector<std::size_t> order;
  for(const Host_sort_table::Entry& o : sorted) {
    order.push_back(o.index);
    f.point.push_back(unsorted[o.index]);
  }
  const std::uint32_t size = std::uint32_t(unsorted.size());
  f.neighbor.resize(size * std::size_t(k));
  find_neighbors(backend, f.point.data(), size, k, f.neighbor.data());
  f.cloud = {f.point.data(), f.neighbor.data(), size, k, {f.point.data(), nullptr, nullptr}};
  return order;
}

inline Fixture make_fixture(const std::string& name, std::size_t size, int k, std::size_t cell_size)
{
  const scenes::Scene scene = scenes::make_scene(name, scene_options(size, .001, .1));
  const double step = scene.diagonal / 1e6;
  std::vector<Grid_point> unsorted;
  for(std::size_t i = 0; i < size; ++i) {
    const scenes::Vec p = (1 / step) * scene.points[i], n = scene.normals[i];
    unsorted.push_back({std::int32_t(p.x), std::int32_t(p.y), std::int32_t(p.z), encode_normal({n.x, n.y, n.z})});
  }
  Fixture f;
  f.name = name;
  scenes::Random random(9);
  for(const scenes::Truth_face& face : scene.faces)
    f.plane.push_back(rounded({{face.normal.x, face.normal.y, face.normal.z}, -face.offset / step}));
  for(const std::size_t i : set_points(f, unsorted, k, cell_size)) {
    const std::uint64_t dice = random.bits() % 100;
    const std::int32_t truth = scene.label[i];
    f.label.push_back(dice < 5    ? std::uint32_t(random.bits() % f.plane.size())
                      : dice < 30 ? (dice < 8 ? locked_label : free_label)
                      : truth < 0 ? free_label
                                  : std::uint32_t(truth));
    f.state.push_back(std::uint8_t(random.bits() % 4));
  }
  f.lists = f.list_shapes(f.label);
  f.tolerance = make_tolerance(2500, cosine_deg(25));
  return f;
}

// Returns the largest number of points of a cell.
template <class Backend>
std::size_t take_cloud(const Fixture& f, Labeled_cloud<Backend>& points)
{
  points.cloud.k = f.cloud.k;
  points.cloud.point = to_buffer(points.backend, f.point);
  points.cloud.neighbor = to_buffer(points.backend, f.neighbor);
  points.cloud.has_levels = !f.level.empty();
  points.cloud.level = to_buffer(points.backend, f.level);
  points.cells = to_buffer(points.backend, f.cells);
  std::size_t cell_size = 0;
  for(const Range& cell : f.cells)
    cell_size = (std::max)(cell_size, std::size_t(cell.size()));
  return cell_size;
}

// Each point has the label, and the state if there are any.
template <class Backend>
void set_labels(Labeled_cloud<Backend>& points, const std::vector<std::uint32_t>& label,
                const std::vector<std::uint8_t>& state = {})
{
  points.start_labels();
  std::copy(label.begin(), label.end(), points.change_labels(false).label);
  std::copy(state.begin(), state.end(), points.state());
}

template <class Backend>
Shape_table<Backend> make_table(Backend& backend, const std::vector<Shape>& shape)
{
  Shape_table<Backend> shapes;
  shapes.size = shape.size();
  shapes.table() = to_buffer(backend, shape);
  return shapes;
}

// The shapes of a cell; of merged ones, some may be there twice. All that fit, where a list has overflown.
inline std::multiset<std::uint32_t> listed(const Cell_shapes& list)
{
  return std::multiset<std::uint32_t>(list.shape, list.shape + (std::min)(list.size, Cell_shapes::capacity));
}

template <class T>
void check_lists(const std::vector<T>& got, const std::vector<T>& expected, const std::string& name)
{
  const long at = first_difference(got, expected);
  CHECK_AT(at < 0, name + ": the first that differs is " + std::to_string(at));
}

// Cells follow each other, up to the end; none is empty or too large.
inline void check_ranges(const std::vector<Range>& cells, std::size_t end, std::size_t cell_size,
                         const std::string& name)
{
  std::uint32_t next = 0;
  for(const Range& cell : cells) {
    CHECK_AT(cell.first == next && cell.size() > 0 && cell.size() <= cell_size,
             name + ", cell at " + std::to_string(cell.first) + " of " + std::to_string(cell.size()));
    next = cell.last;
  }
  CHECK_AT(next == end, name + ": the cells end at " + std::to_string(next));
}

inline bool are_equal(const Moments& a, const Moments& b)
{
  return a.count == b.count && a.squared_tolerances == b.squared_tolerances && std::equal(a.sum, a.sum + 3, b.sum) &&
         std::equal(a.product, a.product + 6, b.product);
}

inline void check_moments(const std::vector<Shared_moments>& got, const std::vector<Shared_moments>& expected,
                          const std::string& name)
{
  for(std::size_t s = 0; s < got.size(); ++s) {
    const Box &p = got[s].box, &q = expected[s].box;
    CHECK_AT(are_equal(got[s].moments(), expected[s].moments()), name + ", moments of shape " + std::to_string(s));
    CHECK_AT(std::equal(p.low, p.low + 3, q.low) && std::equal(p.high, p.high + 3, q.high),
             name + ", box of shape " + std::to_string(s));
  }
}

// The same of the shapes of a table.
template <class Backend>
void check_moments(const Shape_table<Backend>& shapes, const std::vector<Shared_moments>& expected,
                   const std::string& name)
{
  std::vector<Shared_moments> got(shapes.size);
  for(std::size_t s = 0; s < shapes.size; ++s)
    atomic_add<Sequential_backend>(got[s], shapes.table()[s].moments, shapes.table()[s].box);
  check_moments(got, expected, name);
  CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), name + ": deltas that stay");
}

inline void add_point(Shared_moments& target, const Grid_point& p, int sign, std::uint8_t level = 0)
{
  Moments m;
  m.add(p, sign, level);
  Box box;
  box.add(p);
  atomic_add<Sequential_backend>(target, m, box);
}

// Some scenes; two of them again, where points have tolerances of their own.
inline const std::vector<Fixture>& fixtures()
{
  static const std::vector<Fixture> all = [] {
    std::vector<Fixture> made;
    for(int levels : {0, 1}) {
      made.push_back(make_fixture("house", 4000, 12, 8192)); // more shapes than a table of a cell has slots
      made.push_back(make_fixture("indoor", 6000, 16, 300));
      for(std::size_t i = 2; levels == 1 && i < made.size(); ++i)
        made[i].set_levels();
    }
    made.push_back(make_fixture("village", 9000, 8, 9000));
    made.push_back(make_fixture("cube", 12, 12, 64)); // rows that end early
    return made;
  }();
  return all;
}

// f(backend, name) for those that run bodies in different ways: on threads, and with shuffled lanes.
template <class F>
void on_body_backends(F f)
{
  f(Thread_backend(3), std::string("threads"));
  for(std::uint64_t seed : {1, 2})
    f(Shuffled_backend(seed), "shuffled " + std::to_string(seed));
}

// f(backend, name, fixture) for all of both.
template <class F>
void on_fixtures(F f)
{
  for(const Fixture& fixture : fixtures())
    on_body_backends([&](auto backend, const std::string& name) { f(backend, name + ", " + fixture.name, fixture); });
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BODY_FIXTURE_H
