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

// The grid need not have room for points whose coordinates stand for no value.
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
  return std::int32_t((std::max)((std::min)(integer_of(x, frame, c), largest_integer), -largest_integer - 1));
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

// The grid of the first LAS input, if all points are on it, or near it.
Las_frame frame_of(const Output_points& cloud, const Bounds& bounds)
{
  const Las_frame* first = nullptr;
  bool is_one = cloud.records != nullptr;
  for(const Input_part& part : cloud.parts)
    if(const std::optional<Las_frame>& own = part.notes.las_frame) {
      first = first != nullptr ? first : &*own;
      is_one = is_one && own->scale == first->scale && own->offset == first->offset;
    }
  const Bounds measured = bounds_of(cloud, measured_points(cloud));
  if(first != nullptr && (is_one || bounds.count == 0 || (has_room(*first, measured) && is_fine(*first, cloud))))
    return *first;
  Las_frame frame = make_frame(bounds, measured, cloud.shapes.parameters().maximum_distance);
  if(first != nullptr) {
    frame.records = first->records;
    frame.projection = first->projection;
  }
  return frame;
}

std::string padded(std::string text, std::size_t size)
{
  text.resize(size, '\0');
  return text;
}

template <class T>
void put(std::string& bytes, std::size_t place, T value)
{
  const T ordered = little_endian(value);
  bytes.replace(place, sizeof(T), reinterpret_cast<const char*>(&ordered), sizeof(T));
}

// What is around the points.
struct Las_file {
  std::string header, descriptions; // of extra bytes
  std::vector<std::string> records;
  int point_format = 0;
  std::size_t record_length = 0; // of a point without the shape
  std::size_t size_of_added_color = 0;
  Las_frame frame = {};
  bool sets_coordinates = true; // else they are those of the records
};

// Of points of other formats. Most programs read the point formats 0 and 2; 6 and 7 have room for all classes, and are
// those for coordinate systems as WKT.
Las_file make_file(const Output_points& cloud, const Las_frame& frame)
{
  const auto is_high = [&](Point_set::Index i) { return cloud.classification && (*cloud.classification)[i] > 31; };
  const bool is_extended =
    frame.projection == Projection::wkt || std::any_of(cloud.part.begin(), cloud.part.end(), is_high);
  const bool has_color = cloud.has_input_colors() || cloud.has_shape_colors;
  constexpr std::size_t header_size = 375;
  Las_file file;
  file.header = padded("LASF", header_size);
  file.records = frame.records;
  file.point_format = (is_extended ? 6 : 0) + (!has_color ? 0 : is_extended ? 1 : 2);
  // WKT, which the specification asks for with these formats; but keys of GeoTIFF are what they are.
  put(file.header, 6, std::uint16_t(is_extended && frame.projection != Projection::geotiff ? 16 : 0));
  file.header[24] = 1;
  file.header[25] = 4;
  put(file.header, 94, std::uint16_t(header_size));
  file.record_length = las_point_size(file.point_format);
  return file;
}

std::string make_record(const Output_points& cloud, Point_set::Index i, const Las_file& file)
{
  std::string record(file.record_length, '\0');
  const bool is_extended = file.point_format >= 6;
  const float intensity = cloud.intensity ? (*cloud.intensity)[i] : 0;
  put(record, 12, clamped<std::uint16_t>(double(intensity)));
  record[14] = is_extended ? '\x11' : '\x09'; // first return of one
  record[is_extended ? 16 : 15] = char(cloud.classification ? (*cloud.classification)[i] : std::uint8_t(0));
  return record;
}

// The file of the input; a point format without colors gets them where they are asked for.
Las_file file_of_input(const Output_points& cloud)
{
  const std::vector<std::string>& head = cloud.records->head;
  Las_file file;
  file.header = head[0];
  file.descriptions = cloud.parts.size() == 1 ? head[1] : without_bounds(head[1]);
  file.records.assign(head.begin() + 2, head.end());
  file.point_format = file.header[104] & 0x3F;
  file.record_length = number_at<std::uint16_t>(head[0].data() + 105);
  if(!cloud.has_shape_colors || las_color_position(file.point_format) > 0)
    return file;
  constexpr int with_colors[11] = {2, 3, 2, 3, 5, 5, 7, 7, 8, 10, 10};
  const std::size_t before = las_point_size(file.point_format);
  file.point_format = with_colors[file.point_format];
  file.size_of_added_color = las_point_size(file.point_format) - before;
  file.record_length += file.size_of_added_color;
  file.header[25] = (std::max)(file.header[25], '\2'); // LAS 1.2 is the first with colors
  return file;
}

// With the shape.
std::string record_of(const Output_points& cloud, Point_set::Index i, std::string_view of_input, const Las_file& file)
{
  std::string record(of_input);
  const std::size_t color_position = las_color_position(file.point_format);
  if(cloud.records == nullptr)
    record = make_record(cloud, i, file);
  else
    record.insert(color_position, file.size_of_added_color, '\0');
  if(file.sets_coordinates)
    for(int c = 0; c < 3; ++c)
      put(record, 4 * std::size_t(c), integer_on_grid(cloud.points.point(i)[c], file.frame, std::size_t(c)));
  if(color_position > 0 && (cloud.records == nullptr || cloud.has_shape_colors))
    for(std::size_t c = 0; c < 3; ++c)
      put(record, color_position + 2 * c, cloud.wide_color(i)[c]);
  record.resize(record.size() + sizeof(std::int32_t));
  put(record, record.size() - sizeof(std::int32_t), cloud.shape(i));
  return record;
}

// Numbers of points, of all and by their number of return; what the header has no room for is 0.
void set_counts(std::string& header, std::uint64_t count, const std::array<std::uint64_t, 16>& of_returns,
                int point_format)
{
  constexpr std::uint64_t largest = 0xFFFFFFFF;
  const bool is_1_4 = header[25] == 4 && header.size() >= 375;
  if(count > largest && !is_1_4)
    throw_error(count, " points are too many for the LAS version of the inputs");
  const auto old = [&](std::uint64_t n) {
    return is_1_4 && (point_format >= 6 || count > largest) ? std::uint32_t(0) : std::uint32_t(n);
  };
  put(header, 107, old(count));
  for(std::size_t r = 1; r <= 5; ++r)
    put(header, 107 + 4 * r, old(of_returns[r]));
  if(!is_1_4)
    return;
  put(header, 247, count);
  for(std::size_t r = 1; r <= 15; ++r)
    put(header, 247 + 8 * r, of_returns[r]);
}

void set_header(const Output_points& cloud, const Bounds& bounds, Las_file& file)
{
  std::string& header = file.header;
  header.replace(58, 32, padded("detect_planes of Tandem", 32));
  std::size_t first_point = header.size();
  for(const std::string& record : file.records)
    first_point += record.size();
  constexpr std::size_t most = 65535;
  const std::size_t length = file.record_length + sizeof(std::int32_t);
  if(length > most || file.descriptions.size() > most)
    throw std::runtime_error("the points of the LAS input have too many extra bytes to add the shape");
  put(header, 96, std::uint32_t(first_point));
  put(header, 100, std::uint32_t(file.records.size()));
  header[104] = char(file.point_format);
  put(header, 105, std::uint16_t(length));
  std::array<std::uint64_t, 16> of_returns = {};
  cloud.for_each([&](Point_set::Index i, std::string_view record) {
    if(is_finite(cloud.points.point(i)))
      ++of_returns[cloud.records == nullptr ? 1 : std::uint8_t(record[14]) & (file.point_format < 6 ? 7 : 15)];
  });
  set_counts(header, bounds.count, of_returns, file.point_format);
  for(std::size_t c = 0; c < 3; ++c) {
    put(header, 131 + 8 * c, file.frame.scale[c]);
    put(header, 155 + 8 * c, file.frame.offset[c]);
    put(header, 179 + 16 * c, place_on_grid(bounds.box.max(int(c)), file.frame, c));
    put(header, 187 + 16 * c, place_on_grid(bounds.box.min(int(c)), file.frame, c));
  }
  set_tail(header, first_point + bounds.count * length, cloud.records);
}

} // namespace

void set_tail(std::string& header, std::uint64_t first, const Input_records* records)
{
  std::uint32_t count = 0;
  for(std::size_t place = 0; records != nullptr && place < records->tail.size(); ++count)
    place += 60 + std::size_t(number_at<std::uint64_t>(records->tail.data() + place + 20));
  if(header[25] >= 3 && header.size() >= 235)
    put(header, 227, count > 0 && records->waveforms ? first + *records->waveforms : 0);
  if(header[25] >= 4 && header.size() >= 375) {
    put(header, 235, count > 0 ? first : 0);
    put(header, 243, count);
  }
}

void write_las(std::ostream& out, const Output_points& cloud)
{
  const Bounds bounds = bounds_of(cloud, [&](Point_set::Index i) { return is_finite(cloud.points.point(i)); });
  const Las_frame frame = frame_of(cloud, bounds);
  Las_file file = cloud.records != nullptr ? file_of_input(cloud) : make_file(cloud, frame);
  file.frame = frame;
  file.sets_coordinates =
    cloud.records == nullptr || std::any_of(cloud.parts.begin(), cloud.parts.end(), [&](const Input_part& part) {
      const std::optional<Las_frame>& own = part.notes.las_frame;
      return own && (own->scale != frame.scale || own->offset != frame.offset);
    });
  constexpr int int32_type = 6;
  file.descriptions += describe_las_bytes(int32_type, 0, cloud.label_property, "shape of detect_planes");
  std::string record = padded("", 2) + padded("LASF_Spec", 16) + std::string("\4\0\0\0", 4) + padded("extra bytes", 32);
  put(record, 20, std::uint16_t(file.descriptions.size()));
  file.records.push_back(record + file.descriptions);
  set_header(cloud, bounds, file);
  out << file.header;
  for(const std::string& before : file.records)
    out << before;
  cloud.for_each([&](Point_set::Index i, std::string_view of_input) {
    if(is_finite(cloud.points.point(i)))
      out << record_of(cloud, i, of_input, file);
  });
  if(cloud.records != nullptr)
    out << cloud.records->tail;
}

} // namespace program
