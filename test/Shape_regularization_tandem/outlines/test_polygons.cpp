// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The polygons of shapes: corners are on their planes, and rings are simple and nested in the very numbers that users get,
// of all sorts of points in a plane and of random scenes. The parts and holes of known points. And the work that the
// borders between many shapes are.
//   test_outlines --run_test=test_polygons -- SEED COUNT   other random scenes, from SEED on

#include "testing/property_case.h"

#include <CGAL/Shape_regularization_tandem/models/outlines/Border_finder.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_draft.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_triangulation.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/shapes_of_planes.h>

#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <cmath>
#include <string>

BOOST_AUTO_TEST_SUITE(test_polygons)

namespace outlines = CGAL::Tandem::internal::outlines;
using Areas = CGAL::Tandem::Shape_polygons_3<Kernel>;
using Exact = outlines::Kernel; // of the predicates
using Flat = Exact::Point_2;
using Ring = std::vector<Flat>;

struct Case {
  std::string name;
  Cloud cloud;
  Shapes shapes;
};

struct Totals {
  std::size_t with_polygons = 0, polygons = 0, points = 0, inside = 0;
};

// The outlines of a shape in two coordinates, without the one along which the plane is steepest: simplicity is decided of
// the very numbers, by exact predicates.
class Outline_check {
public:
  Outline_check(const Case& c, const Areas& areas, std::size_t s)
    : case_(c), areas_(areas), s_(s), c_(c.shapes.coefficients(s))
  {
    for(int k = 1; k < 3; ++k)
      if(std::fabs(c_[std::size_t(k)]) > std::fabs(c_[std::size_t(steepest_)]))
        steepest_ = k;
    for(const auto& polygon : areas.polygons(s)) {
      polygons_.push_back({ring_of(polygon.outer)});
      for(const auto& hole : polygon.holes)
        polygons_.back().push_back(ring_of(hole));
    }
  }

  void run(Totals& totals)
  {
    check_rings();
    check_areas();
    check_points(totals);
  }

private:
  using Loop = CGAL::Tandem::Indexed_polygon::Loop;
  using Point = Kernel::Point_3;

  void expect(bool is_true, const char* what) const
  {
    CHECK_AT(is_true, case_.name + ", shape " + std::to_string(s_) + ": " + what);
  }

  // Counterclockwise about the normal where the loop is.
  Flat flat(double x, double y) const { return c_[std::size_t(steepest_)] < 0 ? Flat(y, x) : Flat(x, y); }
  Flat flat(const Point& p) const { return flat(p[(steepest_ + 1) % 3], p[(steepest_ + 2) % 3]); }

  // To the rounding of the coordinates.
  long double height(const Point& p, long double& size) const
  {
    long double sum = c_[3];
    size = std::fabs(sum);
    for(int k = 0; k < 3; ++k) {
      const long double term = static_cast<long double>(c_[std::size_t(k)]) * p[k];
      sum += term;
      size += std::fabs(term);
    }
    return sum;
  }

  Ring ring_of(const Loop& loop) const
  {
    Ring ring;
    for(std::uint32_t corner : loop) {
      long double size;
      const Point& p = areas_.points().at(corner);
      expect(std::fabs(height(p, size)) <= size * 0x1p-51L, "off the plane");
      ring.push_back(flat(p));
    }
    return ring;
  }

  // Rings are simple and have nothing in common. A hole is in its polygon, and in no other polygon or hole without the
  // other one of the two; so is a polygon.
  void check_rings() const
  {
    const auto edge = [](const Ring& ring, std::size_t i) {
      return Exact::Segment_2(ring[i], ring[(i + 1) % ring.size()]);
    };
    for_each_ring([&](const std::vector<Ring>& own, const Ring& a) {
      const bool is_hole = &a != &own.front(),
                 is_simple = a.size() >= 3 && CGAL::is_simple_2(a.begin(), a.end(), Exact());
      expect(is_simple, "a ring touches or crosses itself");
      expect(!is_simple ||
               CGAL::orientation_2(a.begin(), a.end(), Exact()) == (is_hole ? CGAL::CLOCKWISE : CGAL::COUNTERCLOCKWISE),
             "orientation");
      expect(!is_hole || is_in(own[0], a[0], CGAL::ON_BOUNDED_SIDE), "hole outside");
      int depth = 0;
      for_each_ring([&](const std::vector<Ring>& other, const Ring& b) {
        if(&a == &b)
          return;
        depth += is_in(b, a[0], CGAL::ON_BOUNDED_SIDE) ? (&b == &other.front() ? 1 : -1) : 0;
        for(std::size_t i = 0; i < a.size(); ++i)
          for(std::size_t j = 0; j < b.size(); ++j)
            expect(!CGAL::do_overlap(edge(a, i).bbox(), edge(b, j).bbox()) ||
                     !CGAL::do_intersect(edge(a, i), edge(b, j)),
                   "rings touch or cross");
      });
      expect(depth == is_hole, "nesting");
    });
  }

  // f(polygon, ring of it)
  template <class F>
  void for_each_ring(const F& f) const
  {
    for(const std::vector<Ring>& polygon : polygons_)
      for(const Ring& ring : polygon)
        f(polygon, ring);
  }

  static bool is_in(const Ring& ring, const Flat& p, CGAL::Bounded_side side)
  {
    return CGAL::bounded_side_2(ring.begin(), ring.end(), p, Exact()) == side;
  }

  static bool is_inside(const std::vector<Ring>& polygon, const Flat& p)
  {
    return !is_in(polygon[0], p, CGAL::ON_UNBOUNDED_SIDE) &&
           std::none_of(polygon.begin() + 1, polygon.end(),
                        [&](const Ring& hole) { return is_in(hole, p, CGAL::ON_BOUNDED_SIDE); });
  }

  long double area_of(const Ring& r)
  {
    long double sum = 0;
    for(std::size_t i = 1; i + 1 < r.size(); ++i) {
      const long double x = r[0].x(), y = r[0].y(), ax = r[i].x() - x, ay = r[i].y() - y;
      sum += ax * (r[i + 1].y() - y) - ay * (r[i + 1].x() - x);
      largest_square_ = (std::max)({largest_square_, ax * ax, ay * ay});
    }
    return sum / 2 / std::fabs(c_[std::size_t(steepest_)]);
  }

  // Of the rings, and of the triangles that fill them.
  void check_areas()
  {
    long double of_rings = 0, of_triangles = 0;
    for_each_ring([&](const std::vector<Ring>&, const Ring& ring) { of_rings += area_of(ring); });
    for(const auto& polygon : areas_.polygons(s_))
      for(const auto& t : polygon.triangles) {
        const Ring triangle = ring_of({t.begin(), t.end()});
        expect(CGAL::orientation(triangle[0], triangle[1], triangle[2]) == CGAL::LEFT_TURN, "a triangle");
        of_triangles += area_of(triangle);
      }
    const long double area = areas_.area(s_);
    for(long double sum : {of_rings, of_triangles})
      expect(std::fabs(sum - area) <= 1e-12L * (area + largest_square_), "area");
  }

  // A polygon has points of its shape in it, and most points are in a polygon.
  void check_points(Totals& totals) const
  {
    std::vector<std::size_t> inside(polygons_.size());
    for(std::size_t i : case_.shapes.points(s_)) {
      const Point p = case_.cloud[i].first;
      long double size;
      const double h = double(height(p, size));
      const Flat foot = flat({p.x() - h * c_[0], p.y() - h * c_[1], p.z() - h * c_[2]});
      for(std::size_t k = 0; k < polygons_.size(); ++k)
        inside[k] += is_inside(polygons_[k], foot);
    }
    for(std::size_t count : inside) {
      expect(count >= 3, "points in a polygon");
      totals.inside += count;
    }
    totals.points += polygons_.empty() ? 0 : case_.shapes.points(s_).size();
    totals.with_polygons += !polygons_.empty();
    totals.polygons += polygons_.size();
  }

  const Case& case_;
  const Areas& areas_;
  std::size_t s_;
  const CGAL::Tandem::Coefficients& c_;
  int steepest_ = 0;
  std::vector<std::vector<Ring>> polygons_; // the outer ring first
  long double largest_square_ = 0;
};

void check_case(const Case& c, Totals& totals)
{
  try {
    const Areas areas = CGAL::Tandem::polygons(c.shapes, c.cloud, CGAL::Tandem::parameters::point_map(First<Kernel>()));
    for(std::size_t s = 0; s < c.shapes.number_of_shapes(); ++s)
      Outline_check(c, areas, s).run(totals);
  } catch(const std::exception& e) {
    CHECK_AT(false, c.name + ": " + e.what());
  }
}

// All points in one shape.
Case case_of_plane(const std::string& name, const Cloud& cloud, const CGAL::Tandem::Coefficients& plane)
{
  const std::vector<CGAL::Tandem::Coefficients> planes = {plane};
  const auto list = CGAL::Tandem::parameters::settings(make_parameters(1, 3)).point_map(First<Kernel>());
  return {name, cloud, CGAL::Tandem::shapes_of_planes<CGAL::Sequential_tag>(planes, cloud, list)};
}

// --- Points in a plane

struct Result {
  double area;
  std::size_t pieces, holes;
};

Result outline_of(const std::vector<Flat>& points, const std::string& where)
{
  const outlines::Outline_limits limits;
  std::vector<outlines::Outline_vertex> vertices;
  std::vector<outlines::Polygon> polygons;
  CHECK_AT(outlines::make_polygons(outlines::Outline_triangulation(points).outline(limits), limits.tolerance, vertices,
                                   polygons),
           where);
  Result result = {0, polygons.size(), 0};
  for(const outlines::Polygon& polygon : polygons) {
    result.holes += polygon.holes.size();
    for(const auto& [a, b, c] : polygon.triangles)
      result.area += CGAL::area(vertices[a].point, vertices[b].point, vertices[c].point);
  }
  return result;
}

struct Rectangle {
  double x, y, width, height;
};

struct Generator {
  std::mt19937 random;
  double unit() { return random_unit(random); }

  void add(std::vector<Flat>& points, int n, const Rectangle& r)
  {
    for(int i = 0; i < n; ++i) {
      const double u = unit(), v = unit();
      points.emplace_back(r.x + r.width * u, r.y + r.height * v);
    }
  }
};

BOOST_AUTO_TEST_CASE(points_in_a_plane)
{
  Generator g{std::mt19937(5)};
  std::vector<Flat> step, apart, line, equal(50, Flat(1, 2)), crossed;
  g.add(step, 20000, {0, 0, 1, 1});
  g.add(step, 800, {1, 0, 1, 1}); // five times as far apart
  const Result one = outline_of(step, "density");
  CHECK_AT(one.pieces == 1 && one.holes == 0 && std::fabs(one.area / 2 - 1) < .05,
           std::to_string(one.pieces) + ' ' + std::to_string(one.holes) + ' ' + std::to_string(one.area));
  g.add(apart, 4000, {0, 0, 1, 1});
  g.add(apart, 4000, {1.2, 0, 1, 1});
  const Result two = outline_of(apart, "apart");
  CHECK_AT(two.pieces == 2 && two.holes == 0 && std::fabs(two.area / 2 - 1) < .05, std::to_string(two.pieces));
  g.add(apart, 3, {1.05, .1, .1, .8}); // stray points between them
  CHECK(outline_of(apart, "stray").pieces == 2);
  for(int i = 0; i < 100; ++i)
    line.emplace_back(.1 * i, .3 * i);
  for(const auto& points : {line, equal, std::vector<Flat>{}, std::vector<Flat>{{0, 0}, {1, 0}, {0, 1}}})
    CHECK(outline_of(points, "degenerate").pieces == 0);
}

// Clusters of all densities, lines, lattices and equal points.
BOOST_AUTO_TEST_CASE(random_points)
{
  Totals totals;
  for(unsigned run = 0; run < 60; ++run) {
    Generator g{std::mt19937(run)};
    std::vector<Flat> points;
    for(int i = 0; i < 6; ++i) {
      const int n = int(400 * g.unit());
      g.add(points, n, {g.unit(), g.unit(), g.unit() * g.unit(), g.unit() * g.unit()});
    }
    if(run % 3 == 0)
      for(int i = 0; i < 300; ++i)
        points.emplace_back(i % 20 * .05, i / 20 * .05);
    if(run % 4 == 0)
      points.insert(points.end(), points.begin(), points.begin() + 20);
    Cloud cloud;
    for(const Flat& p : points)
      add(cloud, {p.x(), p.y(), 0}, {0, 0, 1});
    check_case(case_of_plane("run " + std::to_string(run), cloud, {0, 0, 1, 0}), totals);
  }
  CHECK_AT(totals.polygons > 60, std::to_string(totals.polygons));
}

// --- Scenes

// So far from the origin that coordinates are rounded to a few tenths of the spacing, or less.
BOOST_AUTO_TEST_CASE(far_from_the_origin)
{
  scenes::Random random(3);
  Totals totals;
  constexpr int runs = is_sanitized ? 10 : 100;
  for(int run = 0; run < runs; ++run) {
    const scenes::Vec n = random.direction(), u = unit(cross(n, random.direction())), v = cross(n, u);
    const double width = 1e-9 * std::ldexp(20, run % 10), offset = -5e6 * (n.x + n.y + n.z);
    Cloud cloud;
    for(int cluster = 0; cluster < 6; ++cluster) { // of all densities, so that outlines nearly touch
      const double x = random.uniform(), y = random.uniform();
      const double dx = random.uniform() * random.uniform(), dy = random.uniform() * random.uniform();
      for(int i = 0; i < 200; ++i) {
        const double a = width * (x + dx * random.uniform()), b = width * (y + dy * random.uniform());
        add(cloud, add_scaled(add_scaled({5e6, 5e6, 5e6}, a, u), b, v), n);
      }
    }
    check_case(case_of_plane("far, run " + std::to_string(run), cloud, {n.x, n.y, n.z, offset}), totals);
  }
  CHECK(totals.with_polygons > runs / 5);
}

BOOST_AUTO_TEST_CASE(random_scenes)
{
  Totals t;
  const std::uint64_t first = argument(1, 1), count = argument(2, is_sanitized ? 10 : 60);
  on_random_cases(first, count, [&](const Property_case& c) {
    check_case({c.name, c.cloud, detect(c.cloud, c.parameters, c.given)}, t);
  });
  CHECK(count == 1 || (t.polygons > 0 && double(t.inside) > .8 * double(t.points)));
}

// --- The work

// What it is to find the borders of walls of 1 x 1 that stand on one floor, in rows, each in one plane.
double work(std::size_t walls)
{
  CGAL::Tandem::internal::Shapes_data data;
  data.parameters.maximum_distance = .01;
  data.coefficients = {{0, 0, 1, 0}};
  data.parallel_group = data.coplanar_group = {0};
  std::vector<outlines::Kernel::Point_3> points;
  std::vector<std::int32_t> labels;
  const double row = std::floor(std::sqrt(double(walls)));
  for(std::size_t i = 0; i < walls; ++i) {
    const double x = 2 * std::fmod(double(i), row), y = 2 * std::floor(double(i) / row);
    for(int k = 0; k < 64; ++k) {
      const double u = k % 8 / 7., v = k / 8 / 7.;
      points.emplace_back(x + u, y + v, 0);
      points.emplace_back(x + u, y, v);
      labels.insert(labels.end(), {0, std::int32_t(i + 1)});
    }
    data.coefficients.push_back({0, 1, 0, -y});
    data.parallel_group.push_back(1);
    data.coplanar_group.push_back(1 + int(y / 2));
  }
  data.shape_of = std::move(labels);
  data.is_flipped.resize(walls + 1);
  const outlines::Shapes shapes(data);
  const outlines::Unit unit(points, shapes);
  std::vector<outlines::Shape_points> all;
  for(std::size_t s = 0; s <= walls; ++s) {
    all.push_back({outlines::Plane_frame(shapes, s, unit.in(points[*shapes.points(s).begin()])), {}, {}, {}});
    for(std::uint32_t i : shapes.points(s))
      all.back().points.push_back(unit.in(points[i]));
    all.back().spacing.assign(all.back().points.size(), float(unit.in(1 / 7.)));
  }
  const outlines::Border_finder finder(shapes, unit, all);
  std::size_t comparisons = 0, borders = 0;
  for(std::size_t s = 0; s <= walls; ++s) {
    outlines::Straight_borders of_shape;
    borders += finder.pieces_of(s, of_shape).size();
    comparisons += of_shape.comparisons;
  }
  CHECK(borders > walls / 2);
  return double(comparisons);
}

// Where ten times as many shapes are, the work is ten times as much.
BOOST_AUTO_TEST_CASE(work_grows_with_the_shapes)
{
  constexpr int walls = is_sanitized ? 100 : 1000;
  const double few = work(walls), many = work(10 * walls);
  CHECK_AT(many < 11 * few, std::to_string(few) + ' ' + std::to_string(many));
}

BOOST_AUTO_TEST_SUITE_END()
