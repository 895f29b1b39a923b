// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The header of LAS 1.0 to 1.4, as the specification of the ASPRS has it, and the points that LASzip reads.

#ifndef DETECT_PLANES_LAS_HEADER_H
#define DETECT_PLANES_LAS_HEADER_H

#include "input/readers.h"

namespace program {

// A number behind the bytes of the point format, as a record of the header describes it.
struct Las_dimension {
  std::string name;
  char type; // as that of number_of_type()
  std::size_t size;
  std::size_t position; // in the record of a point
  double scale, offset;
};

// Of the bytes of the dimension.
double value_of(const char* bytes, const Las_dimension& dimension);

struct Las_header {
  int minor_version = 0;
  int point_format = 0;
  bool is_compressed = false; // LAZ
  std::uint16_t record_length = 0;
  std::uint64_t first_point = 0; // position in the file
  std::uint64_t count = 0;
  Las_frame frame;
  std::vector<Las_dimension> dimensions;

  bool has_color() const { return color_position() > 0; }

  // In the record of a point, 0 if there is no color.
  std::size_t color_position() const
  {
    constexpr std::size_t positions[11] = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
    return positions[point_format];
  }
};

Las_header read_las_header(Input_buffer& in);

// Rounded after each operation, also where the processor could do both at once.
double place_of_integer(std::int32_t integer, const Las_frame& frame, std::size_t axis);

// The bytes of a point of this format without extra ones.
std::size_t las_point_size(int point_format);

// The points that LASzip reads. tolerance: the dimension that has it, or null.
void read_laz_points(const std::string& path, const Las_header& header, const Las_dimension* tolerance,
                     Cloud_builder& builder);

} // namespace program

#endif // DETECT_PLANES_LAS_HEADER_H
