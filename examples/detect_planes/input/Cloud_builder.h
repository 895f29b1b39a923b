// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_CLOUD_BUILDER_H
#define DETECT_PLANES_CLOUD_BUILDER_H

#include "input/input_settings.h"
#include "input/point_set.h"

#include <algorithm>
#include <vector>

namespace program {

// What the points of a file have beside coordinates.
struct Fields {
  bool normal = false, color = false, intensity = false, classification = false, tolerance = false;
};

struct Point_row {
  double point[3] = {0, 0, 0};
  double normal[3] = {0, 0, 0};
  Input_color color = {0, 0, 0};
  float intensity = 0;
  std::uint8_t classification = 0;
  double tolerance = 0;
};

// Some writers put channels of 8 bits into 16: 255 becomes 65535.
constexpr std::uint16_t wide_channel(std::uint8_t channel) { return std::uint16_t(257 * channel); }

// Appends points to a cloud, in their order; only those of the classes and in the box of the settings, if there are any.
class Cloud_builder {
public:
  Cloud_builder(Point_set& points, const Fields& fields, const Input_settings& settings, Input_notes& notes)
    : points(points), fields(fields), settings(settings), notes(notes)
  {
    if(fields.normal)
      points.add_normal_map();
    if(fields.color)
      colors = points.add_property_map<Input_color>(color_name).first;
    if(fields.intensity)
      intensities = points.add_property_map<float>(intensity_name).first;
    if(fields.classification)
      classifications = points.add_property_map<std::uint8_t>(classification_name).first;
    if(fields.tolerance)
      tolerances = points.add_property_map<double>(tolerance_name).first;
  }

  // Whether the point is taken.
  bool add(const Point_row& row)
  {
    const std::vector<int>& classes = settings.classes;
    if(settings.crop)
      notes.box.add(row.point);
    if(settings.crop && !settings.crop->has(row.point))
      return false;
    if(!classes.empty() && std::find(classes.begin(), classes.end(), int(row.classification)) == classes.end())
      return false;
    const Point_set::Index i = *points.insert(Kernel::Point_3(row.point[0], row.point[1], row.point[2]));
    if(fields.normal)
      points.normal(i) = Kernel::Vector_3(row.normal[0], row.normal[1], row.normal[2]);
    if(fields.color)
      colors[i] = row.color;
    if(fields.intensity)
      intensities[i] = row.intensity;
    if(fields.classification)
      classifications[i] = row.classification;
    if(fields.tolerance)
      tolerances[i] = row.tolerance;
    return true;
  }

  // `new_colors[i]` is that of the i-th point.
  template <class Colors>
  void set_colors(const Colors& new_colors)
  {
    std::size_t count = 0;
    for(Point_set::Index i : points)
      colors[i] = new_colors[count++];
  }

  // Makes 16 bits of colors that use 8.
  void widen_colors()
  {
    const auto is_narrow = [&](Point_set::Index i) {
      return std::all_of(colors[i].begin(), colors[i].end(), [](std::uint16_t c) { return c <= 255; });
    };
    if(!fields.color || !std::all_of(points.begin(), points.end(), is_narrow))
      return;
    for(Point_set::Index i : points)
      for(std::uint16_t& channel : colors[i])
        channel = wide_channel(std::uint8_t(channel));
  }

private:
  Point_set& points;
  Fields fields;
  const Input_settings& settings;
  Input_notes& notes;
  Point_set::Property_map<Input_color> colors;
  Point_set::Property_map<float> intensities;
  Point_set::Property_map<std::uint8_t> classifications;
  Point_set::Property_map<double> tolerances;
};

} // namespace program

#endif // DETECT_PLANES_CLOUD_BUILDER_H
