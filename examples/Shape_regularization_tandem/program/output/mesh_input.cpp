// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/mesh_input.h"

#include <algorithm>
#include <numeric>

namespace program {

Mesh_input mesh_input(const Point_set& points, const Shapes& shapes, std::size_t largest_number)
{
  std::vector<std::size_t> size(shapes.number_of_coplanar_groups(), 0), order(size.size());
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    size[shapes.coplanar_group(s)] += shapes.points(s).size();
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
  order.resize((std::min)(largest_number, order.size()));

  Mesh_input result;
  const std::vector<Kernel::Plane_3> planes = CGAL::Tandem::distinct_planes(shapes);
  std::vector<int> number(size.size(), -1);
  for(std::size_t group : order) {
    number[group] = int(result.planes.size());
    result.planes.push_back(planes[group]);
  }
  for(Mesh_input::Item& item : CGAL::Tandem::projected_points(points, shapes)) {
    int& group = std::get<2>(item);
    group = number[std::size_t(group)];
    if(group >= 0)
      result.items.push_back(item);
  }
  return result;
}

double signed_volume(const Surface& surface, const std::vector<Surface::Face>& faces)
{
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

} // namespace program
