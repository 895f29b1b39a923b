// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the program says about a run on standard error: one line each.

#ifndef DETECT_PLANES_FAIL_H
#define DETECT_PLANES_FAIL_H

#include "visible_text.h"

#include <iostream>
#include <string_view>

namespace program {

// One line, whatever a library or the name of a file put into the message. Works without memory, too.
inline void print_message(const char* before, std::string_view message, const char* after = "")
{
  std::cerr << before;
  write_visible(std::cerr, message);
  std::cerr << after << std::endl;
}

// Returns the exit code.
inline int fail(int code, const char* message, const char* advice = "")
{
  print_message("detect_planes: ", message, advice);
  return code;
}

inline void warn(std::string_view message) { print_message("detect_planes: warning: ", message); }

} // namespace program

#endif // DETECT_PLANES_FAIL_H
