// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Label propagation over all ranks: see Label_propagation. Proposals to ghosts go to their owners, which list the points
// for the next round.

#ifndef CGAL_TANDEM_INTERNAL_MPI_RANK_PROPAGATION_H
#define CGAL_TANDEM_INTERNAL_MPI_RANK_PROPAGATION_H

#include <CGAL/Tandem/internal/mpi/Ghosts.h>
#include <CGAL/Tandem/internal/mpi/Host_view.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class Backend, class Propagation>
class Rank_propagation {
public:
  // The first proposals of this rank have been made.
  Rank_propagation(Backend& backend, Ghosts<Backend>& ghosts, const Propagation& rounds)
    : backend_(backend), communicator_(backend.communicator()), ghosts_(ghosts), rounds_(rounds)
  {}

  void run(std::size_t maximum_rounds, std::size_t n)
  {
    std::uint32_t* const end = rounds_.proposed.end;
    send_proposals(end);
    for(std::size_t round = 0; round < maximum_rounds; ++round) {
      run_step(backend_, rounds_, Propagation::accept, round, n);
      ghosts_.update_labels(rounds_.labels.label);
      const std::vector<std::uint32_t> of_round = to_vector(backend_, end + round, 2);
      if(communicator_.sum(std::uint64_t(of_round[1] - of_round[0])) <= rounds_.few_points)
        return;
      run_step(backend_, rounds_, Propagation::propose, round, n);
      send_proposals(end + round + 1);
    }
  }

private:
  // Takes the ghosts from the list of points with proposals between end[0] and end[1], and adds own points that other
  // ranks have proposed to.
  void send_proposals(std::uint32_t* end)
  {
    const std::vector<std::uint32_t> ends = to_vector(backend_, end, 2);
    const std::size_t size = ends[1] - ends[0];
    std::uint32_t* const point = rounds_.proposed.point + ends[0];
    std::uint64_t* const proposal = rounds_.proposal.proposal;
    const auto sent = backend_.template collect<Sent_proposal>(size, Take_sent{point, proposal, ghosts_.own_size()});
    if(sent.size() > 0) {
      const auto kept = backend_.template collect<std::uint32_t>(size, Take_kept{point, ghosts_.own_size()});
      backend_.for_each(kept.size(), Copy_items<std::uint32_t>{kept.data(), point});
      write_to(backend_, std::vector<std::uint32_t>{ends[0] + std::uint32_t(kept.size())}, end + 1);
    }
    const auto received = to_buffer(backend_, exchange(to_vector(backend_, sent)));
    backend_.for_each(received.size(),
                      Receive_proposals<Backend>{received.data(), proposal, rounds_.proposed.point, end + 1});
  }

  // From proposals to ghosts to those of other ranks to own points.
  std::vector<Sent_proposal> exchange(const std::vector<Sent_proposal>& sent)
  {
    std::vector<std::vector<Sent_proposal>> by_rank(std::size_t(communicator_.size()));
    for(const Sent_proposal& p : sent) {
      const Rank_point owner = ghosts_.point_at(std::uint32_t(p.index));
      by_rank[owner.rank].push_back({p.value, owner.index});
    }
    std::vector<Sent_proposal> received;
    for(const std::vector<Sent_proposal>& from : communicator_.exchange(by_rank))
      received.insert(received.end(), from.begin(), from.end());
    return received;
  }

  Backend& backend_;
  Communicator& communicator_;
  Ghosts<Backend>& ghosts_;
  Propagation rounds_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_RANK_PROPAGATION_H
