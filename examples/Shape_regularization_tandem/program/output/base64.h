// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_BASE64_H
#define DETECT_PLANES_BASE64_H

#include <cstddef>
#include <ostream>
#include <string>

namespace program {

// The text of RFC 4648, without line breaks.
inline void write_base64(std::ostream& out, const std::string& bytes)
{
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? unsigned(static_cast<unsigned char>(bytes[i])) : 0u;
  };
  for(std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    const std::size_t left = bytes.size() - i;
    const char text[4] = {digits[three >> 18], digits[three >> 12 & 63], left > 1 ? digits[three >> 6 & 63] : '=',
                          left > 2 ? digits[three & 63] : '='};
    out.write(text, 4);
  }
}

} // namespace program

#endif // DETECT_PLANES_BASE64_H
