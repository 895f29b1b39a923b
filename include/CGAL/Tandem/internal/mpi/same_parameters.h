// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether all ranks have been called with the same parameters. If not, they would do different things and wait for each
// other.

#ifndef CGAL_TANDEM_INTERNAL_MPI_SAME_PARAMETERS_H
#define CGAL_TANDEM_INTERNAL_MPI_SAME_PARAMETERS_H

#include <CGAL/Tandem/check_parameters.h>
#include <CGAL/Tandem/internal/base/listed_parameters.h>
#include <CGAL/Tandem/internal/mpi/Communicator.h>

#include <stdexcept>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Called by all ranks.
inline void check_same_parameters(Communicator& communicator, const Parameters& parameters)
{
  const auto list = listed(parameters);
  std::vector<double> own;
  for(const auto& value : list)
    own.push_back(value.second);
  std::vector<std::size_t> first;
  const std::vector<double> all = communicator.gather(own, &first);
  for(std::size_t r = 1; r + 1 < first.size(); ++r)
    for(std::size_t i = 0; i < (std::min)(first[1], first[r + 1] - first[r]); ++i)
      if(all[i] != all[first[r] + i])
        throw std::invalid_argument(std::string(i < list.size() ? list[i].first : "fixed_directions") +
                                    " has to be the same on all ranks: there are " + to_text(all[i]) + " and " +
                                    to_text(all[first[r] + i]));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_SAME_PARAMETERS_H
