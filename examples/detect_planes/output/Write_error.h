// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why something could not be written. A stream tells only that, and maybe much later, when errno has another value.

#ifndef DETECT_PLANES_WRITE_ERROR_H
#define DETECT_PLANES_WRITE_ERROR_H

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

namespace program {

// In brackets, for the end of a message.
inline std::string reason_of(int error) { return std::string(" (") + std::strerror(error != 0 ? error : EIO) + ")"; }

// The value that errno had at the first failure.
class Write_error {
public:
  int error() const { return first; }

protected:
  void keep_error() { first = first != 0 ? first : errno; }

private:
  int first = 0;
};

// A file that keeps it.
class File_buffer : public std::filebuf, public Write_error {
protected:
  int_type overflow(int_type c) override
  {
    const int_type result = std::filebuf::overflow(c);
    if(traits_type::eq_int_type(result, traits_type::eof()))
      keep_error();
    return result;
  }

  std::streamsize xsputn(const char* text, std::streamsize size) override
  {
    const std::streamsize written = std::filebuf::xsputn(text, size);
    if(written < size)
      keep_error();
    return written;
  }

  int sync() override
  {
    const int result = std::filebuf::sync();
    if(result != 0)
      keep_error();
    return result;
  }
};

} // namespace program

#endif // DETECT_PLANES_WRITE_ERROR_H
