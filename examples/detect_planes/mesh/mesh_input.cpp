// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/mesh_methods.h"

#include "../Shape_regularization_tandem/convex_polygons.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace program {

namespace {

// Those that have an area, the one with most points first.
std::vector<std::size_t> order_of_planes(const Mesh_input& all)
{
  std::vector<std::size_t> size(all.planes.size(), 0);
  for(const Mesh_input::Item& item : all.items)
    ++size[std::size_t(std::get<2>(item))];
  std::vector<std::size_t> order = convex_polygons<Kernel>(all.items, all.planes).planes;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
  return order;
}

// The planes at these positions, numbered in this order.
Mesh_input part(const Mesh_input& all, const std::vector<std::size_t>& order)
{
  Mesh_input result;
  std::vector<int> number(all.planes.size(), -1);
  for(std::size_t plane : order) {
    number[plane] = int(result.planes.size());
    result.planes.push_back(all.planes[plane]);
  }
  for(Mesh_input::Item item : all.items) {
    int& plane = std::get<2>(item);
    plane = number[std::size_t(plane)];
    if(plane >= 0)
      result.items.push_back(item);
  }
  return result;
}

} // namespace

Mesh_input mesh_input(const Point_set& points, const Shapes& shapes)
{
  const Mesh_input all{CGAL::Tandem::projected_points(points, shapes), CGAL::Tandem::distinct_planes(shapes)};
  return part(all, order_of_planes(all));
}

Mesh_input largest_planes(const Mesh_input& all, std::size_t number)
{
  std::vector<std::size_t> order((std::min)(number, all.planes.size()));
  std::iota(order.begin(), order.end(), std::size_t(0));
  return part(all, order);
}

double signed_volume(const Surface& surface, const std::vector<Surface::Face>& faces)
{
  if(faces.empty())
    return 0;
  const Kernel::Point_3& origin = surface.points.front();
  double sum = 0;
  for(const Surface::Face& face : faces)
    for(std::size_t i = 2; i < face.size(); ++i)
      sum += CGAL::determinant(surface.points[face[0]] - origin, surface.points[face[i - 1]] - origin,
                               surface.points[face[i]] - origin);
  return sum;
}

void reverse(std::vector<Surface::Face>& faces)
{
  for(Surface::Face& face : faces)
    std::reverse(face.begin(), face.end());
}

bool is_closed(const Surface& surface)
{
  std::map<std::pair<std::size_t, std::size_t>, int> balance;
  for(const Surface::Face& face : surface.faces)
    for(std::size_t i = 0; i < face.size(); ++i) {
      const std::size_t a = face[i], b = face[(i + 1) % face.size()];
      balance[std::minmax({a, b})] += a < b ? 1 : -1;
    }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

} // namespace program
