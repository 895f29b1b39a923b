// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/writers.h"

#include "output/Output_file.h"

#include <laszip_api.h>

namespace program {

namespace {

// Reads or writes a file by LASzip.
class Laszip {
public:
  Laszip()
  {
    if(laszip_create(&pointer))
      throw std::runtime_error("LASzip cannot be used");
  }
  ~Laszip() { laszip_destroy(pointer); }
  Laszip(const Laszip&) = delete;
  Laszip& operator=(const Laszip&) = delete;

  void check(laszip_I32 has_failed)
  {
    laszip_CHAR* error = nullptr;
    if(has_failed == 0)
      return;
    laszip_get_error(pointer, &error);
    throw_error("LASzip cannot compress the output", (error != nullptr ? " (" + std::string(error) + ")" : ""));
  }

  laszip_POINTER pointer = nullptr;
};

void compress(const std::string& las, const std::string& laz)
{
  Laszip reader, writer;
  laszip_BOOL is_compressed = 0;
  laszip_header* header = nullptr;
  laszip_point* point = nullptr;
  laszip_I64 count = 0;
  reader.check(laszip_open_reader(reader.pointer, las.c_str(), &is_compressed));
  reader.check(laszip_get_header_pointer(reader.pointer, &header));
  reader.check(laszip_get_point_pointer(reader.pointer, &point));
  reader.check(laszip_get_point_count(reader.pointer, &count));
  count = header->number_of_point_records > 0 ? laszip_I64(header->number_of_point_records)
                                              : laszip_I64(header->extended_number_of_point_records);
  writer.check(laszip_request_native_extension(writer.pointer, 1));
  writer.check(laszip_set_header(writer.pointer, header));
  writer.check(laszip_open_writer(writer.pointer, laz.c_str(), 1));
  for(laszip_I64 i = 0; i < count; ++i) {
    reader.check(laszip_read_point(reader.pointer));
    writer.check(laszip_set_point(writer.pointer, point));
    writer.check(laszip_write_point(writer.pointer));
  }
  writer.check(laszip_close_writer(writer.pointer));
  reader.check(laszip_close_reader(reader.pointer));
}

} // namespace

// LASzip opens files itself.
void write_laz(std::ostream& out, const Output_points& cloud, const std::optional<Las_frame>& frame_of_input)
{
  const Partial_file las(std::filesystem::temp_directory_path()), laz(std::filesystem::temp_directory_path());
  {
    File_buffer buffer;
    errno = 0;
    if(!buffer.open(las.name(), std::ios::out | std::ios::binary))
      throw_error(las.name().string(), ": cannot be written", reason_of(errno));
    std::ostream file(&buffer);
    write_las(file, cloud, frame_of_input);
    if(!file.flush())
      throw_error(las.name().string(), ": cannot be written completely", reason_of(buffer.error()));
  }
  compress(las.name().string(), laz.name().string());
  std::ifstream compressed(laz.name(), std::ios::binary);
  out << compressed.rdbuf();
}

} // namespace program
