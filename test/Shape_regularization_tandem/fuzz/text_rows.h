// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rows of a text file, to be compared with the points that a reader makes of it.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_FUZZ_TEXT_ROWS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_FUZZ_TEXT_ROWS_H

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

// Without empty ones and comments.
inline std::vector<std::string> rows_of(const std::uint8_t* bytes, std::size_t size)
{
  std::vector<std::string> rows;
  std::istringstream in(std::string(bytes, bytes + size));
  for(std::string row; std::getline(in, row);) {
    const std::size_t first = row.find_first_not_of(" \t\r\v\f");
    if(first != std::string::npos && row[first] != '#')
      rows.push_back(row);
  }
  return rows;
}

// The number of numbers that the row begins with, at most `most`.
inline int numbers_of(const std::string& row, int most)
{
  std::istringstream in(row);
  int count = 0;
  for(double x; count < most && in >> x;)
    ++count;
  return count;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_FUZZ_TEXT_ROWS_H
