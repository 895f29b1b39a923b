// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/Laszip.h"
#include "output/Output_file.h"
#include "output/writers.h"

#include <fstream>

namespace program {

namespace {

void compress(const std::string& las, const std::string& laz)
{
  const Laszip reader, writer;
  laszip_BOOL is_compressed = 0;
  laszip_header* header = nullptr;
  laszip_point* point = nullptr;
  const auto check = [](const Laszip& used, laszip_I32 has_failed) {
    used.check(has_failed, "LASzip cannot compress the output");
  };
  check(reader, laszip_open_reader(reader.pointer, las.c_str(), &is_compressed));
  check(reader, laszip_get_header_pointer(reader.pointer, &header));
  check(reader, laszip_get_point_pointer(reader.pointer, &point));
  const laszip_I64 count = header->number_of_point_records > 0 ? laszip_I64(header->number_of_point_records)
                                                               : laszip_I64(header->extended_number_of_point_records);
  check(writer, laszip_request_native_extension(writer.pointer, 1));
  check(writer, laszip_set_header(writer.pointer, header));
  check(writer, laszip_open_writer(writer.pointer, laz.c_str(), 1));
  for(laszip_I64 i = 0; i < count; ++i) {
    check(reader, laszip_read_point(reader.pointer));
    check(writer, laszip_set_point(writer.pointer, point));
    check(writer, laszip_write_point(writer.pointer));
  }
  check(writer, laszip_close_writer(writer.pointer));
  check(reader, laszip_close_reader(reader.pointer));
}

} // namespace

// LASzip opens files itself.
void write_laz(std::ostream& out, const Output_points& cloud)
{
  const Temporary_path las(partial_name(std::filesystem::temp_directory_path()));
  const Temporary_path laz(partial_name(std::filesystem::temp_directory_path()));
  Descriptor_buffer buffer;
  errno = 0;
  if(!buffer.open(las.name().c_str(), O_EXCL, 0600))
    throw_error(las.name().string(), ": cannot be written", reason_of(errno));
  std::ostream file(&buffer);
  write_completely(las.name().string(), file, buffer, [&](std::ostream& stream) { write_las(stream, cloud); });
  compress(las.name().string(), laz.name().string());
  // LASzip passes over what stands behind the points.
  std::ifstream compressed(laz.name(), std::ios::binary);
  std::string header(375, '\0');
  if(!compressed.read(header.data(), std::streamsize(header.size())))
    throw_error(laz.name().string(), ": cannot be read again", reason_of(errno));
  set_tail(header, std::filesystem::file_size(laz.name()), cloud.records);
  out << header << compressed.rdbuf();
  if(cloud.records != nullptr)
    out << cloud.records->tail;
}

} // namespace program
