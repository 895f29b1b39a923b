// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/las_header.h"

#include <cmath>
#include <stdexcept>

namespace program {

namespace {

constexpr std::size_t smallest_header = 227, header_1_4 = 375, record_header = 54;

void read_exactly(Input_buffer& in, char* bytes, std::size_t count, const char* what)
{
  if(in.left() < count || std::size_t(in.sgetn(bytes, std::streamsize(count))) != count)
    throw std::runtime_error(std::string("is truncated: ") + what + " is not complete");
}

Las_frame read_frame(const char* bytes)
{
  Las_frame frame;
  for(std::size_t i = 0; i < 3; ++i) {
    frame.scale[i] = number_at<double>(bytes + 131 + 8 * i);
    frame.offset[i] = number_at<double>(bytes + 155 + 8 * i);
    if(!std::isfinite(frame.scale[i]) || frame.scale[i] == 0 || !std::isfinite(frame.offset[i]))
      throw std::runtime_error("the LAS header has no scale or no offset of the coordinates");
  }
  return frame;
}

void check_point_format(const Las_header& h)
{
  constexpr std::uint16_t least[11] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  if(h.point_format > 10)
    throw std::runtime_error("has LAS points of the unknown format " + std::to_string(h.point_format) +
                             ", expected 0 to 10");
  if(h.record_length < least[h.point_format])
    throw std::runtime_error("has LAS points of " + std::to_string(h.record_length) + " bytes, the format " +
                             std::to_string(h.point_format) + " needs " + std::to_string(least[h.point_format]));
}

// What the records hold. If that is both, the flag of the header says which to use.
Projection projection_of(const std::vector<std::string>& records, bool is_declared_wkt)
{
  constexpr std::uint16_t wkt = 2112, geotiff_keys = 34735;
  const auto has = [&records](std::uint16_t id) {
    return std::any_of(records.begin(), records.end(),
                       [id](const std::string& r) { return number_at<std::uint16_t>(r.data() + 18) == id; });
  };
  if(has(wkt) && (is_declared_wkt || !has(geotiff_keys)))
    return Projection::wkt;
  return has(geotiff_keys) ? Projection::geotiff : Projection::none;
}

// The records that tell the coordinate system. What comes after a damaged one is left out.
std::vector<std::string> read_records(Input_buffer& in, std::uint32_t count, std::uint64_t end)
{
  std::vector<std::string> records;
  for(; count > 0 && in.position() + record_header <= end; --count) {
    std::string record(record_header, '\0');
    read_exactly(in, record.data(), record_header, "a record of the LAS header");
    const std::uint16_t length = number_at<std::uint16_t>(record.data() + 20);
    if(length > end - in.position())
      break;
    if(record.compare(2, 15, "LASF_Projection") != 0) {
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
    throw std::runtime_error("has the LAS version " + std::to_string(int(bytes[24])) + '.' +
                             std::to_string(int(bytes[25])) + ", expected 1.0 to 1.4");
  Las_header h;
  h.minor_version = bytes[25];
  const std::size_t header_size = number_at<std::uint16_t>(bytes + 94);
  if(header_size < smallest_header)
    throw std::runtime_error("has a LAS header of " + std::to_string(header_size) + " bytes");
  h.first_point = number_at<std::uint32_t>(bytes + 96);
  h.is_compressed = (bytes[104] & 0xC0) != 0;
  h.point_format = bytes[104] & 0x3F;
  h.record_length = number_at<std::uint16_t>(bytes + 105);
  h.count = number_at<std::uint32_t>(bytes + 107);
  h.frame = read_frame(bytes);
  check_point_format(h);
  if(h.minor_version == 4 && header_size >= header_1_4) {
    read_exactly(in, bytes + smallest_header, header_1_4 - smallest_header, "the LAS header");
    const std::uint64_t count = number_at<std::uint64_t>(bytes + 247);
    h.count = count > 0 ? count : h.count;
  }
  if(h.first_point < header_size)
    throw std::runtime_error("the points of the LAS file begin in its header");
  in.skip((std::min)(in.left(), header_size - in.position()));
  h.frame.records =
    read_records(in, number_at<std::uint32_t>(bytes + 100), (std::min)(h.first_point, in.position() + in.left()));
  constexpr std::uint16_t wkt_bit = 16;
  h.frame.projection = projection_of(h.frame.records, (number_at<std::uint16_t>(bytes + 6) & wkt_bit) != 0);
  return h;
}

} // namespace program
