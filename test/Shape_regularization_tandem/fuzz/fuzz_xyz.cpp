// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reader of text tables.

#include "fuzz_reader.h"
#include "text_rows.h"

namespace {

// Without comments.
std::vector<std::string> table_rows(const std::uint8_t* bytes, std::size_t size)
{
  const bool has_mark = size >= 3 && bytes[0] == 0xEF && bytes[1] == 0xBB && bytes[2] == 0xBF; // of UTF-8
  std::vector<std::string> rows;
  for(const std::string& row : rows_of(bytes + (has_mark ? 3 : 0), size - (has_mark ? 3 : 0)))
    if(row.compare(row.find_first_not_of(" \t\r\v\f"), 2, "//") != 0)
      rows.push_back(row);
  return rows;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  const std::size_t points = read_as_file(bytes, size, ".xyz", 4); // ",,,"
  if(points == 0)
    return 0;
  // After names and the number of points, each row is a point. Otherwise labels would belong to other rows.
  const std::vector<std::string> rows = table_rows(bytes, size);
  expect(points <= rows.size(), "more points than rows");
  for(std::size_t i = 0; i < rows.size() - points; ++i)
    expect(numbers_of(rows[i], 3) < 3, "a row that is passed over is a point");
  return 0;
}
