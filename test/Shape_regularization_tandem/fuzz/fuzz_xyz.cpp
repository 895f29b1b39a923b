// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reader of .xyz and .pwn.

#include "fuzz_reader.h"
#include "text_rows.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  const std::size_t points = read_as_file(bytes, size, ".xyz");
  if(points == 0)
    return 0;
  // Each row is a point, except for a first one that is their number. Otherwise labels would belong to other rows.
  const std::vector<std::string> rows = rows_of(bytes, size);
  const bool has_count = !rows.empty() && numbers_of(rows.front(), 2) == 1;
  expect(points + (has_count ? 1 : 0) == rows.size(), "not every row is a point");
  for(std::size_t i = has_count ? 1 : 0; i < rows.size(); ++i)
    expect(numbers_of(rows[i], 3) == 3, "a point of less than three numbers");
  return 0;
}
