// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/Laszip.h"
#include "input/readers.h"

namespace program {

namespace {

// The extra bytes begin behind those of the point format.
double tolerance_of(const laszip_point& p, const Las_header& header, const Las_dimension& tolerance)
{
  const std::size_t position = tolerance.position - las_point_size(header.point_format);
  if(p.num_extra_bytes < 0 || position + tolerance.size > std::size_t(p.num_extra_bytes))
    throw std::runtime_error("has fewer extra bytes than its header says");
  return value_of(reinterpret_cast<const char*>(p.extra_bytes) + position, tolerance);
}

Point_row row_of(const laszip_point& p, const Las_header& header)
{
  Point_row row;
  const std::int32_t integers[3] = {p.X, p.Y, p.Z};
  for(std::size_t i = 0; i < 3; ++i) {
    row.point[i] = place_of_integer(integers[i], header.frame, i);
    row.color[i] = p.rgb[i];
  }
  row.intensity = float(p.intensity);
  row.classification = header.point_format < 6 ? std::uint8_t(p.classification) : p.extended_classification;
  return row;
}

} // namespace

void read_laz_points(const std::string& path, const Las_header& header, const Las_dimension* tolerance,
                     Cloud_builder& builder)
{
  Laszip reader;
  laszip_BOOL is_compressed = 0;
  laszip_point* point = nullptr;
  reader.check(laszip_open_reader(reader.pointer, path.c_str(), &is_compressed), "cannot be opened by LASzip");
  reader.check(laszip_get_point_pointer(reader.pointer, &point), "cannot be opened by LASzip");
  for(std::uint64_t i = 0; i < header.count; ++i) {
    if(i % 4096 == 0)
      check_signals();
    reader.check(laszip_read_point(reader.pointer), "cannot be read completely by LASzip");
    Point_row row = row_of(*point, header);
    if(tolerance != nullptr)
      row.tolerance = tolerance_of(*point, header, *tolerance);
    builder.add(row);
  }
  laszip_close_reader(reader.pointer);
}

} // namespace program
