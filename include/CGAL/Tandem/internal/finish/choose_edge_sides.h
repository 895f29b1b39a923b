// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfels near the edge of two shapes, where normals are estimated. Such a normal is blended there, and says nothing
// about the edge side. The place of the surfel does: it goes to the shape on whose side of the edge it lies, and
// gets the normal of a neighbor there. Given normals are never touched, and decide by themselves.
// Changes labels and interior bits of surfels, their estimated normals, and moments and boxes of shapes. See the
// manual, "Edge Sides".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_CHOOSE_EDGE_SIDES_H
#define CGAL_TANDEM_INTERNAL_FINISH_CHOOSE_EDGE_SIDES_H

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/base/tuning/normals.h>
#include <CGAL/Tandem/internal/rounds/assign.h>

namespace CGAL::Tandem::internal {

// On which side of a plane the surfels of another shape lie: the sum of their signed distances, each at most epsilon,
// and that of the absolute values.
struct Edge_side {
  std::int64_t sum = 0, size = 0; // in 2^-28 steps; below 2^39 a surfel, of which there are at most 2^18

  CGAL_TANDEM_HD void add(std::int64_t e, std::int64_t maximum)
  {
    const std::int64_t bounded = e > maximum ? maximum : e < -maximum ? -maximum : e;
    sum += bounded;
    size += bounded < 0 ? -bounded : bounded;
  }

  // Where a shape goes on beyond the plane, neither side is its own.
  CGAL_TANDEM_HD bool is_clear() const
  {
    constexpr tuning::Ratio ratio = tuning::edge_sides::clear_ratio;
    return (sum < 0 ? -sum : sum) * ratio.denominator > size * ratio.numerator;
  }

  // How far a surfel at the signed distance e is on this side.
  CGAL_TANDEM_HD std::int64_t depth(std::int64_t e) const { return sum > 0 ? e : -e; }
};

// Whether the planes are within alpha of each other. Then they meet at no edge that normals could tell.
CGAL_TANDEM_HD inline bool are_aligned(const Plane& a, const Plane& b, std::int64_t squared_cosine)
{
  const std::int64_t product = normal_product(a, {b.nx, b.ny, b.nz});
  const std::int64_t cosine = (product < 0 ? -product : product) >> (2 * normal_bits - 16); // times 2^16
  return cosine * cosine >= squared_cosine;
}

// The tables that the functors below read, and how they look around a surfel.
struct Edge_view {
  Cloud_view cloud;
  const std::uint32_t* label;
  const Plane* plane; // by shape
  Tolerance tolerance;

  // Whether shapes s and t may meet at an edge: two shapes, of planes that normals can tell.
  CGAL_TANDEM_HD bool is_edge(std::uint32_t s, std::uint32_t t) const
  {
    return t < first_mark && t != s && !are_aligned(plane[s], plane[t], tolerance.squared_cosine);
  }

  // f(q) for the surfels around i, some of them several times, always in the same order. Three steps from neighbor to
  // neighbor, since noise hides the sides of an edge from fewer. The farther half of the neighbors overlaps less with
  // what has been seen; every second one suffices in the last step.
  template <class F>
  CGAL_TANDEM_HD void for_each_around(std::uint32_t i, F f) const
  {
    for_each_farther_neighbor(i, 1, [&](std::uint32_t a) {
      f(a);
      for_each_farther_neighbor(a, 1, [&](std::uint32_t b) {
        f(b);
        for_each_farther_neighbor(b, 2, f);
      });
    });
  }

private:
  template <class F>
  CGAL_TANDEM_HD void for_each_farther_neighbor(std::uint32_t i, int step, F f) const
  {
    const std::uint32_t* row = cloud.row(i);
    const int k = cloud.k < tuning::normals::maximum_neighbors ? cloud.k : tuning::normals::maximum_neighbors;
    for(int j = k / 2; j < k && row[j] != no_index; j += step)
      f(row[j]);
  }
};

// Whether a surfel has a neighbor beyond an edge of its shape. Such surfels are few and take long, so the functors below
// run over their list, not over all surfels.
struct Is_at_edge {
  Edge_view view;
  const std::uint8_t* state; // by surfel, with interior bits

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const
  {
    if(state[i] & interior_bit)
      return false;
    const std::uint32_t s = view.label[i];
    const std::uint32_t* row = view.cloud.row(i);
    bool result = false;
    for(int j = 0; s < first_mark && !result && j < view.cloud.k && row[j] != no_index; ++j)
      result = view.is_edge(s, view.label[row[j]]);
    return result;
  }
};

// So many of these surfels are worth a thread.
constexpr std::size_t edges_per_thread = 128;

// For each surfel at an edge: the shape on whose side it lies, and its next normal. Labels and normals are only read,
// so the order of surfels does not matter.
//
// Two half-planes end at an edge. A surfel that is displaced by noise is as likely to be from one as from the other
// where it is equally deep on both sides. So the place where two planes bisect their angle separates them, in the angle
// and beyond it. On which sides of each other the shapes lie is seen from the surfels around.
struct Choose_edge_side {
  Edge_view view;
  const std::uint32_t* edge; // the surfels
  std::uint32_t* chosen;     // by surfel: its next label ...
  std::uint32_t* normal;     // ... and by place in the list its next normal

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint32_t i = edge[at], s = view.label[i];
    const std::uint32_t* row = view.cloud.row(i);
    std::uint32_t best = s, best_normal = view.cloud.point[i].normal;
    for(int j = next_shape(row, 0, s, s); j < view.cloud.k; j = next_shape(row, j + 1, s, best)) {
      const std::uint32_t t = view.label[row[j]];
      if(!is_beyond(i, best, t))
        continue;
      best = t;
      best_normal = view.cloud.point[row[j]].normal; // it fits the plane of t, as the neighbor does
    }
    chosen[i] = best;
    normal[at] = best_normal;
  }

private:
  // The first neighbor from the j-th on of a shape beyond an edge of the chosen one, other than s, that no nearer
  // neighbor has; k if there is none. In a loop of its own, since is_beyond() takes long: lanes that run together have
  // their neighbors first.
  CGAL_TANDEM_HD int next_shape(const std::uint32_t* row, int j, std::uint32_t s, std::uint32_t chosen_shape) const
  {
    for(; j < view.cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t t = view.label[row[j]];
      if(t != s && view.is_edge(chosen_shape, t) && is_first(row, j))
        return j;
    }
    return view.cloud.k;
  }

  // Whether no nearer neighbor has the label of the j-th one.
  CGAL_TANDEM_HD bool is_first(const std::uint32_t* row, int j) const
  {
    for(int before = 0; before < j; ++before)
      if(view.label[row[before]] == view.label[row[j]])
        return false;
    return true;
  }

  // Whether surfel i of shape s is within epsilon of shape t, and on its side of their edge.
  CGAL_TANDEM_HD bool is_beyond(std::uint32_t i, std::uint32_t s, std::uint32_t t) const
  {
    const std::int64_t epsilon = view.cloud.tolerance_of(i, view.tolerance).distance;
    const Plane plane_s = view.plane[s], plane_t = view.plane[t];
    const Grid_point p = view.cloud.point[i];
    if(!is_near(plane_t, p, epsilon))
      return false;
    Edge_side of_s, of_t;
    view.for_each_around(i, [&](std::uint32_t q) {
      if(view.label[q] == s)
        of_s.add(signed_distance(plane_t, view.cloud.point[q]), epsilon);
      else if(view.label[q] == t)
        of_t.add(signed_distance(plane_s, view.cloud.point[q]), epsilon);
    });
    return of_s.is_clear() && of_t.is_clear() &&
           of_t.depth(signed_distance(plane_s, p)) > of_s.depth(signed_distance(plane_t, p));
  }
};

// In a loop of its own, since neighbors read the normals while new ones are found.
struct Take_normals {
  const std::uint32_t* edge;
  const std::uint32_t* normal;
  Grid_point* point;

  CGAL_TANDEM_HD void operator()(std::size_t at) const { point[edge[at]].normal = normal[at]; }
};

// Computed from the labels before. All labeled surfels fit the planes of their shapes, which are rounded in the table;
// afterwards they still do. Shapes may become empty.
template <class Backend>
void choose_edge_sides(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Tolerance& tolerance)
{
  Backend& backend = points.backend;
  const std::size_t n = points.cloud.number_of_surfels();
  points.refresh_labels(Rings::all);
  const Edge_view view = {points.cloud.view(), points.label(), shapes.plane.data(), tolerance};
  const auto edge = backend.compact(n, Is_at_edge{view, states_of(points, Phase::end)});
  Buffer_of<Backend, std::uint32_t> chosen(n), normal(edge.size());
  backend.for_each(n, Copy_items<std::uint32_t>{points.label(), chosen.data()});
  backend.for_each(edge.size(), Choose_edge_side{view, edge.data(), chosen.data(), normal.data()}, edges_per_thread);
  backend.for_each(edge.size(), Take_normals{edge.data(), normal.data(), points.cloud.point.data()});
  points.ranks.refresh(points.cloud.point.data(), Rings::all);
  take_chosen(points, shapes, chosen.data());
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_FINISH_CHOOSE_EDGE_SIDES_H
