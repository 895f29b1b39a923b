// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether written polygons are what the manual says of them. Rings are simple if they are in two of their coordinates,
// without the one along which the plane is steepest: that is decided of the very numbers, by exact predicates.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_POLYGON_CHECKER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_POLYGON_CHECKER_H

#include "written_polygons.h"

#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <cmath>

class Polygon_checker {
public:
  using Flat = program::Kernel::Point_2;
  using Flat_ring = std::vector<Flat>;
  using Violations = std::vector<std::string>;

  // Faces of meshes are counterclockwise as seen from the outward side, rings of GeoJSON as seen from above, or, if they
  // are upright, from where the normal of the plane points to.
  enum class Seen_from { above, outside };

  Polygon_checker(const program::Shapes& shapes, std::size_t s, Seen_from side = Seen_from::above)
    : c_(shapes.coefficients(s))
  {
    for(int k = 1; k < 3; ++k)
      if(std::fabs(c_[k]) > std::fabs(c_[steepest_]))
        steepest_ = k;
    const bool is_opposite = side == Seen_from::above ? c_[2] < -1e-9 : shapes.is_flipped(s);
    is_reversed_ = (c_[steepest_] < 0) != is_opposite;
  }

  // Of polygons with holes.
  Violations violations(const Written_shape& shape)
  {
    check_plane(shape);
    std::vector<Flat_ring> rings;
    long double sum = 0;
    for(const Written_polygon& polygon : shape.polygons)
      for(const Ring& ring : polygon.rings) {
        rings.push_back(flat(ring));
        sum += area(ring);
        const bool is_outer = &ring == &polygon.rings.front();
        expect(orientation(rings.back()) == (is_outer ? CGAL::COUNTERCLOCKWISE : CGAL::CLOCKWISE), "orientation");
      }
    check_apart(rings);
    if(found_.empty())
      check_nesting(shape);
    expect(is_close(sum, shape.area), "area");
    return found_;
  }

  // Of polygons without holes that cover the area.
  Violations violations_of_faces(const Written_shape& shape, double expected_area)
  {
    check_plane(shape);
    long double sum = 0;
    for(const Written_polygon& face : shape.polygons) {
      expect(face.rings.size() == 1 && face.rings[0].size() >= 3, "face");
      expect(orientation(flat(face.rings[0])) == CGAL::COUNTERCLOCKWISE, "orientation of a face");
      sum += area(face.rings[0]);
    }
    expect(is_close(sum, expected_area), "area of the faces");
    return found_;
  }

  // The point of the plane closest to a point, in the coordinates that decide; and whether it is in a polygon.
  Flat foot(const program::Kernel::Point_3& p) const
  {
    const long double height = c_[0] * static_cast<long double>(p.x()) + c_[1] * static_cast<long double>(p.y()) +
                               c_[2] * static_cast<long double>(p.z()) + c_[3];
    return flat({double(p.x() - height * c_[0]), double(p.y() - height * c_[1]), double(p.z() - height * c_[2])});
  }
  bool is_inside(const Written_polygon& polygon, const Flat& p) const
  {
    for(const Ring& ring : polygon.rings) {
      const CGAL::Bounded_side side = side_of(flat(ring), p);
      if(side == (&ring == &polygon.rings.front() ? CGAL::ON_UNBOUNDED_SIDE : CGAL::ON_BOUNDED_SIDE))
        return false;
    }
    return true;
  }

private:
  void expect(bool is_true, const char* what)
  {
    if(!is_true)
      found_.push_back(what);
  }

  Flat flat(const Position& p) const
  {
    const double x = p[(steepest_ + 1) % 3], y = p[(steepest_ + 2) % 3];
    return is_reversed_ ? Flat(y, x) : Flat(x, y);
  }
  Flat_ring flat(const Ring& ring) const
  {
    Flat_ring result;
    for(const Position& p : ring)
      result.push_back(flat(p));
    return result;
  }

  static CGAL::Bounded_side side_of(const Flat_ring& ring, const Flat& p)
  {
    return CGAL::bounded_side_2(ring.begin(), ring.end(), p, program::Kernel());
  }

  // At the lowest corner, where simple rings turn as they are oriented.
  static CGAL::Orientation orientation(const Flat_ring& ring)
  {
    const std::size_t n = ring.size(), i = std::size_t(std::min_element(ring.begin(), ring.end()) - ring.begin());
    return CGAL::orientation(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
  }

  long double area(const Ring& ring)
  {
    const Flat_ring r = flat(ring);
    long double sum = 0;
    for(std::size_t i = 1; i + 1 < r.size(); ++i) {
      const long double ax = static_cast<long double>(r[i].x()) - r[0].x(),
                        ay = static_cast<long double>(r[i].y()) - r[0].y();
      const long double bx = static_cast<long double>(r[i + 1].x()) - r[0].x(),
                        by = static_cast<long double>(r[i + 1].y()) - r[0].y();
      sum += ax * by - ay * bx;
      largest_square = (std::max)({largest_square, ax * ax, ay * ay});
    }
    return sum / 2 / std::fabs(c_[steepest_]);
  }
  bool is_close(long double a, long double b) const { return std::fabs(a - b) <= 1e-12L * (a + largest_square); }

  // To the rounding of the coordinates.
  void check_plane(const Written_shape& shape)
  {
    for(const Written_polygon& polygon : shape.polygons)
      for(const Ring& ring : polygon.rings)
        for(const Position& p : ring) {
          long double height = c_[3], size = std::fabs(c_[3]);
          for(std::size_t k = 0; k < 3; ++k) {
            height += static_cast<long double>(c_[k]) * p[k];
            size += std::fabs(static_cast<long double>(c_[k]) * p[k]);
          }
          expect(std::fabs(height) <= size * 0x1p-51L, "off the plane");
        }
  }

  void check_apart(const std::vector<Flat_ring>& rings)
  {
    for(std::size_t a = 0; a < rings.size(); ++a) {
      expect(CGAL::is_simple_2(rings[a].begin(), rings[a].end(), program::Kernel()),
             "a ring touches or crosses itself");
      for(std::size_t b = 0; b < a; ++b)
        for(std::size_t i = 0; i < rings[a].size(); ++i)
          for(std::size_t j = 0; j < rings[b].size(); ++j)
            expect(!do_meet(edge(rings[a], i), edge(rings[b], j)), "rings touch or cross");
    }
  }
  using Segment = program::Kernel::Segment_2;
  static Segment edge(const Flat_ring& ring, std::size_t i) { return {ring[i], ring[(i + 1) % ring.size()]}; }
  static bool do_meet(const Segment& e, const Segment& f)
  {
    return CGAL::do_overlap(e.bbox(), f.bbox()) && CGAL::do_intersect(e, f);
  }

  // Holes are inside of their polygon and outside of each other, polygons outside of others or in their holes.
  void check_nesting(const Written_shape& shape)
  {
    for(const Written_polygon& polygon : shape.polygons) {
      const Flat_ring outer = flat(polygon.rings[0]);
      for(std::size_t h = 1; h < polygon.rings.size(); ++h) {
        expect(side_of(outer, flat(polygon.rings[h][0])) == CGAL::ON_BOUNDED_SIDE, "hole outside");
        for(std::size_t g = 1; g < polygon.rings.size(); ++g)
          expect(g == h || side_of(flat(polygon.rings[g]), flat(polygon.rings[h][0])) == CGAL::ON_UNBOUNDED_SIDE,
                 "hole in a hole");
      }
      for(const Written_polygon& other : shape.polygons)
        expect(&other == &polygon || !is_inside(other, outer[0]), "polygon in another one");
    }
  }

  const program::Shapes::Coefficients& c_;
  std::size_t steepest_ = 0;
  bool is_reversed_;
  Violations found_;
  long double largest_square = 0;
};

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_POLYGON_CHECKER_H
