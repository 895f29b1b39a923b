// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_DESCRIPTOR_BUFFER_H
#define DETECT_PLANES_DESCRIPTOR_BUFFER_H

#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#define DETECT_PLANES_HAS_DESCRIPTORS
#endif

#include "output/Write_error.h"

#include <array>
#include <cerrno>
#include <memory>
#include <streambuf>
#include <string>

namespace program {

#ifdef DETECT_PLANES_HAS_DESCRIPTORS

// Writes to a descriptor that the shell has opened, from where that stands. To open the file once more would start at
// its beginning, and overwrite what was or will be written there.
class Descriptor_buffer : public std::streambuf, public Write_error {
public:
  explicit Descriptor_buffer(int opened) : descriptor(dup(opened)) { reset(); }
  ~Descriptor_buffer() override { ::close(descriptor); }
  Descriptor_buffer(const Descriptor_buffer&) = delete;
  Descriptor_buffer& operator=(const Descriptor_buffer&) = delete;

protected:
  int_type overflow(int_type c) override
  {
    if(sync() != 0)
      return traits_type::eof();
    if(!traits_type::eq_int_type(c, traits_type::eof()))
      sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

  int sync() override
  {
    for(const char* next = pbase(); next != pptr();) {
      const ssize_t n = ::write(descriptor, next, std::size_t(pptr() - next));
      if(n < 0 && errno != EINTR) {
        keep_error();
        return -1;
      }
      next += n < 0 ? 0 : n;
    }
    reset();
    return 0;
  }

private:
  void reset() { setp(buffer.data(), buffer.data() + buffer.size()); }

  int descriptor;
  std::array<char, 65536> buffer;
};

// The file as the shell has opened it for writing: /dev/stdout, /dev/fd/3, or a name that is also the target of a
// redirection. Null if it has not.
inline std::unique_ptr<Descriptor_buffer> opened_by_shell(const std::string& path)
{
  constexpr int largest_descriptor_of_shells = 255;
  struct stat file, opened;
  if(stat(path.c_str(), &file) != 0)
    return nullptr;
  for(int d = 0; d <= largest_descriptor_of_shells; ++d)
    if(fstat(d, &opened) == 0 && opened.st_dev == file.st_dev && opened.st_ino == file.st_ino &&
       (fcntl(d, F_GETFL) & O_ACCMODE) != O_RDONLY)
      return std::make_unique<Descriptor_buffer>(d);
  return nullptr;
}

// A new file that only its owner may read.
inline bool create_private(const char* path)
{
  const int descriptor = ::open(path, O_WRONLY | O_CREAT | O_EXCL, S_IRUSR | S_IWUSR);
  return descriptor >= 0 && ::close(descriptor) == 0;
}

#else

class Descriptor_buffer : public std::streambuf, public Write_error {};

inline std::unique_ptr<Descriptor_buffer> opened_by_shell(const std::string&) { return nullptr; }

inline bool create_private(const char*) { return true; }

#endif

} // namespace program

#endif // DETECT_PLANES_DESCRIPTOR_BUFFER_H
