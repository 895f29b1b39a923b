// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_SENTENCE_H
#define DETECT_PLANES_SENTENCE_H

#include <iomanip>
#include <sstream>
#include <string>

namespace program {

// Words and figures, of which four digits tell enough.
template <class... Words>
std::string sentence(const Words&... words)
{
  std::ostringstream text;
  text << std::setprecision(4);
  (text << ... << words);
  return text.str();
}

} // namespace program

#endif // DETECT_PLANES_SENTENCE_H
