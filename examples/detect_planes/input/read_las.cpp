// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Options.h"
#include "file_names.h"
#include "input/readers.h"

namespace program {

namespace {

constexpr std::size_t smallest_header = 227, header_1_4 = 375, record_header = 54;

void read_exactly(Input_buffer& in, char* bytes, std::size_t count, const char* what)
{
  if(in.left() < count || std::size_t(in.sgetn(bytes, std::streamsize(count))) != count)
    throw_error("is truncated: ", what, " is not complete");
}

// What the records hold. If that is both, the flag of the header says which to use.
Projection projection_of(const std::vector<std::string>& records, bool is_declared_wkt)
{
  bool has_wkt = false, has_geotiff_keys = false;
  for(const std::string& record : records) {
    const std::uint16_t id = number_at<std::uint16_t>(record.data() + 18);
    has_wkt = has_wkt || id == 2112;
    has_geotiff_keys = has_geotiff_keys || id == 34735;
  }
  return has_wkt && (is_declared_wkt || !has_geotiff_keys) ? Projection::wkt
         : has_geotiff_keys                                ? Projection::geotiff
                                                           : Projection::none;
}

// Whether a record of the header describes the extra bytes of the points.
bool describes_bytes(const std::string& record)
{
  return record.compare(2, 10, std::string("LASF_Spec\0", 10)) == 0 &&
         number_at<std::uint16_t>(record.data() + 18) == 4;
}

// The extra bytes of points, as far as the record describes them. The types are integers of 1, 2, 4 and 8 bytes, each
// without and with a sign, float and double; in older files two and three numbers of these, too. Bytes of no type are as
// many as the options say.
std::vector<Las_dimension> dimensions_of(const std::string& record, const Las_header& h)
{
  constexpr std::size_t description = 192, scale_bit = 8, offset_bit = 16, sizes[10] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  std::vector<Las_dimension> dimensions;
  std::size_t position = las_point_size(h.point_format);
  for(std::size_t first = record_header; first + description <= record.size(); first += description) {
    const char* const d = record.data() + first;
    const std::size_t type = std::uint8_t(d[2]), options = std::uint8_t(d[3]);
    const std::size_t size = type == 0 ? options : (type - 1) / 10 * sizes[(type - 1) % 10] + sizes[(type - 1) % 10];
    if(type > 30 || size == 0 || position + size > h.record_length)
      break;
    if(type >= 1 && type <= 10)
      dimensions.push_back({std::string(d + 4, std::find(d + 4, d + 36, '\0')), "UIUIUIUIFF"[type - 1], size, position,
                            (options & scale_bit) != 0 ? number_at<double>(d + 112) : 1,
                            (options & offset_bit) != 0 ? number_at<double>(d + 136) : 0});
    position += size;
  }
  return dimensions;
}

// The records that tell the coordinate system, and the one of extra bytes. What comes after a damaged one is left out.
std::vector<std::string> read_records(Input_buffer& in, std::uint32_t count, std::uint64_t end)
{
  std::vector<std::string> records;
  for(; count > 0 && in.position() + record_header <= end; --count) {
    std::string record(record_header, '\0');
    read_exactly(in, record.data(), record_header, "a record of the LAS header");
    const std::uint16_t length = number_at<std::uint16_t>(record.data() + 20);
    if(length > end - in.position())
      break;
    if(record.compare(2, 15, "LASF_Projection") != 0 && !describes_bytes(record)) {
      in.skip(length);
      continue;
    }
    record.resize(record_header + length);
    read_exactly(in, record.data() + record_header, length, "a record of the LAS header");
    records.push_back(record);
  }
  return records;
}

} // namespace

std::size_t las_point_size(int point_format)
{
  constexpr std::size_t sizes[11] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  return sizes[point_format];
}

double value_of(const char* bytes, const Las_dimension& d)
{
  return std::fma(number_of_type(bytes, d.type, d.size), d.scale, d.offset);
}

double place_of_integer(std::int32_t integer, const Las_frame& frame, std::size_t axis)
{
  const volatile double scaled = integer * frame.scale[axis];
  return scaled + frame.offset[axis];
}

Las_header read_las_header(Input_buffer& in)
{
  char bytes[header_1_4] = {};
  if(in.left() < 4 || in.sgetn(bytes, 4) != 4 || std::memcmp(bytes, "LASF", 4) != 0)
    throw std::runtime_error("is not a LAS file (it does not begin with LASF)");
  read_exactly(in, bytes + 4, smallest_header - 4, "the LAS header");
  if(bytes[24] != 1 || bytes[25] < 0 || bytes[25] > 4)
    throw_error("has the LAS version ", int(bytes[24]), '.', int(bytes[25]), ", expected 1.0 to 1.4");
  Las_header h;
  h.minor_version = bytes[25];
  const std::size_t header_size = number_at<std::uint16_t>(bytes + 94);
  if(header_size < smallest_header)
    throw_error("has a LAS header of ", header_size, " bytes");
  h.first_point = number_at<std::uint32_t>(bytes + 96);
  h.is_compressed = (bytes[104] & 0xC0) != 0;
  h.point_format = bytes[104] & 0x3F;
  h.record_length = number_at<std::uint16_t>(bytes + 105);
  h.count = number_at<std::uint32_t>(bytes + 107);
  for(std::size_t i = 0; i < 3; ++i) {
    h.frame.scale[i] = number_at<double>(bytes + 131 + 8 * i);
    h.frame.offset[i] = number_at<double>(bytes + 155 + 8 * i);
    if(!std::isfinite(h.frame.scale[i]) || h.frame.scale[i] == 0 || !std::isfinite(h.frame.offset[i]))
      throw std::runtime_error("the LAS header has no scale or no offset of the coordinates");
  }
  if(h.point_format > 10)
    throw_error("has LAS points of the unknown format ", h.point_format, ", expected 0 to 10");
  const std::size_t least = las_point_size(h.point_format);
  if(h.record_length < least)
    throw_error("has LAS points of ", h.record_length, " bytes, the format ", h.point_format, " needs ", least);
  if(h.minor_version == 4 && header_size >= header_1_4) {
    read_exactly(in, bytes + smallest_header, header_1_4 - smallest_header, "the LAS header");
    const std::uint64_t count = number_at<std::uint64_t>(bytes + 247);
    h.count = count > 0 ? count : h.count;
  }
  if(h.first_point < header_size)
    throw std::runtime_error("the points of the LAS file begin in its header");
  in.skip((std::min)(in.left(), header_size - in.position()));
  for(std::string& record :
      read_records(in, number_at<std::uint32_t>(bytes + 100), (std::min)(h.first_point, in.position() + in.left())))
    if(describes_bytes(record))
      h.dimensions = dimensions_of(record, h);
    else
      h.frame.records.push_back(std::move(record));
  constexpr std::uint16_t wkt_bit = 16;
  h.frame.projection = projection_of(h.frame.records, (number_at<std::uint16_t>(bytes + 6) & wkt_bit) != 0);
  return h;
}

namespace {

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
    if(in.sgetn(record.data(), h.record_length) != h.record_length)
      fail_after(i, h.count);
    Point_row row = point_of_record(record.data(), h);
    if(tolerance != nullptr)
      row.tolerance = value_of(record.data() + tolerance->position, *tolerance);
    builder.add(row);
  }
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
  const std::uint64_t bytes = in.position() + in.left();
  check_room(h.count, h.first_point < bytes ? (bytes - h.first_point) / h.record_length : 0);
  in.skip(h.first_point - in.position());
  if(settings.classes.empty() && !settings.crop)
    points.reserve(std::size_t(h.count));
  read_records(in, h, tolerance, builder);
}

} // namespace program
