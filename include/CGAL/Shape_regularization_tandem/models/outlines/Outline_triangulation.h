// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outline of a shape, and the triangulation of its points in its plane that it comes
// from. Triangles whose circumscribed circle is small, compared with the spacing of the points there, are inside.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_vertex.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Straight_border.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

class Outline_triangulation {
public:
  // Fastest if points that are close in the sequence are close in the plane. Points that are closer to each other than
  // the resolution may be copies of one.
  explicit Outline_triangulation(const std::vector<Kernel::Point_2>& points, double resolution = 0);

  // Of each point: the median length of the edges at it, smoothed; 0 if all points are on a line. Edges cross the gaps
  // between scan lines, too. Copies have the spacing of their places.
  std::vector<float> spacings() const
  {
    std::vector<float> result;
    for(Vertex_handle v : vertices)
      result.push_back(v->info().spacing);
    return result;
  }

  // Of each point: the length of the second shortest edge at it, smoothed. So two directions count: along a scan line, it
  // is the distance of its points.
  std::vector<float> second_distances();

  void insert(const Straight_border& border, const Plane_frame& frame);

  // The points beyond a straight border take no part.
  void cut(std::size_t point) { vertices[point]->info().is_cut = true; }

  // Simple closed lines without common points, the inside to their left. None if all points are on a line. Vertices are
  // written as they are, and only those of straight borders have positions.
  std::vector<Outline_loop> outline(const Outline_limits& limits);

private:
  struct Vertex_info {
    int border = -1;   // position in border_vertices
    float spacing = 0; // 0: not of the points
    float measured = 0;
    bool is_cut = false;
  };
  struct Face_info {
    bool is_inside = false, is_beyond = false; // beyond a straight border
    int component = -1;
  };
  struct Border_vertex {
    Position position;
    bool is_corner;
    std::vector<int> borders;
    float reach;
  };
  using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<Vertex_info, Kernel>,
                                         CGAL::Triangulation_face_base_with_info_2<
                                           Face_info, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>>,
    CGAL::Exact_predicates_tag>;
  using Vertex_handle = Triangulation::Vertex_handle;
  using Face_handle = Triangulation::Face_handle;

  static constexpr int smoothing_rounds = 8;
  static constexpr double smallest_square = 0x1p-200; // of a spacing; coordinates are up to 1
  static constexpr std::size_t fewest_places = 20;    // of a piece

  template <class Number_of_shorter>
  void measure_spacings(Number_of_shorter number_of_shorter);
  void smooth_spacings();
  void take_spacings_of_places(const std::vector<Kernel::Point_2>& points, double resolution);
  Vertex_handle insert(const Border_vertex_position& position, const Straight_border& border, const Plane_frame& frame);
  void mark_inside(const Outline_limits& limits);
  void mark_beyond();
  bool is_inside(Face_handle f, double radius) const;
  std::vector<double> find_components();
  void drop_crumbs(const Outline_limits& limits);
  bool separate(Vertex_handle v);
  void separate_pieces();
  bool share_border(Vertex_handle u, Vertex_handle v, int* border) const;
  Outline_loop straight_loop(const std::vector<Vertex_handle>& loop) const;

  // f(a vertex that shares an edge with v)
  template <class Function>
  void for_each_neighbor(Vertex_handle v, Function f) const
  {
    auto u = triangulation.incident_vertices(v);
    const auto end = u;
    do
      if(!triangulation.is_infinite(u))
        f(Vertex_handle(u));
    while(++u != end);
  }

  Triangulation triangulation;
  std::vector<Vertex_handle> vertices;
  std::vector<Border_vertex> border_vertices;
  std::vector<std::pair<Vertex_handle, Vertex_handle>> border_edges; // the shape is to their left
  int number_of_borders = 0;
  bool has_area; // the points are not on a line
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_triangulation_impl.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_triangulation_loops_impl.h>

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_H
