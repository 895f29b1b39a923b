// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What connects the ranks: the members of backend/Ranks.h for many processes. Each is called by all ranks, at the same
// place of the method. See the manual, "Many Machines".

#ifndef CGAL_TANDEM_INTERNAL_MPI_MPI_RANKS_H
#define CGAL_TANDEM_INTERNAL_MPI_MPI_RANKS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/base/tuning/normals.h>
#include <CGAL/Tandem/internal/finish/clutter.h>
#include <CGAL/Tandem/internal/mpi/Ghosts.h>
#include <CGAL/Tandem/internal/mpi/Host_view.h>
#include <CGAL/Tandem/internal/mpi/Rank_propagation.h>
#include <CGAL/Tandem/internal/mpi/Seams.h>
#include <CGAL/Tandem/internal/mpi/gather_links.h>
#include <CGAL/Tandem/internal/mpi/octants.h>
#include <CGAL/Tandem/internal/mpi/rank_functors.h>
#include <CGAL/Tandem/internal/mpi/same_parameters.h>
#include <CGAL/Tandem/internal/mpi/sample_cells.h>

#include <memory>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class Local>
class Ranks<Mpi_backend<Local>> {
  using Backend = Mpi_backend<Local>;
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  static constexpr bool are_many = true;
  using Seams = internal::Seams;

  explicit Ranks(Backend& backend) : backend_(&backend) {}

  template <class F>
  static auto together(Backend& backend, F f)
  {
    return backend.communicator().together(f);
  }

  static void check_same(Backend& backend, const Parameters& parameters)
  {
    check_same_parameters(backend.communicator(), parameters);
  }

  // Ranks without a callback agree with the others.
  template <class Callback>
  static Callback joined(Backend& backend, Callback callback)
  {
    return [&backend, callback](double share) {
      int goes_on = !callback || callback(share);
      backend.communicator().minimize(&goes_on, 1);
      return goes_on != 0;
    };
  }

  template <class Import>
  void join_imports(Import& in) const
  {
    communicator().minimize(in.box.low, 3);
    communicator().maximize(in.box.high, 3);
    std::uint64_t counts[4] = {in.total.points, in.total.items, in.total.ignored_coordinates, in.total.ignored_normals};
    communicator().sum(counts, 4);
    in.total = {counts[0], counts[1], counts[2], counts[3]};
    // Ranks without points follow the others: an empty point set may have no normals.
    int given[2] = {in.size() > 0 && in.has_normals, in.size() > 0 && !in.has_normals};
    communicator().maximize(given, 2);
    if(given[0] && given[1])
      throw std::invalid_argument("normal_map is given on some ranks only");
    in.has_normals = given[0] || (in.has_normals && !given[1]);
  }

  bool are_same(std::uint64_t own) const
  {
    std::uint64_t range[2] = {own, ~own}; // the complement of the largest is the smallest complement
    communicator().minimize(range, 2);
    return range[0] == ~range[1];
  }

  bool all(bool own, std::string& why) const { return communicator().all(own, why); }

  std::vector<Grid_point> sample_cells(const Host_buffer<Grid_point>& point) const
  {
    return internal::sample_cells(*backend_, point);
  }

  // The own cells: leaves of the octree are on one rank.
  std::vector<Range> split_cells(const typename Backend::Sort_table& sorted, const Code_frame& frame,
                                 std::size_t cell_size) const
  {
    Buffer<std::uint64_t> keys(sorted.size());
    backend_->for_each(keys.size(), Copy_keys<typename Backend::Sort_table::View>{sorted.view(), keys.data()});
    const Host_view<Backend, const std::uint64_t> key(*backend_, keys.data(), keys.size());
    std::vector<Range> cells;
    for(const Octant& leaf : find_leaves(
          communicator(), keys.size(), [&](std::uint32_t i) { return key.data()[i]; }, frame, cell_size))
      append_cells(leaf.own, cell_size, cells);
    return cells;
  }

  std::size_t total(std::size_t own) const { return std::size_t(communicator().sum(std::uint64_t(own))); }

  template <class T>
  void sum(T* table, std::size_t n) const
  {
    Host_view<Backend, T> view(*backend_, table, n);
    communicator().sum(view.data(), n);
    view.write_back();
  }

  void sum(Neighbor_counts* table, std::size_t n) const
  {
    static_assert(sizeof(Neighbor_counts) == 3 * sizeof(std::uint64_t), "three numbers");
    sum(reinterpret_cast<std::uint64_t*>(table), 3 * n);
  }

  // Each rank has changed few shapes.
  void sum(Shared_moments* table, std::size_t n) const
  {
    const auto all = of_all<Shape_moments>(n, Take_moments{table});
    backend_->for_each(all.size(), Add_moments<Backend>{all.data(), table});
  }

  // Rows are completed on the host.
  template <class Points>
  void connect(Points& points, int rings)
  {
    auto& cloud = points.cloud;
    const std::uint32_t n = std::uint32_t(cloud.size());
    ghosts_ = std::make_shared<Ghosts<Backend>>(*backend_, n);
    std::vector<std::uint32_t> ghost_rows;
    {
      const Host_view<Backend, const Grid_point> point(*backend_, cloud.point.data(), n);
      Host_view<Backend, std::uint32_t> rows(*backend_, cloud.neighbor.data(), cloud.neighbor.size());
      const std::vector<Remote_entry> remote =
        Border_search<Search_host<Local>>(communicator(), point.data(), n, cloud.k, rows.data())();
      ghosts_->add_ring(points_of(remote));
      for(const Remote_entry& e : remote)
        rows.data()[e.entry] = ghosts_->place_of(e.point);
      for(int ring = 1; ring < rings; ++ring)
        ghosts_->add_next_ring(rows.data(), std::size_t(cloud.k), ghost_rows);
      rows.write_back();
    }
    if(!ghost_rows.empty()) {
      const std::size_t own = cloud.neighbor.size();
      cloud.neighbor = extended(std::move(cloud.neighbor), own + ghost_rows.size());
      write_to(*backend_, ghost_rows, cloud.neighbor.data() + own);
    }
    // While normals are estimated, ghosts adopt planes of points that are no ghosts: one for each of the passes.
    const std::size_t passes = rings > 1 ? std::size_t(tuning::normals::adoption_passes) + 1 : 0;
    cloud.ghosts = ghosts_->size() + passes * ghosts_->ring_size(0);
    cloud.first = first_position(n);
    cloud.point = extended(std::move(cloud.point), n + cloud.ghosts);
    update_all(cloud.point.data());
  }

  template <class T>
  void update(T* table) const
  {
    ghosts_->update(0, table);
  }

  template <class T>
  void update_all(T* table) const
  {
    for(std::size_t ring = 0; ring < ghosts_->rings(); ++ring)
      ghosts_->update(ring, table);
  }

  void update_labels(std::uint32_t* label) const { ghosts_->update_labels(label); }

  void update_all_labels(std::uint32_t* label) const
  {
    ghosts_->update_labels(label);
    for(std::size_t ring = 1; ring < ghosts_->rings(); ++ring)
      ghosts_->update(ring, label);
  }

  template <class Candidate>
  void update_adopted(Candidate* candidate, Grid_point* point, std::uint32_t* source, int pass) const
  {
    const std::size_t first_slot = ghosts_->own_size() + ghosts_->size() + std::size_t(pass) * ghosts_->ring_size(0);
    ghosts_->exchange(
      0, Adopted_values<Candidate>{candidate, point, source, ghosts_->ring_begin(0), std::uint32_t(first_slot)});
  }

  template <class Shapes>
  std::size_t share_started(Shapes& shapes, std::size_t ids, Buffer<std::uint32_t>& started) const
  {
    const std::vector<std::uint32_t> own = to_vector(*backend_, started);
    Buffer<Shared_moments> sums(own.size());
    backend_->for_each(own.size(), Get_started{started.data(), shapes.delta.data() + shapes.size, sums.data()});
    std::vector<std::size_t> first;
    const std::vector<Shared_moments> all = communicator().gather(to_vector(*backend_, sums), &first);
    const std::size_t own_first = first[std::size_t(communicator().rank())], own_last = own_first + own.size();
    std::vector<Shared_moments> others(all.begin(), all.begin() + std::ptrdiff_t(own_first));
    others.insert(others.end(), all.begin() + std::ptrdiff_t(own_last), all.end());
    std::vector<std::uint32_t> places;
    std::uint32_t next = std::uint32_t(ids - shapes.size);
    for(std::size_t i = 0; i < all.size(); ++i)
      places.push_back(i >= own_first && i < own_last ? own[i - own_first] : next++);
    started = to_buffer(*backend_, places);
    const std::size_t end = ids + others.size(), old = shapes.delta.size();
    if(end >= first_mark)
      throw std::length_error("there are more than 2^31 shapes while they grow: minimum_region_size is too small");
    if(old < end) {
      shapes.delta = extended(std::move(shapes.delta), end + end / 2);
      backend_->for_each(shapes.delta.size() - old, Fill<Shared_moments>{shapes.delta.data() + old, Shared_moments()});
    }
    write_to(*backend_, others, shapes.delta.data() + ids);
    return end;
  }

  template <class Propagation>
  void run_propagation(Backend&, std::size_t maximum_rounds, std::size_t n, const Propagation& rounds) const
  {
    Rank_propagation<Backend, Propagation>(*backend_, *ghosts_, rounds).run(maximum_rounds, n);
  }

  Own_share own_share() const { return {std::uint32_t(communicator().rank()), std::uint32_t(communicator().size())}; }

  template <class Fits>
  void share_fits(std::size_t n, const Fits& fits) const
  {
    backend_->for_each(n, Make_fit<Fits>{fits, own_share()}, shapes_per_thread);
    spread_fits(n, fits);
  }

  // After each step of which this rank has done its share, it gets what the others have.
  template <class Rounds>
  void run_unions(Backend&, std::size_t maximum_rounds, std::size_t n, const Rounds& rounds) const
  {
    for(std::size_t round = 0; round < maximum_rounds; ++round) {
      const std::int32_t mark = std::int32_t(round + 1);
      for(int step = 0; step < Rounds::fit; ++step) {
        run_step(*backend_, rounds, step, round, n);
        if(step == Rounds::test) {
          const auto accepted = of_all<Accepted_pair>(rounds.pairs, Take_accepted<Rounds>{rounds, mark});
          backend_->for_each(accepted.size(), Put_accepted<Rounds>{rounds, accepted.data()});
        }
      }
      if(backend_->template sum<1>(1, Is_last<Rounds>{rounds, round})[0] != 0)
        return;
      run_step(*backend_, rounds, Rounds::fit, round, n);
      spread_fits(rounds.shapes, Union_fits<Rounds>{rounds, mark});
    }
  }

  Seams join_components(const std::uint32_t* label, std::uint32_t* component) const
  {
    const std::size_t n = ghosts_->own_size() + ghosts_->ring_size(0);
    const Host_view<Backend, const std::uint32_t> labels(*backend_, label, n);
    Host_view<Backend, std::uint32_t> roots(*backend_, component, n);
    const Seams seams = internal::join_components(communicator(), *ghosts_, labels.data(), roots.data());
    roots.write_back();
    return seams;
  }

  void sum_sizes(Seams& seams, std::uint32_t* size) const
  {
    Host_view<Backend, std::uint32_t> sizes(*backend_, size, ghosts_->own_size());
    seams.sum_sizes(communicator(), sizes.data());
    sizes.write_back();
  }

  template <class Component>
  std::vector<Component> join_large(const Seams& seams, const std::vector<Component>& own) const
  {
    return seams.join_large(communicator(), own);
  }

  template <class Links>
  Links join_links(Links&& own, std::uint32_t minimum) const
  {
    return to_buffer(*backend_, gather_links(communicator(), to_vector(*backend_, own), minimum));
  }

private:
  Communicator& communicator() const { return backend_->communicator(); }

  // The own fits have been made.
  template <class Fits>
  void spread_fits(std::size_t n, const Fits& fits) const
  {
    const auto all = of_all<Numbered_fit>(n, Take_fit<Fits>{fits, own_share()});
    backend_->for_each(all.size(), Put_fit<Fits>{fits, all.data()});
  }

  // f.take(i) of the i in [0, n) with f.has(i), of all ranks.
  template <class T, class F>
  Buffer<T> of_all(std::size_t n, F f) const
  {
    const auto own = backend_->template collect<T>(n, f);
    return to_buffer(*backend_, communicator().gather(to_vector(*backend_, own)));
  }

  std::uint32_t first_position(std::uint32_t n) const
  {
    std::uint64_t first = 0;
    const std::vector<std::uint64_t> sizes = communicator().gather(std::vector<std::uint64_t>{n});
    for(int r = 0; r < communicator().rank(); ++r)
      first += sizes[std::size_t(r)];
    return std::uint32_t(first);
  }

  template <class T>
  Buffer<T> extended(Buffer<T>&& table, std::size_t size) const
  {
    Buffer<T> larger(size);
    backend_->for_each(table.size(), Copy_items<T>{table.data(), larger.data()});
    table.release();
    return larger;
  }

  Backend* backend_;
  std::shared_ptr<Ghosts<Backend>> ghosts_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_MPI_RANKS_H
