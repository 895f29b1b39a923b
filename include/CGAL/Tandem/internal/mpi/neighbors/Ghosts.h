// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surfels of other ranks that this rank refers to. They follow the own surfels in tables of surfels, ring by ring:
// first the neighbors of own surfels, then those of the first ring, and so on. Within a ring they ascend by rank and
// position.

#ifndef CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_GHOSTS_H
#define CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_GHOSTS_H

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/mpi/neighbors/Border_search.h>

namespace CGAL::Tandem::internal {

// Something else than each of the listed entries.
template <class T>
struct Pack_other {
  const T* table;
  const std::uint32_t* index;
  T* packed;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { packed[i] = T(~table[index[i]]); }
};

template <class T>
struct Sent_entry {
  std::uint32_t place; // in the list of own surfels that are ghosts elsewhere, then among the ghosts from one rank
  T value;
};

// The entries that have changed since they were sent.
template <class T>
struct Take_changed {
  const std::uint32_t* index;
  const T* table;
  T* sent;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return table[index[i]] != sent[i]; }

  CGAL_TANDEM_HD Sent_entry<T> take(std::uint32_t i) const
  {
    sent[i] = table[index[i]];
    return {i, sent[i]};
  }
};

template <class T>
struct Put_entries {
  const Sent_entry<T>* received;
  T* table; // from the first ghost on

  CGAL_TANDEM_HD void operator()(std::size_t i) const { table[received[i].place] = received[i].value; }
};

inline std::vector<Rank_point> points_of(const std::vector<Remote_entry>& entries)
{
  std::vector<Rank_point> points;
  for(const Remote_entry& e : entries)
    points.push_back(e.point);
  return points;
}

// Tables of surfels are where the functors of the back end run; the rest is on the host.
template <class Backend>
class Ghosts {
public:
  // n: number of own surfels.
  Ghosts(Backend& backend, std::uint32_t n) : backend_(backend), communicator_(backend.communicator()), n_(n) {}

  std::size_t rings() const { return ring_.size(); }
  std::size_t size() const { return size_; }
  std::size_t ring_size(std::size_t r) const { return ring_[r].point.size(); }

  // Adds a ring of so far unknown surfels, and tells their owners.
  void add_ring(std::vector<Rank_point> points)
  {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    Ring ring;
    ring.offset = size_;
    size_ += points.size();
    std::vector<std::vector<std::uint32_t>> wanted(std::size_t(communicator_.size()));
    for(const Rank_point& p : points)
      wanted[p.rank].push_back(p.index);
    for(const std::vector<std::uint32_t>& from_rank : wanted)
      ring.imported_from.push_back(from_rank.size());
    ring.point = std::move(points);
    std::vector<std::uint32_t> exported;
    for(const std::vector<std::uint32_t>& by_rank : communicator_.exchange(wanted)) {
      ring.exported_to.push_back(by_rank.size());
      exported.insert(exported.end(), by_rank.begin(), by_rank.end());
    }
    ring.exported = to_buffer(backend_, exported);
    ring_.push_back(std::move(ring));
  }

  // Appends the rows of the last ring, and adds what is unknown in them as the next one. neighbor: the rows of own
  // surfels.
  void add_next_ring(const std::uint32_t* neighbor, std::size_t k, std::vector<std::uint32_t>& rows)
  {
    const std::size_t last = rings() - 1, ghosts = ring_size(last);
    std::vector<Rank_point> points(k * ghosts), unknown;
    for(std::size_t j = 0; j < k; ++j) {
      const std::vector<Rank_point> column = exchange_on_host(last, [&](std::uint32_t i) {
        const std::uint32_t q = neighbor[i * k + j];
        return q == no_index ? Rank_point{no_index, no_index} : point_at(q);
      });
      for(std::size_t g = 0; g < ghosts; ++g)
        points[g * k + j] = column[g];
    }
    for(const Rank_point& p : points)
      if(p.rank != no_index && place_of(p) == no_index)
        unknown.push_back(p);
    add_ring(std::move(unknown));
    for(const Rank_point& p : points)
      rows.push_back(p.rank == no_index ? no_index : place_of(p));
  }

  // The place of a surfel in tables of surfels; no_index if it is neither an own one nor a ghost.
  std::uint32_t place_of(const Rank_point& p) const
  {
    if(int(p.rank) == communicator_.rank())
      return p.index;
    for(const Ring& ring : ring_) {
      const auto it = std::lower_bound(ring.point.begin(), ring.point.end(), p);
      if(it != ring.point.end() && *it == p)
        return n_ + std::uint32_t(ring.offset + std::size_t(it - ring.point.begin()));
    }
    return no_index;
  }

  Rank_point point_at(std::uint32_t place) const
  {
    if(place < n_)
      return {std::uint32_t(communicator_.rank()), place};
    for(const Ring& ring : ring_)
      if(place - n_ < ring.offset + ring.point.size())
        return ring.point[place - n_ - ring.offset];
    return {no_index, no_index};
  }

  // The ghosts of a ring take the entries of their owners.
  template <class T>
  void update(std::size_t r, T* table) const
  {
    const Ring& ring = ring_[r];
    Buffer_of<Backend, T> packed(ring.exported.size());
    backend_.for_each(packed.size(), Gather_items<T>{table, ring.exported.data(), packed.data()});
    // Ranks ascend, as the ghosts of a ring do.
    write_to(backend_, communicator_.exchange(to_vector(backend_, packed), ring.exported_to, ring.imported_from),
             table + n_ + ring.offset);
  }

  // The same for the first ring and a table of integers. What has been sent before is not sent again: `sent` is empty at
  // first, and nobody else changes entries of ghosts.
  template <class T>
  void update_changed(T* table, Buffer_of<Backend, T>& sent) const
  {
    using Entries = std::vector<Sent_entry<T>>;
    const Ring& ring = ring_[0];
    const std::uint32_t* const index = ring.exported.data();
    if(sent.size() != ring.exported.size()) {
      sent.reset(ring.exported.size());
      backend_.for_each(sent.size(), Pack_other<T>{table, index, sent.data()});
    }
    Entries changed = to_vector(
      backend_, backend_.template collect<Sent_entry<T>>(sent.size(), Take_changed<T>{index, table, sent.data()}));
    std::vector<std::size_t> sizes, from;
    std::size_t first = 0;
    auto at = changed.begin();
    for(const std::size_t n : ring.exported_to) {
      const auto begin = at;
      for(; at != changed.end() && at->place < first + n; ++at)
        at->place -= std::uint32_t(first);
      sizes.push_back(std::size_t(at - begin));
      first += n;
    }
    Entries received = communicator_.exchange(changed, sizes, &from);
    first = 0;
    at = received.begin();
    for(std::size_t r = 0; r < from.size(); ++r) {
      for(const auto end = at + std::ptrdiff_t(from[r]); at != end; ++at)
        at->place += std::uint32_t(first);
      first += ring.imported_from[r];
    }
    const auto entries = to_buffer(backend_, received);
    backend_.for_each(entries.size(), Put_entries<T>{entries.data(), table + n_});
  }

  // value(i) of their owners on the host, for the ghosts of a ring.
  template <class F>
  auto exchange_on_host(std::size_t r, F value) const
  {
    std::vector<decltype(value(0u))> send;
    for(const std::uint32_t i : to_vector(backend_, ring_[r].exported))
      send.push_back(value(i));
    return communicator_.exchange(send, ring_[r].exported_to, ring_[r].imported_from);
  }

private:
  struct Ring {
    std::vector<Rank_point> point;              // ascending
    Buffer_of<Backend, std::uint32_t> exported; // own surfels that are ghosts of this ring elsewhere
    std::vector<std::size_t> exported_to;       // how many of them on each rank
    std::vector<std::size_t> imported_from;     // how many ghosts of each rank
    std::size_t offset;                         // of the first ghost among all
  };

  Backend& backend_;
  Communicator& communicator_;
  std::uint32_t n_;
  std::size_t size_ = 0;
  std::vector<Ring> ring_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_GHOSTS_H
