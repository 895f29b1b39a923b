// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What reads the formats, and what the readers share.

#ifndef DETECT_PLANES_READERS_H
#define DETECT_PLANES_READERS_H

#include "input/Input_buffer.h"
#include "input/read_cloud.h"
#include "input/point_set.h"

namespace program {

// What the points of a file have beside coordinates.
struct Fields {
  bool normal = false, color = false, intensity = false, classification = false, tolerance = false;
};

// has(column): normals and colors have three.
template <class Has>
Fields fields_of(const Has& has)
{
  return {has(Column::nx) && has(Column::ny) && has(Column::nz),
          has(Column::red) && has(Column::green) && has(Column::blue), has(Column::intensity),
          has(Column::classification), has(Column::tolerance)};
}

// Where a file that names what its points have, has each of the columns.
using Column_places = std::array<std::size_t, std::size_t(Column::none)>;
constexpr std::size_t nowhere = std::size_t(-1);

// kind: what has these names, for the message.
inline Fields fields_of(const Column_places& places, const Input_settings& settings, const char* kind)
{
  const Fields fields = fields_of([&](Column c) { return places[std::size_t(c)] != nowhere; });
  if(!settings.classes.empty() && !fields.classification)
    throw_error("has no ", kind, " 'classification', which --classes needs");
  return fields;
}

// number(place): 0 where there is none.
template <class Number>
Row_values values_at(const Column_places& places, const Number& number)
{
  Row_values values = {};
  for(std::size_t c = 0; c < values.size(); ++c)
    if(places[c] != nowhere)
      values[c] = number(places[c]);
  return values;
}

struct Point_row {
  double point[3] = {0, 0, 0};
  double normal[3] = {0, 0, 0};
  Input_color color = {0, 0, 0};
  float intensity = 0;
  std::uint8_t classification = 0;
  double tolerance = 0;
};

// Rounded, from 0 on; of NaN 0.
template <class Integer>
Integer clamped(double x)
{
  constexpr double largest = double((std::numeric_limits<Integer>::max)());
  return x > 0 ? Integer(std::lround((std::min)(x, largest))) : Integer(0);
}

// But for the color.
inline Point_row row_of(const Row_values& values)
{
  Point_row row;
  for(std::size_t c = 0; c < 3; ++c) {
    row.point[c] = values[c];
    row.normal[c] = values[std::size_t(Column::nx) + c];
  }
  row.intensity = float(values[std::size_t(Column::intensity)]);
  const double classification = values[std::size_t(Column::classification)];
  row.classification = classification > 0 && classification < 256 ? std::uint8_t(classification) : std::uint8_t(0);
  row.tolerance = values[std::size_t(Column::tolerance)];
  return row;
}

// Some writers put channels of 8 bits into 16: 255 becomes 65535.
constexpr std::uint16_t wide_channel(std::uint8_t channel) { return std::uint16_t(257 * channel); }

// Appends points to a cloud, in their order; only those of the classes and in the box of the settings, if there are any.
class Cloud_builder {
public:
  Cloud_builder(Point_set& points, const Fields& fields, const Input_settings& settings, Input_notes& notes)
    : points(points), fields(fields), settings(settings), notes(notes)
  {
    if(fields.normal)
      points.add_normal_map();
    if(fields.color)
      colors = points.add_property_map<Input_color>(color_name).first;
    if(fields.intensity)
      intensities = points.add_property_map<float>(intensity_name).first;
    if(fields.classification)
      classifications = points.add_property_map<std::uint8_t>(classification_name).first;
    if(fields.tolerance)
      tolerances = points.add_property_map<double>(tolerance_name).first;
  }

  // Whether the point is taken.
  bool add(const Point_row& row)
  {
    const Kernel::Point_3 point(row.point[0], row.point[1], row.point[2]);
    if(settings.crop && is_finite(point))
      notes.box += point.bbox();
    if(settings.crop && !is_within(row.point, *settings.crop))
      return false;
    if(!settings.classes.empty() && !is_in(row.classification, settings.classes))
      return false;
    const Point_set::Index i = *points.insert(point);
    if(fields.normal)
      points.normal(i) = Kernel::Vector_3(row.normal[0], row.normal[1], row.normal[2]);
    if(fields.color)
      colors[i] = row.color;
    if(fields.intensity)
      intensities[i] = row.intensity;
    if(fields.classification)
      classifications[i] = row.classification;
    if(fields.tolerance)
      tolerances[i] = row.tolerance;
    return true;
  }

  // next(): the channels, point by point.
  template <class Next>
  void set_colors(Next next)
  {
    for(Point_set::Index i : points)
      for(std::uint16_t& channel : colors[i])
        channel = next();
  }

  // Makes 16 bits of colors that use 8.
  void widen_colors()
  {
    const auto is_narrow = [&](Point_set::Index i) {
      return std::all_of(colors[i].begin(), colors[i].end(), [](std::uint16_t c) { return c <= 255; });
    };
    if(!fields.color || !std::all_of(points.begin(), points.end(), is_narrow))
      return;
    for(Point_set::Index i : points)
      for(std::uint16_t& channel : colors[i])
        channel = wide_channel(std::uint8_t(channel));
  }

private:
  Point_set& points;
  Fields fields;
  const Input_settings& settings;
  Input_notes& notes;
  Point_set::Property_map<Input_color> colors;
  Point_set::Property_map<float> intensities;
  Point_set::Property_map<std::uint8_t> classifications;
  Point_set::Property_map<double> tolerances;
};

// --- The faces of a mesh, and points on them.

// Whether points are put on the faces of a file: no faces are passed over without a word.
inline bool samples_faces(std::uint64_t faces, const Input_settings& settings, Input_notes& notes)
{
  const std::string number = std::to_string(faces) + (faces == 1 ? " face" : " faces");
  if(faces > 0 && !settings.sample)
    throw_error("has ", number,
                ": --sample N puts N points on the faces of a mesh, --sample 0 uses only their corners");
  const bool is_sampled = settings.sample && *settings.sample > 0;
  if(is_sampled && faces == 0)
    notes.warnings.push_back("has no faces for --sample; the program uses its points");
  if(faces > 0 && is_sampled)
    notes.lines.emplace_back("sample", std::to_string(*settings.sample) + " points on " + number);
  if(faces > 0 && !is_sampled)
    notes.lines.emplace_back("sample", "the corners of " + number);
  return is_sampled && faces > 0;
}

// How the corners of the faces are read, if points are put on these: then it is those that are cropped.
inline Input_settings settings_of_corners(std::uint64_t faces, Input_settings settings)
{
  if(faces == 0 || settings.sample.value_or(0) == 0)
    return settings;
  check_no_attributes(settings, "has faces: the points that --sample puts on them");
  settings.crop.reset();
  return settings;
}

// Faces are fans of triangles around their first corner. Each operation is rounded by itself, or is std::fma, so that
// the points are the same on all machines.
class Mesh_faces {
public:
  explicit Mesh_faces(const Point_set& points)
  {
    for(Point_set::Index i : points)
      corners.push_back({points.point(i).x(), points.point(i).y(), points.point(i).z()});
  }

  // The places of the corners of a face.
  void add(const std::vector<double>& face)
  {
    ++count;
    for(double i : face)
      if(!(i >= 0 && i < double(corners.size())) || i != std::floor(i))
        throw_error("face ", count, " has a corner that is not one of the ", corners.size(), " points");
    for(std::size_t i = 2; i < face.size(); ++i) {
      const Triangle t = {std::size_t(face[0]), std::size_t(face[i - 1]), std::size_t(face[i])};
      const Vector normal = normal_of(t);
      const double area = length(normal);
      if(!std::isfinite(area))
        throw_error("face ", count, " has no finite area");
      if(!(area > 0))
        continue;
      triangles.push_back(t);
      areas.push_back((areas.empty() ? 0 : areas.back()) + area);
    }
  }

  // As many points on each part of the faces as its area asks for, in the order of the faces, with their normals.
  Point_set sample(const Input_settings& settings, Input_notes& notes) const
  {
    if(triangles.empty())
      throw std::runtime_error("has faces, but none of them has an area");
    const double step = areas.back() / double(*settings.sample);
    if(!std::isfinite(areas.back()))
      throw std::runtime_error("has faces whose area is not finite");
    Point_set points;
    Cloud_builder builder(points, {true, false, false, false, false}, settings, notes);
    std::size_t t = 0;
    for(std::size_t i = 0; i < *settings.sample; ++i) {
      const double place = (double(i) + random(3 * i)) * step;
      while(t + 1 < triangles.size() && areas[t] <= place)
        ++t;
      builder.add(point_on(triangles[t], random(3 * i + 1), random(3 * i + 2)));
    }
    return points;
  }

private:
  using Vector = std::array<double, 3>;
  using Triangle = std::array<std::size_t, 3>;

  // From 0 to below 1: the function splitmix64 of the number.
  static double random(std::uint64_t number)
  {
    std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return double((z ^ z >> 31) >> 11) * 0x1p-53;
  }

  Vector edge(const Triangle& t, std::size_t i) const
  {
    const Vector &a = corners[t[0]], &b = corners[t[i]];
    return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  }

  // Its length is twice the area.
  Vector normal_of(const Triangle& t) const
  {
    const Vector a = edge(t, 1), b = edge(t, 2);
    const auto minor = [&](std::size_t i, std::size_t j) {
      const double product = a[j] * b[i];
      return std::fma(a[i], b[j], -product);
    };
    return {minor(1, 2), minor(2, 0), minor(0, 1)};
  }

  static double length(const Vector& v)
  {
    const double square = v[2] * v[2];
    return std::sqrt(std::fma(v[0], v[0], std::fma(v[1], v[1], square)));
  }

  Point_row point_on(const Triangle& t, double u, double v) const
  {
    if(u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vector a = edge(t, 1), b = edge(t, 2), normal = normal_of(t);
    const double size = length(normal);
    Point_row row;
    for(std::size_t i = 0; i < 3; ++i) {
      row.point[i] = std::fma(u, a[i], std::fma(v, b[i], corners[t[0]][i]));
      row.normal[i] = normal[i] / size;
    }
    return row;
  }

  std::vector<Vector> corners;
  std::vector<Triangle> triangles;
  std::vector<double> areas; // twice the sum up to each triangle
  std::size_t count = 0;     // of the faces
};

// --- What reads the formats.

// A little-endian number of any type.
template <class T>
T number_at(const char* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return little_endian(value);
}

// A little-endian number of a type that is known at run time: I, U or F, signed, unsigned or real.
inline double number_of_type(const char* bytes, char type, std::size_t size)
{
  const auto number = [=](auto is_signed, auto is_unsigned) {
    return type == 'I' ? double(number_at<decltype(is_signed)>(bytes))
                       : double(number_at<decltype(is_unsigned)>(bytes));
  };
  if(type == 'F')
    return size == 4 ? double(number_at<float>(bytes)) : number_at<double>(bytes);
  return size == 1   ? number(std::int8_t(), std::uint8_t())
         : size == 2 ? number(std::int16_t(), std::uint16_t())
         : size == 4 ? number(std::int32_t(), std::uint32_t())
                     : number(std::int64_t(), std::uint64_t());
}

inline void check_room(std::uint64_t points, std::uint64_t room)
{
  if(points > room)
    throw_error("is truncated: ", points, " points announced, but the file has room for ", room);
}

[[noreturn]] inline void fail_after(std::uint64_t point, std::uint64_t points)
{
  check_signals();
  throw_error("unreadable after point ", point, " of ", points);
}

// --- The records of points, for an output of the same format.

// Whether the records keep a field of this name and column: not if the output has another one in its place. A field that
// they keep is described.
inline bool keeps_field(const std::string& name, Column column, const Input_settings& settings, Input_notes& notes)
{
  const bool is_normal = column >= Column::nx && column <= Column::nz;
  const bool is_color = column >= Column::red && column <= Column::blue;
  if(name == settings.label)
    notes.lines.emplace_back("replaced",
                             "the property '" + name + "' of the input (--label-property names another one)");
  if(name == settings.label || (is_normal && settings.replaces_normals) || (is_color && settings.replaces_colors))
    return false;
  Input_records& records = *notes.records;
  records.names.push_back(name);
  records.has_normals = records.has_normals || is_normal;
  records.has_colors = records.has_colors || is_color;
  records.has_others = records.has_others || column == Column::none;
  return true;
}

// Of a field by its place; `none` also of those of an incomplete triple.
inline Column column_at(const Column_places& places, std::size_t place)
{
  const auto has = [&](Column c) { return places[std::size_t(c)] != nowhere; };
  const auto c = Column(std::find(places.begin(), places.end(), place) - places.begin());
  const Fields fields = fields_of(has);
  const bool is_incomplete = c < Column::red ? c >= Column::nx && !fields.normal : c <= Column::blue && !fields.color;
  return is_incomplete ? Column::none : c;
}

// --- LAS 1.0 to 1.4, as the specification of the ASPRS has it.

constexpr std::size_t las_record_header = 54; // of a record before the points, in bytes
constexpr std::size_t las_description = 192;  // of extra bytes

// A number behind the bytes of the point format, as a record of the header describes it.
struct Las_dimension {
  std::string name;
  char type; // as that of number_of_type()
  std::size_t size;
  std::size_t position; // in the record of a point
  double scale, offset;
};

// Of the bytes of the dimension.
double value_of(const char* bytes, const Las_dimension& dimension);

struct Las_header {
  int minor_version = 0;
  int point_format = 0;
  bool is_compressed = false; // LAZ
  std::uint16_t record_length = 0;
  std::uint64_t first_point = 0; // position in the file
  std::uint64_t count = 0;
  Las_frame frame;
  std::vector<Las_dimension> dimensions;

  std::string bytes;                // of the header
  std::vector<std::string> records; // but for those of extra bytes, of compression and of where points are in the file
  std::size_t lost_records = 0;     // announced, but damaged or not there
  std::string descriptions;         // of all extra bytes but for those of the label
  std::size_t label_position = 0, label_size = 0; // in the record of a point
};

// label: the name of extra bytes that the records of points are kept without.
Las_header read_las_header(Input_buffer& in, const std::string& label);

// Rounded after each operation, also where the processor could do both at once.
double place_of_integer(std::int32_t integer, const Las_frame& frame, std::size_t axis);

// The bytes of a point of this format without extra ones.
std::size_t las_point_size(int point_format);

// In the record of a point, 0 if the format has no color.
std::size_t las_color_position(int point_format);

// What describes some extra bytes; type and options as files have them.
std::string describe_las_bytes(int type, int options, const std::string& name, const std::string& text);

// Descriptions without the smallest and largest values, which are those of one file.
std::string without_bounds(std::string descriptions);

// add(record): of each point that LASzip reads, as a LAS file has it.
void read_laz_points(const std::string& path, const Las_header& header, const std::function<void(const char*)>& add);

// LAS or LAZ. `path` is for LASzip, which opens a LAZ file itself.
void read_las(Byte_source& file, const std::string& path, const Input_settings& settings, Point_set& points,
              Input_notes& notes);

void read_pcd(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes);

// A text table: a point in each row.
void read_table(Byte_source& file, const std::string& extension, const Input_settings& settings, Point_set& points,
                Input_notes& notes);

// Scans of a scanner, each with its place.
void read_ptx(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes);

// PLY and OFF may be meshes, whose faces have points where the settings say so.
void read_off(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes);
void read_ply(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes);

} // namespace program

#endif // DETECT_PLANES_READERS_H
