// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reader of .off.

#include "fuzz_reader.h"
#include "text_rows.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  const std::size_t points = read_as_file(bytes, size, ".off", 6); // ".1.2.3"
  if(points == 0)
    return 0;
  // First the word OFF and the numbers of points, faces and edges, on one row or on two; then points; then faces.
  const std::vector<std::string> rows = rows_of(bytes, size);
  std::string word;
  long long announced = 0, faces = 0;
  std::istringstream head(rows[0]);
  const std::size_t first = head >> word >> announced >> faces ? 1 : 2;
  if(first == 2)
    std::istringstream(rows[1]) >> announced >> faces;
  expect(announced == (long long)(points), "another number of points than the file announces");
  expect(rows.size() >= first + points, "more points than rows");
  for(std::size_t i = first; i < first + points; ++i)
    expect(numbers_of(rows[i], 3) == 3, "a row in place of a point, or a point in place of another one");
  expect(rows.size() >= first + points + std::size_t(faces < 0 ? 0 : faces), "faces in place of points");
  return 0;
}
