// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bodies of the end game, over the points, against naive versions of them, on
// several back ends: label propagation, reassignment, components, and sums from the labels.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/finish/end_game.h>

#include <map>
#include <set>

using namespace CGAL::Tandem::internal;

template <class Backend>
class Label_propagation_bodies {
public:
  Label_propagation_bodies(Backend& backend, const std::string& name, const Fixture& f)
    : backend_(backend), name_(name), f_(f)
  {}

  void run()
  {
    test_proposals();
    test_rounds();
    test_propagation();
    test_reassignment(false);
    test_reassignment(true);
    test_take_chosen();
    test_take_chosen_of_shapes();
    test_components();
    for(std::uint32_t parts : {1u, 3u, 16u})
      test_sums(parts);
    test_recount();
  }

private:
  // Both ends of a relation propose; the nearest shape wins, then the smallest.
  void test_proposals()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::set<std::pair<std::uint64_t, std::uint32_t>>> proposals(n);
    auto make = [&](std::uint32_t i, std::uint32_t q) {
      if(f_.label[i] < first_mark && f_.label[q] >= first_mark && f_.fits(f_.label[i], q))
        proposals[q].emplace(f_.distance(f_.label[i], q) >> 16, f_.label[i]);
    };
    for(std::uint32_t i = 0; i < n; ++i)
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        make(i, q);
        make(q, i);
      });
    std::vector<std::uint32_t> label = f_.label, expected = label, proposed(n), end = {0, 0, 0}, expected_proposed;
    for(std::uint32_t i = 0; i < n; ++i)
      if(!proposals[i].empty()) {
        expected[i] = proposals[i].begin()->second;
        expected_proposed.push_back(i);
      }
    std::vector<std::uint8_t> state(n, 0);
    std::vector<std::uint64_t> proposal(n, no_proposal);
    Propose_label<Backend> pass = {f_.cloud,        label.data(), state.data(),    f_.plane.data(),
                                   proposal.data(), f_.tolerance, proposed.data(), end.data() + 1};
    backend_.for_each(n, pass);
    const Proposed_points first = {proposed.data(), end.data()};
    const std::size_t items = 7;
    backend_.for_each(items, Accept_proposals{{label.data(), state.data()}, proposal.data(), first, items});
    check_lists(label, expected, name_ + ": label propagation");
    CHECK_AT(std::count(proposal.begin(), proposal.end(), no_proposal) == std::ptrdiff_t(n),
             name_ + ": proposals that stay");
    const std::uint32_t size = end[1];
    std::sort(proposed.begin(), proposed.begin() + size);
    check_lists(std::vector<std::uint32_t>(proposed.begin(), proposed.begin() + size), expected_proposed,
                name_ + ": points that got proposals");
    for(std::uint32_t i = 0; i < n; i += 2) // so that there are many to pass proposals on to
      if(!std::binary_search(expected_proposed.begin(), expected_proposed.end(), i))
        label[i] = free_label;
    test_proposals_again({pass, {label.data(), state.data()}, first, size - 1}, items, size);
  }

  // The points that joined a shape pass proposals of their shapes on, once each, unless they were few.
  void test_proposals_again(Label_propagation<Backend> rounds, std::size_t items, std::uint32_t size)
  {
    const Propose_label<Backend>& pass = rounds.proposal;
    const Proposed_points& joined = rounds.proposed;
    std::set<std::uint32_t> expected;
    for(std::uint32_t at = 0; at < size; ++at) {
      const std::uint32_t i = joined.point[at], s = pass.label[i];
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        if(pass.label[q] >= first_mark && f_.fits(s, q))
          expected.insert(q);
      });
    }
    CHECK_AT(!rounds.is_last(0), name_ + ": no proposals again");
    backend_.for_each(items, [&](std::size_t lane) { rounds.run(rounds.propose, 0, lane, items); });
    const std::set<std::uint32_t> got(joined.point + size, joined.point + joined.end[2]);
    CHECK_AT(joined.end[2] - size == got.size() && got == expected, name_ + ": points that get proposals later");
    CHECK_AT(2 * expected.size() >= size, name_ + ": there are too few of these");
    rounds.few_points = size;
    CHECK_AT(rounds.is_last(0), name_ + ": few points pass proposals on");
  }

  using Proposals = std::map<std::uint32_t, std::pair<std::uint64_t, std::uint32_t>>; // the best one, by point

  // From a point that has a shape to its neighbors.
  void make_proposals(const std::vector<std::uint32_t>& label, std::uint32_t i, Proposals& proposals) const
  {
    f_.for_each_neighbor(i, [&](std::uint32_t q) { make_proposal(label, i, q, proposals); });
  }

  void make_proposal(const std::vector<std::uint32_t>& label, std::uint32_t from, std::uint32_t to,
                     Proposals& proposals) const
  {
    const std::uint32_t s = label[from];
    if(s >= first_mark || label[to] < first_mark || !f_.fits(s, to))
      return;
    const auto proposal = std::make_pair(f_.distance(s, to) >> 16, s);
    const auto found = proposals.emplace(to, proposal);
    found.first->second = (std::min)(found.first->second, proposal);
  }

  // Round by round. Returns how many points joined shapes in each.
  std::vector<std::size_t> propagate_naively(std::vector<std::uint32_t>& label, std::size_t maximum_rounds,
                                             std::size_t few) const
  {
    Proposals proposals;
    for(std::uint32_t i = 0; i < label.size(); ++i)
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        make_proposal(label, i, q, proposals);
        make_proposal(label, q, i, proposals);
      });
    std::vector<std::size_t> joined;
    while(joined.size() < maximum_rounds && (joined.empty() || joined.back() > few)) {
      for(const auto& proposal : proposals)
        label[proposal.first] = proposal.second.second;
      joined.push_back(proposals.size());
      Proposals next;
      for(const auto& proposal : proposals)
        make_proposals(label, proposal.first, next);
      proposals.swap(next);
    }
    return joined;
  }

  // Until few points join a shape in a round, or for so many rounds.
  void test_rounds()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::uint32_t> sparse(n, free_label);
    for(std::uint32_t i = 0; i < n; i += 61)
      sparse[i] = f_.label[i];
    std::vector<std::uint32_t> all = sparse;
    const std::vector<std::size_t> joined = propagate_naively(all, 16, 0);
    if(n < 100)
      return; // nobody joins anybody
    CHECK_AT(joined.size() > 3, name_ + ": there are too few rounds");
    const std::pair<std::size_t, std::size_t> ends[] = {{16, 0}, {2, 0}, {16, joined[1]}};
    for(const auto& end : ends) {
      std::vector<std::uint32_t> expected = sparse, label = sparse, proposed(n), counters(end.first + 2, 0);
      propagate_naively(expected, end.first, end.second);
      std::vector<std::uint8_t> state(n, 0);
      std::vector<std::uint64_t> proposal(n, no_proposal);
      const Propose_label<Backend> first = {f_.cloud,        label.data(), state.data(),    f_.plane.data(),
                                            proposal.data(), f_.tolerance, proposed.data(), counters.data() + 1};
      backend_.for_each(n, first);
      backend_.run_rounds(end.first, n,
                          Label_propagation<Backend>{
                            first, {label.data(), state.data()}, {proposed.data(), counters.data()}, end.second});
      check_lists(label, expected, name_ + ": rounds of label propagation");
      CHECK_AT((label == all) == (end.first == 16 && end.second == 0), name_ + ": the end of label propagation");
    }
  }

  // The whole of it, with the numbers of rounds and of points of the end game.
  void test_propagation()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::uint32_t> sparse(n, free_label);
    for(std::uint32_t i = 0; i < n; i += 61)
      sparse[i] = f_.label[i];
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, sparse, std::vector<std::uint8_t>(n, tried_seed_bit));
    Shape_table<Backend> shapes;
    shapes.size = f_.plane.size();
    shapes.plane = to_buffer(backend_, f_.plane);
    propagate_labels(points, shapes, f_.tolerance, Phase::end);
    CHECK_AT(!shapes.has_moments() && !points.has_lists(), name_ + ": tables that follow from labels");
    std::vector<std::uint32_t> expected = sparse;
    propagate_naively(expected, tuning::end_game::propagation_rounds, n / tuning::end_game::points_per_late_point);
    check_lists(to_vector(backend_, points.label(), n), expected, name_ + ": propagation");
  }

  // The distance of two planes along their normals, where they are nearest to a point.
  std::int64_t distance_of_planes(std::uint32_t s, std::uint32_t t, std::uint32_t i) const
  {
    const Plane &a = f_.plane[s], &b = f_.plane[t];
    const double cosine = double(a.nx) * b.nx + double(a.ny) * b.ny + double(a.nz) * b.nz;
    const std::int64_t e = signed_distance(a, f_.point[i]), f = signed_distance(b, f_.point[i]);
    return std::abs(cosine < 0 ? e + f : e - f);
  }

  // The largest of the shapes that are no layers beside the nearest one. Interior points stay, and points become
  // interior if that is asked for.
  void test_reassignment(bool marks_interior)
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<Shape> shape(f_.plane.size());
    std::vector<std::uint8_t> may_lose, state(n, 0);
    for(std::size_t s = 0; s < shape.size(); ++s) {
      shape[s].moments.count = std::int64_t(s * 7 % 10);
      may_lose.push_back(s % 3 != 0);
    }
    for(std::uint32_t i = 0; i < n; i += 9)
      state[i] = interior_bit | tried_seed_bit;
    std::vector<std::uint8_t> expected_state = state;
    std::vector<std::uint32_t> chosen(n), expected = f_.label;
    for(std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t own = f_.label[i];
      bool is_inside = own < first_mark;
      std::set<std::uint32_t> shapes = {own};
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = f_.label[q];
        is_inside = is_inside && t == own;
        if(t < first_mark && f_.fits(t, i))
          shapes.insert(t);
      });
      if(marks_interior && is_inside)
        expected_state[i] |= interior_bit;
      if(own >= first_mark || !may_lose[own] || i % 9 == 0)
        continue;
      std::set<std::pair<std::int64_t, std::uint32_t>> nearest, choice;
      for(std::uint32_t t : shapes)
        nearest.emplace(f_.distance(t, i), t);
      const std::int64_t epsilon = f_.tolerance.distance, least = nearest.begin()->first;
      for(std::uint32_t t : shapes)
        if(std::int64_t(f_.distance(t, i)) <= least + epsilon / 4 ||
           10 * distance_of_planes(nearest.begin()->second, t, i) <= 9 * epsilon)
          choice.emplace(-shape[t].moments.count, t);
      expected[i] = choice.begin()->second;
    }
    std::vector<std::int64_t> size;
    for(const Shape& s : shape)
      size.push_back(s.moments.count);
    backend_.for_each(n, Choose_largest{f_.cloud, f_.label.data(), state.data(), f_.plane.data(), size.data(),
                                        may_lose.data(), chosen.data(), f_.tolerance, marks_interior});
    check_lists(chosen, expected, name_ + ": reassignment");
    check_lists(state, expected_state, name_ + ": states after a reassignment");
    CHECK_AT(n < 100 || chosen != f_.label, name_ + ": nothing is reassigned");
  }

  // Every third point goes to the next shape.
  void test_take_chosen()
  {
    const std::uint32_t shapes = std::uint32_t(f_.plane.size());
    std::vector<std::uint32_t> label = f_.label, chosen = label;
    std::vector<std::uint8_t> state(label.size(), interior_bit | tried_seed_bit), expected_state = state;
    std::vector<Shared_moments> change(shapes), expected(shapes);
    for(std::uint32_t i = 0; i < f_.cloud.size; i += 3)
      if(label[i] < first_mark && shapes > 1) {
        chosen[i] = (label[i] + 1) % shapes;
        expected_state[i] = tried_seed_bit;
        add_point(expected[label[i]], f_.point[i], -1);
        add_point(expected[chosen[i]], f_.point[i], 1);
      }
    backend_.template for_each_cell<Moment_table>(
      f_.cells.size(),
      Apply_chosen<Backend>{f_.cloud, f_.cells.data(), chosen.data(), {label.data(), state.data()}, change.data()});
    check_lists(label, chosen, name_ + ": labels that were chosen");
    check_lists(state, expected_state, name_ + ": states of points that change");
    check_moments(change, expected, name_ + ": points that change");
  }

  // The same points, with the table of shapes. Boxes do not shrink; then nothing changes any more.
  void test_take_chosen_of_shapes()
  {
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, f_.label, f_.state);
    std::vector<std::uint32_t> chosen = f_.label;
    std::vector<Shape> shape(f_.plane.size());
    std::vector<Shared_moments> expected(shape.size());
    std::vector<char> is_other(shape.size(), 0);
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = f_.label[i];
      if(s >= first_mark)
        continue;
      shape[s].moments.add(f_.point[i], 1);
      shape[s].box.add(f_.point[i]);
      expected[s].box.add(f_.point[i]);
      chosen[i] = i % 3 == 0 ? (s + 1) % std::uint32_t(shape.size()) : s;
      add_point(expected[chosen[i]], f_.point[i], 1);
      if(chosen[i] != s)
        is_other[s] = is_other[chosen[i]] = 1;
    }
    for(Shape& s : shape)
      s.history.set_fitted(true);
    Shape_table<Backend> shapes;
    shapes.size = shape.size();
    shapes.table() = to_buffer(backend_, shape);
    const bool is_any = chosen != f_.label;
    check_equal(take_chosen(points, shapes, chosen.data()), is_any, name_ + ": whether any label has changed");
    check_lists(to_vector(backend_, points.label(), chosen.size()), chosen, name_ + ": chosen labels");
    check_shapes(shapes, expected, name_ + ": shapes of chosen labels");
    for(std::size_t s = 0; s < shape.size(); ++s)
      check_equal(shapes.table()[s].history.is_fitted(), is_other[s] == 0, name_ + ": shapes to be fitted");
    CHECK_AT(!take_chosen(points, shapes, chosen.data()), name_ + ": labels that are chosen already");
    check_shapes(shapes, expected, name_ + ": shapes of the same labels");
  }

  void check_shapes(const Shape_table<Backend>& shapes, const std::vector<Shared_moments>& expected,
                    const std::string& name)
  {
    std::vector<Shared_moments> got(shapes.size);
    for(std::size_t s = 0; s < shapes.size; ++s)
      atomic_add<Sequential_backend>(got[s], shapes.table()[s].moments, shapes.table()[s].box);
    check_moments(got, expected, name);
    CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), name + ": deltas that stay");
  }

  // By repeated propagation of the smallest position.
  void test_components()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::uint32_t> component(n), expected(n);
    for(std::uint32_t i = 0; i < n; ++i)
      expected[i] = i;
    for(bool is_changed = true; is_changed;) {
      is_changed = false;
      for(std::uint32_t r = 0; r < n; ++r) {
        std::map<std::uint32_t, std::uint32_t> least; // by label, over the point and its neighbors
        auto look = [&](std::uint32_t q) {
          if(f_.label[q] < first_mark) {
            std::uint32_t& smallest = least.emplace(f_.label[q], expected[q]).first->second;
            smallest = (std::min)(smallest, expected[q]);
          }
        };
        auto take = [&](std::uint32_t q) {
          if(f_.label[q] < first_mark && expected[q] != least[f_.label[q]]) {
            expected[q] = least[f_.label[q]];
            is_changed = true;
          }
        };
        look(r);
        f_.for_each_neighbor(r, look);
        take(r);
        f_.for_each_neighbor(r, take);
      }
    }
    Labeled_cloud<Backend> points(backend_);
    const std::size_t cell_size = take_cloud(f_, points);
    find_border(points);
    find_components(points, cell_size, f_.label.data(), component.data());
    check_lists(component, expected, name_ + ": components");
    test_small_components(points, component);
  }

  // Points of components of less than three points become free; before that, interior bits are cleared, and no others.
  void test_small_components(Labeled_cloud<Backend>& points, const std::vector<std::uint32_t>& component)
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::uint32_t> label = f_.label, expected = f_.label;
    std::vector<std::uint8_t> state(n, interior_bit | tried_seed_bit);
    std::map<std::uint32_t, std::uint32_t> size; // by root
    for(std::uint32_t i = 0; i < n; ++i)
      size[component[i]] += f_.label[i] < first_mark;
    for(std::uint32_t i = 0; i < n; ++i)
      if(expected[i] < first_mark && size[component[i]] < 3)
        expected[i] = free_label;
    Seams<Backend> seams(backend_, points.ranks);
    const auto sizes = component_sizes(points, label.data(), component.data(), seams);
    backend_.for_each(n, Clear_interior{state.data()});
    backend_.for_each(n, Free_small_components{component.data(), sizes.data(), 3, label.data()});
    check_lists(label, expected, name_ + ": labels without small components");
    CHECK_AT(label != f_.label, name_ + ": no component is small");
    check_lists(state, std::vector<std::uint8_t>(n, tried_seed_bit), name_ + ": states without small components");
  }

  // Cells are in parts.
  void test_sums(std::uint32_t parts)
  {
    std::vector<Shared_moments> sum(f_.plane.size()), expected(f_.plane.size());
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
      if(f_.label[i] < first_mark)
        add_point(expected[f_.label[i]], f_.point[i], 1);
    backend_.template for_each_cell<Moment_table>(
      f_.cells.size() * parts, Sum_moments<Backend>{f_.cloud, f_.parts_view(parts), f_.label.data(), sum.data()});
    check_moments(sum, expected, name_ + ": sums");
  }

  // Moments and boxes that were wrong are those of the labels, also of shapes that have no point any more.
  void test_recount()
  {
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, f_.label);
    std::vector<Shape> shape(f_.plane.size() + 3);
    std::vector<Shared_moments> expected(shape.size());
    for(Shape& s : shape) {
      s.moments.add({1 << 28, 5, 6, no_normal}, 1);
      s.box.add(Grid_point{1 << 28, 5, 6, no_normal});
    }
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
      if(f_.label[i] < first_mark)
        add_point(expected[f_.label[i]], f_.point[i], 1);
    Shape_table<Backend> shapes;
    shapes.size = shape.size();
    shapes.table() = to_buffer(backend_, shape);
    shapes.lose_moments();
    require(points, shapes, tables::moments | tables::lists);
    for(std::size_t s = 0; s < shape.size(); ++s)
      if(expected[s].count == 0) // the box of no points does not matter
        expected[s].box = shapes.table()[s].box;
    check_shapes(shapes, expected, name_ + ": shapes that are counted again");
    CHECK_AT(!shapes.table()[shape.size() - 1].is_live(), name_ + ": a shape without points");
    const std::uint32_t overflown = Cell_shapes::capacity + 1; // or more
    for(std::size_t c = 0; c < f_.cells.size(); ++c)
      check_equal((std::min)(points.lists()[c].size, overflown), (std::min)(f_.lists[c].size, overflown),
                  name_ + ": lists of cells");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

int main()
{
  test_on_all_backends<Label_propagation_bodies>();
  return report();
}
