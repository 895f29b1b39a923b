// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"

#include "input/Cloud_builder.h"
#include "input/decimal_commas.h"
#include "input/find_name.h"
#include "input/las_header.h"
#include "input/lzf.h"
#include "input/pcd_header.h"
#include "input/table_values.h"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace program {

namespace {

using Field = Pcd_header::Field;

// The fields that are used, null where the file has none.
struct Used_fields {
  std::array<const Field*, 3> point, normal;
  const Field *color, *intensity, *classification, *tolerance;
};

// That of --tolerance-column.
const Field* tolerance_field(const Pcd_header& h, const std::string& wanted)
{
  std::vector<std::string> names;
  for(const Field& f : h.fields)
    names.push_back(f.count == 1 ? f.name : "");
  return wanted.empty() ? nullptr : &h.fields[find_name(names, wanted, "field")];
}

Used_fields used_fields(const Pcd_header& h, const std::string& tolerance)
{
  const auto single = [&h](const char* name) {
    const Field* f = h.find(name);
    return f != nullptr && f->count == 1 ? f : nullptr;
  };
  Used_fields used = {{single("x"), single("y"), single("z")},
                      {single("normal_x"), single("normal_y"), single("normal_z")},
                      single("rgb"),
                      single("intensity"),
                      single("classification"),
                      tolerance_field(h, tolerance)};
  if(used.color == nullptr)
    used.color = single("rgba");
  if(used.color != nullptr && used.color->size != 4)
    used.color = nullptr;
  if(used.normal[0] == nullptr || used.normal[1] == nullptr || used.normal[2] == nullptr)
    used.normal = {nullptr, nullptr, nullptr};
  return used;
}

Input_color unpacked(std::uint32_t rgb)
{
  return {wide_channel(std::uint8_t(rgb >> 16)), wide_channel(std::uint8_t(rgb >> 8)), wide_channel(std::uint8_t(rgb))};
}

std::uint8_t class_of(double x) { return x > 0 && x < 256 ? std::uint8_t(x) : std::uint8_t(0); }

// `value` gives the number in a field, `bits` the four bytes of a color.
template <class Value, class Bits>
Point_row make_row(const Used_fields& used, Value value, Bits bits)
{
  Point_row row;
  for(std::size_t i = 0; i < 3; ++i) {
    row.point[i] = value(*used.point[i]);
    if(used.normal[i] != nullptr)
      row.normal[i] = value(*used.normal[i]);
  }
  if(used.color != nullptr)
    row.color = unpacked(bits(*used.color));
  if(used.intensity != nullptr)
    row.intensity = float(value(*used.intensity));
  if(used.classification != nullptr)
    row.classification = class_of(value(*used.classification));
  if(used.tolerance != nullptr)
    row.tolerance = value(*used.tolerance);
  return row;
}

void check_room(std::uint64_t points, std::uint64_t room)
{
  if(points > room)
    throw std::runtime_error("is truncated: " + std::to_string(points) + " points announced, room for " +
                             std::to_string(room));
}

[[noreturn]] void fail_after(std::uint64_t point, std::uint64_t points)
{
  if(is_interrupted())
    throw Interrupted();
  throw std::runtime_error("unreadable after point " + std::to_string(point) + " of " + std::to_string(points));
}

// `start_of(field, i)` are the bytes of a field of point i.
template <class Start_of>
Point_row row_of_bytes(const Used_fields& used, Start_of start_of)
{
  return make_row(
    used, [&](const Field& f) { return number_of_type(start_of(f), f.type, f.size); },
    [&](const Field& f) { return number_at<std::uint32_t>(start_of(f)); });
}

void read_binary(Input_buffer& in, const Pcd_header& h, const Used_fields& used, Cloud_builder& builder)
{
  check_room(h.points, in.left() / h.row_size());
  std::vector<char> row(h.row_size());
  for(std::uint64_t i = 0; i < h.points; ++i) {
    if(in.sgetn(row.data(), std::streamsize(row.size())) != std::streamsize(row.size()))
      fail_after(i, h.points);
    builder.add(row_of_bytes(used, [&](const Field& f) { return row.data() + f.position; }));
  }
}

// Two numbers, the sizes with and without compression. What is compressed has all values of the first field, then all
// of the second one.
std::string decompress(Input_buffer& in, const Pcd_header& h)
{
  char sizes[8];
  if(in.sgetn(sizes, 8) != 8)
    throw std::runtime_error("is truncated: the sizes of the compressed points are missing");
  const std::uint64_t compressed = number_at<std::uint32_t>(sizes), size = number_at<std::uint32_t>(sizes + 4);
  constexpr std::uint64_t largest_ratio = 88; // three bytes repeat 264
  if(compressed > in.left() || size > compressed * largest_ratio)
    throw std::runtime_error("is truncated: " + std::to_string(compressed) + " compressed bytes announced, " +
                             std::to_string(in.left()) + " found");
  check_room(h.points, size / h.row_size());
  std::string bytes(std::size_t(compressed), '\0'), result;
  if(in.sgetn(bytes.data(), std::streamsize(bytes.size())) != std::streamsize(bytes.size()) && is_interrupted())
    throw Interrupted();
  if(!decompress_lzf(bytes, std::size_t(size), result))
    throw std::runtime_error("the compressed points are damaged");
  return result;
}

void read_compressed(Input_buffer& in, const Pcd_header& h, const Used_fields& used, Cloud_builder& builder)
{
  const std::string bytes = decompress(in, h);
  const std::size_t n = std::size_t(h.points);
  for(std::size_t i = 0; i < n; ++i)
    builder.add(
      row_of_bytes(used, [&](const Field& f) { return bytes.data() + f.position * n + i * f.size * f.count; }));
}

// The bits of a real number are the color, as PCL takes it.
std::uint32_t color_bits(double value, const Field& f)
{
  const float real = float(value);
  std::uint32_t bits;
  std::memcpy(&bits, &real, 4);
  return f.type == 'F' ? bits : value >= 0 && value < 4294967296. ? std::uint32_t(value) : 0;
}

// Numbers are separated by blanks.
void parse_row(const Text_row& row, std::vector<double>& values)
{
  Table_values rest(row.text, ' ');
  std::string_view text;
  for(std::size_t i = 0; i < values.size(); ++i) {
    const std::optional<double> number = rest.next(text) ? parse_number(text) : std::nullopt;
    if(!number)
      fail_at_row(row.number, text.empty()
                                ? "has " + std::to_string(i) + " values instead of " + std::to_string(values.size())
                                : "has '" + std::string(text.substr(0, 40)) + "' where a number is expected" +
                                    advice_on_commas(row.text));
    values[i] = *number;
    text = {};
  }
  if(rest.next(text))
    fail_at_row(row.number, "has more than " + std::to_string(values.size()) + " values");
}

void read_text(Input_buffer& in, Text_lines& lines, const Pcd_header& h, const Used_fields& used,
               Cloud_builder& builder)
{
  check_room(h.points, (in.left() + 1) / (2 * h.row_values())); // a digit and a separator each
  std::vector<double> values(h.row_values());
  for(std::uint64_t i = 0; i < h.points; ++i) {
    if(!lines.next_filled())
      fail_after(i, h.points);
    parse_row(lines.row(), values);
    builder.add(make_row(
      used, [&](const Field& f) { return values[f.first]; },
      [&](const Field& f) { return color_bits(values[f.first], f); }));
  }
  if(lines.next_filled())
    throw std::runtime_error("has more rows than the " + std::to_string(h.points) + " points that it announces");
}

// The place, and the rotation as quaternion, which says nothing of the side that was seen. Files were read whatever the
// line says, so it is no error.
void note_viewpoint(const std::vector<std::string>& words, bool has_normals, Input_notes& notes)
{
  if(words.empty())
    return;
  std::vector<double> numbers;
  for(const std::string& word : words)
    if(const std::optional<double> number = parse_number(word); number && std::isfinite(*number))
      numbers.push_back(*number);
  if(numbers.size() == words.size() && numbers.size() == 7)
    notes.viewpoint = {{numbers[0], numbers[1], numbers[2]}, numbers == std::vector<double>{0, 0, 0, 1, 0, 0, 0}};
  else if(!has_normals)
    notes.warnings.push_back("the VIEWPOINT of the PCD header is not seven finite numbers, and is not used");
}

} // namespace

void read_pcd(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes)
{
  Input_buffer in(file);
  Text_lines lines(in);
  const Pcd_header h = read_pcd_header(lines);
  const Used_fields used = used_fields(h, settings.tolerance);
  if(!settings.classes.empty() && used.classification == nullptr)
    throw std::runtime_error("has no field 'classification', which --classes needs");
  note_viewpoint(h.viewpoint, used.normal[0] != nullptr, notes);
  Cloud_builder builder(points,
                        {used.normal[0] != nullptr, used.color != nullptr, used.intensity != nullptr,
                         used.classification != nullptr, used.tolerance != nullptr},
                        settings, notes);
  if(h.data == "binary")
    read_binary(in, h, used, builder);
  else if(h.data == "binary_compressed")
    read_compressed(in, h, used, builder);
  else
    read_text(in, lines, h, used, builder);
}

} // namespace program
