// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What detect_planes writes of random scenes: polygons, whose corners are on their planes, and whose rings are simple and
// nested in the very numbers that are written.
//   test_program --run_test=test_outputs -- SEED COUNT   other scenes, from SEED on

#include "testing/property_case.h"

#include "output/writers.h"

#include <CGAL/Shape_regularization_tandem/shapes_of_planes.h>

#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <cmath>

BOOST_AUTO_TEST_SUITE(test_outputs)

using program::Point_set;
using Program_kernel = program::Kernel;
using Flat = Program_kernel::Point_2;
using Ring = std::vector<Flat>;

struct Output_case {
  std::string name;
  Point_set points;
  program::Shapes shapes;
};

struct Totals {
  std::size_t with_polygons = 0, polygons = 0, points = 0, inside = 0;
};

// The outlines of a shape in two coordinates, without the one along which the plane is steepest: simplicity is decided of
// the very numbers, by exact predicates.
class Outline_check {
public:
  Outline_check(const Output_case& c, const program::Shape_areas& areas, std::size_t s)
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
  using Point = Program_kernel::Point_3;

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
      return Program_kernel::Segment_2(ring[i], ring[(i + 1) % ring.size()]);
    };
    for_each_ring([&](const std::vector<Ring>& own, const Ring& a) {
      const bool is_hole = &a != &own.front(),
                 is_simple = a.size() >= 3 && CGAL::is_simple_2(a.begin(), a.end(), Program_kernel());
      expect(is_simple, "a ring touches or crosses itself");
      expect(!is_simple || CGAL::orientation_2(a.begin(), a.end(), Program_kernel()) ==
                             (is_hole ? CGAL::CLOCKWISE : CGAL::COUNTERCLOCKWISE),
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
    return CGAL::bounded_side_2(ring.begin(), ring.end(), p, Program_kernel()) == side;
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
      const Point p = case_.points.point(*(case_.points.begin() + std::ptrdiff_t(i)));
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

  const Output_case& case_;
  const program::Shape_areas& areas_;
  std::size_t s_;
  const program::Shapes::Coefficients& c_;
  int steepest_ = 0;
  std::vector<std::vector<Ring>> polygons_; // the outer ring first
  long double largest_square_ = 0;
};

void check_outputs(const Output_case& c, Totals& totals)
{
  try {
    const program::Shape_areas areas = program::Described_shapes(c.points, c.shapes, {0, 0, 1}).areas();
    for(std::size_t s = 0; s < c.shapes.number_of_shapes(); ++s)
      Outline_check(c, areas, s).run(totals);
  } catch(const std::exception& e) {
    CHECK_AT(false, c.name + ": " + e.what());
  }
}

// --- Scenes

Output_case case_of(const std::string& name, const Cloud& cloud, const Shapes& shapes)
{
  Output_case result = {name, {}, program::Shapes(shapes.data())};
  result.points.add_normal_map();
  for(const auto& [p, n] : cloud)
    result.points.insert(Program_kernel::Point_3(p.x(), p.y(), p.z()), Program_kernel::Vector_3(n.x(), n.y(), n.z()));
  return result;
}

// All points in one shape.
Output_case case_of_plane(const std::string& name, const Cloud& cloud, const program::Shapes::Coefficients& plane)
{
  const std::vector<program::Shapes::Coefficients> planes = {plane};
  const auto list = CGAL::Tandem::parameters::settings(make_parameters(1, 3)).point_map(First<Kernel>());
  return case_of(name, cloud, CGAL::Tandem::shapes_of_planes<CGAL::Sequential_tag>(planes, cloud, list));
}

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
    check_outputs(case_of_plane("far, run " + std::to_string(run), cloud, {n.x, n.y, n.z, offset}), totals);
  }
  CHECK(totals.with_polygons > runs / 5);
}

BOOST_AUTO_TEST_CASE(random_scenes)
{
  Totals t;
  const std::uint64_t first = argument(1, 1), count = argument(2, is_sanitized ? 10 : 60);
  for(std::uint64_t seed = first; seed < first + count; ++seed) {
    const Property_case c = Case_maker(seed).make();
    try {
      check_outputs(case_of(c.name, c.cloud, detect(c.cloud, c.parameters, c.given)), t);
    } catch(const CGAL::Tandem::Parameter_error&) {
    } // too wide: test_properties
  }
  CHECK(count == 1 || (t.polygons > 0 && double(t.inside) > .8 * double(t.points)));
}

BOOST_AUTO_TEST_SUITE_END()
