// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What connects the ranks: the members of backend/Ranks.h for many processes. Each is called by all ranks, at the same
// place of the method. See the manual, "Many Machines".

#ifndef CGAL_TANDEM_INTERNAL_MPI_MPI_RANKS_H
#define CGAL_TANDEM_INTERNAL_MPI_MPI_RANKS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/finish/clutter.h>
#include <CGAL/Tandem/internal/finish/propagate_labels.h>
#include <CGAL/Tandem/internal/mpi/Ghosts.h>
#include <CGAL/Tandem/internal/mpi/Seams.h>
#include <CGAL/Tandem/internal/mpi/octants.h>
#include <CGAL/Tandem/internal/mpi/same_parameters.h>
#include <CGAL/Tandem/internal/mpi/sample_cells.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/links.h>
#include <CGAL/Tandem/internal/shapes/shape_deltas.h>

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
    for(double& high : in.box.high) // so that minima do both
      high = -high;
    communicator().minimize(in.box.low, 3);
    communicator().minimize(in.box.high, 3);
    for(double& high : in.box.high)
      high = -high;
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

  std::vector<Grid_point> sample_cells(const Host_buffer<Grid_point>& point) const
  {
    return internal::sample_cells(*backend_, point);
  }

  // The own cells: leaves of the octree are on one rank.
  std::vector<Range> split_cells(const Host_sort_table& sorted, const Code_frame& frame, std::size_t cell_size) const
  {
    std::vector<Range> cells;
    for(const Octant& leaf : find_leaves(communicator(), sorted, frame, cell_size))
      append_cells(leaf.own, cell_size, cells);
    return cells;
  }

  std::size_t total(std::size_t own) const { return std::size_t(communicator().sum(std::uint64_t(own))); }

  template <class T>
  void sum(T* table, std::size_t n) const
  {
    communicator().sum(table, n);
  }

  void sum(Neighbor_counts* table, std::size_t n) const
  {
    static_assert(sizeof(Neighbor_counts) == 3 * sizeof(std::uint64_t), "three numbers");
    communicator().sum(reinterpret_cast<std::uint64_t*>(table), 3 * n);
  }

  // Each rank has changed few shapes.
  void sum(Shared_moments* table, std::size_t n) const
  {
    std::vector<Shape_moments> changed;
    for(std::size_t id = 0; id < n; ++id)
      if(is_any(table[id])) {
        changed.push_back({id, table[id]});
        table[id] = Shared_moments();
      }
    for(const Shape_moments& s : communicator().gather(changed))
      atomic_add<Backend>(table[s.id], s.moments.moments(), s.moments.box);
  }

  template <class Points>
  void connect(Points& points, int rings)
  {
    auto& cloud = points.cloud;
    const std::uint32_t n = std::uint32_t(cloud.size());
    const std::size_t k = std::size_t(cloud.k);
    const std::vector<Remote_entry> remote =
      Border_search<Local>(*backend_, cloud.point.data(), n, cloud.k, cloud.neighbor.data())();
    ghosts_ = std::make_shared<Ghosts>(communicator(), n);
    ghosts_->add_ring(points_of(remote));
    for(const Remote_entry& e : remote)
      cloud.neighbor[e.entry] = ghosts_->place_of(e.point);
    for(int ring = 1; ring < rings; ++ring)
      add_ring(cloud.neighbor, k);
    // While normals are estimated, ghosts adopt planes of points that are no ghosts: one for each of the passes.
    const std::size_t adopted =
      rings > 1 ? std::size_t(tuning::normals::adoption_passes + 1) * ghosts_->ring_size(0) : 0;
    cloud.ghosts = ghosts_->size() + adopted;
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

  template <class Candidate>
  void update_adopted(Candidate* candidate, Grid_point* point, std::uint32_t* source, int pass) const
  {
    struct Adopted {
      Candidate candidate;
      Grid_point point;
    };
    const std::uint32_t first_ghost = ghosts_->ring_begin(0);
    const std::uint32_t first_slot =
      std::uint32_t(ghosts_->own_size() + ghosts_->size() + std::size_t(pass) * ghosts_->ring_size(0));
    ghosts_->exchange<Adopted>(
      0,
      [&](std::uint32_t i) {
        return Adopted{candidate[source[i]], point[source[i]]};
      },
      [&](std::uint32_t place, const Adopted& a) {
        const std::uint32_t slot = first_slot + place - first_ghost;
        candidate[slot] = a.candidate;
        point[slot] = a.point;
        source[place] = slot;
      });
  }

  template <class Shapes>
  std::size_t share_started(Shapes& shapes, std::size_t ids, Buffer<std::uint32_t>& started) const
  {
    std::vector<Shared_moments> own;
    for(const std::uint32_t place : started)
      own.push_back(shapes.delta[shapes.size + place]);
    std::vector<std::size_t> first;
    const std::vector<Shared_moments> all = communicator().gather(own, &first);
    const std::size_t own_first = first[std::size_t(communicator().rank())], end = ids + all.size() - own.size();
    if(shapes.delta.size() < end) {
      const std::size_t old = shapes.delta.size();
      shapes.delta = extended(std::move(shapes.delta), end + end / 2);
      std::fill(shapes.delta.begin() + old, shapes.delta.end(), Shared_moments());
    }
    Buffer<std::uint32_t> places(all.size());
    std::size_t next = ids;
    for(std::size_t i = 0; i < all.size(); ++i) {
      const bool is_own = i >= own_first && i < own_first + own.size();
      places[i] = is_own ? started[i - own_first] : std::uint32_t(next - shapes.size);
      if(!is_own)
        shapes.delta[next++] = all[i];
    }
    started = std::move(places);
    return end;
  }

  // See Label_propagation. Proposals to ghosts go to their owners, which list the points for the next round.
  template <class Propagation>
  void run_propagation(Backend& backend, std::size_t maximum_rounds, std::size_t n, const Propagation& rounds) const
  {
    const std::size_t lanes = (std::max)((std::min)(n, std::size_t(4096)), std::size_t(1));
    const auto run = [&](int step, std::size_t round) {
      backend.for_each(
        lanes, [&](std::size_t lane) { rounds.run(step, round, lane, lanes); }, lanes / 64 + 1);
    };
    std::uint32_t* const end = rounds.proposed.end;
    send_proposals(rounds, end[0], end[1]);
    for(std::size_t round = 0; round < maximum_rounds; ++round) {
      run(Propagation::accept, round);
      update(rounds.labels.label);
      if(total(end[round + 1] - end[round]) <= rounds.few_points)
        return;
      run(Propagation::propose, round);
      send_proposals(rounds, end[round + 1], end[round + 2]);
    }
  }

  Seams join_components(const std::uint32_t* label, std::uint32_t* component) const
  {
    return internal::join_components(communicator(), *ghosts_, label, component);
  }

  void sum_sizes(Seams& seams, std::uint32_t* size) const { seams.sum_sizes(communicator(), size); }

  template <class Component>
  std::vector<Component> join_large(const Seams& seams, const std::vector<Component>& own) const
  {
    return seams.join_large(communicator(), own);
  }

  template <class Links>
  Links join_links(Links&& own, std::uint32_t minimum) const
  {
    std::vector<Link> all = communicator().gather(std::vector<Link>(own.begin(), own.end()));
    std::sort(all.begin(), all.end(), [](const Link& a, const Link& b) { return a.pair < b.pair; });
    std::vector<Link> joined;
    for(const Link& link : all) {
      if(joined.empty() || joined.back().pair != link.pair)
        joined.push_back({link.pair, 0});
      joined.back().count += link.count;
    }
    joined.erase(std::remove_if(joined.begin(), joined.end(), [&](const Link& l) { return l.count < minimum; }),
                 joined.end());
    return to_buffer(*backend_, joined);
  }

private:
  struct Shape_moments {
    std::uint64_t id;
    Shared_moments moments;
  };

  struct Proposal {
    std::uint64_t value;
    std::uint64_t index; // wide, so that all bytes are defined
  };

  Communicator& communicator() const { return backend_->communicator(); }

  static std::vector<Rank_point> points_of(const std::vector<Remote_entry>& entries)
  {
    std::vector<Rank_point> points;
    for(const Remote_entry& e : entries)
      points.push_back(e.point);
    return points;
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
  static Host_buffer<T> extended(Host_buffer<T>&& table, std::size_t size)
  {
    Host_buffer<T> larger(size);
    std::copy(table.begin(), table.end(), larger.begin());
    table.release();
    return larger;
  }

  // Gives rows to the last ring, and adds what they refer to as the next one.
  void add_ring(Buffer<std::uint32_t>& neighbor, std::size_t k)
  {
    const std::size_t last = ghosts_->rings() - 1;
    const std::uint32_t begin = ghosts_->ring_begin(last);
    std::vector<Rank_point> rows(k * ghosts_->ring_size(last)), unknown;
    for(std::size_t j = 0; j < k; ++j)
      ghosts_->exchange<Rank_point>(
        last,
        [&](std::uint32_t i) {
          const std::uint32_t q = neighbor[i * k + j];
          return q == no_index ? Rank_point{no_index, no_index} : ghosts_->point_at(q);
        },
        [&](std::uint32_t place, const Rank_point& p) { rows[(place - begin) * k + j] = p; });
    for(const Rank_point& p : rows)
      if(p.rank != no_index && ghosts_->place_of(p) == no_index)
        unknown.push_back(p);
    ghosts_->add_ring(std::move(unknown));
    neighbor = extended(std::move(neighbor), begin * k + rows.size());
    for(std::size_t e = 0; e < rows.size(); ++e)
      neighbor[begin * k + e] = rows[e].rank == no_index ? no_index : ghosts_->place_of(rows[e]);
  }

  // Takes the ghosts from a list of points with proposals, and adds own points that other ranks have proposed to.
  template <class Propagation>
  void send_proposals(const Propagation& rounds, std::uint32_t first, std::uint32_t& last) const
  {
    std::uint32_t* const point = rounds.proposed.point;
    std::uint64_t* const proposal = rounds.proposal.proposal;
    std::vector<std::vector<Proposal>> send(std::size_t(communicator().size()));
    std::uint32_t kept = first;
    for(std::uint32_t at = first; at < last; ++at) {
      const std::uint32_t i = point[at];
      if(i < ghosts_->own_size()) {
        point[kept++] = i;
        continue;
      }
      const Rank_point owner = ghosts_->point_at(i);
      send[owner.rank].push_back({proposal[i], owner.index});
      proposal[i] = no_proposal;
    }
    for(const std::vector<Proposal>& from : communicator().exchange(send))
      for(const Proposal& p : from) {
        if(proposal[p.index] == no_proposal)
          point[kept++] = std::uint32_t(p.index);
        proposal[p.index] = (std::min)(proposal[p.index], p.value);
      }
    last = kept;
  }

  Backend* backend_;
  std::shared_ptr<Ghosts> ghosts_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_MPI_RANKS_H
