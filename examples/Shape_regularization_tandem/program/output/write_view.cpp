// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/write_view.h"
#include "output/base64.h"
#include "output/shape_polygons.h"
#include "view/view_page.h"

#include <CGAL/linear_least_squares_fitting_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <vector>

namespace program {

namespace {

constexpr std::size_t most_points_shown = 3000000;

// The points that are shown, without a shape first, then shape after shape; places that are not finite are left out.
class Shown_points {
public:
  Shown_points(const Point_set& points, const Shapes& shapes) : points(points), shapes(shapes)
  {
    std::vector<std::size_t> all;
    for(std::size_t i = 0; i < shapes.number_of_points(); ++i)
      if(shapes.shape_index(i) < 0 && is_finite(point(i)))
        all.push_back(i);
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      all.insert(all.end(), shapes.points(s).begin(), shapes.points(s).end());
    stride = (all.size() + most_points_shown - 1) / most_points_shown;
    stride = (std::max)(stride, std::size_t(1));
    of_shape.assign(shapes.number_of_shapes() + 1, 0);
    for(std::size_t k = 0; k < all.size(); k += stride) {
      items.push_back(all[k]);
      ++of_shape[std::size_t(shapes.shape_index(all[k]) + 1)];
    }
    find_box();
  }

  const Kernel::Point_3& point(std::size_t i) const { return points.point(*(points.begin() + std::ptrdiff_t(i))); }

  // Three coordinates of 16 bits in the box, and the signed distance to the plane in 127ths of the tolerance.
  std::string packed() const
  {
    std::string bytes;
    bytes.reserve(7 * items.size());
    for(std::size_t i : items) {
      const Kernel::Point_3& p = point(i);
      for(int c = 0; c < 3; ++c) {
        const double share = size[std::size_t(c)] > 0 ? (p[c] - low[std::size_t(c)]) / size[std::size_t(c)] : 0;
        const auto place = std::uint16_t(std::lround(65535 * (std::min)((std::max)(share, 0.), 1.)));
        bytes += char(place & 255);
        bytes += char(place >> 8);
      }
      bytes += char(std::int8_t(std::lround(127 * relative_distance(i, p))));
    }
    return bytes;
  }

  std::size_t stride;
  std::vector<std::size_t> items;
  std::vector<std::size_t> of_shape; // the number shown; entry s + 1 for shape s, the first one for no shape
  std::array<double, 3> low, size;

private:
  void find_box()
  {
    std::array<double, 3> high = {0, 0, 0};
    low = {0, 0, 0};
    for(std::size_t k = 0; k < items.size(); ++k)
      for(std::size_t c = 0; c < 3; ++c) {
        const double x = point(items[k])[int(c)];
        low[c] = k == 0 ? x : (std::min)(low[c], x);
        high[c] = k == 0 ? x : (std::max)(high[c], x);
      }
    for(std::size_t c = 0; c < 3; ++c)
      size[c] = high[c] - low[c];
  }

  double relative_distance(std::size_t i, const Kernel::Point_3& p) const
  {
    const int s = shapes.shape_index(i);
    if(s < 0)
      return 0;
    const auto& c = shapes.coefficients(std::size_t(s));
    const double distance = c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3];
    return (std::min)((std::max)(distance / shapes.parameters().maximum_distance, -1.), 1.);
  }

  const Point_set& points;
  const Shapes& shapes;
};

// How far a shape is from the plane that fits its own points best: the angle in degrees, and the distance of the
// centroid.
struct Motion {
  double angle, distance;
};

Motion motion_of_shape(const Shown_points& shown, const Shapes& shapes, std::size_t s)
{
  std::vector<Kernel::Point_3> members;
  for(std::size_t i : shapes.points(s))
    members.push_back(shown.point(i));
  Kernel::Plane_3 fitted;
  Kernel::Point_3 center;
  CGAL::linear_least_squares_fitting_3(members.begin(), members.end(), fitted, center, CGAL::Dimension_tag<0>());
  const Kernel::Vector_3 m = fitted.orthogonal_vector(), n = shapes.plane(s).orthogonal_vector();
  const double sine = std::sqrt(CGAL::cross_product(m, n).squared_length());
  return {std::atan2(sine, std::fabs(m * n)) * 180 / CGAL_PI,
          std::sqrt(CGAL::squared_distance(center, shapes.plane(s)))};
}

void write_shapes(std::ostream& out, const Point_set& points, const Shapes& shapes, const Shown_points& shown)
{
  const std::vector<Shape_polygons> polygons = polygons_of_shapes(points, shapes);
  out << "\"shapes\": [";
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const auto& c = shapes.coefficients(s);
    const Motion moved = motion_of_shape(shown, shapes, s);
    out << (s > 0 ? ",\n" : "\n") << "{\"points\": " << shapes.points(s).size()
        << ", \"shown\": " << shown.of_shape[s + 1] << ", \"direction\": " << shapes.parallel_group(s)
        << ", \"plane\": " << shapes.coplanar_group(s) << ", \"coefficients\": [" << std::setprecision(17) << c[0]
        << ", " << c[1] << ", " << c[2] << ", " << c[3] << "], \"turned\": " << std::setprecision(6) << moved.angle
        << ", \"moved\": " << moved.distance << ", \"area\": " << polygons[s].area << '}';
  }
  out << "],\n\"orthogonal\": [";
  const char* before = "";
  for(const auto& pair : shapes.orthogonal_groups()) {
    out << before << '[' << pair.first << ", " << pair.second << ']';
    before = ", ";
  }
  out << "]";
}

// A name of a file may have any bytes. What could end the script is escaped, too.
std::string quoted(const std::string& text)
{
  std::ostringstream out;
  out << '"';
  for(unsigned char c : text)
    if(c < 32 || c > 126 || c == '"' || c == '\\' || c == '<')
      out << "\\u" << std::hex << std::setw(4) << std::setfill('0') << int(c);
    else
      out << c;
  out << '"';
  return out.str();
}

void write_model(std::ostream& out, const Point_set& points, const Shapes& shapes, const std::string& title)
{
  const Shown_points shown(points, shapes);
  const CGAL::Tandem::Statistics& statistics = shapes.statistics();
  out << "<script>\nconst model = {\"title\": " << quoted(title) << ", \"points\": " << statistics.number_of_points
      << ", \"assigned\": " << statistics.number_of_assigned_points
      << ", \"directions\": " << shapes.number_of_parallel_groups()
      << ", \"planes\": " << shapes.number_of_coplanar_groups() << ", \"shown\": " << shown.items.size()
      << ", \"unassignedShown\": " << shown.of_shape[0] << ", \"stride\": " << shown.stride << std::setprecision(6)
      << ", \"maximumDistance\": " << shapes.parameters().maximum_distance << ", \"size\": [" << shown.size[0] << ", "
      << shown.size[1] << ", " << shown.size[2] << "],\n";
  write_shapes(out, points, shapes, shown);
  out << "};\n</script>\n<script id=\"points\" type=\"text/plain\">";
  write_base64(out, shown.packed());
  out << "</script>\n";
}

} // namespace

bool has_view() { return page_before_model[0] != '\0'; }

void write_view(std::ostream& out, const Point_set& points, const Shapes& shapes, const std::string& title)
{
  out << page_before_model;
  write_model(out, points, shapes, title);
  out << page_after_model;
}

} // namespace program
