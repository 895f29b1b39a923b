// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Texts of words and figures.

#ifndef TANDEM_EXAMPLES_SENTENCES_H
#define TANDEM_EXAMPLES_SENTENCES_H

#include <iomanip>
#include <sstream>
#include <string>

namespace tandem_examples {

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

} // namespace tandem_examples

#endif // TANDEM_EXAMPLES_SENTENCES_H
