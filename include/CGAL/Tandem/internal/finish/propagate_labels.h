// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Label propagation: free points join shapes around them that they fit, in rounds, while planes are fixed. Changes
// labels of free points and clears their interior bits, nothing else; the caller counts again. See the manual, "Label
// Propagation".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_PROPAGATE_LABELS_H
#define CGAL_TANDEM_INTERNAL_FINISH_PROPAGATE_LABELS_H

#include <CGAL/Tandem/internal/backend/lanes.h>
#include <CGAL/Tandem/internal/base/tuning/finish.h>
#include <CGAL/Tandem/internal/shapes/require.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// A proposal is distance << 32 | shape: the smallest one wins, and ties go to the smaller number of a shape.
constexpr std::uint64_t no_proposal = ~std::uint64_t(0);

// The free points with a proposal, each once, round by round; within a round in any order. The ones of a round are
// [end[0], end[1]), those of the next follow up to end[2]. So `end` of round r is the table's entry r.
struct Proposed_points {
  std::uint32_t* point;
  std::uint32_t* end;
};

// The first round: proposals along every edge of the neighbor graph, from both of its ends. Each goes to a free end
// that fits the plane of the other end's shape. Only minima and sets are written, so neither order nor races matter.
// Labels do not change meanwhile.
template <class Backend>
struct Propose_label {
  Cloud_view cloud;
  const std::uint32_t* label;
  const std::uint8_t* state;
  const Plane* plane;
  std::uint64_t* proposal; // by point
  Tolerance tolerance;
  std::uint32_t* proposed; // the points of all rounds, in Proposed_points ...
  std::uint32_t* end;      // ... and where those of the round that is being filled end

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint32_t i = std::uint32_t(at);
    const std::uint32_t* row = cloud.row(i);
    if(label[i] < first_mark) {
      const bool has_others = !(state[i] & interior_bit);
      for(int j = 0; has_others && j < cloud.k && row[j] != no_index; ++j)
        to(row[j], label[i]);
      return;
    }
    std::uint32_t last = free_label; // most neighbors that have a shape have the same one
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t s = label[row[j]];
      if(s >= first_mark || s == last)
        continue;
      last = s;
      make(s, i);
    }
  }

  // Proposes the shape s to a neighbor q of one of its points, if q is free. Most points around q propose the same
  // shape. Its distance does not change, so once is enough.
  CGAL_TANDEM_HD void to(std::uint32_t q, std::uint32_t s) const
  {
    if(label[q] >= first_mark && std::uint32_t(Backend::atomic_load(proposal[q])) != s)
      make(s, q);
  }

private:
  // The item that makes the first proposal to a point appends the point to the list of the round.
  CGAL_TANDEM_HD void make(std::uint32_t s, std::uint32_t i) const
  {
    if(!fits(plane[s], cloud.point[i], tolerance))
      return;
    const std::int64_t e = signed_distance(plane[s], cloud.point[i]);
    const std::uint64_t distance = std::uint64_t(e < 0 ? -e : e) >> 16; // 2^-12 steps: < 2^24, as epsilon < 2^11 steps
    if(Backend::atomic_min(proposal[i], distance << 32 | s) == no_proposal)
      proposed[Backend::atomic_add(*end, 1u)] = i;
  }
};

// Later rounds: new proposals can come only from points that were labeled in the round before. Lanes share
// their rows, because the host does not know how many there are.
template <class Backend>
struct Propose_again {
  Propose_label<Backend> proposal;
  Proposed_points accepted; // the points that the last round labeled
  std::size_t lanes;        // number of items of the loop

  CGAL_TANDEM_HD void operator()(std::size_t lane) const
  {
    const std::size_t first = accepted.end[0], size = accepted.end[1] - first, k = std::size_t(proposal.cloud.k);
    for_items_of_lane(lane, lanes, size * k, [&](std::size_t at) {
      const std::uint32_t p = accepted.point[first + at / k], q = proposal.cloud.row(p)[at % k];
      if(q != no_index)
        proposal.to(q, proposal.label[p]);
    });
  }
};

// No point has a proposal.
struct Clear_proposals {
  std::uint64_t* proposal;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { proposal[i] = no_proposal; }
};

// Each point of a round takes the shape of its best proposal. Points are listed once, so no two items write the same
// one. The list of the next round begins empty, where this one ends.
struct Accept_proposals {
  Labels_view labels;
  std::uint64_t* proposal;
  Proposed_points proposed;
  std::size_t lanes; // number of items of the loop

  CGAL_TANDEM_HD void operator()(std::size_t lane) const
  {
    const std::size_t first = proposed.end[0], last = proposed.end[1];
    if(lane == 0)
      proposed.end[2] = proposed.end[1];
    for_items_of_lane(lane, lanes, last - first, [&](std::size_t at) {
      const std::uint32_t p = proposed.point[first + at];
      labels.label[p] = std::uint32_t(proposal[p]);
      labels.state[p] &= std::uint8_t(~interior_bit);
      proposal[p] = no_proposal;
    });
  }
};

// A round accepts the proposals to free points; then these points propose their new shapes in turn. All of them must be
// accepted before the first one proposes.
template <class Backend>
struct Label_propagation {
  enum Step { accept, propose, number_of_steps };
  static constexpr int steps = number_of_steps;

  Propose_label<Backend> proposal; // of the first round, which has been executed
  Labels_view labels;
  Proposed_points proposed;
  std::size_t few_points; // a round that labels at most so many points is the last one

  static constexpr std::size_t few(int) { return 4096; }

  // After the first step of the round.
  CGAL_TANDEM_HD bool is_last(std::size_t round) const
  {
    return proposed.end[round + 1] - proposed.end[round] <= few_points;
  }

  CGAL_TANDEM_HD void run(int step, std::size_t round, std::size_t lane, std::size_t lanes) const
  {
    const Proposed_points of_round = {proposed.point, proposed.end + round};
    if(step == accept)
      return Accept_proposals{labels, proposal.proposal, of_round, lanes}(lane);
    Propose_label<Backend> next = proposal;
    next.end = proposed.end + round + 2;
    Propose_again<Backend>{next, of_round, lanes}(lane);
  }
};

// A proposal to a point of another rank.
struct Sent_proposal {
  std::uint64_t value;
  std::uint64_t index; // of a ghost, then of the point there; wide, so that all bytes are defined
};

// The ghosts of a list of points with proposals. Their proposals are taken.
struct Take_sent {
  const std::uint32_t* point;
  std::uint64_t* proposal; // by point
  std::uint32_t first_ghost;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return point[i] >= first_ghost; }

  CGAL_TANDEM_HD Sent_proposal take(std::uint32_t i) const
  {
    const Sent_proposal sent = {proposal[point[i]], point[i]};
    proposal[point[i]] = no_proposal;
    return sent;
  }
};

// The other points of the list.
struct Take_kept {
  const std::uint32_t* point;
  std::uint32_t first_ghost;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return point[i] < first_ghost; }
  CGAL_TANDEM_HD std::uint32_t take(std::uint32_t i) const { return point[i]; }
};

// Makes the proposals that have come, as Propose_label does.
template <class Backend>
struct Receive_proposals {
  const Sent_proposal* received;
  std::uint64_t* proposal; // by point
  std::uint32_t* point;    // of all rounds
  std::uint32_t* end;      // of the list

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t p = std::uint32_t(received[i].index);
    if(Backend::atomic_min(proposal[p], received[i].value) == no_proposal)
      point[Backend::atomic_add(*end, 1u)] = p;
  }
};

// Takes the ghosts from the list of points with proposals between end[0] and end[1], and adds own points that other
// ranks have proposed to.
template <class Backend>
void send_proposals(Labeled_cloud<Backend>& points, const Label_propagation<Backend>& rounds, std::uint32_t* end)
{
  Backend& backend = points.backend;
  const std::vector<std::uint32_t> ends = to_vector(backend, end, 2);
  const std::size_t size = ends[1] - ends[0];
  const std::uint32_t first_ghost = std::uint32_t(points.cloud.size());
  std::uint32_t* const point = rounds.proposed.point + ends[0];
  std::uint64_t* const proposal = rounds.proposal.proposal;
  const auto sent = backend.template collect<Sent_proposal>(size, Take_sent{point, proposal, first_ghost});
  if(sent.size() > 0) {
    const auto kept = backend.template collect<std::uint32_t>(size, Take_kept{point, first_ghost});
    backend.for_each(kept.size(), Copy_items<std::uint32_t>{kept.data(), point});
    write_to(backend, std::vector<std::uint32_t>{ends[0] + std::uint32_t(kept.size())}, end + 1);
  }
  const auto received = to_buffer(backend, points.ranks.to_owners(to_vector(backend, sent)));
  backend.for_each(received.size(),
                   Receive_proposals<Backend>{received.data(), proposal, rounds.proposed.point, end + 1});
}

// The rounds of many ranks. Proposals to ghosts go to the ranks of the points, and labels come back.
template <class Backend>
void run_joint_propagation(Labeled_cloud<Backend>& points, std::size_t maximum_rounds,
                           const Label_propagation<Backend>& rounds)
{
  std::uint32_t* const end = rounds.proposed.end;
  send_proposals(points, rounds, end);
  run_joint_rounds(points.backend, maximum_rounds, points.cloud.size(), rounds, [&](int step, std::size_t round) {
    if(step == Label_propagation<Backend>::propose) {
      send_proposals(points, rounds, end + round + 1);
      return false;
    }
    points.refresh_labels();
    const std::vector<std::uint32_t> of_round = to_vector(points.backend, end + round, 2);
    return points.ranks.total(std::size_t(of_round[1] - of_round[0])) <= rounds.few_points;
  });
}

// Labels free points until a round labels hardly any, or after a number of rounds. Proposals that are still open then
// are dropped. Moments do not follow.
template <class Backend>
void propagate_labels(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Tolerance& tolerance,
                      Phase phase)
{
  constexpr std::size_t maximum_rounds = tuning::end_game::propagation_rounds;
  Backend& backend = points.backend;
  const std::size_t n = points.cloud.size(), few = points.total_points() / tuning::end_game::points_per_late_point;
  const std::size_t with_ghosts = points.cloud.size_with_ghosts();
  typename Backend::template Buffer<std::uint64_t> proposal(with_ghosts);
  typename Backend::template Buffer<std::uint32_t> proposed(with_ghosts);
  auto end = filled_buffer(backend, maximum_rounds + 2, std::uint32_t(0));
  backend.for_each(with_ghosts, Clear_proposals{proposal.data()});
  const std::uint8_t* const state = states_of(points, phase);
  const Labels_view labels = points.change_labels(false);
  shapes.lose_moments();
  const Propose_label<Backend> first = {points.cloud.view(), labels.label, state,           shapes.plane.data(),
                                        proposal.data(),     tolerance,    proposed.data(), end.data() + 1};
  backend.for_each(n, first);
  const Label_propagation<Backend> rounds = {first, labels, {proposed.data(), end.data()}, few};
  if constexpr(Ranks<Backend>::are_many)
    run_joint_propagation(points, maximum_rounds, rounds);
  else
    backend.run_rounds(maximum_rounds, n, rounds);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_PROPAGATE_LABELS_H
