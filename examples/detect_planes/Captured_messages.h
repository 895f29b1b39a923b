// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_CAPTURED_MESSAGES_H
#define DETECT_PLANES_CAPTURED_MESSAGES_H

#include <iostream>
#include <sstream>
#include <string>

namespace program {

// CGAL reports on std::cerr; its message becomes part of our one line. Some of it reports on std::cout.
class Captured_messages {
public:
  explicit Captured_messages(std::ostream& stream = std::cerr)
    : stream(stream), precision(stream.precision()), previous(stream.rdbuf(text.rdbuf()))
  {}
  ~Captured_messages()
  {
    stream.rdbuf(previous);
    stream.precision(precision);
  }
  Captured_messages(const Captured_messages&) = delete;
  Captured_messages& operator=(const Captured_messages&) = delete;

  std::string first_line() const { return text.str().substr(0, text.str().find('\n')); }

private:
  std::ostream& stream;
  std::ostringstream text;
  std::streamsize precision;
  std::streambuf* previous;
};

} // namespace program

#endif // DETECT_PLANES_CAPTURED_MESSAGES_H
