// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/Laszip.h"
#include "input/readers.h"

#include <ostream>

namespace program {

namespace {

// Of a stream that writes one point after the other to the same place.
class Record_buffer : public std::streambuf {
public:
  explicit Record_buffer(std::size_t size) : record(size) {}

  void begin() { setp(record.data(), record.data() + record.size()); }
  bool is_full() const { return pptr() == epptr(); }
  const char* bytes() const { return record.data(); }

private:
  std::vector<char> record;
};

} // namespace

// A writer of points without compression knows how LAS files have them.
void read_laz_points(const std::string& path, const Las_header& header, const std::function<void(const char*)>& add)
{
  const Laszip reader, writer;
  laszip_BOOL is_compressed = 0;
  laszip_header* header_of_file = nullptr;
  laszip_point* point = nullptr;
  const auto check = [](const Laszip& used, laszip_I32 has_failed, const char* what = "cannot be opened by LASzip") {
    used.check(has_failed, what);
  };
  check(reader, laszip_open_reader(reader.pointer, path.c_str(), &is_compressed));
  check(reader, laszip_get_header_pointer(reader.pointer, &header_of_file));
  check(reader, laszip_get_point_pointer(reader.pointer, &point));
  Record_buffer buffer(header.record_length);
  std::ostream stream(&buffer);
  check(writer, laszip_set_header(writer.pointer, header_of_file));
  check(writer, laszip_open_writer_stream(writer.pointer, stream, 0, 1));
  for(std::uint64_t i = 0; i < header.count; ++i) {
    if(i % 4096 == 0)
      check_signals();
    buffer.begin();
    constexpr const char* failed = "cannot be read completely by LASzip";
    check(reader, laszip_read_point(reader.pointer), failed);
    check(writer, laszip_set_point(writer.pointer, point), failed);
    check(writer, laszip_write_point(writer.pointer), failed);
    if(!buffer.is_full())
      throw std::runtime_error("has points of another size than its header says");
    add(buffer.bytes());
  }
  laszip_close_writer(writer.pointer);
  laszip_close_reader(reader.pointer);
}

} // namespace program
