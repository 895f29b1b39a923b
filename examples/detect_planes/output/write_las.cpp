// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/writers.h"

#include "input/readers.h"

namespace program {

namespace {

struct Bounds {
  Box box = Box(0, 0, 0, 0, 0, 0);
  std::uint64_t count = 0; // of the points that are finite
};

// Points whose place is none may be where they need no room on the grid.
std::function<bool(Point_set::Index)> measured_points(const Output_points& cloud)
{
  const auto has_none = find_property<bool>(cloud.points, no_value_name);
  return [&cloud, has_none](Point_set::Index i) {
    return is_finite(cloud.points.point(i)) && !(has_none && (*has_none)[i]);
  };
}

template <class Is_counted>
Bounds bounds_of(const Output_points& cloud, const Is_counted& is_counted)
{
  Bounds b = {Box(), 0};
  for(Point_set::Index i : cloud.part)
    if(is_counted(i)) {
      ++b.count;
      b.box += cloud.points.point(i).bbox();
    }
  return b.count > 0 ? b : Bounds();
}

double integer_of(double x, const Las_frame& frame, std::size_t c)
{
  return std::round((x - frame.offset[c]) / frame.scale[c]);
}

constexpr double largest_integer = 2147483647;

// The nearest one that there is.
std::int32_t integer_on_grid(double x, const Las_frame& frame, std::size_t c)
{
  return std::int32_t((std::max)((std::min)(integer_of(x, frame, c), largest_integer), -largest_integer));
}

double place_on_grid(double x, const Las_frame& frame, std::size_t c)
{
  return place_of_integer(integer_on_grid(x, frame, c), frame, c);
}

bool has_room(const Las_frame& frame, const Bounds& b)
{
  for(int c = 0; c < 3; ++c)
    for(double x : {b.box.min(c), b.box.max(c)})
      if(!(std::fabs(integer_of(x, frame, std::size_t(c))) <= largest_integer))
        return false;
  return true;
}

// The middle with as few digits as leave room on both sides of it: 0 for a cloud around the origin.
double make_offset(double least, double most, double scale)
{
  const double middle = least / 2 + most / 2;
  const double room = (std::min)(largest_integer * scale - (most / 2 - least / 2), 1e300);
  if(!(room > 0))
    return middle;
  const int exponent = int(std::floor(std::log10(room)));
  const double unit = std::pow(10., std::abs(exponent));
  const double rounded = exponent < 0 ? std::round(middle * unit) / unit : std::round(middle / unit) * unit;
  return rounded + 0.; // never -0
}

// False where the integers have no room for these steps.
bool set_grid(double scale, const Bounds& b, Las_frame& frame)
{
  frame.scale = {scale, scale, scale};
  for(int c = 0; c < 3; ++c)
    frame.offset[std::size_t(c)] = make_offset(b.box.min(c), b.box.max(c), scale);
  return has_room(frame, b);
}

constexpr double largest_step = 2e-4; // times the maximum distance

// Steps of a power of ten; the largest step, or a power that is larger, where the integers have no room for that. Room for
// the measured points is enough where all need larger steps.
Las_frame make_frame(const Bounds& all, const Bounds& measured, double maximum_distance)
{
  const double largest = (std::max)(largest_step * maximum_distance, 1e-300);
  const auto power = [](int exponent) { return exponent < 0 ? 1 / std::pow(10., -exponent) : std::pow(10., exponent); };
  int exponent = int(std::floor(std::log10(largest)));
  Las_frame frame;
  for(const Bounds* b : {&all, &measured})
    if(set_grid(power(exponent), *b, frame) || set_grid(largest, *b, frame))
      return frame;
  while(!set_grid(power(++exponent), measured, frame) && exponent < 300)
    ;
  return frame;
}

// No point is moved by more than the largest step rounds it: the points of other inputs need not be on this grid.
bool is_fine(const Las_frame& frame, const Output_points& cloud)
{
  const double most = largest_step / 2 * cloud.shapes.parameters().maximum_distance;
  return std::all_of(cloud.part.begin(), cloud.part.end(), [&, is_measured = measured_points(cloud)](auto i) {
    const Kernel::Point_3& p = cloud.points.point(i);
    for(int c = 0; is_measured(i) && c < 3; ++c)
      if(std::fabs(place_on_grid(p[c], frame, std::size_t(c)) - p[c]) > most)
        return false;
    return true;
  });
}

std::string padded(std::string text, std::size_t size)
{
  text.resize(size, '\0');
  return text;
}

// The record that describes the extra bytes.
std::string extra_bytes_record(const std::string& name)
{
  constexpr char int32_type = 6;
  std::string record =
    padded("", 2) + padded("LASF_Spec", 16) + std::string("\4\0\300\0", 4) + padded("extra bytes", 32);
  record += std::string("\0\0", 2) + int32_type + '\0' + padded(name, 32);
  return padded(record, 54 + 160) + padded("shape of detect_planes", 32);
}

void write_header(std::ostream& out, const Las_frame& frame, const Bounds& bounds, bool is_format_7)
{
  constexpr std::uint16_t header_size = 375;
  std::size_t first_point = header_size;
  for(const std::string& record : frame.records)
    first_point += record.size();
  // WKT, which the specification asks for with this format; but keys of GeoTIFF are what they are.
  const std::uint16_t global_encoding = is_format_7 && frame.projection != Projection::geotiff ? 16 : 0;
  // Not for the formats from 6 on, nor for more than 32 bits.
  const std::uint32_t old_count = !is_format_7 && bounds.count <= 0xFFFFFFFF ? std::uint32_t(bounds.count) : 0;
  out << "LASF" << padded("", 2);
  write_binary(out, global_encoding);
  out << padded("", 16) << '\1' << '\4' << padded("", 32) << padded("detect_planes of Tandem", 32) << padded("", 4);
  write_binary(out, header_size);
  write_binary(out, std::uint32_t(first_point));
  write_binary(out, std::uint32_t(frame.records.size()));
  out << (is_format_7 ? '\7' : '\2');
  write_binary(out, std::uint16_t((is_format_7 ? 36 : 26) + 4));
  write_binary(out, old_count);
  write_binary(out, old_count);
  out << padded("", 16);
  for(const std::array<double, 3>& numbers : {frame.scale, frame.offset})
    for(double x : numbers)
      write_binary(out, x);
  for(int c = 0; c < 3; ++c)
    for(double x : {bounds.box.max(c), bounds.box.min(c)})
      write_binary(out, place_on_grid(x, frame, std::size_t(c)));
  out << padded("", 20); // neither waveforms nor extended records
  write_binary(out, bounds.count);
  write_binary(out, bounds.count); // all of them are first returns
  out << padded("", 14 * 8);
}

void write_point(std::ostream& out, const Output_points& cloud, Point_set::Index i, const Las_frame& frame,
                 bool is_format_7)
{
  const Kernel::Point_3& p = cloud.points.point(i);
  for(int c = 0; c < 3; ++c)
    write_binary(out, integer_on_grid(p[c], frame, std::size_t(c)));
  const float intensity = cloud.intensity ? (*cloud.intensity)[i] : 0;
  write_binary(out, intensity > 0 ? std::uint16_t(std::lround((std::min)(intensity, 65535.f))) : std::uint16_t(0));
  const std::uint8_t classification = cloud.classification ? (*cloud.classification)[i] : std::uint8_t(0);
  if(is_format_7)
    out << '\x11' << '\0' << char(classification) << padded("", 13); // first return of one; no time
  else
    out << '\x09' << char(classification) << padded("", 4);
  for(std::uint16_t channel : cloud.wide_color(i))
    write_binary(out, channel);
  write_binary(out, cloud.shape(i));
}

} // namespace

void write_las(std::ostream& out, const Output_points& cloud, const std::optional<Las_frame>& frame_of_input)
{
  const auto is_written = [&](Point_set::Index i) { return is_finite(cloud.points.point(i)); };
  const Bounds bounds = bounds_of(cloud, is_written), measured = bounds_of(cloud, measured_points(cloud));
  const bool is_kept =
    frame_of_input && (bounds.count == 0 || (has_room(*frame_of_input, measured) && is_fine(*frame_of_input, cloud)));
  Las_frame frame =
    is_kept ? *frame_of_input : make_frame(bounds, measured, cloud.shapes.parameters().maximum_distance);
  if(frame_of_input) {
    frame.records = frame_of_input->records;
    frame.projection = frame_of_input->projection;
  }
  frame.records.push_back(extra_bytes_record(cloud.label_property));
  // Most programs read the point format 2; 7 has room for all classes, and is the one for coordinate systems as WKT.
  const auto is_high = [&](Point_set::Index i) { return cloud.classification && (*cloud.classification)[i] > 31; };
  const bool is_format_7 =
    frame.projection == Projection::wkt || std::any_of(cloud.part.begin(), cloud.part.end(), is_high);
  write_header(out, frame, bounds, is_format_7);
  for(const std::string& record : frame.records)
    out << record;
  for(Point_set::Index i : cloud.part)
    if(is_finite(cloud.points.point(i)))
      write_point(out, cloud, i, frame, is_format_7);
}

} // namespace program
