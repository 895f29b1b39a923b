// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The values of a file that an option names.

#ifndef DETECT_PLANES_FIND_NAME_H
#define DETECT_PLANES_FIND_NAME_H

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace program {

// What names differ by that mean the same: case, blanks and underscores, and the word that CloudCompare puts before.
inline std::string plain_name(std::string_view text)
{
  std::string name;
  for(unsigned char c : text)
    if(c != '"' && c != '\'' && c != '_' && c != ' ')
      name += char(std::tolower(c));
  return name.compare(0, 6, "scalar") == 0 && name.size() > 6 ? name.substr(6) : name;
}

// Names of what is passed over.
inline bool is_no_name(const std::string& name) { return plain_name(name).empty() || name == "-"; }

inline bool mean_the_same(const std::string& a, const std::string& b)
{
  return !is_no_name(a) && plain_name(a) == plain_name(b);
}

// The place of a name of --tolerance-column: the name itself, else the first that means the same.
// kind: what has these names, for the message.
inline std::size_t find_name(const std::vector<std::string>& names, const std::string& wanted, const std::string& kind)
{
  auto found = is_no_name(wanted) ? names.end() : std::find(names.begin(), names.end(), wanted);
  if(found == names.end())
    found = std::find_if(names.begin(), names.end(), [&](const auto& name) { return mean_the_same(name, wanted); });
  if(found != names.end())
    return std::size_t(found - names.begin());
  std::string all;
  for(const std::string& name : names)
    if(!is_no_name(name))
      all += (all.empty() ? "" : ", ") + name;
  throw std::runtime_error("has no " + kind + " '" + wanted + "', which --tolerance-column names; it has " +
                           (all.empty() ? "none" : all));
}

} // namespace program

#endif // DETECT_PLANES_FIND_NAME_H
