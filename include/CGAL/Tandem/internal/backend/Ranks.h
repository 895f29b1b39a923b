// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the part of the cloud in this process, a rank, is connected with the parts of other ranks. Each rank has
// consecutive cells of the sorted cloud. Rows of neighbors also refer to surfels of other ranks: the ghosts, which
// follow the own surfels in tables of surfels. The table of shapes is the same on all ranks. So after a pass over the
// surfels, its sums by shape are added up, and labels of ghosts are renewed. Loops over shapes need nothing, but each
// rank makes its own items of the tests and fits.
//
// Here there is one process, and nothing to do. mpi/Mpi_ranks.h has the same operations for many.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_RANKS_H
#define CGAL_TANDEM_INTERNAL_BACKEND_RANKS_H

#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/backend/buffers.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Tables of the back end as MPI needs them: on the host.

// The first n items of a table: itself where it is memory of the host, otherwise a copy.
template <class Backend, class T>
class Host_view {
  static constexpr bool is_host = std::is_base_of<Host_memory, Backend>::value;

public:
  Host_view(Backend& backend, T* table, std::size_t n) : backend_(backend), table_(table)
  {
    if(!is_host)
      copy_ = to_vector(backend, table, n);
  }

  T* data() { return is_host ? table_ : copy_.data(); }
  const T* data() const { return is_host ? table_ : copy_.data(); }

  // The table becomes what the view is.
  void write_back()
  {
    if constexpr(!is_host)
      write_to(backend_, copy_, table_);
  }

private:
  Backend& backend_;
  T* table_;
  std::vector<typename std::remove_const<T>::type> copy_;
};

// --- The ranks themselves.

// The items of a table that all ranks have, of which this rank does the work.
struct Own_items {
  std::uint32_t rank = 0, ranks = 1;

  CGAL_TANDEM_HD bool has(std::size_t i) const { return i % ranks == rank; }
};

// The ghosts of one or several steps from neighbor to neighbor. The inner ones, which are in rows of own surfels, come
// first in tables of surfels.
enum class Rings { inner, all };

template <class Backend>
class Ranks {
public:
  static constexpr bool are_many = false;

  explicit Ranks(Backend&) {}

  Own_items own_items() const { return {}; }

  template <class F>
  auto together(F f) const
  {
    return f();
  }

  template <class T>
  T total(T own) const
  {
    return own;
  }

  template <class T>
  void sum(T*, std::size_t) const
  {}

  template <class T>
  std::vector<T> gather(std::vector<T> own, std::vector<std::size_t>* first = nullptr) const
  {
    if(first != nullptr)
      *first = {0, own.size()};
    return own;
  }

  template <class Cloud>
  void connect(Cloud&, int) const
  {}

  // After rows have changed: entries beyond the ghosts are the surfels with these numbers.
  template <class Cloud>
  void connect_again(Cloud&, const std::vector<std::uint64_t>&) const
  {}

  std::size_t ghosts(Rings) const { return 0; }
  std::uint64_t number(std::uint32_t place) const { return place; }

  template <class T>
  void refresh(T*, Rings) const
  {}
  template <class T, class Sent>
  void refresh(T*, Sent&) const
  {}

  template <class T>
  std::vector<T> to_owners(std::vector<T> items) const
  {
    return items;
  }
};

// --- What stages make of these operations.

// f.take(i) of the i in [0, n) with f.has(i), of all ranks.
template <class T, class Backend, class F>
Buffer_of<Backend, T> collect_of_all(Backend& backend, const Ranks<Backend>& ranks, std::size_t n, F f)
{
  auto own = backend.template collect<T>(n, f);
  if constexpr(Ranks<Backend>::are_many)
    return to_buffer(backend, ranks.gather(to_vector(backend, own)));
  else
    return own;
}

// A lane of a step of rounds.
template <class Rounds>
struct Run_step {
  Rounds rounds;
  int step;
  std::size_t round, lanes;

  CGAL_TANDEM_HD void operator()(std::size_t lane) const { rounds.run(step, round, lane, lanes); }
};

// backend.run_rounds() of many ranks, which exchange something after some steps: exchange(step, round), on the host. It
// returns whether the round is the last one.
template <class Backend, class Rounds, class Exchange>
void run_joint_rounds(Backend& backend, std::size_t maximum_rounds, std::size_t n, const Rounds& rounds,
                      Exchange exchange)
{
  const std::size_t lanes = ((std::min)(n, std::size_t(4096)) / 32 + 1) * 32; // in whole groups: see Lane_group
  for(std::size_t round = 0; round < maximum_rounds; ++round)
    for(int step = 0; step < Rounds::steps; ++step) {
      backend.for_each(lanes, Run_step<Rounds>{rounds, step, round, lanes},
                       n < Rounds::few(step) ? lanes : lanes / 64 + 1);
      if(exchange(step, round))
        return;
    }
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BACKEND_RANKS_H
