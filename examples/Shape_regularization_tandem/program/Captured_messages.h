// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_CAPTURED_MESSAGES_H
#define DETECT_PLANES_CAPTURED_MESSAGES_H

#include <iostream>
#include <sstream>
#include <string>

namespace program {

// CGAL reports on std::cerr; its message becomes part of our one line.
class Captured_messages {
public:
  Captured_messages() : previous(std::cerr.rdbuf(text.rdbuf())) {}
  ~Captured_messages() { std::cerr.rdbuf(previous); }
  Captured_messages(const Captured_messages&) = delete;
  Captured_messages& operator=(const Captured_messages&) = delete;

  std::string first_line() const { return text.str().substr(0, text.str().find('\n')); }

private:
  std::ostringstream text;
  std::streambuf* previous;
};

} // namespace program

#endif // DETECT_PLANES_CAPTURED_MESSAGES_H
