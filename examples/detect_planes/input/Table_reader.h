// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_TABLE_READER_H
#define DETECT_PLANES_TABLE_READER_H

#include "input/Cloud_builder.h"
#include "input/input_settings.h"
#include "input/table_columns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace program {

template <class Integer>
Integer clamped(double x)
{
  constexpr double largest = double((std::numeric_limits<Integer>::max)());
  return x > 0 ? Integer(std::lround((std::min)(x, largest))) : Integer(0); // NaN is 0
}

// Makes points of rows, and looks whether their normals are some.
class Table_reader {
public:
  Table_reader(const std::vector<Column>& columns, double channel_unit, const Input_settings& settings,
               Input_notes& notes, Point_set& points)
    : columns(columns), fields{has_column(columns, Column::nx), has_column(columns, Column::red),
                               has_column(columns, Column::intensity), has_column(columns, Column::classification),
                               has_column(columns, Column::tolerance)},
      channel_unit(channel_unit), builder(points, fields, settings, notes)
  {}

  void add(const Row_values& values)
  {
    Point_row row;
    for(std::size_t i = 0; i < 3; ++i) {
      row.point[i] = values[i];
      row.normal[i] = values[std::size_t(Column::nx) + i];
      row.color[i] = clamped<std::uint16_t>(channel_unit * values[std::size_t(Column::red) + i]);
    }
    row.intensity = float(values[std::size_t(Column::intensity)]);
    row.classification = clamped<std::uint8_t>(values[std::size_t(Column::classification)]);
    row.tolerance = values[std::size_t(Column::tolerance)];
    builder.add(row);
    ++count;
    if(fields.normal)
      look_at_normal(row.normal);
  }

  std::size_t finish(Input_notes& notes)
  {
    if(channel_unit == 1)
      builder.widen_colors();
    if(2 * strange > count)
      notes.warnings.push_back("the normals (nx ny nz, columns " + places() + ") are far from length 1, as " +
                               std::to_string(example) + "; name the columns by --columns if they are no normals");
    return count;
  }

private:
  void look_at_normal(const double (&n)[3])
  {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if(!(length > 0) || std::fabs(length - 1) <= largest_error_of_length)
      return;
    example = strange++ == 0 ? length : example;
  }

  std::string places() const
  {
    std::string text;
    for(std::size_t c = 0; c < columns.size(); ++c)
      if(columns[c] == Column::nx || columns[c] == Column::ny || columns[c] == Column::nz)
        text += (text.empty() ? "" : " ") + std::to_string(c + 1);
    return text;
  }

  std::vector<Column> columns;
  Fields fields;
  double channel_unit;
  Cloud_builder builder;
  std::size_t count = 0, strange = 0;
  double example = 0;
};

} // namespace program

#endif // DETECT_PLANES_TABLE_READER_H
