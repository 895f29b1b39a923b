// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_HASH_OF_ALL_H
#define DETECT_PLANES_HASH_OF_ALL_H

#include "input/read_cloud.h"
#include "ranks/Ranks.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace program {

// What Planar_shapes_3::hash() is for the points of all ranks, in the order of the inputs: from file to file, the rank
// that has it goes on.
class Hash_of_all {
public:
  Hash_of_all(const std::vector<Input_part>& parts, const std::vector<int>& rank_of_input, const Ranks& ranks)
    : parts(parts), rank_of_input(rank_of_input), ranks(ranks)
  {}

  std::uint64_t operator()(const Shapes& shapes)
  {
    hash = Shapes::hash(std::vector<std::int32_t>(), {});
    add(shapes.data().shape_of);
    Shapes::add_to_hash(hash, shapes.data().coefficients);
    add(shapes.data().normal);
    return hash;
  }

private:
  // A table of the own points, or an empty one.
  template <class Table>
  void add(const Table& table)
  {
    auto part = parts.begin();
    for(std::size_t input = 0; input < rank_of_input.size(); ++input) {
      if(part != parts.end() && part->input == input) {
        for(std::size_t i = part->first; i < (std::min)(part->last, std::size_t(table.size())); ++i)
          Shapes::add_to_hash(hash, std::uint32_t(table[i]));
        ++part;
      }
      hash = ranks.number_of(rank_of_input[input], hash);
    }
  }

  const std::vector<Input_part>& parts;
  const std::vector<int>& rank_of_input;
  const Ranks& ranks;
  std::uint64_t hash = 0;
};

} // namespace program

#endif // DETECT_PLANES_HASH_OF_ALL_H
