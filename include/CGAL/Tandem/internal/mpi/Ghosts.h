// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of other ranks that this rank refers to. They follow the own points in tables of points, ring by ring:
// first the neighbors of own points, then those of the first ring, and so on. Within a ring they ascend by rank and
// position.

#ifndef CGAL_TANDEM_INTERNAL_MPI_GHOSTS_H
#define CGAL_TANDEM_INTERNAL_MPI_GHOSTS_H

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/mpi/Border_search.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// What a table of points sends to ghosts, and how it takes what comes: the value of a point itself.
template <class T>
struct Point_values {
  using Value = T;
  T* table;

  CGAL_TANDEM_HD T value(std::uint32_t i) const { return table[i]; }
  CGAL_TANDEM_HD void take(std::uint32_t place, const T& v) const { table[place] = v; }
};

template <class Values>
struct Pack_values {
  Values values;
  const std::uint32_t* index;
  typename Values::Value* packed;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { packed[i] = values.value(index[i]); }
};

template <class Values>
struct Unpack_values {
  Values values;
  std::uint32_t first; // place of the first ghost
  const typename Values::Value* packed;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { values.take(first + std::uint32_t(i), packed[i]); }
};

struct Sent_label {
  std::uint32_t place; // in the list of own points that are ghosts elsewhere, then among the ghosts from one rank
  std::uint32_t label;
};

// The labels that have changed since they were sent.
struct Take_changed {
  const std::uint32_t* index;
  const std::uint32_t* label;
  std::uint32_t* sent;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return label[index[i]] != sent[i]; }

  CGAL_TANDEM_HD Sent_label take(std::uint32_t i) const
  {
    sent[i] = label[index[i]];
    return {i, sent[i]};
  }
};

struct Put_labels {
  const Sent_label* received;
  std::uint32_t* label; // of the first ghost

  CGAL_TANDEM_HD void operator()(std::size_t i) const { label[received[i].place] = received[i].label; }
};

inline std::vector<Rank_point> points_of(const std::vector<Remote_entry>& entries)
{
  std::vector<Rank_point> points;
  for(const Remote_entry& e : entries)
    points.push_back(e.point);
  return points;
}

// Tables of points are where the functors of the back end run; the rest is on the host.
template <class Backend>
class Ghosts {
public:
  // n: number of own points.
  Ghosts(Backend& backend, std::uint32_t n) : backend_(backend), communicator_(backend.communicator()), n_(n) {}

  std::size_t rings() const { return ring_.size(); }
  std::size_t size() const { return size_; }
  std::size_t ring_size(std::size_t r) const { return ring_[r].point.size(); }
  std::uint32_t own_size() const { return n_; }

  // The place of the first ghost of a ring in tables of points.
  std::uint32_t ring_begin(std::size_t r) const { return n_ + std::uint32_t(ring_[r].offset); }

  // Adds a ring of so far unknown points, and tells their owners.
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

  // Appends the rows of the last ring, and adds what is unknown in them as the next one. neighbor: the rows of own points.
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

  // The place of a point in tables of points; no_index if it is neither an own one nor a ghost.
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

  // The ghosts of a ring take the values of their owners.
  template <class Values>
  void exchange(std::size_t r, const Values& values) const
  {
    using T = typename Values::Value;
    const Ring& ring = ring_[r];
    typename Backend::template Buffer<T> packed(ring.exported.size());
    backend_.for_each(packed.size(), Pack_values<Values>{values, ring.exported.data(), packed.data()});
    // Ranks ascend, as the ghosts of a ring do.
    const auto received =
      to_buffer(backend_, communicator_.exchange(to_vector(backend_, packed), ring.exported_to, ring.imported_from));
    backend_.for_each(received.size(), Unpack_values<Values>{values, ring_begin(r), received.data()});
  }

  // The labels of the first ring, which are free at first. Nobody else changes labels of ghosts.
  void update_labels(std::uint32_t* label)
  {
    const Ring& ring = ring_[0];
    if(sent_.size() < ring.exported.size())
      sent_ = filled_buffer(backend_, ring.exported.size(), std::uint32_t(free_label));
    std::vector<Sent_label> sent = to_vector(
      backend_,
      backend_.template collect<Sent_label>(sent_.size(), Take_changed{ring.exported.data(), label, sent_.data()}));
    std::vector<std::size_t> sizes;
    std::size_t first = 0;
    auto at = sent.begin();
    for(const std::size_t n : ring.exported_to) {
      const auto begin = at;
      for(; at != sent.end() && at->place < first + n; ++at)
        at->place -= std::uint32_t(first);
      sizes.push_back(std::size_t(at - begin));
      first += n;
    }
    std::vector<std::size_t> from;
    std::vector<Sent_label> received = communicator_.exchange(sent, sizes, &from);
    first = 0;
    at = received.begin();
    for(std::size_t r = 0; r < from.size(); ++r) {
      for(const auto end = at + std::ptrdiff_t(from[r]); at != end; ++at)
        at->place += std::uint32_t(first);
      first += ring.imported_from[r];
    }
    const auto labels = to_buffer(backend_, received);
    backend_.for_each(labels.size(), Put_labels{labels.data(), label + ring_begin(0)});
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

  template <class T>
  void update(std::size_t r, T* table) const
  {
    exchange(r, Point_values<T>{table});
  }

private:
  struct Ring {
    std::vector<Rank_point> point;                             // ascending
    typename Backend::template Buffer<std::uint32_t> exported; // own points that are ghosts of this ring elsewhere
    std::vector<std::size_t> exported_to;                      // how many of them on each rank
    std::vector<std::size_t> imported_from;                    // how many ghosts of each rank
    std::size_t offset;                                        // of the first ghost among all
  };

  Backend& backend_;
  Communicator& communicator_;
  std::uint32_t n_;
  std::size_t size_ = 0;
  std::vector<Ring> ring_;
  typename Backend::template Buffer<std::uint32_t> sent_; // the labels of the own points in the first ring elsewhere
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_GHOSTS_H
