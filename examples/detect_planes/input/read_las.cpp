// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Built_with.h"
#include "input/readers.h"

#include "file_names.h"
#include "input/Cloud_builder.h"
#include "input/find_name.h"
#include "input/las_header.h"

#include <stdexcept>

namespace program {

Point_row point_of_record(const char* record, const Las_header& h)
{
  Point_row row;
  for(std::size_t i = 0; i < 3; ++i)
    row.point[i] = place_of_integer(number_at<std::int32_t>(record + 4 * i), h.frame, i);
  row.intensity = float(number_at<std::uint16_t>(record + 12));
  // The older formats have flags in the other three bits.
  row.classification = h.point_format < 6 ? std::uint8_t(record[15] & 31) : std::uint8_t(record[16]);
  if(const std::size_t position = h.color_position())
    for(std::size_t i = 0; i < 3; ++i)
      row.color[i] = number_at<std::uint16_t>(record + position + 2 * i);
  return row;
}

namespace {

// That of --tolerance-column, or null.
const Las_dimension* tolerance_of(const Las_header& h, const std::string& wanted)
{
  std::vector<std::string> names;
  for(const Las_dimension& dimension : h.dimensions)
    names.push_back(dimension.name);
  return wanted.empty() ? nullptr : &h.dimensions[find_name(names, wanted, "extra dimension")];
}

void read_records(Input_buffer& in, const Las_header& h, const Las_dimension* tolerance, Cloud_builder& builder)
{
  std::vector<char> record(h.record_length);
  for(std::uint64_t i = 0; i < h.count; ++i) {
    if(in.sgetn(record.data(), h.record_length) != h.record_length) {
      if(is_interrupted())
        throw Interrupted();
      throw std::runtime_error("unreadable after point " + std::to_string(i) + " of " + std::to_string(h.count));
    }
    Point_row row = point_of_record(record.data(), h);
    if(tolerance != nullptr)
      row.tolerance = value_of(record.data() + tolerance->position, *tolerance);
    builder.add(row);
  }
}

void check_room(Input_buffer& in, const Las_header& h)
{
  const std::uint64_t bytes = in.position() + in.left();
  const std::uint64_t room = h.first_point < bytes ? (bytes - h.first_point) / h.record_length : 0;
  if(room < h.count)
    throw std::runtime_error("is truncated: " + std::to_string(h.count) + " points announced, room for " +
                             std::to_string(room));
}

} // namespace

void read_las(Byte_source& file, const std::string& path, const Input_settings& settings, Point_set& points,
              Input_notes& notes)
{
  Input_buffer in(file);
  const Las_header h = read_las_header(in);
  if(!notes.las_frame)
    notes.las_frame = h.frame;
  const Las_dimension* const tolerance = tolerance_of(h, settings.tolerance);
  Cloud_builder builder(points, {false, h.has_color(), true, true, tolerance != nullptr}, settings, notes);
  if(h.is_compressed) {
    if(is_gzip(path))
      throw std::runtime_error("is LAZ within gzip; decompress it with gunzip");
    if constexpr(has_laszip)
      return read_laz_points(path, h, tolerance, builder);
    throw std::runtime_error("LAZ needs LASzip; decompress with laszip or build Tandem with it");
  }
  check_room(in, h);
  in.skip(h.first_point - in.position());
  if(settings.classes.empty() && !settings.crop)
    points.reserve(std::size_t(h.count));
  read_records(in, h, tolerance, builder);
}

} // namespace program
