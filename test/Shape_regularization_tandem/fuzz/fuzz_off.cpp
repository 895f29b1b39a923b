// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reader of .off.

#include "fuzz_reader.h"
#include "text_rows.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  const std::size_t points = read_as_file(bytes, size, ".off");
  if(points == 0)
    return 0;
  // The rows after the word OFF and the numbers of points, faces and edges are points, and then come faces.
  const std::vector<std::string> rows = rows_of(bytes, size);
  expect(rows.size() >= points + 2, "more points than rows");
  for(std::size_t i = 2; i < points + 2; ++i)
    expect(numbers_of(rows[i], 3) == 3, "a row in place of a point, or a point in place of another one");
  long long announced = 0, faces = 0;
  std::istringstream(rows[1]) >> announced >> faces;
  expect(announced == (long long)(points), "another number of points than the file announces");
  expect(rows.size() >= points + 2 + std::size_t(faces < 0 ? 0 : faces), "faces in place of points");
  return 0;
}
