// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the part of the cloud in this process, a rank, is connected with the parts of other ranks. Each rank has
// consecutive cells of the sorted cloud. Rows of neighbors also refer to points of other ranks: the ghosts, which follow
// the own points in tables of points. The table of shapes is the same on all ranks. So after a pass over the points,
// its sums by shape are added up, and labels of ghosts are renewed. Loops over shapes need nothing, but each rank makes
// a share of the tests and fits.
//
// Here there is one process, and nothing to do. mpi/Mpi_ranks.h has the same members for many.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_RANKS_H
#define CGAL_TANDEM_INTERNAL_BACKEND_RANKS_H

#include <CGAL/Tandem/internal/base/types.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The items of a table that all ranks have, of which this rank does the work.
struct Own_share {
  std::uint32_t rank = 0, ranks = 1;

  CGAL_TANDEM_HD bool has(std::size_t i) const { return i % ranks == rank; }
};

template <class Backend>
class Ranks {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  static constexpr bool are_many = false;
  // Components that lie on several ranks.
  struct Seams {};

  Ranks() = default;
  explicit Ranks(Backend&) {}

  // Sums over all ranks: of numbers that each has, and of each entry of a table.
  std::size_t total(std::size_t own) const { return own; }
  template <class T>
  void sum(T*, std::size_t) const
  {}

  // f() on each rank. Where it throws, all ranks throw the same exception, instead of waiting for each other.
  template <class F>
  static auto together(Backend&, F f)
  {
    return f();
  }

  // Throws on all ranks unless they have the same parameters.
  template <class Parameters>
  static void check_same(Backend&, const Parameters&)
  {}

  // The callback that calls those of all ranks.
  template <class Callback>
  static Callback joined(Backend&, Callback callback)
  {
    return callback;
  }

  // Box and counts become those of all ranks. All of them have normals, or none.
  template <class Import>
  void join_imports(Import&) const
  {}

  // Whether all ranks say so. If not, `why` becomes that of the first one that does not.
  bool all(bool own, std::string&) const { return own; }

  // Whether all ranks have the same number.
  bool are_same(std::uint64_t) const { return true; }

  // Finds the ghosts. `rings`: how many steps from neighbor to neighbor lead to them; all but those of the last ring
  // have rows, too.
  template <class Points>
  void connect(Points&, int) const
  {}

  // The entries of the ghosts in a table of points become those of their owners: of the first ring, or of all.
  template <class T>
  void update(T*) const
  {}
  template <class T>
  void update_all(T*) const
  {}

  // The same for the labels of the loop. Those of the first ring are sent only where they have changed.
  void update_labels(std::uint32_t*) const {}
  void update_all_labels(std::uint32_t*) const {}

  // While points adopt candidates of their neighbors: renews what those of ghosts have adopted before the pass.
  template <class Candidate>
  void update_adopted(Candidate*, Grid_point*, std::uint32_t*, int) const
  {}

  // Makes the list of the shapes that have started on this rank, by the number of their id among new ids, that of all
  // ranks. Those of other ranks get ids from `ids` on, with sums. Returns the end of the ids.
  template <class Shapes>
  std::size_t share_started(Shapes&, std::size_t ids, Buffer<std::uint32_t>&) const
  {
    return ids;
  }

  // The rounds of a label propagation, of which the first proposals have been made.
  template <class Propagation>
  void run_propagation(Backend& backend, std::size_t maximum_rounds, std::size_t n, const Propagation& rounds) const
  {
    backend.run_rounds(maximum_rounds, n, rounds);
  }

  // Before fits that all ranks need: each makes its share, and gets the others. fits.has(i): one is to be made for
  // fits[i] of the n moments; fits.set_made(i): it has been made.
  template <class Fits>
  void share_fits(std::size_t, const Fits&) const
  {}

  // The rounds of unions of shapes, see Mutual_unions.h, with the share of the work that is done by this rank.
  Own_share own_share() const { return {}; }
  template <class Rounds>
  void run_unions(Backend& backend, std::size_t maximum_rounds, std::size_t n, const Rounds& rounds) const
  {
    backend.run_rounds(maximum_rounds, n, rounds);
  }

  // Joins the components of points of all ranks. Roots become the smallest position on this rank.
  Seams join_components(const std::uint32_t*, std::uint32_t*) const { return {}; }
  // Sizes, by root, become those of the whole components.
  void sum_sizes(Seams&, std::uint32_t*) const {}
  // The components of the result, of all ranks.
  template <class Component>
  std::vector<Component> join_large(const Seams&, std::vector<Component>&& own) const
  {
    return std::move(own);
  }

  // Of all links of this rank, those of all ranks with so many edges.
  template <class Links>
  Links join_links(Links&& links, std::uint32_t) const
  {
    return std::forward<Links>(links);
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_RANKS_H
