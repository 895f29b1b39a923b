// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_BINARY_WRITER_H
#define DETECT_PLANES_BINARY_WRITER_H

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <ostream>

namespace program {

inline bool is_little_endian()
{
  const std::uint16_t one = 1;
  unsigned char first;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

// Binary numbers, little-endian on every machine.
class Binary_writer {
public:
  explicit Binary_writer(std::ostream& out) : out(out), is_swapped(!is_little_endian()) {}

  template <class T>
  void write(T value)
  {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if(is_swapped)
      std::reverse(bytes, bytes + sizeof(T));
    out.write(bytes, sizeof(T));
  }

  void write_real(double value, bool is_double)
  {
    if(is_double)
      write(value);
    else
      write(float(value));
  }

private:
  std::ostream& out;
  bool is_swapped;
};

} // namespace program

#endif // DETECT_PLANES_BINARY_WRITER_H
