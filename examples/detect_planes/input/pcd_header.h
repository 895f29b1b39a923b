// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The header of PCD files, the format of the Point Cloud Library.

#ifndef DETECT_PLANES_PCD_HEADER_H
#define DETECT_PLANES_PCD_HEADER_H

#include "input/Text_lines.h"

#include <cstdint>
#include <string>
#include <vector>

namespace program {

struct Pcd_header {
  struct Field {
    std::string name;
    std::size_t size = 0;     // of one value, in bytes
    char type = 0;            // I, U or F: signed, unsigned, real
    std::size_t count = 1;    // of values
    std::size_t position = 0; // of its bytes in the row of a point
    std::size_t first = 0;    // of its values in a row of text
  };
  std::vector<Field> fields;
  std::uint64_t points = 0;
  std::string data;                   // ascii, binary or binary_compressed
  std::vector<std::string> viewpoint; // the words of that line; none without one

  const Field* find(const std::string& name) const
  {
    for(const Field& f : fields)
      if(f.name == name)
        return &f;
    return nullptr;
  }

  std::size_t row_size() const
  {
    return fields.empty() ? 0 : fields.back().position + fields.back().size * fields.back().count;
  }
  std::size_t row_values() const { return fields.empty() ? 0 : fields.back().first + fields.back().count; }
};

// Up to the line DATA.
Pcd_header read_pcd_header(Text_lines& text);

} // namespace program

#endif // DETECT_PLANES_PCD_HEADER_H
