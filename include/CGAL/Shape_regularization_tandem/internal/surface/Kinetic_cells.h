// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells of CGAL's kinetic space partition: the hull of the points of each plane grows in it until it meets another
// one. Nothing is rounded before all cells are known. What CGAL prints meanwhile is not shown.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_KINETIC_CELLS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_KINETIC_CELLS_H

#include <CGAL/Shape_regularization_tandem/internal/surface/Plane_coverage.h>

#include <CGAL/Kinetic_space_partition_3.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

class Silenced_stream {
public:
  explicit Silenced_stream(std::ostream& stream)
    : stream_(stream), precision_(stream.precision()), previous_(stream.rdbuf(text_.rdbuf()))
  {}
  ~Silenced_stream()
  {
    stream_.rdbuf(previous_);
    stream_.precision(precision_);
  }
  Silenced_stream(const Silenced_stream&) = delete;
  Silenced_stream& operator=(const Silenced_stream&) = delete;

private:
  std::ostream& stream_;
  std::ostringstream text_;
  std::streamsize precision_;
  std::streambuf* previous_;
};

class Kinetic_cells {
public:
  Kinetic_cells(const std::vector<Plane_coverage>& planes, const CGAL::Bbox_3& box)
    : center_((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2)
  {
    std::frexp(extent_of(box), &exponent_);
    for(const double first_angle : {.1, .2, .3, .4}) // none is along a symmetric polygon
      if(make_cells(planes, box, first_angle))
        return;
    throw std::runtime_error("The kinetic space partition of CGAL fails at these planes: ask for fewer of them by "
                             "maximum_number_of_planes, or take the default partition.");
  }

  const Cells& cells() const { return cells_; }

private:
  struct No_partition {};
  using Partition = CGAL::Kinetic_space_partition_3<Kernel>;
  using Exact = Partition::Intersection_kernel;
  using Complex = CGAL::Linear_cell_complex_for_combinatorial_map<3, 3, CGAL::Linear_cell_complex_traits<3, Exact>,
                                                                  Partition::Linear_cell_complex_min_items>;
  using Dart = Complex::Dart_descriptor;                    // of an edge of a facet, on one side of it
  static constexpr std::size_t number_of_intersections = 1; // a polygon grows until it meets as many others
  static constexpr int number_of_directions = 8;

  // Where the box is about the origin, and has an extent of about 1.
  Point in(const Point& p) const
  {
    const Vector v = p - center_;
    return Point(std::ldexp(v.x(), -exponent_), std::ldexp(v.y(), -exponent_), std::ldexp(v.z(), -exponent_));
  }

  Point out(const Exact::Point_3& p) const
  {
    const Exact::FT unit(std::ldexp(1., exponent_));
    return Point(CGAL::to_double(p.x() * unit + center_.x()), CGAL::to_double(p.y() * unit + center_.y()),
                 CGAL::to_double(p.z() * unit + center_.z()));
  }

  // CGAL fails, seldom, at polygons of ordinary planes, and not at those with other corners in them.
  bool make_cells(const std::vector<Plane_coverage>& planes, const CGAL::Bbox_3& box, double first_angle)
  try {
    plane_of_input_.clear();
    cells_ = Cells();
    exact_.clear();
    numbers_.clear();
    facets_.clear();
    make_partition(planes, box, first_angle);
    check();
    return true;
  } catch(const CGAL::Failure_exception&) {
    return false;
  } catch(const No_partition&) {
    return false;
  }

  // Corners where the hull goes farthest in each of some directions, and a little beyond it. CGAL drops corners at which
  // a polygon turns by little, which would be all of those of a round one; and of a symmetric one corners grow along
  // lines that end exactly where planes meet, at which its assertions fail by rounding.
  static std::vector<Point> corners_of(const Plane_coverage& plane, double first_angle)
  {
    const CGAL::Bbox_2 box = CGAL::bbox_2(plane.hull().begin(), plane.hull().end());
    const double beyond = .001 * (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
    std::vector<Point> result;
    for(int i = 0; i < number_of_directions; ++i) {
      const double angle = first_angle + 2 * CGAL_PI * i / number_of_directions;
      const Kernel::Vector_2 direction(std::cos(angle), std::sin(angle));
      const auto farthest = std::max_element(plane.hull().begin(), plane.hull().end(),
                                             [&](const auto& p, const auto& q) { return (q - p) * direction > 0; });
      result.push_back(plane.raised(*farthest + beyond * direction));
    }
    return result;
  }

  void make_partition(const std::vector<Plane_coverage>& planes, const CGAL::Bbox_3& box, double first_angle)
  {
    const Silenced_stream remarks(std::cout), errors(std::cerr);
    Partition partition;
    const CGAL::Bbox_3 inserted = insert(planes, first_angle, partition);
    // More polygons than this size would make CGAL cut the space by an octree, whose planes would be walls.
    partition.initialize(
      CGAL::parameters::max_octree_node_size(planes.size()).bbox_dilation_ratio(dilation(inserted, box)));
    partition.partition(number_of_intersections);
    Complex complex;
    partition.get_linear_cell_complex(complex);
    cells_.cells.resize(partition.number_of_volumes());
    add_cells(complex);
  }

  // Returns the box of the polygons. CGAL leaves out those that have the plane of another one.
  CGAL::Bbox_3 insert(const std::vector<Plane_coverage>& planes, double first_angle, Partition& partition)
  {
    CGAL::Bbox_3 result;
    for(std::size_t p = 0; p < planes.size(); ++p) {
      std::vector<Point> corners;
      for(const Point& corner : corners_of(planes[p], first_angle)) {
        corners.push_back(in(corner));
        result += corner.bbox();
      }
      std::vector<std::size_t> loop(corners.size());
      std::iota(loop.begin(), loop.end(), std::size_t(0));
      partition.insert(corners, std::vector<std::vector<std::size_t>>(1, loop));
      if(partition.input_planes().size() > plane_of_input_.size())
        plane_of_input_.push_back(int(p));
    }
    return result;
  }

  // By which the box of the polygons is about as large as the box that is to be cut, and larger than the polygons.
  static double dilation(const CGAL::Bbox_3& polygons, const CGAL::Bbox_3& box)
  {
    double result = 1.001;
    for(int axis = 0; axis < 3; ++axis)
      result = (std::max)(result, (box.max(axis) - box.min(axis)) / (polygons.max(axis) - polygons.min(axis)));
    return (std::min)(result, 1.1);
  }

  void add_cells(Complex& complex)
  {
    const auto cells = complex.one_dart_per_cell<3>();
    for(auto c = cells.begin(); c != cells.end(); ++c) {
      const Dart of_cell = complex.dart_descriptor(*c);
      const int cell = int(complex.info<3>(of_cell).volume_id);
      fail_unless(cell >= 0 && std::size_t(cell) < cells_.cells.size());
      std::vector<std::vector<int>> loops;
      std::vector<int> planes;
      const auto facets = complex.one_dart_per_incident_cell<2, 3>(of_cell);
      for(auto f = facets.begin(); f != facets.end(); ++f) {
        const Dart first = complex.dart_descriptor(*f);
        const int input = int(complex.info<2>(first).input_polygon_index);
        fail_unless(input < int(plane_of_input_.size()));
        planes.push_back(input < 0 ? none : plane_of_input_[std::size_t(input)]);
        loops.emplace_back();
        Dart d = first;
        do {
          loops.back().push_back(number_of(complex.point(d)));
          d = complex.beta<1>(d);
        } while(d != first);
      }
      const Exact::Point_3 middle = middle_of(loops);
      for(std::size_t f = 0; f < loops.size(); ++f)
        add_facet(loops[f], planes[f], cell, middle);
    }
  }

  int number_of(const Exact::Point_3& p)
  {
    const auto added = numbers_.emplace(p, int(exact_.size()));
    if(added.second) {
      exact_.push_back(p);
      cells_.points.push_back(out(p));
    }
    return added.first->second;
  }

  const Exact::Point_3& exact(int vertex) const { return exact_[std::size_t(vertex)]; }

  // A point within a convex cell.
  Exact::Point_3 middle_of(const std::vector<std::vector<int>>& loops) const
  {
    std::set<int> vertices;
    for(const std::vector<int>& loop : loops)
      vertices.insert(loop.begin(), loop.end());
    Exact::Vector_3 sum = CGAL::NULL_VECTOR;
    for(int v : vertices)
      sum = sum + (exact(v) - CGAL::ORIGIN);
    return CGAL::ORIGIN + sum / Exact::FT(int(vertices.size()));
  }

  // Of the side of one of its cells.
  void add_facet(std::vector<int> loop, int plane, int cell, const Exact::Point_3& middle)
  {
    std::vector<int> key = loop;
    std::sort(key.begin(), key.end());
    const auto added = facets_.emplace(key, int(cells_.facets.size()));
    const int f = added.first->second;
    cells_.cells[std::size_t(cell)].push_back(f);
    if(!added.second) {
      fail_unless(cells_.facet(f).front == none);
      cells_.facets[std::size_t(f)].front = cell;
      return;
    }
    std::size_t i = 2;
    while(i + 1 < loop.size() && CGAL::collinear(exact(loop[0]), exact(loop[1]), exact(loop[i])))
      ++i;
    if(CGAL::orientation(exact(loop[0]), exact(loop[1]), exact(loop[i]), middle) == CGAL::POSITIVE)
      std::reverse(loop.begin(), loop.end());
    cells_.facets.push_back({loop, plane, cell, none});
  }

  // Each cell is closed.
  void check() const
  {
    fail_unless(!cells_.cells.empty());
    for(std::size_t c = 0; c < cells_.cells.size(); ++c) {
      std::map<std::pair<int, int>, int> balance;
      fail_unless(cells_.cells[c].size() > 3);
      for(int f : cells_.cells[c]) {
        const Facet& facet = cells_.facet(f);
        fail_unless((facet.plane != none) == (facet.front != none) && facet.front != facet.behind);
        for_each_edge(facet.vertices, [&](int u, int v) {
          const bool is_behind = facet.behind == int(c);
          fail_unless(balance.emplace(is_behind ? std::make_pair(u, v) : std::make_pair(v, u), 0).second);
        });
      }
      for(const auto& edge : balance)
        fail_unless(balance.count({edge.first.second, edge.first.first}) > 0);
    }
  }

  static void fail_unless(bool condition)
  {
    if(!condition)
      throw No_partition();
  }

  Point center_;
  int exponent_ = 0;
  std::vector<int> plane_of_input_; // of each polygon that CGAL took
  Cells cells_;
  std::vector<Exact::Point_3> exact_; // of the vertices
  std::map<Exact::Point_3, int> numbers_;
  std::map<std::vector<int>, int> facets_; // by their vertices in ascending order
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_KINETIC_CELLS_H
