// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_FAIL_H
#define DETECT_PLANES_FAIL_H

#include <cstring>
#include <iostream>

namespace program {

// One line, whatever a library put into its message; returns the exit code. Works without memory, too.
inline int fail(int code, const char* message, const char* advice = "")
{
  std::cerr << "detect_planes: ";
  for(const char* line = message; line != nullptr;) {
    const char* end = std::strchr(line, '\n');
    std::cerr.write(line, end == nullptr ? std::streamsize(std::strlen(line)) : end - line);
    std::cerr << (end == nullptr ? advice : " ");
    line = end == nullptr ? nullptr : end + 1;
  }
  std::cerr << std::endl;
  return code;
}

} // namespace program

#endif // DETECT_PLANES_FAIL_H
