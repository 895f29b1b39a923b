// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"

namespace program {

namespace {

// What stands before the points of a scan. Rows of the matrix are images of the axes, the last one is the place of the
// scanner.
struct Ptx_header {
  std::uint64_t count = 0;
  std::array<std::vector<double>, 4> matrix;
};

std::vector<double> numbers_of(const Text_row& row) { return numbers_of(row, separator_of(row.text)); }

// A row of the header, with that many numbers.
std::vector<double> read_numbers(Text_lines& lines, std::size_t count)
{
  if(!lines.next_filled())
    throw std::runtime_error("is truncated: the header of a scan is not complete");
  const std::vector<double> numbers = numbers_of(lines.row());
  if(numbers.size() != count)
    fail_at_row(lines.row().number, "of the header of a scan has ", numbers.size(), " numbers instead of ", count);
  return numbers;
}

// The numbers of columns and rows, the place and the axes of the scanner, and the matrix. The first row is read.
Ptx_header read_scan_header(Text_lines& lines)
{
  constexpr double most = 1e9;
  Ptx_header header;
  const auto count_of = [&](const std::vector<double>& numbers) {
    if(numbers.size() != 1 || !(numbers[0] >= 0 && numbers[0] <= most) || numbers[0] != std::floor(numbers[0]))
      fail_at_row(lines.row().number, "is not the number of columns or rows of a scan, with which .ptx files begin");
    return std::uint64_t(numbers[0]);
  };
  header.count = count_of(numbers_of(lines.row()));
  header.count *= count_of(read_numbers(lines, 1));
  for(int i = 0; i < 4; ++i)
    read_numbers(lines, 3);
  for(std::vector<double>& row : header.matrix)
    row = read_numbers(lines, 4);
  return header;
}

// The point in the coordinates that all scans have.
Point_row placed_row(const Ptx_header& header, const std::vector<double>& numbers)
{
  const auto& m = header.matrix;
  Point_row row;
  for(std::size_t i = 0; i < 3; ++i)
    row.point[i] = std::fma(numbers[0], m[0][i], std::fma(numbers[1], m[1][i], std::fma(numbers[2], m[2][i], m[3][i])));
  row.intensity = float(numbers[3]);
  for(std::size_t c = 0; c < 3 && numbers.size() == 7; ++c)
    row.color[c] = numbers[4 + c] > 0 ? wide_channel(std::uint8_t((std::min)(numbers[4 + c], 255.))) : std::uint16_t(0);
  return row;
}

} // namespace

void read_ptx(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes)
{
  check_no_attributes(settings, "is PTX, whose points");
  Input_buffer in(file);
  Text_lines lines(in, settings.has_decimal_commas);
  std::optional<Cloud_builder> builder;
  std::size_t scans = 0, size = 0; // of a row
  std::uint64_t empty = 0;         // pixels
  for(; lines.next_filled(); ++scans) {
    const Ptx_header header = read_scan_header(lines);
    notes.viewpoints.push_back({{header.matrix[3][0], header.matrix[3][1], header.matrix[3][2]}, false, points.size()});
    for(std::uint64_t i = 0; i < header.count; ++i) {
      if(!lines.next_filled())
        throw_error("is truncated: ", i, " of the ", header.count, " points of a scan");
      const std::vector<double> numbers = numbers_of(lines.row());
      if(!builder) {
        size = numbers.size();
        builder.emplace(points, Fields{false, size == 7, true, false, false}, settings, notes);
      }
      if(numbers.size() != size || (size != 4 && size != 7))
        fail_at_row(lines.row().number, "has ", numbers.size(),
                    " numbers, expected x y z intensity or x y z intensity r g b, the same in all rows");
      if(numbers[0] == 0 && numbers[1] == 0 && numbers[2] == 0)
        ++empty;
      else
        builder->add(placed_row(header, numbers));
    }
  }
  notes.lines.emplace_back("scans", text_of(scans, ", ", empty, " pixels without a point left out"));
}

} // namespace program
