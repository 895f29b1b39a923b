// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/Input_buffer.h"
#include "output/writers.h"

namespace program {

namespace {

// One type for coordinates and normals: some readers want them to agree.
bool has_double(const Output_points& cloud)
{
  return std::any_of(cloud.part.begin(), cloud.part.end(), [&](Point_set::Index i) {
    const std::array<double, 6> numbers = cloud.place_and_normal(i);
    return !std::all_of(numbers.begin(), numbers.end(), fits_float);
  });
}

// A number of each point, as an output describes it.
struct Output_field {
  std::string name;
  char type;        // as that of number_of_type()
  std::size_t size; // in bytes
  Column value;     // `none` is the shape
};

// The numbers of a point by column, and its shape behind them.
using Output_values = std::array<double, std::size_t(Column::none) + 1>;

Output_values values_of(const Output_points& cloud, Point_set::Index i)
{
  Output_values values = {};
  const std::array<double, 6> numbers = cloud.place_and_normal(i);
  std::copy(numbers.begin(), numbers.end(), values.begin());
  const Color color = cloud.color(i);
  std::copy(color.begin(), color.end(), values.begin() + std::size_t(Column::red));
  values[std::size_t(Column::intensity)] = cloud.intensity ? double((*cloud.intensity)[i]) : 0;
  values[std::size_t(Column::classification)] = cloud.classification ? (*cloud.classification)[i] : 0;
  values[std::size_t(Column::tolerance)] = cloud.tolerance ? (*cloud.tolerance)[i] : 0;
  values[std::size_t(Column::none)] = cloud.shape(i);
  return values;
}

using Field_names = std::array<const char*, std::size_t(Column::none)>; // empty: a part of another field

// What the records of the input do not have: without records, everything. real_size: of coordinates and normals.
std::vector<Output_field> fields_of(const Output_points& cloud, const Field_names& names, std::size_t real_size)
{
  const Input_records* const r = cloud.records;
  std::vector<Output_field> fields;
  const auto add = [&](Column first, std::size_t count, char type, std::size_t size) {
    const std::size_t before = fields.size();
    std::string suffix; // where a name is that of something else
    for(bool is_taken = true; std::exchange(is_taken, false); suffix += '2') {
      fields.resize(before);
      for(std::size_t c = std::size_t(first); c < std::size_t(first) + count; ++c) {
        const std::string name = c < names.size() ? names[c] : cloud.label_property;
        if(name.empty())
          continue;
        fields.push_back({name + suffix, type, size, Column(c)});
        is_taken = is_taken || (r != nullptr && is_in(name + suffix, r->names));
      }
    }
  };
  const bool is_packed = names[std::size_t(Column::green)][0] == '\0';
  if(r == nullptr)
    add(Column::x, 3, 'F', real_size);
  if(r == nullptr || !r->has_normals)
    add(Column::nx, 3, 'F', real_size);
  if(r == nullptr || !r->has_colors)
    add(Column::red, 3, is_packed ? 'F' : 'U', is_packed ? 4 : 1);
  if(r == nullptr && cloud.intensity)
    add(Column::intensity, 1, 'F', 4);
  if(r == nullptr && cloud.classification)
    add(Column::classification, 1, 'U', 1);
  if(cloud.tolerance)
    add(Column::tolerance, 1, 'F', 8);
  add(Column::none, 1, 'I', 4);
  return fields;
}

std::size_t real_size_of(const Output_points& cloud)
{
  return cloud.records != nullptr ? cloud.records->real_size : has_double(cloud) ? 8 : 4;
}

// The channels as the bits of a real number, as PCL has them.
float packed(const Color& c)
{
  const std::uint32_t bits = std::uint32_t(c[0]) << 16 | std::uint32_t(c[1]) << 8 | std::uint32_t(c[2]);
  float real;
  std::memcpy(&real, &bits, sizeof real);
  return real;
}

// write(number): of the type of the field.
template <class Write>
void write_field(double number, const Output_field& field, const Write& write)
{
  if(field.type == 'U')
    write(std::uint8_t(number));
  else if(field.type == 'I')
    write(std::int32_t(number));
  else if(field.size == 4)
    write(float(number));
  else
    write(number);
}

// A value of a text. Where blanks separate values, it has none, and is not empty; between commas, it is in quotes where it
// has one. Quotes in it are those of the input: two stand for one.
void write_value(std::ostream& out, std::string_view value, char separator)
{
  if(separator != ' ') {
    const bool is_quoted = value.find(separator) != value.npos || value.find("\"\"") != value.npos;
    const char* const quote = is_quoted ? "\"" : "";
    out << quote << value << quote;
  } else if(value.empty()) {
    out << "nan";
  } else {
    std::replace_copy_if(value.begin(), value.end(), std::ostreambuf_iterator<char>(out), &is_blank, '_');
  }
}

void write_text(std::ostream& out, std::string_view record, char separator)
{
  while(!record.empty()) {
    const std::size_t end = record.find(end_of_value);
    write_value(out, record.substr(0, end), separator);
    out << separator;
    record.remove_prefix(end + 1);
  }
}

// Each point has its record, and the fields behind it; separator: of texts.
void write_points(std::ostream& out, const Output_points& cloud, const std::vector<Output_field>& fields,
                  char separator = ' ', Encoding of_made = Encoding::little_endian)
{
  const Encoding encoding = cloud.records != nullptr ? cloud.records->encoding : of_made;
  char end = separator;
  const auto write = [&](auto number) {
    if(encoding == Encoding::text)
      return write_shortest(out, number, end);
    char bytes[sizeof number];
    number = little_endian(number);
    std::memcpy(bytes, &number, sizeof number);
    if(encoding == Encoding::big_endian)
      std::reverse(bytes, bytes + sizeof number);
    out.write(bytes, sizeof number);
  };
  cloud.for_each([&](Point_set::Index i, std::string_view record) {
    Output_values values = values_of(cloud, i);
    if(encoding == Encoding::text)
      write_text(out, record, separator);
    else
      out << record;
    for(const Output_field& field : fields) {
      if(field.value == Column::red && field.type == 'F')
        values[std::size_t(Column::red)] = double(packed(cloud.color(i)));
      end = field.value == Column::none ? '\n' : separator;
      write_field(values[std::size_t(field.value)], field, write);
    }
  });
}

// The parts of the head: what is before the number of points, the properties of these, and what is behind them.
void write_ply(std::ostream& out, const Output_points& cloud)
{
  const std::vector<Output_field> fields = fields_of(
    cloud, {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "intensity", "classification", "tolerance"},
    real_size_of(cloud));
  const Input_records* const r = cloud.records;
  out << (r != nullptr ? r->head[0]
                       : "ply\nformat binary_little_endian 1.0\ncomment detect_planes of Tandem\nelement vertex ")
      << cloud.part.size() << '\n'
      << (r != nullptr ? r->head[1] : "");
  for(const Output_field& f : fields)
    out << "property "
        << (f.type == 'U'   ? "uchar "
            : f.type == 'I' ? "int "
            : f.size == 4   ? "float "
                            : "double ")
        << f.name << '\n';
  out << (r != nullptr ? r->head[2] : "end_header\n");
  write_points(out, cloud, fields);
  out << (r != nullptr ? r->tail : "");
}

// The parts of the head: what is before the fields, the lines of these, width and height of all points, or nothing, and
// the viewpoint.
void write_pcd(std::ostream& out, const Output_points& cloud)
{
  const std::vector<Output_field> fields = fields_of(
    cloud,
    {"x", "y", "z", "normal_x", "normal_y", "normal_z", "rgb", "", "", "intensity", "classification", "tolerance"},
    real_size_of(cloud));
  const Input_records* const r = cloud.records;
  std::array<std::string, 4> lines = {"FIELDS", "SIZE", "TYPE", "COUNT"};
  for(std::size_t i = 0; i < lines.size() && r != nullptr; ++i)
    lines[i] = r->head[i + 1];
  for(const Output_field& f : fields) {
    lines[0] += ' ' + f.name;
    lines[1] += ' ' + std::to_string(f.size);
    lines[2] += std::string(" ") + f.type;
    lines[3] += " 1";
  }
  out << (r != nullptr ? r->head[0] : "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n");
  for(const std::string& line : lines)
    out << line << '\n';
  if(r != nullptr && cloud.parts.size() == 1 && !r->head[5].empty())
    out << r->head[5];
  else
    out << "WIDTH " << cloud.part.size() << "\nHEIGHT 1\n";
  out << (r != nullptr ? r->head[6] : "VIEWPOINT 0 0 0 1 0 0 0\n") << "POINTS " << cloud.part.size() << "\nDATA "
      << (r != nullptr && r->encoding == Encoding::text ? "ascii" : "binary") << '\n';
  write_points(out, cloud, fields);
}

// The head: the names of the columns.
void write_table(std::ostream& out, const Output_points& cloud, char separator, const char* comment)
{
  const std::vector<Output_field> fields =
    fields_of(cloud, {"x", "y", "z", "nx", "ny", "nz", "r", "g", "b", "intensity", "classification", "tolerance"}, 8);
  out << comment;
  if(cloud.records != nullptr)
    write_text(out, cloud.records->head[0], separator);
  for(const Output_field& f : fields)
    out << f.name << (f.value == Column::none ? '\n' : separator);
  write_points(out, cloud, fields, separator, Encoding::text);
}

} // namespace

void write_cloud(std::ostream& out, const Output_points& cloud, const std::string& extension)
{
  if constexpr(has_laszip)
    if(extension == ".laz")
      return write_laz(out, cloud);
  if(extension == ".las")
    write_las(out, cloud);
  else if(extension == ".pcd")
    write_pcd(out, cloud);
  else if(extension == ".csv")
    write_table(out, cloud, ',', "");
  else if(is_in(extension, {".xyz", ".txt"}))
    write_table(out, cloud, ' ', "# ");
  else
    write_ply(out, cloud);
}

} // namespace program
