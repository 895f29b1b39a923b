// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planes from a file, as --planes writes them, or from the columns a, b, c, d of a table with a line of names.

#ifndef DETECT_PLANES_PLANES_FILE_H
#define DETECT_PLANES_PLANES_FILE_H

#include "Options.h"
#include "input/Table_rows.h"
#include "output/Write_error.h"

#include <CGAL/Tandem/Coefficients.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace program {

// A file or a pipe, which is read once, up to its end.
class Stream_source final : public Byte_source {
public:
  explicit Stream_source(const std::string& path)
  {
    if(std::filesystem::is_directory(path))
      throw std::runtime_error("is a directory");
    errno = 0;
    file_.open(path, std::ios::binary);
    if(!file_)
      throw std::runtime_error("cannot be opened" + reason_of(errno));
  }

  std::uint64_t size() const override { return UINT64_MAX; } // it is not known
  void seek(std::uint64_t) override {}
  std::size_t read(char* bytes, std::size_t count) override
  {
    errno = 0;
    file_.read(bytes, std::streamsize(count));
    if(file_.bad())
      throw std::runtime_error("cannot be read" + reason_of(errno));
    return std::size_t(file_.gcount());
  }

private:
  std::ifstream file_;
};

using Cells = std::vector<std::string_view>;
using Plane_columns = std::array<std::size_t, 4>; // of a, b, c, d

inline Cells cells_of(std::string_view row)
{
  Cells cells;
  Table_values values(row);
  for(std::string_view value; values.next(value);)
    cells.push_back(value);
  return cells;
}

inline bool are_numbers(const Cells& cells)
{
  return std::all_of(cells.begin(), cells.end(), [](std::string_view cell) { return parse_number(cell).has_value(); });
}

inline Plane_columns columns_of_planes(const Text_row& row, const Cells& names)
{
  Plane_columns columns;
  for(std::size_t c = 0; c < 4; ++c) {
    columns[c] =
      std::size_t(std::find(names.begin(), names.end(), std::string_view("abcd").substr(c, 1)) - names.begin());
    if(columns[c] == names.size())
      fail_at_row(row.number, "has neither four numbers 'a b c d' nor names of columns with a, b, c and d");
  }
  return columns;
}

inline CGAL::Tandem::Coefficients plane_of(const Text_row& row, const Cells& cells, const Plane_columns& columns)
{
  CGAL::Tandem::Coefficients plane;
  for(std::size_t c = 0; c < 4; ++c) {
    const std::string_view cell = cells[columns[c]];
    const std::optional<double> number = parse_number(cell);
    if(!number || !std::isfinite(*number))
      fail_at_row(row.number, "has '" + std::string(cell.substr(0, 40)) + "' where a finite number is expected");
    plane[c] = *number;
  }
  const double largest = (std::max)({std::fabs(plane[0]), std::fabs(plane[1]), std::fabs(plane[2])});
  if(largest == 0)
    fail_at_row(row.number, "has a null vector as normal");
  if(!std::isfinite(plane[3] / largest))
    fail_at_row(row.number, "has a plane whose distance from the origin is not finite");
  return plane;
}

// The first row may have names instead of numbers.
inline std::vector<CGAL::Tandem::Coefficients> read_planes(Text_lines& lines)
{
  std::vector<CGAL::Tandem::Coefficients> planes;
  Plane_columns columns = {0, 1, 2, 3};
  std::size_t values = 0; // of each row
  while(lines.next_filled()) {
    const Text_row& row = lines.row();
    const Cells cells = cells_of(row.text);
    if(is_comment(row.text))
      continue;
    if(values == 0 && !are_numbers(cells)) {
      columns = columns_of_planes(row, cells);
      values = cells.size();
      continue;
    }
    values = values == 0 ? 4 : values;
    if(cells.size() != values)
      fail_at_row(row.number, "has " + std::to_string(cells.size()) + " values instead of " + std::to_string(values));
    planes.push_back(plane_of(row, cells, columns));
  }
  if(planes.empty())
    throw std::runtime_error("has no planes");
  return planes;
}

inline void read_known_planes(Options& o)
try {
  if(o.planes_from.empty())
    return;
  Stream_source file(o.planes_from);
  Input_buffer bytes(file);
  Text_lines lines(bytes);
  o.known_planes = read_planes(lines);
} catch(const std::runtime_error& e) {
  throw std::runtime_error("--planes-from " + o.planes_from + ": " + e.what());
}

} // namespace program

#endif // DETECT_PLANES_PLANES_FILE_H
