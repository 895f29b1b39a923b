// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"

#include <map>

namespace program {

namespace {

// --- The decompression of LZF, as PCD files have it.

// A piece of a compressed text begins with a byte c. Below 32, c + 1 bytes follow, which are taken as they are. Else
// the upper three bits are a length less 2 (7: the next byte is added), the other five and one more byte a distance
// back, less 1, to what is repeated. False if the result has not exactly `size` bytes.
bool decompress_lzf(const std::string& in, std::size_t size, std::string& out)
{
  out.clear();
  out.reserve(size);
  const auto byte = [&in](std::size_t i) { return std::size_t(static_cast<unsigned char>(in[i])); };
  for(std::size_t i = 0; i < in.size();) {
    const std::size_t c = byte(i++);
    if(c < 32) {
      if(in.size() - i < c + 1 || size - out.size() < c + 1)
        return false;
      out.append(in, i, c + 1);
      i += c + 1;
      continue;
    }
    std::size_t length = c >> 5;
    if(length == 7 && i < in.size())
      length += byte(i++);
    length += 2;
    if(i >= in.size())
      return false;
    const std::size_t distance = ((c & 31) << 8) + byte(i++) + 1;
    if(distance > out.size() || size - out.size() < length)
      return false;
    for(; length > 0; --length)
      out += out[out.size() - distance]; // what is repeated may overlap its repetition
  }
  return out.size() == size;
}

// --- The header of PCD files, the format of the Point Cloud Library.

struct Pcd_header {
  struct Field {
    std::string name;
    std::size_t size = 0;     // of one value, in bytes
    char type = 0;            // I, U or F: signed, unsigned, real
    std::size_t count = 1;    // of values
    std::size_t position = 0; // of its bytes in the row of a point
    std::size_t first = 0;    // of its values in a row of text
  };
  std::vector<Field> fields;
  std::uint64_t points = 0;
  std::string data;                   // ascii, binary or binary_compressed
  std::vector<std::string> viewpoint; // the words of that line; none without one

  const Field* find(const std::string& name) const
  {
    for(const Field& f : fields)
      if(f.name == name)
        return &f;
    return nullptr;
  }

  std::size_t row_size() const
  {
    return fields.empty() ? 0 : fields.back().position + fields.back().size * fields.back().count;
  }
  std::size_t row_values() const { return fields.empty() ? 0 : fields.back().first + fields.back().count; }
};

// What the lines say, before they are put together.
struct Lines {
  std::vector<std::string> names, types, viewpoint;
  std::vector<std::uint64_t> sizes, counts;
  std::map<std::string, std::uint64_t> numbers; // WIDTH, HEIGHT, POINTS

  std::uint64_t number(const std::string& key, std::uint64_t otherwise) const
  {
    const auto found = numbers.find(key);
    return found == numbers.end() ? otherwise : found->second;
  }
};

std::uint64_t parse_number_of(const std::string& key, const std::string& word)
{
  constexpr std::size_t most_digits = 15;
  if(word.empty() || word.size() > most_digits || word.find_first_not_of("0123456789") != word.npos)
    throw_error("the PCD header has '", word, "' where a number of ", key, " is expected");
  return std::stoull(word);
}

std::vector<std::string> words_of(std::istream& line)
{
  std::vector<std::string> words;
  for(std::string word; line >> word;)
    words.push_back(word);
  return words;
}

std::vector<std::uint64_t> parse_numbers(const std::string& key, std::istream& line)
{
  std::vector<std::uint64_t> numbers;
  for(const std::string& word : words_of(line))
    numbers.push_back(parse_number_of(key, word));
  return numbers;
}

std::uint64_t parse_one(const std::string& key, std::istream& line)
{
  const std::vector<std::uint64_t> numbers = parse_numbers(key, line);
  if(numbers.size() != 1)
    throw_error("the PCD header has no number of ", key);
  return numbers[0];
}

void parse_line(const std::string& key, std::istream& line, Lines& lines)
{
  if(key == "FIELDS" || key == "COLUMNS")
    lines.names = words_of(line);
  else if(key == "SIZE")
    lines.sizes = parse_numbers(key, line);
  else if(key == "TYPE")
    lines.types = words_of(line);
  else if(key == "COUNT")
    lines.counts = parse_numbers(key, line);
  else if(key == "WIDTH" || key == "HEIGHT" || key == "POINTS")
    lines.numbers[key] = parse_one(key, line);
  else if(key == "VIEWPOINT")
    lines.viewpoint = words_of(line);
  else if(key != "VERSION")
    throw_error("the PCD header has the unknown line '", key.substr(0, 40), "'");
}

Pcd_header::Field make_field(const Lines& lines, std::size_t i)
{
  Pcd_header::Field f;
  f.name = lines.names[i];
  f.size = std::size_t(lines.sizes[i]);
  f.type = lines.types[i][0];
  f.count = lines.counts.empty() ? 1 : std::size_t(lines.counts[i]);
  const bool is_integer = f.type == 'I' || f.type == 'U';
  const bool is_known = is_integer ? f.size == 1 || f.size == 2 || f.size == 4 || f.size == 8
                                   : f.type == 'F' && (f.size == 4 || f.size == 8);
  constexpr std::size_t most = 65536;
  if(!is_known || lines.types[i].size() != 1 || f.count > most)
    throw_error("the PCD field '", f.name, "' has the type ", lines.types[i], " of ", f.size, " bytes, ", f.count,
                " times, expected I, U or F of 1, 2, 4 or 8 bytes");
  return f;
}

Pcd_header join(const Lines& lines)
{
  const std::size_t n = lines.names.size();
  if(n == 0 || lines.sizes.size() != n || lines.types.size() != n ||
     (!lines.counts.empty() && lines.counts.size() != n))
    throw std::runtime_error("the PCD header must have as many items in FIELDS, SIZE, TYPE and COUNT");
  Pcd_header header;
  header.viewpoint = lines.viewpoint;
  for(std::size_t i = 0; i < n; ++i) {
    Pcd_header::Field f = make_field(lines, i);
    f.position = header.row_size();
    f.first = header.row_values();
    header.fields.push_back(f);
  }
  const std::uint64_t width = lines.number("WIDTH", lines.number("POINTS", 0)), height = lines.number("HEIGHT", 1);
  if(height > 0 && width > (std::numeric_limits<std::uint64_t>::max)() / height)
    throw std::runtime_error("the PCD header has too large a WIDTH or HEIGHT");
  header.points = lines.number("POINTS", width * height);
  if(header.points != width * height)
    throw_error("the PCD header has ", header.points, " POINTS, but WIDTH times HEIGHT is ", width * height);
  return header;
}

void check_coordinates(const Pcd_header& header)
{
  for(const char* name : {"x", "y", "z"})
    if(const Pcd_header::Field* f = header.find(name); f == nullptr || f->count != 1)
      throw_error("the points of the PCD file have no field '", name, "'");
}

// Up to the line DATA.
Pcd_header read_pcd_header(Text_lines& text)
{
  Lines lines;
  while(text.next()) {
    std::istringstream line(text.row().text);
    std::string key;
    if(!(line >> key) || key[0] == '#')
      continue;
    if(key != "DATA") {
      parse_line(key, line, lines);
      continue;
    }
    Pcd_header header = join(lines);
    check_coordinates(header);
    line >> header.data;
    if(header.data != "ascii" && header.data != "binary" && header.data != "binary_compressed")
      throw_error("unknown DATA '", header.data, "' of PCD");
    return header;
  }
  throw std::runtime_error("is not a PCD file, or its header has no end (a line DATA)");
}

// --- The points

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
    throw_error("is truncated: ", points, " points announced, room for ", room);
}

[[noreturn]] void fail_after(std::uint64_t point, std::uint64_t points)
{
  check_signals();
  throw_error("unreadable after point ", point, " of ", points);
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
    throw_error("is truncated: ", compressed, " compressed bytes announced, ", in.left(), " found");
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
    throw_error("has more rows than the ", h.points, " points that it announces");
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
