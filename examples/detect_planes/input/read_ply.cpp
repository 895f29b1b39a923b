// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/ply_parts.h"
#include "input/readers.h"

#include <locale>

namespace program {

namespace {

// A real number of a text, as a stream reads it: one that is too small becomes 0, a float is rounded once.
template <class Real>
bool parse_real(std::string_view word, Real& x)
{
  if(word.size() > 1 && word.front() == '+' && word[1] != '-')
    word.remove_prefix(1);
  const auto end = std::from_chars(word.data(), word.data() + word.size(), x);
  if(end.ptr != word.data() + word.size() || end.ec == std::errc())
    return end.ptr == word.data() + word.size() && !word.empty();
  std::istringstream in{std::string(word)};
  in.imbue(std::locale::classic());
  return bool(in >> x);
}

// The rows of an element of a PLY file that is known to be complete.
class Ply_rows {
public:
  Ply_rows(Byte_source& file, const std::string& format, const Ply_part& part)
    : in(file, part.bytes, ""), element(part.element), is_ascii(format == "ascii"),
      is_big(format == "binary_big_endian")
  {
    for(const Ply_header::Property& p : element.properties) {
      values.push_back(type_of(p.type));
      counts.push_back(type_of(p.is_list() ? p.count_type : p.type));
    }
  }

  // A number of each property: of a list that of its items, which `list` gets where it is wanted.
  void next(std::vector<double>& numbers, std::size_t wanted_list, std::vector<double>& list)
  {
    numbers.resize(values.size());
    for(std::size_t i = 0; i < values.size(); ++i) {
      numbers[i] = read(i, counts[i]);
      if(!element.properties[i].is_list())
        continue;
      list.resize(i == wanted_list ? std::size_t(numbers[i]) : list.size());
      for(std::size_t k = 0; k < std::size_t(numbers[i]); ++k) {
        const double item = read(i, values[i]);
        if(i == wanted_list)
          list[k] = item;
      }
    }
    ++row;
  }

  void next(std::vector<double>& numbers) { next(numbers, values.size(), no_list); }

private:
  // The kind is that of number_of_type().
  struct Type {
    char kind;
    std::size_t size;
  };

  static Type type_of(const std::string& name)
  {
    return {is_real_ply_type(name) ? 'F' : name[0] == 'u' ? 'U' : 'I', std::size_t(ply_type_size(name))};
  }

  double read(std::size_t property, const Type& type)
  {
    if(is_ascii)
      return parse(property, type);
    char bytes[8];
    if(in.sgetn(bytes, std::streamsize(type.size)) != std::streamsize(type.size))
      fail("");
    if(is_big)
      std::reverse(bytes, bytes + type.size);
    return number_of_type(bytes, type.kind, type.size);
  }

  double parse(std::size_t property, const Type& type)
  {
    skip_blanks_of(in);
    word.clear();
    for(int c = in.sgetc(); c != std::streambuf::traits_type::eof() && !is_blank(c); c = in.snextc())
      word += char(c);
    double x = 0;
    if(word.empty() || !parse_word(type, x))
      fail(word.empty() ? ""
                        : " (a value is not of the type that the header says: '" + word.substr(0, 40) +
                            "' of the property '" + element.properties[property].name + "')");
    return x;
  }

  bool parse_word(const Type& type, double& x) const
  {
    if(type.kind == 'F' && type.size == 8)
      return parse_real(word, x);
    if(type.kind == 'F') {
      float real = 0;
      const bool is_real = parse_real(word, real);
      x = double(real);
      return is_real;
    }
    std::int64_t integer = 0;
    const char* const first = word.data() + (word.size() > 1 && word[0] == '+' && is_digit(word[1]) ? 1 : 0);
    const auto end = std::from_chars(first, word.data() + word.size(), integer);
    x = double(integer);
    const std::int64_t largest = (std::int64_t(1) << (8 * type.size - (type.kind == 'U' ? 0 : 1))) - 1;
    return end.ec == std::errc() && end.ptr == word.data() + word.size() && integer <= largest &&
           integer >= (type.kind == 'U' ? 0 : -largest - 1);
  }

  [[noreturn]] void fail(const std::string& reason) const
  {
    check_signals();
    throw_error("unreadable after ", element.name == "face" ? "face " : "point ", row, " of ", element.count, reason);
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  Input_buffer in;
  Ply_header::Element element;
  bool is_ascii, is_big;
  std::vector<Type> values, counts;
  std::vector<double> no_list;
  std::string word;
  std::uint64_t row = 0; // those that were read
};

// ---

// The property that has each of the columns.
class Ply_columns {
public:
  Ply_columns(const Ply_header::Element& points, const std::string& tolerance) : none(points.properties.size())
  {
    places.fill(none);
    for(Column c : {Column::x, Column::y, Column::z, Column::nx, Column::ny, Column::nz})
      place(c) = find_ply_number(points, name_of(c));
    std::vector<std::string> names; // of those that are neither coordinates nor normals
    for(std::size_t i = 0; i < none; ++i) {
      const bool is_other =
        !points.properties[i].is_list() && std::find(places.begin(), places.end(), i) == places.end();
      names.push_back(is_other ? points.properties[i].name : "");
    }
    for(std::size_t i = 0; i < none; ++i)
      if(const Column c = column_of_name(names[i]); c >= Column::red && c != Column::none && !has(c))
        place(c) = i;
    if(!tolerance.empty())
      place(Column::tolerance) = find_name(names, tolerance, "property");
  }

  bool has(Column c) const { return places[std::size_t(c)] < none; }

  bool has_three(Column first) const
  {
    return has(first) && has(Column(int(first) + 1)) && has(Column(int(first) + 2));
  }

  double get(const std::vector<double>& numbers, Column c) const { return numbers[places[std::size_t(c)]]; }

  std::array<double, 3> get_three(const std::vector<double>& numbers, Column first) const
  {
    return {get(numbers, first), get(numbers, Column(int(first) + 1)), get(numbers, Column(int(first) + 2))};
  }

private:
  std::size_t& place(Column c) { return places[std::size_t(c)]; }

  std::size_t none;
  std::array<std::size_t, std::size_t(Column::none)> places;
};

// Channels of 8 bits, of 16 bits, or real ones from 0 to 1: all points tell which.
class Ply_colors {
public:
  void look_at(const std::array<double, 3>& color)
  {
    for(double x : color) {
      largest = (std::max)(largest, x);
      is_integer = is_integer && x == std::floor(x);
    }
  }

  void add(const std::array<double, 3>& color) { colors.push_back(color); }

  Input_color operator[](std::size_t i) const
  {
    const double unit = !is_integer && largest <= 1 ? 65535 : largest <= 255 ? 257 : 1;
    Input_color color = {0, 0, 0};
    for(std::size_t c = 0; c < 3; ++c)
      if(const double x = unit * colors[i][c]; x > 0)
        color[c] = std::uint16_t(std::lround((std::min)(x, 65535.)));
    return color;
  }

private:
  std::vector<std::array<double, 3>> colors;
  double largest = 0;
  bool is_integer = true;
};

Point_row row_of(const Ply_columns& columns, const Fields& fields, const std::vector<double>& numbers)
{
  Point_row row;
  const std::array<double, 3> point = columns.get_three(numbers, Column::x);
  std::copy(point.begin(), point.end(), row.point);
  if(fields.normal) {
    const std::array<double, 3> normal = columns.get_three(numbers, Column::nx);
    std::copy(normal.begin(), normal.end(), row.normal);
  }
  if(fields.intensity)
    row.intensity = float(columns.get(numbers, Column::intensity));
  if(fields.classification) {
    const double x = columns.get(numbers, Column::classification);
    row.classification = x > 0 && x < 256 ? std::uint8_t(x) : std::uint8_t(0);
  }
  if(fields.tolerance)
    row.tolerance = columns.get(numbers, Column::tolerance);
  return row;
}

void add_faces(Byte_source& file, const std::string& format, const Ply_part& part, Mesh_faces& faces)
{
  const std::vector<Ply_header::Property>& properties = part.element.properties;
  const auto are_corners = [](const Ply_header::Property& p) {
    return p.is_list() && (p.name == "vertex_indices" || p.name == "vertex_index");
  };
  const auto corners = std::find_if(properties.begin(), properties.end(), are_corners);
  if(part.element.name == "tristrips" || corners == properties.end())
    throw_error("has '", part.element.name, "' without the corners of single faces; --sample 0 takes its points");
  Ply_rows rows(file, format, part);
  std::vector<double> numbers, face;
  for(std::uint64_t i = 0; i < part.element.count; ++i) {
    rows.next(numbers, std::size_t(corners - properties.begin()), face);
    faces.add(face);
  }
}

void read_points(Byte_source& file, const Ply_parts& parts, const Input_settings& settings, Point_set& points,
                 Input_notes& notes)
{
  const Ply_columns columns(parts.points.element, settings.tolerance);
  const Fields fields = {columns.has_three(Column::nx), columns.has_three(Column::red), columns.has(Column::intensity),
                         columns.has(Column::classification), columns.has(Column::tolerance)};
  if(!settings.classes.empty() && !fields.classification)
    throw std::runtime_error("has no property 'classification', which --classes needs");
  Ply_rows rows(file, parts.format, parts.points);
  Cloud_builder builder(points, fields, settings, notes);
  Ply_colors colors;
  std::vector<double> numbers;
  for(std::uint64_t i = 0; i < parts.points.element.count; ++i) {
    rows.next(numbers);
    const bool is_kept = builder.add(row_of(columns, fields, numbers));
    if(!fields.color)
      continue;
    const std::array<double, 3> color = columns.get_three(numbers, Column::red);
    colors.look_at(color);
    if(is_kept)
      colors.add(color);
  }
  if(fields.color)
    builder.set_colors(colors);
}

} // namespace

void read_ply(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes)
{
  const Ply_parts parts = find_ply_parts(file);
  std::uint64_t number_of_faces = 0;
  for(const Ply_part& part : parts.faces)
    number_of_faces += part.element.count;
  const bool is_sampled = samples_faces(number_of_faces, settings, notes);
  if(is_sampled)
    check_no_attributes(settings, "has faces: the points that --sample puts on them");
  Input_settings of_points = settings;
  if(is_sampled)
    of_points.crop.reset(); // of the points on the faces, not of corners
  read_points(file, parts, of_points, points, notes);
  if(!is_sampled)
    return;
  Mesh_faces faces(points);
  for(const Ply_part& part : parts.faces)
    add_faces(file, parts.format, part, faces);
  points = faces.sample(*settings.sample);
}

} // namespace program
