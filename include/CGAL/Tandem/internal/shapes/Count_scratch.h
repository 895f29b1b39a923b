// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_COUNT_SCRATCH_H
#define CGAL_TANDEM_INTERNAL_SHAPES_COUNT_SCRATCH_H

#include <CGAL/Tandem/internal/base/types.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Numbers of points of a cell, by shape or whatever they are counted by. A key whose
// slot another one has is counted in the table of all at once.
struct Count_scratch {
  static constexpr std::uint32_t slots = 64;
  std::uint32_t key[slots];
  std::uint32_t count[slots];

  template <class Block>
  CGAL_TANDEM_HD void clear(Block& block)
  {
    block.for_each(slots, [&](std::uint32_t i) {
      key[i] = no_index;
      count[i] = 0;
    });
  }

  template <class Backend, class Block>
  CGAL_TANDEM_HD void add(Block& block, std::uint32_t k, std::uint32_t* total)
  {
    const std::uint32_t slot = k % slots;
    const std::uint32_t owner = block.exchange_if(key[slot], no_index, k);
    if(owner == no_index || owner == k)
      block.append(count[slot]);
    else
      Backend::atomic_add(total[k], 1u);
  }

  template <class Backend, class Block>
  CGAL_TANDEM_HD void flush(Block& block, std::uint32_t* total)
  {
    block.for_each(slots, [&](std::uint32_t i) {
      if(count[i] > 0)
        Backend::atomic_add(total[key[i]], count[i]);
    });
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_COUNT_SCRATCH_H
