// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The decompression of LZF, as PCD files have it.

#ifndef DETECT_PLANES_LZF_H
#define DETECT_PLANES_LZF_H

#include <cstddef>
#include <string>

namespace program {

// A piece of a compressed text begins with a byte c. Below 32, c + 1 bytes follow, which are taken as they are. Else
// the upper three bits are a length less 2 (7: the next byte is added), the other five and one more byte a distance
// back, less 1, to what is repeated. False if the result has not exactly `size` bytes.
inline bool decompress_lzf(const std::string& in, std::size_t size, std::string& out)
{
  out.clear();
  out.reserve(size);
  const auto byte = [&in](std::size_t i) { return std::size_t(static_cast<unsigned char>(in[i])); };
  for(std::size_t i = 0; i < in.size();) {
    const std::size_t c = byte(i++);
    if(c < 32) {
      if(in.size() - i < c + 1 || size - out.size() < c + 1)
        return false;
      out.append(in, i, c + 1);
      i += c + 1;
      continue;
    }
    std::size_t length = c >> 5;
    if(length == 7 && i < in.size())
      length += byte(i++);
    length += 2;
    if(i >= in.size())
      return false;
    const std::size_t distance = ((c & 31) << 8) + byte(i++) + 1;
    if(distance > out.size() || size - out.size() < length)
      return false;
    for(; length > 0; --length)
      out += out[out.size() - distance]; // what is repeated may overlap its repetition
  }
  return out.size() == size;
}

} // namespace program

#endif // DETECT_PLANES_LZF_H
