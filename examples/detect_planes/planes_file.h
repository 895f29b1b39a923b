// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planes from a file, as --planes writes them, or from the columns a, b, c, d of a table with a line of names.

#ifndef DETECT_PLANES_PLANES_FILE_H
#define DETECT_PLANES_PLANES_FILE_H

#include "Options.h"
#include "input/table_values.h"
#include "output/Write_error.h"

#include <CGAL/Tandem/Coefficients.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace program {

// Lines of a file of planes, each a word of which is an error with its number.
class Plane_lines {
public:
  explicit Plane_lines(const std::string& path) : path_(path)
  {
    if(std::filesystem::is_directory(path))
      throw std::runtime_error("--planes-from " + path + ": is a directory");
    errno = 0;
    file_.open(path);
    if(!file_)
      throw std::runtime_error("--planes-from " + path + ": cannot be opened" + reason_of(errno));
  }

  // The words of the next line that has some, and does not begin with #.
  bool next()
  {
    for(std::string line; std::getline(file_, line);) {
      ++number_;
      for(char& c : line)
        c = c == ',' || c == ';' || c == '\t' || c == '\r' ? ' ' : c;
      std::istringstream in(line);
      words_.clear();
      for(std::string word; in >> word;)
        words_.push_back(word);
      if(!words_.empty() && words_[0][0] != '#')
        return true;
    }
    return false;
  }

  const std::vector<std::string>& words() const { return words_; }

  [[noreturn]] void fail(const std::string& what) const
  {
    throw std::runtime_error("--planes-from " + path_ + ": line " + std::to_string(number_) + " " + what);
  }

private:
  std::string path_;
  std::ifstream file_;
  std::size_t number_ = 0;
  std::vector<std::string> words_;
};

// The places of the columns a, b, c, d: by a line of names, or the four numbers of each line.
inline std::array<std::size_t, 4> plane_columns(const Plane_lines& lines, bool& are_names)
{
  const std::vector<std::string>& words = lines.words();
  are_names = !parse_number(words[0]);
  std::array<std::size_t, 4> columns = {0, 1, 2, 3};
  for(std::size_t c = 0; c < 4 && are_names; ++c) {
    const auto at = std::find(words.begin(), words.end(), std::string(1, "abcd"[c]));
    if(at == words.end())
      lines.fail("has neither four numbers 'a b c d' nor names of columns with a, b, c and d");
    columns[c] = std::size_t(at - words.begin());
  }
  return columns;
}

inline CGAL::Tandem::Coefficients plane_of(const Plane_lines& lines, const std::array<std::size_t, 4>& columns)
{
  CGAL::Tandem::Coefficients plane;
  for(std::size_t c = 0; c < 4; ++c) {
    const std::string& word = lines.words()[columns[c]];
    const std::optional<double> number = parse_number(word);
    if(!number || !std::isfinite(*number))
      lines.fail("has '" + word.substr(0, 40) + "' where a finite number is expected");
    plane[c] = *number;
  }
  if(plane[0] == 0 && plane[1] == 0 && plane[2] == 0)
    lines.fail("has a null vector as normal");
  return plane;
}

inline std::vector<CGAL::Tandem::Coefficients> read_planes(const std::string& path)
{
  Plane_lines lines(path);
  std::vector<CGAL::Tandem::Coefficients> planes;
  std::array<std::size_t, 4> columns;
  bool are_names = false;
  std::size_t words = 4;
  for(bool is_first = true; lines.next(); is_first = false) {
    if(is_first)
      columns = plane_columns(lines, are_names);
    if(is_first && are_names) {
      words = lines.words().size();
      continue;
    }
    if(lines.words().size() != words)
      lines.fail("has " + std::to_string(lines.words().size()) + " values instead of " + std::to_string(words));
    planes.push_back(plane_of(lines, columns));
  }
  if(planes.empty())
    throw std::runtime_error("--planes-from " + path + ": has no planes");
  return planes;
}

inline void read_known_planes(Options& o)
{
  if(!o.planes_from.empty())
    o.known_planes = read_planes(o.planes_from);
}

} // namespace program

#endif // DETECT_PLANES_PLANES_FILE_H
