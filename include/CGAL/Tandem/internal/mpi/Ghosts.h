// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of other ranks that this rank refers to. They follow the own points in tables of points, ring by ring:
// first the neighbors of own points, then those of the first ring, and so on. Within a ring they ascend by rank and
// position.

#ifndef CGAL_TANDEM_INTERNAL_MPI_GHOSTS_H
#define CGAL_TANDEM_INTERNAL_MPI_GHOSTS_H

#include <CGAL/Tandem/internal/mpi/Border_search.h>

namespace CGAL {
namespace Tandem {
namespace internal {

class Ghosts {
public:
  // n: number of own points.
  Ghosts(Communicator& communicator, std::uint32_t n) : communicator_(communicator), n_(n) {}

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
    ring.point = std::move(points);
    ring.exported = communicator_.exchange(wanted);
    ring_.push_back(std::move(ring));
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

  // value(i) of the owner, for each ghost of a ring: take(place, value).
  template <class T, class Value, class Take>
  void exchange(std::size_t r, Value value, Take take) const
  {
    const Ring& ring = ring_[r];
    std::vector<std::vector<T>> send(ring.exported.size());
    for(std::size_t to = 0; to < send.size(); ++to) {
      send[to].reserve(ring.exported[to].size());
      for(const std::uint32_t i : ring.exported[to])
        send[to].push_back(value(i));
    }
    std::uint32_t place = ring_begin(r);
    for(const std::vector<T>& values : communicator_.exchange(send)) // ranks ascend, as the ghosts of a ring
      for(const T& v : values)
        take(place++, v);
  }

  template <class T>
  void update(std::size_t r, T* table) const
  {
    exchange<T>(
      r, [&](std::uint32_t i) { return table[i]; }, [&](std::uint32_t place, const T& v) { table[place] = v; });
  }

private:
  struct Ring {
    std::vector<Rank_point> point;                    // ascending
    std::vector<std::vector<std::uint32_t>> exported; // by rank: own points that are its ghosts of this ring
    std::size_t offset;                               // of the first ghost among all
  };

  Communicator& communicator_;
  std::uint32_t n_;
  std::size_t size_ = 0;
  std::vector<Ring> ring_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_GHOSTS_H
