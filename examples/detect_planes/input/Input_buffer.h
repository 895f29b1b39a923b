// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bytes of a file, and how the readers get them.

#ifndef DETECT_PLANES_INPUT_BUFFER_H
#define DETECT_PLANES_INPUT_BUFFER_H

#include "signals.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <streambuf>
#include <string>
#include <string_view>

namespace program {

// The bytes of a file; of one that ends in .gz, those that it had before it was compressed.
class Byte_source {
public:
  virtual ~Byte_source() = default;
  virtual std::uint64_t size() const = 0;
  virtual void seek(std::uint64_t position) = 0;
  virtual std::size_t read(char* bytes, std::size_t count) = 0; // less than `count` at the end
};

std::unique_ptr<Byte_source> open_bytes(const std::string& path);
std::unique_ptr<Byte_source> open_gzip(const std::string& path); // by zlib

// Bytes of a file.
struct Byte_range {
  std::uint64_t first, last;
};

// Reads a range of a file, after a text that may be put before it. A signal ends it early: CGAL's
// readers do not know of signals, but they stop where a file ends.
class Input_buffer : public std::streambuf {
public:
  explicit Input_buffer(Byte_source& file) : Input_buffer(file, {0, file.size()}, "") {}

  Input_buffer(Byte_source& file, Byte_range range, const std::string& text)
    : file(file), text(text), position_of_file(range.first), behind(range.last)
  {
    file.seek(range.first);
    setg(this->text.data(), this->text.data(), this->text.data() + text.size());
  }

  // The byte of the file that is read next; meaningful after the text.
  std::uint64_t position() const { return position_of_file - std::uint64_t(egptr() - gptr()); }

  std::uint64_t left() const { return behind - position(); }

  // Those in the buffer, one at least unless the file ends. skip() passes over them.
  std::string_view bytes_at_hand()
  {
    if(gptr() == egptr())
      underflow();
    return {gptr(), std::size_t(egptr() - gptr())};
  }

  // At most as many bytes as are left.
  void skip(std::uint64_t bytes)
  {
    const std::uint64_t buffered = (std::min)(bytes, std::uint64_t(egptr() - gptr()));
    gbump(int(buffered));
    if(bytes == buffered)
      return;
    position_of_file += bytes - buffered;
    file.seek(position_of_file);
  }

protected:
  int_type underflow() override
  {
    if(is_interrupted())
      return traits_type::eof();
    const std::uint64_t wanted = (std::min)(std::uint64_t(buffer.size()), behind - position_of_file);
    const std::size_t n = file.read(buffer.data(), std::size_t(wanted));
    position_of_file += n;
    setg(buffer.data(), buffer.data(), buffer.data() + n);
    return n == 0 ? traits_type::eof() : traits_type::to_int_type(buffer[0]);
  }

private:
  Byte_source& file;
  std::string text;
  std::array<char, 65536> buffer;
  std::uint64_t position_of_file; // behind the bytes in the buffer
  std::uint64_t behind;
};

} // namespace program

#endif // DETECT_PLANES_INPUT_BUFFER_H
