// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bodies of a round, over the points, against naive versions of them, on several
// back ends: proposals, growth, shapes of cells, links, misfits, and the update of labels.
// Also what a pass of growth makes of the table of shapes.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/rounds/Misfit_counter.h>
#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/shapes/links.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <map>
#include <set>
#include <tuple>

using namespace CGAL::Tandem::internal;

template <class Backend>
class Growth_bodies {
public:
  Growth_bodies(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    test_propose();
    test_growth();
    for(bool is_sparse : {false, true})
      for(bool has_room : {false, true})
        test_take_growth(is_sparse, has_room);
    test_lists();
    for(std::uint32_t parts : {1u, 3u, 16u}) {
      test_parts(parts);
      test_links(parts);
      test_misfits(parts);
    }
    test_misfit_counter(0);
    test_misfit_counter(Sample_memory<Backend>().large_cloud);
    test_update();
  }

private:
  void test_propose()
  {
    std::vector<std::uint32_t> border, proposal, expected;
    for(std::uint32_t i = 0; i < f_.cloud.size; i += 2)
      border.push_back(i);
    for(std::uint32_t i : border) {
      std::set<std::pair<std::uint64_t, std::uint32_t>> proposals;
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        if(f_.label[i] == free_label && f_.label[q] < first_mark && f_.fits(f_.label[q], i))
          proposals.emplace(f_.distance(f_.label[q], i), f_.label[q]);
      });
      expected.push_back(proposals.empty() ? no_index : proposals.begin()->second);
    }
    proposal.resize(border.size());
    backend_.for_each(
      border.size(), Propose{f_.cloud, f_.label.data(), f_.plane.data(), border.data(), proposal.data(), f_.tolerance});
    check_lists(proposal, expected, name_ + ": Propose");
  }

  // Round by round, in each cell alone; ties go to the smallest shape.
  std::vector<std::uint32_t> flood_fill(std::vector<std::uint32_t> label, const std::vector<std::uint8_t>& state,
                                        const std::vector<std::uint16_t>& rounds) const
  {
    for(const Range& cell : f_.cells) {
      std::vector<std::uint32_t> frontier;
      for(std::uint32_t i = cell.first; i < cell.last; ++i)
        if(label[i] < first_mark && (state[i] & frontier_bit))
          frontier.push_back(i);
      for(int round = 0; !frontier.empty(); ++round) {
        std::map<std::uint32_t, std::uint32_t> claims;
        for(std::uint32_t i : frontier)
          f_.for_each_neighbor(i, [&](std::uint32_t q) {
            if(round < rounds[label[i]] && q >= cell.first && q < cell.last && label[q] == free_label &&
               f_.fits(label[i] % std::uint32_t(f_.plane.size()), q))
              claims[q] = claims.count(q) ? (std::min)(claims[q], label[i]) : label[i];
          });
        frontier.clear();
        for(const auto& claim : claims) {
          label[claim.first] = claim.second;
          frontier.push_back(claim.first);
        }
      }
    }
    return label;
  }

  void test_growth()
  {
    // Three shapes of each plane, which race for its points.
    std::vector<std::uint32_t> label = f_.label, cursor(f_.cells.size(), 0);
    std::vector<std::uint8_t> state = f_.state;
    const std::uint32_t faces = std::uint32_t(f_.plane.size());
    for(std::size_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark)
        label[i] = i % 7 == 0 ? label[i] + faces * std::uint32_t(i % 3) : free_label;
    std::vector<Plane> plane;
    for(int copy = 0; copy < 3; ++copy)
      plane.insert(plane.end(), f_.plane.begin(), f_.plane.end());
    std::vector<std::uint16_t> rounds;
    for(std::size_t s = 0; s < plane.size(); ++s)
      rounds.push_back(std::uint16_t(s % 3 == 0 ? tuning::growth::maximum_steps : int(s % 5)));
    const std::vector<std::uint32_t> expected = flood_fill(label, state, rounds);
    std::vector<std::uint8_t> is_restarted(plane.size(), 0);
    std::vector<Shared_moments> delta(plane.size()), expected_delta(plane.size());
    for(std::size_t i = 0; i < label.size(); ++i)
      if(label[i] != expected[i])
        add_point(expected_delta[expected[i]], f_.point[i], 1);
    // No points of the border, no seeds.
    const std::vector<Range> border(f_.cells.size(), Range{0, 0});
    const std::vector<std::uint32_t> none(f_.cells.size(), 0);
    const std::vector<Cell_shapes> lists = f_.list_shapes(label);
    const Cells_view cells = {f_.cells.data(), lists.data()};
    const Cell_tables tables = {cells, border.data(), nullptr, nullptr, nullptr, none.data(), cursor.data()};
    const Grow_cells<Backend> body = {
      f_.cloud,
      {plane.data(), rounds.data(), is_restarted.data(), delta.data()},
      {label.data(), state.data()},
      {f_.tolerance, tuning::growth::young_seeds_in_flight, tuning::growth::seed_tries, 7, 0},
      tables,
      0};
    if(std::all_of(f_.cells.begin(), f_.cells.end(), [](const Range& r) { return r.size() <= small_cell; }))
      backend_.template for_each_cell<Growth_scratch<small_cell>>(f_.cells.size(), body);
    else
      backend_.template for_each_cell<Growth_scratch<largest_cell>>(f_.cells.size(), body);
    check_lists(label, expected, name_ + ": growth");
    check_moments(delta, expected_delta, name_ + ": growth");
  }

  static Plane marked_plane(std::uint32_t id) { return {0, 0, 0, id}; }

  // Shapes with few or many ids out of use, and those that start in the pass. Each live one has some point before, and
  // every fifth one gets no other. Unless there is room the tables have to grow.
  void test_take_growth(bool is_sparse, bool has_room)
  {
    const std::string where =
      name_ + (is_sparse ? ": growth of few shapes" : ": growth of shapes") + (has_room ? " with room" : "");
    const std::uint32_t size = 60, ids = 101, room = has_room ? 500 : size;
    const auto is_live = [&](std::uint32_t id) { return id < size && (id % 3 == 1) == is_sparse; };
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    std::vector<std::uint32_t> label = f_.label;
    std::vector<Shape> shape(room);
    std::vector<Plane> plane(room, marked_plane(99999));
    std::vector<Shared_moments> delta(ids);
    for(std::uint32_t id = 0; id < size; ++id) {
      shape[id].age = int(id % 11);
      shape[id].entry = int(id);
      shape[id].is_active = id % 2 == 0;
      shape[id].history.set_fitted(true);
      shape[id].history.set_linked(true);
      if(is_live(id))
        shape[id].moments.add({std::int32_t(id), 1, 2, no_normal}, 1);
      plane[id] = marked_plane(id);
    }
    std::size_t new_points = 0;
    for(std::uint32_t i = 0; i < label.size(); ++i) {
      const std::uint32_t id = i % ids;
      label[i] = is_live(id) || (id >= size && id % 4 == 2) ? id : f_.label[i] >= first_mark ? f_.label[i] : free_label;
      if(label[i] == id && id % 5 != 0) {
        add_point(delta[id], f_.point[i], 1);
        ++new_points;
      } else if(label[i] == id && id >= size)
        label[i] = locked_label;
    }
    std::vector<std::uint32_t> old; // by new id
    for(std::uint32_t id = 0; id < ids; ++id)
      if(id < size ? is_live(id) || !is_sparse : is_any(delta[id]))
        old.push_back(id);

    set_labels(points, label);
    Shape_table<Backend> shapes;
    shapes.size = size;
    shapes.table() = to_buffer(backend_, shape);
    shapes.plane = to_buffer(backend_, plane);
    shapes.steps = filled_buffer(backend_, room, std::uint16_t(999));
    shapes.is_restarted = filled_buffer(backend_, room, std::uint8_t(1));
    shapes.delta = to_buffer(backend_, delta);
    check_equal(take_growth(points, shapes, ids), new_points, where + ": new points");
    check_equal(shapes.size, old.size(), where + ": ids");
    CHECK_AT((std::min)({shapes.table().size(), shapes.plane.size(), shapes.steps.size(),
                         shapes.is_restarted.size()}) >= old.size(),
             where + ": room of the tables");
    std::vector<std::uint32_t> new_id(ids, no_index);
    for(std::uint32_t i = 0; i < old.size() && shapes.size == old.size(); ++i) {
      new_id[old[i]] = i;
      const bool is_new = old[i] >= size, is_active = is_any(delta[old[i]]);
      Shape before = is_new ? Shape() : shape[old[i]];
      before.moments += delta[old[i]].moments();
      const Shape& s = shapes.table()[i];
      const std::string at = where + ", shape " + std::to_string(old[i]);
      CHECK_AT(s.moments.count == before.moments.count &&
                 std::equal(s.moments.sum, s.moments.sum + 3, before.moments.sum) &&
                 std::equal(s.moments.product, s.moments.product + 6, before.moments.product),
               at + ": moments");
      CHECK_AT(s.box.low[0] == delta[old[i]].box.low[0] && s.box.high[2] == delta[old[i]].box.high[2], at + ": box");
      check_equal(s.entry, is_new ? 0 : int(old[i]), at + ": entry");
      check_equal(shapes.plane[i].d, is_new ? Plane().d : marked_plane(old[i]).d, at + ": plane");
      check_equal(int(shapes.is_restarted[i]), 0, at + ": restart");
      const bool is_out_of_use = !is_new && !is_live(old[i]);
      check_equal(s.age, before.age + !is_out_of_use, at + ": age");
      check_equal(int(shapes.steps[i]),
                  is_out_of_use ? 0 : (std::min)(1 << (std::min)(s.age, 30), tuning::growth::maximum_steps),
                  at + ": steps");
      if(!is_out_of_use)
        CHECK_AT((s.is_active != 0) == is_active && s.history.is_fitted() == !is_active &&
                   s.history.is_linked() == !is_active,
                 at + ": changes");
    }
    for(std::uint32_t& l : label)
      l = l < first_mark ? new_id[l] : l;
    check_lists(to_vector(backend_, points.label(), label.size()), label, where + ": labels");
    CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), where + ": deltas that stay");
  }

  // Of few shapes a cell, and of more than fit into a list.
  void test_lists()
  {
    std::vector<std::uint32_t> many(f_.label);
    for(std::size_t i = 0; i < many.size(); ++i)
      many[i] = i % 5 == 0 ? free_label : std::uint32_t(i);
    for(const std::vector<std::uint32_t>& label : {f_.label, many}) {
      std::vector<Cell_shapes> list(f_.cells.size());
      backend_.template for_each_cell<List_scratch>(f_.cells.size(),
                                                    List_shapes{f_.cells.data(), label.data(), list.data()});
      for(std::size_t c = 0; c < list.size(); ++c) {
        std::set<std::uint32_t> expected(label.begin() + f_.cells[c].first, label.begin() + f_.cells[c].last);
        expected.erase(expected.lower_bound(first_mark), expected.end());
        const std::size_t size = list[c].size;
        const std::set<std::uint32_t> got(list[c].shape,
                                          list[c].shape + (std::min)(size, std::size_t(Cell_shapes::capacity)));
        const bool is_complete = size == expected.size() && got == expected;
        const bool has_overflown = size > Cell_shapes::capacity && expected.size() > Cell_shapes::capacity;
        CHECK_AT(is_complete || has_overflown, name_ + ": shapes of cell " + std::to_string(c));
      }
    }
  }

  // The parts of a cell are consecutive and about equal, and have the shapes of the cell.
  void test_parts(std::uint32_t parts)
  {
    const std::string where = name_ + ": cells in " + std::to_string(parts) + " parts";
    const Cells_view view = f_.parts_view(parts);
    Serial_block block;
    std::uint32_t next = 0;
    for(std::uint32_t c = 0; c < f_.cells.size(); ++c) {
      const Cell_shapes& list = f_.lists[c];
      for(std::uint32_t p = c * parts; p < (c + 1) * parts; ++p) {
        const std::uint32_t size = f_.cells[c].size();
        CHECK_AT(view[p].first == next && view[p].size() >= size / parts && view[p].size() <= size / parts + 1, where);
        next = view[p].last;
        for(std::uint32_t s : {0u, 3u, 1000000u}) {
          const bool is_listed =
            list.size > Cell_shapes::capacity || std::count(list.shape, list.shape + list.size, s) > 0;
          check_equal(view.may_have(block, p, [&](std::uint32_t shape) { return shape == s; }), is_listed,
                      where + ", their shapes");
        }
      }
      check_equal(next, f_.cells[c].last, where + ": the last one of a cell");
    }
  }

  void test_links(std::uint32_t parts)
  {
    std::vector<std::uint8_t> state(f_.state.size(), 0), expected_state(state), is_selected;
    for(std::size_t s = 0; s < f_.plane.size(); ++s)
      is_selected.push_back(s % 4 != 1);
    std::map<std::uint64_t, std::uint32_t> expected, got;
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = f_.label[i];
      if(s >= first_mark || !is_selected[s])
        continue;
      expected_state[i] = interior_bit;
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = f_.label[q];
        if(t != s)
          expected_state[i] = 0;
        if(t != s && t < first_mark)
          ++expected[std::uint64_t((std::min)(s, t)) << 32 | (std::max)(s, t)];
      });
    }
    std::uint32_t size = 1, lost = 0;
    while(size < 2 * f_.neighbor.size())
      size *= 2;
    std::vector<Link> links(size);
    std::vector<std::uint32_t> label = f_.label;
    backend_.template for_each_cell<Link_scratch>(
      f_.cells.size() * parts,
      Collect_links<Backend>{
        f_.cloud, f_.parts_view(parts), label.data(), state.data(), is_selected.data(), {links.data(), size, &lost}});
    for(const Link& link : links)
      if(link.pair != Link::none)
        CHECK_AT(got.emplace(link.pair, link.count).second, name_ + ": a pair has two links");
    check_equal(lost, 0u, name_ + ": links that are lost");
    CHECK_AT(got == expected && expected.size() > 3, name_ + ": links");
    check_lists(state, expected_state, name_ + ": interior points");
  }

  // The planes, shifted by half of epsilon.
  std::vector<Plane> moved_planes() const
  {
    std::vector<Plane> planes = f_.plane;
    for(Plane& p : planes)
      p.d += f_.tolerance.distance / 2;
    return planes;
  }

  // Some shapes have no sample, and some of those that have one are not tested.
  void test_misfits(std::uint32_t parts)
  {
    const std::vector<Plane> after = moved_planes();
    std::vector<std::uint32_t> place_of, mask, query_of, expected; // by shape; by place; by place; by query
    std::vector<Misfit_query> query;
    for(std::uint32_t s = 0; s < after.size(); ++s) {
      const bool has_sample = s % 5 != 4, is_tested = s % 4 != 3;
      place_of.push_back(has_sample ? std::uint32_t(mask.size()) : no_index);
      if(!has_sample)
        continue;
      mask.push_back(s % 4 == 2 ? 3 : s % 4);
      query_of.push_back(is_tested ? std::uint32_t(query.size()) : no_index);
      if(is_tested)
        query.push_back({f_.plane[s], after[s]});
    }
    std::vector<std::uint32_t> place(f_.cloud.size, no_index); // of the points of the sample
    expected.resize(query.size(), 0);
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = f_.label[i], p = s < first_mark ? place_of[s] : no_index;
      if(p == no_index || (i & mask[p]) != 0)
        continue;
      place[i] = p;
      if(query_of[p] != no_index)
        expected[query_of[p]] += f_.fits(s, i) && !fits(after[s], f_.point[i], f_.tolerance);
    }
    std::vector<std::uint32_t> count(query.size(), 0);
    std::vector<Sample> sample(f_.cloud.size);
    const Cells_view view = f_.parts_view(parts);
    std::vector<Range> range(f_.cells.size() * parts);
    const auto expected_samples = std::uint32_t(place.size() - std::count(place.begin(), place.end(), no_index));
    for(Sample* memory : {static_cast<Sample*>(nullptr), sample.data()}) { // first they are only counted
      std::uint32_t samples = 0;
      backend_.template for_each_cell<Count_scratch>(
        range.size(), Collect_samples<Backend>{f_.cloud, view, f_.label.data(), place_of.data(), mask.data(), memory,
                                               &samples, range.data()});
      check_equal(samples, expected_samples, name_ + ": samples");
    }
    check_samples(view, place, sample, range);
    backend_.template for_each_cell<Count_scratch>(
      range.size(), Count_misfits<Backend>{view, sample.data(), range.data(), place_of.data(), query_of.data(),
                                           query.data(), count.data(), f_.tolerance});
    check_lists(count, expected, name_ + ": misfits");
    CHECK_AT(f_.cloud.size < 100 || std::count(count.begin(), count.end(), 0u) < long(count.size()),
             name_ + ": no misfits");
  }

  // Those of each part of a cell are in its range, in any order.
  void check_samples(const Cells_view& view, const std::vector<std::uint32_t>& place, const std::vector<Sample>& sample,
                     const std::vector<Range>& range)
  {
    using Key = std::tuple<std::int32_t, std::int32_t, std::int32_t, std::uint32_t>;
    const auto key = [](const Grid_point& p, std::uint32_t place) { return Key(p.x, p.y, p.z, place); };
    for(std::uint32_t c = 0; c < range.size(); ++c) {
      std::multiset<Key> got, expected;
      for(std::uint32_t i = range[c].first; i < range[c].last; ++i)
        got.insert(key(sample[i].point, sample[i].place));
      for(std::uint32_t i = view[c].first; i < view[c].last; ++i)
        if(place[i] != no_index)
          expected.insert(key(f_.point[i], place[i]));
      CHECK_AT(got == expected, name_ + ": samples of part " + std::to_string(c));
    }
  }

  // Of the points of some shapes.
  std::size_t number_of_samples(const std::vector<Shape>& shape, const std::vector<std::uint32_t>& ids) const
  {
    std::size_t samples = 0;
    for(std::uint32_t s : ids)
      for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
        samples += f_.label[i] == s && (i & sample_mask(shape[s].moments.count)) == 0;
    return samples;
  }

  // Shapes with the points of their labels. Each second one may be tested; its plane is moved, unless it is every third
  // one of these. large: clouds of more points have memory for their samples only.
  void test_misfit_counter(std::size_t large)
  {
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, f_.label);
    Options options = Options();
    options.maximum_distance = 2500;
    options.growth.tolerance = f_.tolerance;
    std::vector<Shape> shape(f_.plane.size());
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
      if(f_.label[i] < first_mark) {
        shape[f_.label[i]].moments.add(f_.point[i], 1);
        shape[f_.label[i]].box.add(f_.point[i]);
      }
    std::vector<std::uint32_t> id;
    std::vector<Regular_plane> candidate;
    std::vector<double> expected;
    for(std::uint32_t s = 0; s < shape.size(); ++s) {
      const Plane& p = f_.plane[s];
      shape[s].local = {{p.nx / normal_scale, p.ny / normal_scale, p.nz / normal_scale}, double(p.d) / normal_scale};
      if(s % 2 != 0 || !shape[s].is_live())
        continue;
      id.push_back(s);
      candidate.push_back(shape[s].local);
      candidate.back().offset += id.size() % 3 == 0 ? 0 : options.maximum_distance / 2;
      expected.push_back(share_of_misfits(s, shape[s], candidate.back()));
    }
    Shape_table<Backend> shapes;
    shapes.size = shape.size();
    shapes.table() = to_buffer(backend_, shape);
    const auto ids = to_buffer(backend_, id);
    const auto candidates = to_buffer(backend_, candidate);
    const auto shares = [&](Misfit_counter<Backend>& counter) {
      const auto share = counter.shares(shapes, ids, candidates);
      return to_vector(backend_, share);
    };
    require(points, shapes, tables::fits | tables::lists);
    for(std::size_t s = 0; s < shape.size(); ++s) // the planes of the test in place of fits
      shapes.table()[s].local = shape[s].local;
    Sample_memory<Backend> memory = {large};
    Misfit_counter<Backend> counter(points, shapes, options, ids, memory);
    check_lists(shares(counter), expected, name_ + ": shares of misfits");
    CHECK_AT(f_.cloud.size < 100 || std::count(expected.begin(), expected.end(), 0.) < long(id.size()),
             name_ + ": no share of misfits");
    check_equal(memory.sample.size(), large == 0 ? number_of_samples(shape, id) : f_.cloud.size,
                name_ + ": memory for samples");

    // Of nearly the same points the last share is taken; otherwise they are counted again.
    for(std::size_t i = 0; i < id.size(); ++i) {
      Misfit_record& last = shapes.table()[id[i]].history.last_misfits;
      const bool is_moved = (i + 1) % 3 != 0;
      check_equal(last.points, is_moved ? shape[id[i]].moments.count : 0, name_ + ": points of a record");
      last.misfit_share = .125;
      last.points += i % 2 == 0 ? 0 : 2 * last.points / tuning::verification::points_per_change + 1;
      expected[i] = is_moved && i % 2 == 0 ? .125 : expected[i];
    }
    check_lists(shares(counter), expected, name_ + ": shares of misfits that are known");
  }

  // Of the sample of a shape.
  double share_of_misfits(std::uint32_t s, const Shape& shape, const Regular_plane& candidate) const
  {
    std::uint32_t step = 1, misfits = 0; // positions of the sample are multiples
    while(shape.moments.count / (2 * step) >= tuning::verification::sample_size)
      step *= 2;
    const Plane before = rounded(shape.local), after = rounded(candidate);
    for(std::uint32_t i = 0; i < f_.cloud.size; i += step)
      misfits += f_.label[i] == s && fits(before, f_.point[i], f_.tolerance) && !fits(after, f_.point[i], f_.tolerance);
    return double(misfits) * step / double(shape.moments.count);
  }

  void test_update()
  {
    const std::vector<Plane> plane = moved_planes();
    std::vector<std::uint32_t> target, label = f_.label, expected = label;
    std::vector<std::uint8_t> is_checked, state = f_.state;
    for(std::uint32_t s = 0; s < plane.size(); ++s) {
      target.push_back(s % 5 == 0 ? free_label : s % 5 == 1 ? 2 : s);
      is_checked.push_back(s % 2);
    }
    std::vector<Shared_moments> loss(plane.size()), expected_loss(plane.size());
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t old = label[i], s = old < first_mark ? target[old] : old;
      expected[i] = s;
      if(s < first_mark && is_checked[old] && !fits(plane[s], f_.point[i], f_.tolerance)) {
        expected[i] = state[i] & detached_bit ? locked_label : free_label;
        add_point(expected_loss[s], f_.point[i], -1);
      }
    }
    std::vector<Cell_shapes> lists = f_.lists;
    lists[0].size = Cell_shapes::capacity + 1; // of all shapes, maybe: stays so
    backend_.template for_each_cell<Update_scratch>(f_.cells.size(),
                                                    Update_points<Backend>{f_.cloud,
                                                                           f_.cells.data(),
                                                                           lists.data(),
                                                                           {label.data(), state.data()},
                                                                           target.data(),
                                                                           is_checked.data(),
                                                                           plane.data(),
                                                                           loss.data(),
                                                                           f_.tolerance});
    check_lists(label, expected, name_ + ": update");
    CHECK_AT(lists[0].size == Cell_shapes::capacity + 1, name_ + ": a list that has overflown");
    for(std::size_t c = 1; c < lists.size(); ++c) {
      std::multiset<std::uint32_t> relabeled;
      for(std::uint32_t i = 0; i < f_.lists[c].size; ++i)
        if(target[f_.lists[c].shape[i]] < first_mark)
          relabeled.insert(target[f_.lists[c].shape[i]]);
      CHECK_AT(f_.lists[c].size <= Cell_shapes::capacity &&
                 relabeled == std::multiset<std::uint32_t>(lists[c].shape, lists[c].shape + lists[c].size),
               name_ + ": list of cell " + std::to_string(c) + " after an update");
    }
    check_moments(loss, expected_loss, name_ + ": update");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

int main()
{
  test_on_all_backends<Growth_bodies>();
  return report();
}
