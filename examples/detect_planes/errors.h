// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Texts of words and figures, and errors that have them.

#ifndef DETECT_PLANES_ERRORS_H
#define DETECT_PLANES_ERRORS_H

#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string>

namespace program {

// Bad usage: exit code 2. Every other exception is exit code 1. The library makes them alike on all processes.
using Usage_error = std::invalid_argument;

template <class... Words>
std::string text_of(const Words&... words)
{
  std::ostringstream text;
  (text << ... << words);
  return text.str();
}

// With figures, of which four digits tell enough.
template <class... Words>
std::string sentence(const Words&... words)
{
  return text_of(std::setprecision(4), words...);
}

template <class Error = std::runtime_error, class... Words>
[[noreturn]] void throw_error(const Words&... words)
{
  throw Error(text_of(words...));
}

} // namespace program

#endif // DETECT_PLANES_ERRORS_H
