// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"

#include "input/Cloud_builder.h"
#include "input/find_name.h"
#include "input/table_columns.h"

#include <functional>

namespace program {

namespace {

using Get_number = std::function<double(Point_set::Index)>;

template <class T>
bool find_number(const Point_set& points, const std::string& name, Get_number& get)
{
  const auto map = find_property<T>(points, name.c_str());
  if(map)
    get = [map = *map](Point_set::Index i) { return double(map[i]); };
  return bool(map);
}

template <class... Types>
Get_number find_number_of(const Point_set& points, const std::string& name)
{
  Get_number get;
  static_cast<void>((find_number<Types>(points, name, get) || ...));
  return get;
}

Get_number find_any_number(const Point_set& points, const std::string& name)
{
  return find_number_of<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t, float,
                        double>(points, name);
}

template <class T>
void remove_property(Point_set& points, const std::string& name)
{
  auto map = find_property<T>(points, name.c_str());
  if(map)
    points.remove_property_map(*map);
}

// A scalar property, as a function of the point.
struct Numbers {
  std::array<Get_number, 11> of_column;

  const Get_number& operator[](Column c) const { return of_column[std::size_t(c)]; }
};

Numbers find_numbers(const Point_set& points)
{
  Numbers numbers;
  for(const std::string& name : points.properties()) {
    const Column c = column_of_name(name);
    if(c < Column::red || c == Column::none || numbers[c])
      continue;
    numbers.of_column[std::size_t(c)] = find_any_number(points, name);
  }
  return numbers;
}

// Channels of 8 bits, of 16 bits, or real ones from 0 to 1.
double channel_unit(const Point_set& points, const Numbers& numbers)
{
  double largest = 0;
  bool is_integer = true;
  for(Point_set::Index i : points)
    for(Column c : {Column::red, Column::green, Column::blue}) {
      const double x = numbers[c](i);
      largest = (std::max)(largest, x);
      is_integer = is_integer && x == std::floor(x);
    }
  return !is_integer && largest <= 1 ? 65535 : largest <= 255 ? 257 : 1;
}

std::vector<Input_color> colors_of(const Point_set& points, const Numbers& numbers)
{
  const double unit = channel_unit(points, numbers);
  std::vector<Input_color> colors;
  for(Point_set::Index i : points) {
    Input_color color = {0, 0, 0};
    for(std::size_t c = 0; c < 3; ++c) {
      const double x = unit * numbers[Column(std::size_t(Column::red) + c)](i);
      color[c] = x > 0 ? std::uint16_t(std::lround((std::min)(x, 65535.))) : std::uint16_t(0);
    }
    colors.push_back(color);
  }
  return colors;
}

std::vector<double> tolerances_of(const Point_set& points, const std::string& wanted)
{
  std::vector<std::string> names;
  for(const std::string& name : points.properties())
    if(find_any_number(points, name))
      names.push_back(name);
  const Get_number tolerance = find_any_number(points, names[find_name(names, wanted, "property")]);
  std::vector<double> tolerances;
  for(Point_set::Index i : points)
    tolerances.push_back(tolerance(i));
  return tolerances;
}

template <class T>
void add_property(Point_set& points, const char* name, const std::vector<T>& values)
{
  auto map = points.add_property_map<T>(name).first;
  auto value = values.begin();
  for(Point_set::Index i : points)
    map[i] = *value++;
}

template <class... Types>
void remove_properties(Point_set& points)
{
  for(const std::string& name : points.properties())
    if(name != "index" && name != "point" && name != "normal")
      (remove_property<Types>(points, name), ...);
}

} // namespace

void convert_attributes(const Input_settings& settings, Point_set& points)
{
  const Numbers numbers = find_numbers(points);
  std::vector<Input_color> colors;
  std::vector<float> intensities;
  std::vector<std::uint8_t> classes;
  std::vector<double> tolerances;
  if(!settings.tolerance.empty())
    tolerances = tolerances_of(points, settings.tolerance);
  if(numbers[Column::red] && numbers[Column::green] && numbers[Column::blue])
    colors = colors_of(points, numbers);
  if(numbers[Column::intensity])
    for(Point_set::Index i : points)
      intensities.push_back(float(numbers[Column::intensity](i)));
  if(numbers[Column::classification])
    for(Point_set::Index i : points) {
      const double x = numbers[Column::classification](i);
      classes.push_back(x > 0 && x < 256 ? std::uint8_t(x) : std::uint8_t(0));
    }
  remove_properties<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t, float, double,
                    std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
                    std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>,
                    std::vector<float>, std::vector<double>>(points);
  if(!colors.empty())
    add_property(points, color_name, colors);
  if(!intensities.empty())
    add_property(points, intensity_name, intensities);
  if(!classes.empty())
    add_property(points, classification_name, classes);
  if(!settings.tolerance.empty())
    add_property(points, tolerance_name, tolerances);
}

} // namespace program
