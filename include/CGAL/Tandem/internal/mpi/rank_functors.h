// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loops over the tables of a rank before it sends, and after it has received: for Mpi_ranks.h. They run where the
// tables are.

#ifndef CGAL_TANDEM_INTERNAL_MPI_RANK_FUNCTORS_H
#define CGAL_TANDEM_INTERNAL_MPI_RANK_FUNCTORS_H

#include <CGAL/Tandem/internal/finish/propagate_labels.h>
#include <CGAL/Tandem/internal/rounds/Mutual_unions.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>

#include <algorithm>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class T>
struct Copy_items {
  const T* source;
  T* target;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { target[i] = source[i]; }
};

template <class Table>
struct Copy_keys {
  Table sorted;
  std::uint64_t* key;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { key[i] = sorted.key(i); }
};

// What a rank has added to a shape.
struct Shape_moments {
  std::uint64_t id;
  Shared_moments moments;
};

// The sums that are not zero; they are zero afterwards.
struct Take_moments {
  Shared_moments* sum; // by id

  CGAL_TANDEM_HD bool has(std::uint32_t id) const { return is_any(sum[id]); }

  CGAL_TANDEM_HD Shape_moments take(std::uint32_t id) const
  {
    const Shape_moments taken = {id, sum[id]};
    sum[id] = Shared_moments();
    return taken;
  }
};

template <class Backend>
struct Add_moments {
  const Shape_moments* added;
  Shared_moments* sum; // by id

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const Shared_moments& m = added[i].moments;
    atomic_add<Backend>(sum[added[i].id], m.moments(), m.box);
  }
};

// The sums of the shapes that have started on this rank.
struct Get_started {
  const std::uint32_t* started;
  const Shared_moments* sum; // by id, from the first new one on
  Shared_moments* value;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { value[i] = sum[started[i]]; }
};

// What a point has adopted: a candidate, and the point whose candidate it is.
template <class Candidate>
struct Adopted_values {
  struct Value {
    Candidate candidate;
    Grid_point point;
  };

  Candidate* candidate;
  Grid_point* point;
  std::uint32_t* source;
  std::uint32_t first_ghost, first_slot; // of the pass

  CGAL_TANDEM_HD Value value(std::uint32_t i) const { return {candidate[source[i]], point[source[i]]}; }

  CGAL_TANDEM_HD void take(std::uint32_t place, const Value& v) const
  {
    const std::uint32_t slot = first_slot + place - first_ghost;
    candidate[slot] = v.candidate;
    point[slot] = v.point;
    source[place] = slot;
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

// A lane of a step of rounds.
template <class Rounds>
struct Run_step {
  Rounds rounds;
  int step;
  std::size_t round, lanes;

  CGAL_TANDEM_HD void operator()(std::size_t lane) const { rounds.run(step, round, lane, lanes); }
};

// One step of rounds that exchange something between their steps.
template <class Backend, class Rounds>
void run_step(Backend& backend, const Rounds& rounds, int step, std::size_t round, std::size_t n)
{
  const std::size_t lanes = (std::max)((std::min)(n, std::size_t(4096)), std::size_t(1));
  backend.for_each(lanes, Run_step<Rounds>{rounds, step, round, lanes}, n < Rounds::few(step) ? lanes : lanes / 64 + 1);
}

template <class Rounds>
struct Is_last {
  Rounds rounds;
  std::size_t round;

  CGAL_TANDEM_HD void operator()(std::size_t, std::int64_t* sum) const { sum[0] += rounds.is_last(round); }
};

// The fits of a table of moments: the own share, then those of all ranks. The scatter costs less than to send it.
template <class Fits>
struct Make_fit {
  Fits fits;
  Own_share own;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(!fits.has(i))
      return;
    fits[i].scatter = make_scatter(fits[i].moments);
    if(own.has(i))
      fits[i].fit = fit_plane(fits[i].scatter);
  }
};

struct Numbered_fit {
  std::uint64_t number; // wide, so that all bytes are defined
  Fit fit;
};

template <class Fits>
struct Take_fit {
  Fits fits;
  Own_share own;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return own.has(i) && fits.has(i); }
  CGAL_TANDEM_HD Numbered_fit take(std::uint32_t i) const { return {i, fits[i].fit}; }
};

template <class Fits>
struct Put_fit {
  Fits fits;
  const Numbered_fit* of_all;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::size_t number = std::size_t(of_all[i].number);
    set_fit(fits[number], of_all[i].fit);
    fits.set_made(number);
  }
};

// The unions that have changed in a round.
template <class Rounds>
struct Union_fits {
  Rounds rounds;
  std::int32_t round;

  CGAL_TANDEM_HD bool has(std::size_t s) const { return rounds.root[s].changed == round; }
  CGAL_TANDEM_HD Fitted_moments& operator[](std::size_t s) const { return rounds.whole[rounds.root[s].place]; }
  CGAL_TANDEM_HD void set_made(std::size_t) const {}
};

// What the tests of a round of unions say. A pair that is not among these has been rejected.
struct Accepted_pair {
  std::uint32_t pair;
  std::int32_t is_taken;
  std::uint64_t cost;
};

template <class Rounds>
struct Take_accepted {
  Rounds rounds;
  std::int32_t round;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const
  {
    return rounds.own.has(i) && rounds.pair[i].tested == round && rounds.pair[i].is_accepted();
  }
  CGAL_TANDEM_HD Accepted_pair take(std::uint32_t i) const
  {
    return {i, rounds.pair[i].is_taken, rounds.pair[i].key.cost};
  }
};

template <class Rounds>
struct Put_accepted {
  Rounds rounds;
  const Accepted_pair* accepted;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const Accepted_pair& a = accepted[i];
    rounds.pair[a.pair].is_taken = a.is_taken;
    rounds.pair[a.pair].key.cost = a.cost;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_RANK_FUNCTORS_H
