// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Options.h"
#include "file_names.h"
#include "input/readers.h"

namespace program {

namespace {

constexpr std::size_t smallest_header = 227, header_1_4 = 375;

void read_exactly(Input_buffer& in, char* bytes, std::size_t count, const char* what)
{
  if(in.left() < count || std::size_t(in.sgetn(bytes, std::streamsize(count))) != count)
    throw_error("is truncated: ", what, " is not complete");
}

// Of a record before or behind the points.
bool is_of(const std::string& record, const std::string& user)
{
  return record.compare(2, user.size() + 1, user.c_str(), user.size() + 1) == 0;
}

std::uint16_t id_of(const std::string& record) { return number_at<std::uint16_t>(record.data() + 18); }

// Whether a record describes the extra bytes of the points.
bool describes_bytes(const std::string& record) { return is_of(record, "LASF_Spec") && id_of(record) == 4; }

// Of compression, or of where points are in the file: it is wrong in another file.
bool is_of_this_file(const std::string& record)
{
  return is_of(record, "laszip encoded") || is_of(record, "copc") || (is_of(record, "LAStools") && id_of(record) == 30);
}

// What the records hold. If that is both, the flag of the header says which to use.
Projection projection_of(const std::vector<std::string>& records, bool is_declared_wkt)
{
  const auto has = [&](std::uint16_t id) {
    return std::any_of(records.begin(), records.end(), [=](const auto& record) { return id_of(record) == id; });
  };
  const bool has_wkt = has(2112), has_geotiff_keys = has(34735);
  return has_wkt && (is_declared_wkt || !has_geotiff_keys) ? Projection::wkt
         : has_geotiff_keys                                ? Projection::geotiff
                                                           : Projection::none;
}

// The extra bytes of points, as far as the record describes them. The types are integers of 1, 2, 4 and 8 bytes, each
// without and with a sign, float and double; in older files two and three numbers of these, too. Bytes of no type are as
// many as the options say.
void read_descriptions(const std::string& record, const std::string& label, Las_header& h)
{
  constexpr std::size_t scale_bit = 8, offset_bit = 16, sizes[10] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  std::size_t position = las_point_size(h.point_format);
  for(std::size_t first = las_record_header; first + las_description <= record.size(); first += las_description) {
    const char* const d = record.data() + first;
    const std::size_t type = std::uint8_t(d[2]), options = std::uint8_t(d[3]);
    const std::size_t size = type == 0 ? options : (type - 1) / 10 * sizes[(type - 1) % 10] + sizes[(type - 1) % 10];
    if(type > 30 || size == 0 || position + size > h.record_length)
      break;
    const std::string name(d + 4, std::find(d + 4, d + 36, '\0'));
    if(type >= 1 && type <= 10)
      h.dimensions.push_back({name, "UIUIUIUIFF"[type - 1], size, position,
                              (options & scale_bit) != 0 ? number_at<double>(d + 112) : 1,
                              (options & offset_bit) != 0 ? number_at<double>(d + 136) : 0});
    if(name == label && h.label_size == 0) {
      h.label_position = position;
      h.label_size = size;
    } else {
      h.descriptions.append(d, las_description);
    }
    position += size;
  }
  constexpr std::size_t most = 255;
  for(std::size_t size = 0; position < h.record_length; position += size) {
    size = (std::min)(most, h.record_length - position);
    h.descriptions += describe_las_bytes(0, int(size), "ExtraBytes", "");
  }
}

// What comes after a damaged one is left out.
std::vector<std::string> read_records(Input_buffer& in, std::uint32_t count, std::uint64_t end)
{
  std::vector<std::string> records;
  for(; count > 0 && in.position() + las_record_header <= end; --count) {
    std::string record(las_record_header, '\0');
    read_exactly(in, record.data(), record.size(), "a record of the LAS header");
    const std::uint16_t length = number_at<std::uint16_t>(record.data() + 20);
    if(length > end - in.position())
      break;
    record.resize(las_record_header + length);
    read_exactly(in, record.data() + las_record_header, length, "a record of the LAS header");
    records.push_back(record);
  }
  return records;
}

// The records behind the points: of LAS 1.4, or the waveforms of LAS 1.3. Returns how many of them are not there.
std::size_t read_tail(Byte_source& file, const Las_header& h, Input_records& records)
{
  constexpr std::size_t header_1_3 = 235, record_header = 60;
  const bool has_waveforms = h.minor_version >= 3 && h.bytes.size() >= header_1_3;
  const std::uint64_t waveforms = has_waveforms ? number_at<std::uint64_t>(h.bytes.data() + 227) : 0;
  std::uint64_t first = waveforms;
  std::uint32_t count = 1;
  if(h.minor_version == 4 && h.bytes.size() >= header_1_4 && number_at<std::uint32_t>(h.bytes.data() + 243) > 0) {
    first = number_at<std::uint64_t>(h.bytes.data() + 235);
    count = number_at<std::uint32_t>(h.bytes.data() + 243);
  }
  if(first == 0)
    return 0;
  if(first < h.first_point || first > file.size())
    return count;
  for(Input_buffer in(file, first); count > 0 && in.left() >= record_header; --count) {
    if(in.position() == waveforms)
      records.waveforms = records.tail.size();
    std::string record(record_header, '\0');
    read_exactly(in, record.data(), record_header, "a record behind the LAS points");
    const std::uint64_t length = (std::min)(number_at<std::uint64_t>(record.data() + 20), in.left() + 1);
    if(length <= in.left())
      record.resize(record_header + std::size_t(length));
    read_exactly(in, record.data() + record_header, std::size_t(length), "a record behind the LAS points");
    if(!is_of_this_file(record) && !describes_bytes(record)) // which the header has
      records.tail += record;
  }
  return count;
}

} // namespace

std::size_t las_point_size(int point_format)
{
  constexpr std::size_t sizes[11] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  return sizes[point_format];
}

std::size_t las_color_position(int point_format)
{
  constexpr std::size_t positions[11] = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
  return positions[point_format];
}

std::string without_bounds(std::string descriptions)
{
  constexpr std::size_t options = 3, smallest = 64, scale = 112; // their places
  for(std::size_t first = 0; first + las_description <= descriptions.size(); first += las_description) {
    descriptions[first + options] = char(descriptions[first + options] & ~6); // that there are such values
    std::fill_n(descriptions.begin() + std::ptrdiff_t(first + smallest), scale - smallest, '\0');
  }
  return descriptions;
}

std::string describe_las_bytes(int type, int options, const std::string& name, const std::string& text)
{
  std::string description(las_description, '\0');
  description[2] = char(type);
  description[3] = char(options);
  description.replace(4, name.size(), name);
  description.replace(160, text.size(), text);
  return description;
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

Las_header read_las_header(Input_buffer& in, const std::string& label)
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
  h.bytes.assign(bytes, std::size_t(in.position()));
  h.bytes.resize(header_size);
  read_exactly(in, &h.bytes[std::size_t(in.position())], header_size - std::size_t(in.position()), "the LAS header");
  std::string descriptions;
  const std::uint32_t announced = number_at<std::uint32_t>(bytes + 100);
  std::vector<std::string> records = read_records(in, announced, (std::min)(h.first_point, in.position() + in.left()));
  h.lost_records = announced - records.size();
  for(std::string& record : records) {
    if(is_of(record, "LASF_Projection"))
      h.frame.records.push_back(record);
    if(describes_bytes(record))
      descriptions = std::move(record);
    else if(!is_of_this_file(record))
      h.records.push_back(std::move(record));
  }
  read_descriptions(descriptions, label, h);
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
  if(const std::size_t position = las_color_position(h.point_format))
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

void read_points(Input_buffer& in, const Las_header& h, const std::function<void(const char*)>& add)
{
  std::vector<char> record(h.record_length);
  for(std::uint64_t i = 0; i < h.count; ++i) {
    if(in.sgetn(record.data(), h.record_length) != h.record_length)
      fail_after(i, h.count);
    add(record.data());
  }
}

// The parts of the head are the header, the descriptions of the extra bytes, and the records.
void describe_records(const Las_header& h, Input_records& records)
{
  records.has_others = true;
  const auto length = std::uint16_t(h.record_length - h.label_size), ordered = little_endian(length);
  records.layout = text_of(h.minor_version, ' ', h.point_format, ' ', length, without_bounds(h.descriptions));
  records.head = {h.bytes, h.descriptions};
  std::memcpy(&records.head[0][105], &ordered, sizeof ordered);
  records.head.insert(records.head.end(), h.records.begin(), h.records.end());
  records.is_whole = records.waveforms.has_value(); // points have places in them
}

} // namespace

void read_las(Byte_source& file, const std::string& path, const Input_settings& settings, Point_set& points,
              Input_notes& notes)
{
  Input_buffer in(file);
  const Las_header h = read_las_header(in, settings.label);
  notes.las_frame = h.frame;
  const Las_dimension* const tolerance = tolerance_of(h, settings.tolerance);
  const bool has_color = las_color_position(h.point_format) > 0;
  Cloud_builder builder(points, {false, has_color, true, true, tolerance != nullptr}, settings, notes);
  const auto add = [&](const char* record) {
    Point_row row = point_of_record(record, h);
    if(tolerance != nullptr)
      row.tolerance = value_of(record + tolerance->position, *tolerance);
    if(!builder.add(row) || !notes.records)
      return;
    const std::size_t rest = h.label_position + h.label_size;
    notes.records->bytes.append(record, h.label_position);
    notes.records->add({record + rest, h.record_length - rest});
  };
  if(h.is_compressed) {
    if(is_gzip(path))
      throw std::runtime_error("is LAZ within gzip; decompress it with gunzip");
    if constexpr(has_laszip)
      read_laz_points(path, h, add);
    else
      throw std::runtime_error("LAZ needs LASzip; decompress with laszip or build Tandem with it");
  } else {
    const std::uint64_t bytes = in.position() + in.left();
    check_room(h.count, h.first_point < bytes ? (bytes - h.first_point) / h.record_length : 0);
    in.skip(h.first_point - in.position());
    if(settings.classes.empty() && !settings.crop) {
      points.reserve(std::size_t(h.count));
      if(notes.records)
        notes.records->bytes.reserve(std::size_t(h.count) * h.record_length);
    }
    read_points(in, h, add);
  }
  if(!notes.records)
    return;
  if(const std::size_t lost = h.lost_records + read_tail(file, h, *notes.records); lost > 0)
    notes.warnings.push_back(text_of("LAS records that are damaged, or not there, are not in the output: ", lost));
  describe_records(h, *notes.records);
  if(h.label_size > 0)
    keeps_field(settings.label, Column::none, settings, notes);
}

} // namespace program
