// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The searches of a block, find() and find_first(), beside plain loops, on any back end.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BLOCK_SEARCHES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BLOCK_SEARCHES_H

#include <CGAL/Tandem/internal/backend/buffers.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace CGAL::Tandem::internal {

// From the item `start` of each cell on.
struct Search_cells {
  const Range* cells;
  const std::uint8_t* is_hit;
  std::uint32_t start, most;
  std::uint32_t* found; // `most` for each cell
  std::uint32_t* size;
  std::uint32_t* first;
  std::uint32_t* visits;

  template <class Block, class Scratch>
  CGAL_TANDEM_HD void operator()(Block& block, Scratch&, std::uint32_t c) const
  {
    const std::uint8_t* hits = is_hit + cells[c].first;
    const auto test = [&](std::uint32_t i) { return hits[i] != 0; };
    const std::uint32_t n = block.find(start, cells[c].size(), most, test,
                                       [&](std::uint32_t rank, std::uint32_t i) { found[c * most + rank] = i; });
    const std::uint32_t one = block.find_first(start, cells[c].size(), test);
    block.single([&] {
      size[c] = n;
      first[c] = one;
      ++visits[c];
    });
  }
};

// Of cells of many sizes with none, few, many and only hits. Returns the number of searches that differ.
template <class Backend>
int count_wrong_searches(Backend& backend, std::uint32_t start, std::uint32_t most)
{
  std::mt19937_64 random(start + most);
  std::vector<Range> cells;
  std::vector<std::uint8_t> is_hit;
  for(std::uint32_t one_of : {0u, 1000u, 40u, 3u, 1u})
    for(std::uint32_t size : {0u, 1u, 31u, 32u, 33u, 511u, 512u, 513u, 4000u}) {
      const std::uint32_t begin = std::uint32_t(is_hit.size());
      cells.push_back({begin, begin + size});
      for(std::uint32_t i = 0; i < size; ++i)
        is_hit.push_back(one_of != 0 && random() % one_of == 0);
    }
  const std::uint32_t untouched = 0x5a5a5a5au;
  const auto ranges = to_buffer(backend, cells);
  const auto hits = to_buffer(backend, is_hit);
  auto founds = filled_buffer(backend, cells.size() * most, untouched);
  auto sizes = filled_buffer(backend, cells.size(), untouched),
       firsts = filled_buffer(backend, cells.size(), untouched),
       visited = filled_buffer(backend, cells.size(), std::uint32_t(0));
  backend.template for_each_cell<std::uint32_t>(
    cells.size(),
    Search_cells{ranges.data(), hits.data(), start, most, founds.data(), sizes.data(), firsts.data(), visited.data()});
  const std::vector<std::uint32_t> found = to_vector(backend, founds), size = to_vector(backend, sizes),
                                   first = to_vector(backend, firsts), visits = to_vector(backend, visited);
  int wrong = 0;
  for(std::size_t c = 0; c < cells.size(); ++c) {
    std::vector<std::uint32_t> expected;
    for(std::uint32_t i = start; i < cells[c].size(); ++i)
      if(is_hit[cells[c].first + i])
        expected.push_back(i);
    const std::uint32_t expected_first = expected.empty() ? cells[c].size() : expected.front();
    expected.resize((std::min)(expected.size(), std::size_t(most)));
    const bool is_size = size[c] == expected.size();
    expected.resize(most, untouched);
    wrong += first[c] != expected_first || !is_size || visits[c] != 1 ||
             !std::equal(expected.begin(), expected.end(), found.begin() + std::ptrdiff_t(c * most));
  }
  return wrong;
}

constexpr std::uint32_t search_starts[] = {0, 1, 32, 700}, search_sizes[] = {1, 31, 32, 33, 600};

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BLOCK_SEARCHES_H
