// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"

#include <iterator>
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
  std::string before, shape;          // the comments and the version; width and height

  // The first of that name, if it has one value.
  std::size_t find(const std::string& name) const
  {
    const auto f = std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
    return f != fields.end() && f->count == 1 ? std::size_t(f - fields.begin()) : nowhere;
  }

  std::size_t row_size() const
  {
    return fields.empty() ? 0 : fields.back().position + fields.back().size * fields.back().count;
  }
  std::size_t row_values() const { return fields.empty() ? 0 : fields.back().first + fields.back().count; }
};

// The words of each line, before they are put together.
using Lines = std::map<std::string, std::vector<std::string>>;

std::uint64_t parse_number_of(const std::string& key, const std::string& word)
{
  constexpr std::size_t most_digits = 15;
  if(word.size() > most_digits || word.find_first_not_of("0123456789") != word.npos)
    throw_error("the PCD header has '", word, "' where a number of ", key, " is expected");
  return std::stoull(word);
}

std::uint64_t number_of_line(const Lines& lines, const std::string& key, std::uint64_t otherwise)
{
  const auto line = lines.find(key);
  if(line != lines.end() && line->second.size() != 1)
    throw_error("the PCD header has no number of ", key);
  return line == lines.end() ? otherwise : parse_number_of(key, line->second[0]);
}

Pcd_header::Field make_field(Lines& lines, std::size_t i)
{
  Pcd_header::Field f;
  const std::string type = lines["TYPE"][i];
  f.name = lines["FIELDS"][i];
  f.size = std::size_t(parse_number_of("SIZE", lines["SIZE"][i]));
  f.type = type[0];
  f.count = lines["COUNT"].empty() ? 1 : std::size_t(parse_number_of("COUNT", lines["COUNT"][i]));
  const bool is_known = ((f.type == 'I' || f.type == 'U') && (f.size == 1 || f.size == 2)) ||
                        ((f.type == 'I' || f.type == 'U' || f.type == 'F') && (f.size == 4 || f.size == 8));
  constexpr std::size_t most = 65536;
  if(!is_known || type.size() != 1 || f.count > most)
    throw_error("the PCD field '", f.name, "' has the type ", type, " of ", f.size, " bytes, ", f.count,
                " times, expected I, U or F of 1, 2, 4 or 8 bytes");
  return f;
}

Pcd_header join(Lines& lines)
{
  const std::size_t n = lines["FIELDS"].size(), counts = lines["COUNT"].size();
  if(n == 0 || lines["SIZE"].size() != n || lines["TYPE"].size() != n || (counts > 0 && counts != n))
    throw std::runtime_error("the PCD header must have as many items in FIELDS, SIZE, TYPE and COUNT");
  Pcd_header header;
  header.viewpoint = lines["VIEWPOINT"];
  for(std::size_t i = 0; i < n; ++i) {
    Pcd_header::Field f = make_field(lines, i);
    f.position = header.row_size();
    f.first = header.row_values();
    header.fields.push_back(f);
  }
  for(const char* name : {"x", "y", "z"})
    if(header.find(name) == nowhere)
      throw_error("the points of the PCD file have no field '", name, "'");
  const std::uint64_t width = number_of_line(lines, "WIDTH", number_of_line(lines, "POINTS", 0));
  const std::uint64_t height = number_of_line(lines, "HEIGHT", 1);
  if(height > 0 && width > (std::numeric_limits<std::uint64_t>::max)() / height)
    throw std::runtime_error("the PCD header has too large a WIDTH or HEIGHT");
  header.points = number_of_line(lines, "POINTS", width * height);
  if(header.points != width * height)
    throw_error("the PCD header has ", header.points, " POINTS, but WIDTH times HEIGHT is ", width * height);
  header.shape = text_of("WIDTH ", width, "\nHEIGHT ", height, '\n');
  header.data = lines["DATA"].empty() ? "" : lines["DATA"][0];
  if(!is_in(header.data, {"ascii", "binary", "binary_compressed"}))
    throw_error("unknown DATA '", header.data, "' of PCD");
  return header;
}

// Up to the line DATA.
Pcd_header read_pcd_header(Text_lines& text)
{
  Lines lines;
  std::string before;
  while(text.next()) {
    std::istringstream line(text.row().text);
    std::vector<std::string> words(std::istream_iterator<std::string>(line), {});
    if(!words.empty() && (words[0][0] == '#' || words[0] == "VERSION"))
      before += text.row().text + '\n';
    if(words.empty() || words[0][0] == '#')
      continue;
    const std::string key = words[0] == "COLUMNS" ? "FIELDS" : words[0];
    if(!is_in(key, {"VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS", "DATA"}))
      throw_error("the PCD header has the unknown line '", key.substr(0, 40), "'");
    words.erase(words.begin());
    lines[key] = words;
    if(key == "DATA") {
      Pcd_header header = join(lines);
      header.before = before;
      return header;
    }
  }
  throw std::runtime_error("is not a PCD file, or its header has no end (a line DATA)");
}

// --- The points

using Field = Pcd_header::Field;

// The fields that are used.
struct Used_fields {
  const Pcd_header& header;
  Column_places places;
  const Field* color;                  // or null
  std::vector<const Field*> kept = {}; // in the records of points
};

Used_fields used_fields(const Pcd_header& h, const std::string& tolerance)
{
  const char* const names_of_columns[] = {"x", "y", "z", "normal_x",  "normal_y",      "normal_z",
                                          "",  "",  "",  "intensity", "classification"};
  const std::size_t color = h.find(h.find("rgb") != nowhere ? "rgb" : "rgba");
  Used_fields used = {h, {}, color != nowhere && h.fields[color].size == 4 ? &h.fields[color] : nullptr};
  used.places.fill(nowhere);
  std::transform(std::begin(names_of_columns), std::end(names_of_columns), used.places.begin(),
                 [&](const char* name) { return h.find(name); });
  std::vector<std::string> names;
  for(const Field& f : h.fields)
    names.push_back(f.count == 1 ? f.name : "");
  if(!tolerance.empty())
    used.places[std::size_t(Column::tolerance)] = find_name(names, tolerance, "field");
  return used;
}

// `value` gives the number in a field, `bits` the four bytes of a color.
template <class Value, class Bits>
Point_row make_row(const Used_fields& used, Value value, Bits bits)
{
  Point_row row = row_of(values_at(used.places, [&](std::size_t place) { return value(used.header.fields[place]); }));
  const std::uint32_t rgb = used.color != nullptr ? bits(*used.color) : 0;
  for(std::size_t c = 0; c < 3; ++c)
    row.color[c] = wide_channel(std::uint8_t(rgb >> (16 - 8 * c)));
  return row;
}

// Adds a point; start_of(field): its bytes.
template <class Start_of>
void add_bytes(const Used_fields& used, Start_of start_of, Cloud_builder& builder, Input_records* records)
{
  const Point_row row = make_row(
    used, [&](const Field& f) { return number_of_type(start_of(f), f.type, f.size); },
    [&](const Field& f) { return number_at<std::uint32_t>(start_of(f)); });
  if(!builder.add(row) || records == nullptr)
    return;
  for(const Field* f : used.kept)
    records->bytes.append(start_of(*f), f->size * f->count);
  records->add("");
}

void read_binary(Input_buffer& in, const Used_fields& used, Cloud_builder& builder, Input_records* records)
{
  const Pcd_header& h = used.header;
  check_room(h.points, in.left() / h.row_size());
  std::vector<char> row(h.row_size());
  for(std::uint64_t i = 0; i < h.points; ++i) {
    if(in.sgetn(row.data(), std::streamsize(row.size())) != std::streamsize(row.size()))
      fail_after(i, h.points);
    add_bytes(
      used, [&](const Field& f) { return row.data() + f.position; }, builder, records);
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

void read_compressed(Input_buffer& in, const Used_fields& used, Cloud_builder& builder, Input_records* records)
{
  const std::string bytes = decompress(in, used.header);
  for(std::size_t i = 0, n = std::size_t(used.header.points); i < n; ++i) {
    const auto start_of = [&](const Field& f) { return bytes.data() + f.position * n + i * f.size * f.count; };
    add_bytes(used, start_of, builder, records);
  }
}

// The bits of a real number are the color, as PCL takes it.
std::uint32_t color_bits(double value, const Field& f)
{
  const float real = float(value);
  std::uint32_t bits;
  std::memcpy(&bits, &real, 4);
  return f.type == 'F' ? bits : value >= 0 && value < 4294967296. ? std::uint32_t(value) : 0;
}

void read_text(Input_buffer& in, Text_lines& lines, const Used_fields& used, Cloud_builder& builder,
               Input_records* records)
{
  const Pcd_header& h = used.header;
  check_room(h.points, (in.left() + 1) / (2 * h.row_values())); // a digit and a separator each
  const std::size_t count = h.row_values();
  for(std::uint64_t i = 0; i < h.points; ++i) {
    if(!lines.next_filled())
      fail_after(i, h.points);
    const std::vector<double> values = numbers_of(lines.row(), ' ');
    if(values.size() > count)
      fail_at_row(lines.row().number, "has more than ", count, " values");
    if(values.size() < count)
      fail_at_row(lines.row().number, "has ", values.size(), " values instead of ", count);
    const Point_row row = make_row(
      used, [&](const Field& f) { return values[f.first]; },
      [&](const Field& f) { return color_bits(values[f.first], f); });
    if(!builder.add(row) || records == nullptr)
      continue;
    const Cells cells = values_of(lines.row().text, ' ');
    for(const Field* f : used.kept)
      for(std::size_t c = f->first; c < f->first + f->count; ++c)
        (records->bytes += cells[c]) += end_of_value;
    records->add("");
  }
  if(lines.next_filled())
    throw_error("has more rows than the ", h.points, " points that it announces");
}

// Finds the fields that records keep, and describes the records.
void describe_records(const Input_settings& settings, Used_fields& used, Input_notes& notes)
{
  Input_records& records = *notes.records;
  const Pcd_header& h = used.header;
  std::array<std::string, 4> lines = {"FIELDS", "SIZE", "TYPE", "COUNT"};
  for(std::size_t i = 0; i < h.fields.size(); ++i) {
    const Field& f = h.fields[i];
    if(!keeps_field(f.name, &f == used.color ? Column::red : column_at(used.places, i), settings, notes))
      continue;
    used.kept.push_back(&f);
    lines[0] += ' ' + f.name;
    lines[1] += ' ' + std::to_string(f.size);
    lines[2] += std::string(" ") + f.type;
    lines[3] += ' ' + std::to_string(f.count);
  }
  const Field& x = h.fields[used.places[0]];
  records.real_size = x.type == 'F' ? x.size : 4;
  records.encoding = h.data == "ascii" ? Encoding::text : Encoding::little_endian;
  records.layout = text_of(h.data == "ascii", lines[0], lines[1], lines[2], lines[3]);
  const std::string viewpoint = h.viewpoint.empty() ? "" : "VIEWPOINT " + boost::join(h.viewpoint, " ") + '\n';
  records.head = {h.before, lines[0], lines[1], lines[2], lines[3], h.shape, viewpoint};
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
    notes.viewpoints = {{{numbers[0], numbers[1], numbers[2]}, numbers == std::vector<double>{0, 0, 0, 1, 0, 0, 0}}};
  else if(!has_normals)
    notes.warnings.push_back("the VIEWPOINT of the PCD header is not seven finite numbers, and is not used");
}

} // namespace

void read_pcd(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes)
{
  Input_buffer in(file);
  Text_lines lines(in);
  const Pcd_header h = read_pcd_header(lines);
  Used_fields used = used_fields(h, settings.tolerance);
  Fields fields = fields_of(used.places, settings, "field");
  fields.color = used.color != nullptr;
  note_viewpoint(h.viewpoint, fields.normal, notes);
  Cloud_builder builder(points, fields, settings, notes);
  if(notes.records)
    describe_records(settings, used, notes);
  if(h.data == "binary")
    read_binary(in, used, builder, notes.records.get());
  else if(h.data == "binary_compressed")
    read_compressed(in, used, builder, notes.records.get());
  else
    read_text(in, lines, used, builder, notes.records.get());
  if(notes.records && notes.records->ends.size() != h.points)
    notes.records->head[5].clear();
}

} // namespace program
