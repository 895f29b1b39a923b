// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What connects the ranks: the operations of backend/Ranks.h for many processes. Each is called by all ranks, at the
// same place of the method, except those without a message: own_items(), ghosts() and number(). See the manual, "Many
// Machines".

#ifndef CGAL_TANDEM_INTERNAL_MPI_MPI_RANKS_H
#define CGAL_TANDEM_INTERNAL_MPI_MPI_RANKS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/mpi/Mpi_backend.h>
#include <CGAL/Tandem/internal/mpi/neighbors/Ghosts.h>

#include <memory>

namespace CGAL::Tandem::internal {

template <class Local>
class Ranks<Mpi_backend<Local>> {
  using Backend = Mpi_backend<Local>;

public:
  static constexpr bool are_many = true;

  explicit Ranks(Backend& backend) : backend_(&backend) {}

  Own_items own_items() const { return {std::uint32_t(communicator().rank()), std::uint32_t(communicator().size())}; }

  template <class F>
  auto together(F f) const
  {
    return communicator().together(f);
  }

  std::size_t total(std::size_t own) const { return std::size_t(communicator().sum(std::uint64_t(own))); }
  std::vector<std::uint64_t> total(std::vector<std::uint64_t> own) const
  {
    communicator().sum(own.data(), own.size());
    return own;
  }

  template <class T>
  void sum(T* table, std::size_t n) const
  {
    Host_view<Backend, T> view(*backend_, table, n);
    communicator().sum(view.data(), n);
    view.write_back();
  }

  template <class T>
  std::vector<T> gather(const std::vector<T>& own, std::vector<std::size_t>* first = nullptr) const
  {
    return communicator().gather(own, first);
  }

  // Rows are completed on the host.
  template <class Cloud>
  void connect(Cloud& cloud, int rings)
  {
    const std::uint32_t n = std::uint32_t(cloud.number_of_surfels());
    std::vector<Remote_entry> remote;
    {
      const Host_view<Backend, const Grid_point> point(*backend_, cloud.point.data(), n);
      Host_view<Backend, std::uint32_t> rows(*backend_, cloud.neighbor.data(), std::size_t(n) * std::size_t(cloud.k));
      remote = Border_search<Search_host<Local>>(communicator(), point.data(), n, cloud.k, rows.data())();
      rows.write_back();
    }
    add_ghosts(cloud, rings, remote);
  }

  template <class Cloud>
  void connect_again(Cloud& cloud, const std::vector<std::uint64_t>& added)
  {
    const std::uint32_t n = std::uint32_t(cloud.number_of_surfels()), present = n + std::uint32_t(cloud.ghosts);
    std::vector<Remote_entry> remote;
    {
      const std::size_t entries = std::size_t(n) * std::size_t(cloud.k);
      const Host_view<Backend, const std::uint32_t> rows(*backend_, cloud.neighbor.data(), entries);
      for(std::size_t e = 0; e < entries; ++e)
        if(const std::uint32_t place = rows.data()[e]; place >= n && place != no_index)
          remote.push_back({e, place < present ? ghosts_->point_at(place) : rank_point(added[place - present])});
    }
    add_ghosts(cloud, int(ghosts_->rings()), remote);
  }

  std::size_t ghosts(Rings rings) const { return rings == Rings::all ? ghosts_->size() : ghosts_->ring_size(0); }

  std::uint64_t number(std::uint32_t place) const
  {
    const Rank_point p = ghosts_->point_at(place);
    return std::uint64_t(p.rank) << 32 | p.index;
  }

  std::uint32_t place_of(std::uint64_t number) const { return ghosts_->place_of(rank_point(number)); }

  template <class T>
  void refresh(T* table, Rings rings) const
  {
    for(std::size_t ring = 0; ring < (rings == Rings::all ? ghosts_->rings() : 1); ++ring)
      ghosts_->update(ring, table);
  }

  template <class T, class Sent>
  void refresh(T* table, Sent& sent) const
  {
    ghosts_->update_changed(table, sent);
  }

  template <class T>
  std::vector<T> to_owners(const std::vector<T>& items) const
  {
    std::vector<std::vector<T>> by_rank(std::size_t(communicator().size()));
    for(T item : items) {
      const Rank_point owner = ghosts_->point_at(std::uint32_t(item.index));
      item.index = owner.index;
      by_rank[owner.rank].push_back(item);
    }
    std::vector<T> received;
    for(const std::vector<T>& from : communicator().exchange(by_rank))
      received.insert(received.end(), from.begin(), from.end());
    return received;
  }

private:
  static Rank_point rank_point(std::uint64_t number) { return {std::uint32_t(number >> 32), std::uint32_t(number)}; }

  // The ghosts are those of these entries, which are undefined so far.
  template <class Cloud>
  void add_ghosts(Cloud& cloud, int rings, const std::vector<Remote_entry>& remote)
  {
    const std::uint32_t n = std::uint32_t(cloud.number_of_surfels());
    const std::size_t entries = std::size_t(n) * std::size_t(cloud.k);
    ghosts_ = std::make_shared<Ghosts<Backend>>(*backend_, n);
    ghosts_->add_ring(points_of(remote));
    std::vector<std::uint32_t> ghost_rows;
    {
      Host_view<Backend, std::uint32_t> rows(*backend_, cloud.neighbor.data(), entries);
      for(const Remote_entry& e : remote)
        rows.data()[e.entry] = ghosts_->place_of(e.point);
      for(int ring = 1; ring < rings; ++ring)
        ghosts_->add_next_ring(rows.data(), std::size_t(cloud.k), ghost_rows);
      rows.write_back();
    }
    if(!ghost_rows.empty() || cloud.neighbor.size() > entries) {
      cloud.neighbor = resized<std::uint32_t>(*backend_, cloud.neighbor, entries, entries + ghost_rows.size());
      write_to(*backend_, ghost_rows, cloud.neighbor.data() + entries);
    }
    cloud.first = first_position(n);
    cloud.first_of_points = first_position(std::uint32_t(cloud.number_of_points()));
    cloud.ghosts = ghosts_->size();
    cloud.point = resized<Grid_point>(*backend_, cloud.point, n, n + cloud.ghosts);
    refresh(cloud.point.data(), Rings::all);
    if(cloud.has_levels) {
      cloud.level = resized<std::uint8_t>(*backend_, cloud.level, n, n + cloud.ghosts);
      refresh(cloud.level.data(), Rings::all);
    }
  }

  Communicator& communicator() const { return backend_->communicator(); }

  std::uint32_t first_position(std::uint32_t n) const
  {
    std::uint64_t first = 0;
    const std::vector<std::uint64_t> sizes = communicator().gather(std::vector<std::uint64_t>{n});
    for(int r = 0; r < communicator().rank(); ++r)
      first += sizes[std::size_t(r)];
    return std::uint32_t(first);
  }

  Backend* backend_;
  std::shared_ptr<Ghosts<Backend>> ghosts_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_MPI_MPI_RANKS_H
