// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_OUTPUT_POINTS_H
#define DETECT_PLANES_OUTPUT_POINTS_H

#include "input/input_settings.h"
#include "output/write_results.h"

namespace program {

// A part of the cloud with the result, as the formats of --output get it.
class Output_points {
public:
  // `has_shape_colors`: even if the input has colors.
  Output_points(const Point_set& points, const Point_part& part, const Shapes& shapes, bool has_shape_colors,
                const std::string& label_property)
    : points(points), part(part), shapes(shapes), label_property(label_property),
      intensity(find_property<float>(points, intensity_name)),
      classification(find_property<std::uint8_t>(points, classification_name)),
      tolerance(find_property<double>(points, tolerance_name))
  {
    if(has_shape_colors)
      return;
    colors = find_property<Input_color>(points, color_name);
    has_narrow_colors =
      colors && std::all_of(part.begin(), part.end(), [&](Point_set::Index i) {
        return std::all_of((*colors)[i].begin(), (*colors)[i].end(), [](std::uint16_t c) { return c <= 255; });
      });
  }

  Kernel::Vector_3 normal(Point_set::Index i) const { return normal_used(points, shapes, i); }
  std::int32_t shape(Point_set::Index i) const { return shapes.shape_index(i); }

  // Of 16 bits, as the input has it.
  Input_color wide_color(Point_set::Index i) const
  {
    if(colors)
      return (*colors)[i];
    Input_color wide;
    const Color narrow = color_of_shape(shape(i));
    std::transform(narrow.begin(), narrow.end(), wide.begin(), [](std::uint8_t c) { return std::uint16_t(257 * c); });
    return wide;
  }

  Color color(Point_set::Index i) const
  {
    if(!colors)
      return color_of_shape(shape(i));
    Color narrow;
    const Input_color& wide = (*colors)[i];
    std::transform(wide.begin(), wide.end(), narrow.begin(),
                   [this](std::uint16_t c) { return std::uint8_t(has_narrow_colors ? c : c >> 8); });
    return narrow;
  }

  const Point_set& points;
  const Point_part part;
  const Shapes& shapes;
  const std::string label_property; // the name of the shape of a point
  std::optional<Point_set::Property_map<float>> intensity;
  std::optional<Point_set::Property_map<std::uint8_t>> classification;
  std::optional<Point_set::Property_map<double>> tolerance; // where points have their own

private:
  std::optional<Point_set::Property_map<Input_color>> colors; // of the input
  bool has_narrow_colors = false;                             // 8 bits in the lower half of 16
};

// LAS 1.4 with the shape as extra bytes. Coordinates are rounded to the grid of the input, or to one that is fine for
// the distances within shapes. Points that are not finite are left out.
void write_las(std::ostream& out, const Output_points& cloud, const std::optional<Las_frame>& frame_of_input);

// The same, compressed by LASzip.
void write_laz(std::ostream& out, const Output_points& cloud, const std::optional<Las_frame>& frame_of_input);

} // namespace program

#endif // DETECT_PLANES_OUTPUT_POINTS_H
