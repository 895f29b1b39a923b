// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The links between shapes over all ranks: each has counted the edges of its own rows.

#ifndef CGAL_TANDEM_INTERNAL_MPI_GATHER_LINKS_H
#define CGAL_TANDEM_INTERNAL_MPI_GATHER_LINKS_H

#include <CGAL/Tandem/internal/mpi/Communicator.h>
#include <CGAL/Tandem/internal/shapes/links.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Those with so many edges, by pair, on all ranks.
inline std::vector<Link> gather_links(Communicator& communicator, const std::vector<Link>& own, std::uint32_t minimum)
{
  std::vector<Link> all = communicator.gather(own);
  std::sort(all.begin(), all.end(), [](const Link& a, const Link& b) { return a.pair < b.pair; });
  std::vector<Link> joined;
  for(const Link& link : all) {
    if(joined.empty() || joined.back().pair != link.pair)
      joined.push_back({link.pair, 0});
    const std::uint64_t count = std::uint64_t(joined.back().count) + link.count;
    joined.back().count = std::uint32_t((std::min)(count, std::uint64_t(0xffffffffu)));
  }
  const auto is_weak = [&](const Link& link) { return link.count < minimum; };
  joined.erase(std::remove_if(joined.begin(), joined.end(), is_weak), joined.end());
  return joined;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_GATHER_LINKS_H
