// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each body that runs over the points against a naive version of it, on several
// back ends, one of which shuffles all that the concepts leave open.

#undef NDEBUG

#include "Shuffled_block.h"
#include "test_support.h"

#include <CGAL/Tandem/internal/absorb.h>
#include <CGAL/Tandem/internal/components.h>
#include <CGAL/Tandem/internal/grow_shapes.h>
#include <CGAL/Tandem/internal/prepare.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#endif

#include <map>
#include <set>

using namespace CGAL::Tandem::internal;

// A sorted cloud, the true planes, and labels of which some are missing or wrong.
struct Fixture {
  std::vector<Grid_point> point;
  std::vector<std::uint32_t> neighbor;
  std::vector<Range> cells;
  Cloud_view cloud;
  Tolerance tolerance;
  std::vector<Plane> plane;
  std::vector<std::uint32_t> label;
  std::vector<std::uint8_t> state;

  bool fits(std::uint32_t s, std::uint32_t i) const { return CGAL::Tandem::internal::fits(plane[s], point[i], tolerance); }

  // f(neighbor) for each neighbor of i.
  template <class F>
  void for_each_neighbor(std::uint32_t i, F f) const
  {
    const std::uint32_t* row = cloud.row(i);
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
      f(row[j]);
  }

  std::uint64_t distance(std::uint32_t s, std::uint32_t i) const
  {
    const std::int64_t e = signed_distance(plane[s], point[i]);
    return std::uint64_t(e < 0 ? -e : e);
  }
};

Fixture make_fixture(const std::string& name, std::size_t size, int k, std::size_t cell_size)
{
  const scenes::Scene scene = scenes::make_scene(name, scene_options(size, .001, .1));
  const double step = scene.diagonal / 1e6;
  std::vector<Grid_point> unsorted;
  for(std::size_t i = 0; i < size; ++i) {
    const scenes::Vec p = (1 / step) * scene.points[i], n = scene.normals[i];
    unsorted.push_back({std::int32_t(p.x), std::int32_t(p.y), std::int32_t(p.z), encode_normal({n.x, n.y, n.z})});
  }
  Fixture f;
  Sequential_backend backend;
  const Code_frame frame = make_code_frame(unsorted.data(), size);
  const auto order = sort_along_curve(backend, unsorted.data(), size, frame);
  f.cells = split_leaves(order.data(), size, frame, cell_size);
  scenes::Random random(9);
  for(const scenes::Truth_face& face : scene.faces)
    f.plane.push_back(rounded({{face.normal.x, face.normal.y, face.normal.z}, -face.offset / step}));
  for(const Keyed_index& o : order) {
    f.point.push_back(unsorted[o.index]);
    const std::uint64_t dice = random.bits() % 100;
    const std::int32_t truth = scene.label[o.index];
    f.label.push_back(dice < 5    ? std::uint32_t(random.bits() % f.plane.size())
                      : dice < 30 ? (dice < 8 ? is_locked : is_free)
                      : truth < 0 ? is_free
                                  : std::uint32_t(truth));
    f.state.push_back(std::uint8_t(random.bits() % 8));
  }
  f.neighbor.resize(size * std::size_t(k));
  find_neighbors(backend, f.point.data(), std::uint32_t(size), k, f.neighbor.data());
  f.cloud = {f.point.data(), f.neighbor.data(), std::uint32_t(size), k};
  f.tolerance = make_tolerance(2500, cosine_deg(25));
  return f;
}

template <class T>
void check_lists(const std::vector<T>& got, const std::vector<T>& expected, const std::string& name)
{
  const long at = first_difference(got, expected);
  CHECK_AT(at < 0, name + ": the first that differs is " + std::to_string(at));
}

void check_moments(const std::vector<Shared_moments>& got, const std::vector<Shared_moments>& expected, const std::string& name)
{
  for(std::size_t s = 0; s < got.size(); ++s) {
    const Moments a = got[s].moments(), b = expected[s].moments();
    const Box &p = got[s].box, &q = expected[s].box;
    CHECK_AT(a.count == b.count && std::equal(a.sum, a.sum + 3, b.sum) && std::equal(a.product, a.product + 6, b.product),
             name + ", moments of shape " + std::to_string(s));
    CHECK_AT(std::equal(p.low, p.low + 3, q.low) && std::equal(p.high, p.high + 3, q.high), name + ", box of shape " + std::to_string(s));
  }
}

void add_point(Shared_moments& target, const Grid_point& p, int sign)
{
  Moments m;
  m.add(p, sign);
  Box box;
  box.add(p);
  atomic_add<Sequential_backend>(target, m, box);
}

template <class Backend>
class Bodies {
public:
  Bodies(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    test_propose();
    test_growth();
    test_links();
    test_misfits();
    test_update();
    test_offers();
    test_reassignment();
    test_components();
    test_sums();
  }

private:
  void test_propose()
  {
    std::vector<std::uint32_t> border, proposal, expected;
    for(std::uint32_t i = 0; i < f_.cloud.size; i += 2)
      border.push_back(i);
    for(std::uint32_t i : border) {
      std::set<std::pair<std::uint64_t, std::uint32_t>> offers;
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        if(f_.label[i] == is_free && f_.label[q] < first_mark && f_.fits(f_.label[q], i))
          offers.emplace(f_.distance(f_.label[q], i), f_.label[q]);
      });
      expected.push_back(offers.empty() ? no_index : offers.begin()->second);
    }
    proposal.resize(border.size());
    backend_.for_each(border.size(), Propose{f_.cloud, f_.label.data(), f_.plane.data(), border.data(), proposal.data(), f_.tolerance});
    check_lists(proposal, expected, name_ + ": Propose");
  }

  // Round by round, in each leaf alone; ties go to the smallest shape.
  std::vector<std::uint32_t> flood_fill(std::vector<std::uint32_t> label, const std::vector<std::uint8_t>& state,
                                        const std::vector<std::uint16_t>& rounds) const
  {
    for(const Range& cell : f_.cells) {
      std::vector<std::uint32_t> frontier;
      for(std::uint32_t i = cell.first; i < cell.last; ++i)
        if(label[i] < first_mark && (state[i] & on_frontier))
          frontier.push_back(i);
      for(int round = 0; !frontier.empty(); ++round) {
        std::map<std::uint32_t, std::uint32_t> claims;
        for(std::uint32_t i : frontier)
          f_.for_each_neighbor(i, [&](std::uint32_t q) {
            if(round < rounds[label[i]] && q >= cell.first && q < cell.last && label[q] == is_free && f_.fits(label[i], q))
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
    std::vector<std::uint32_t> label = f_.label, cursor(f_.cells.size(), 0);
    std::vector<std::uint8_t> state = f_.state;
    for(std::size_t i = 0; i < label.size(); ++i) // few points to start from
      if(label[i] < first_mark && i % 97 != 0)
        label[i] = is_free;
    std::vector<Plane> plane = f_.plane;
    std::vector<std::uint16_t> rounds;
    for(std::size_t s = 0; s < plane.size(); ++s)
      rounds.push_back(std::uint16_t(s % 3 == 0 ? 256 : s % 5));
    const std::vector<std::uint32_t> expected = flood_fill(label, state, rounds);
    std::vector<std::uint8_t> is_restarted(plane.size(), 0);
    std::vector<Shared_moments> gain(plane.size()), expected_gain(plane.size());
    for(std::size_t i = 0; i < label.size(); ++i)
      if(label[i] != expected[i])
        add_point(expected_gain[expected[i]], f_.point[i], 1);
    std::vector<Cell_job> jobs;
    for(std::size_t c = 0; c < f_.cells.size(); ++c)
      jobs.push_back({f_.cells[c], nullptr, nullptr, 0, nullptr, 0, &cursor[c], nullptr});
    backend_.template for_each_cell<Growth_scratch>(
      jobs.size(), Grow_cells<Backend>{f_.cloud, {plane.data(), rounds.data(), is_restarted.data(), gain.data()},
                                       {label.data(), state.data()}, {f_.tolerance, 8, 64, 7}, jobs.data()});
    check_lists(label, expected, name_ + ": growth");
    check_moments(gain, expected_gain, name_ + ": growth");
  }

  void test_links()
  {
    std::vector<std::uint8_t> state(f_.state.size(), 0), expected_state(state), is_asked;
    for(std::size_t s = 0; s < f_.plane.size(); ++s)
      is_asked.push_back(s % 4 != 1);
    std::map<std::uint64_t, std::uint32_t> expected, got;
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = f_.label[i];
      if(s >= first_mark || !is_asked[s])
        continue;
      expected_state[i] = is_interior;
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = f_.label[q];
        if(t != s)
          expected_state[i] = 0;
        if(t != s && t < first_mark)
          ++expected[std::uint64_t((std::min)(s, t)) << 32 | (std::max)(s, t)];
      });
    }
    std::vector<Link> links(f_.neighbor.size());
    std::uint32_t size = 0;
    std::vector<std::uint32_t> label = f_.label;
    backend_.template for_each_cell<Link_scratch>(
      f_.cells.size(), Collect_links<Backend>{f_.cloud, f_.cells.data(), {label.data(), state.data()}, is_asked.data(),
                                              {links.data(), &size, std::uint32_t(links.size())}});
    for(std::uint32_t l = 0; l < size; ++l)
      got[links[l].pair] += links[l].count;
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

  void test_misfits()
  {
    const std::vector<Plane> after = moved_planes();
    std::vector<std::uint32_t> mask, count(after.size(), 0), expected(after.size(), 0);
    for(std::size_t s = 0; s < after.size(); ++s)
      mask.push_back(s % 4 == 3 ? nobody : std::uint32_t(s % 4));
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = f_.label[i];
      if(s < first_mark && (i & mask[s]) == 0)
        expected[s] += f_.fits(s, i) && !fits(after[s], f_.point[i], f_.tolerance);
    }
    backend_.template for_each_cell<Count_scratch>(
      f_.cells.size(), Count_misfits<Backend>{f_.cloud, f_.cells.data(), f_.label.data(), mask.data(), f_.plane.data(), after.data(),
                                              count.data(), f_.tolerance});
    check_lists(count, expected, name_ + ": misfits");
    CHECK_AT(f_.cloud.size < 100 || std::count(count.begin(), count.end(), 0u) < long(count.size()), name_ + ": no misfits");
  }

  void test_update()
  {
    const std::vector<Plane> plane = moved_planes();
    std::vector<std::uint32_t> target, label = f_.label, expected = label;
    std::vector<std::uint8_t> is_checked, state = f_.state;
    for(std::uint32_t s = 0; s < plane.size(); ++s) {
      target.push_back(s % 5 == 0 ? is_free : s % 5 == 1 ? 2 : s);
      is_checked.push_back(s % 2);
    }
    std::vector<Shared_moments> loss(plane.size()), expected_loss(plane.size());
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t old = label[i], s = old < first_mark ? target[old] : old;
      expected[i] = s;
      if(s < first_mark && is_checked[old] && !fits(plane[s], f_.point[i], f_.tolerance)) {
        expected[i] = state[i] & detached_once ? is_locked : is_free;
        add_point(expected_loss[s], f_.point[i], -1);
      }
    }
    backend_.template for_each_cell<Moment_table>(
      f_.cells.size(), Update_points<Backend>{f_.cloud, f_.cells.data(), {label.data(), state.data()}, target.data(),
                                              is_checked.data(), plane.data(), loss.data(), f_.tolerance});
    check_lists(label, expected, name_ + ": update");
    check_moments(loss, expected_loss, name_ + ": update");
  }

  // Both ends of a relation offer; the nearest shape wins, then the smallest.
  void test_offers()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::set<std::pair<std::uint64_t, std::uint32_t>>> offers(n);
    auto make = [&](std::uint32_t i, std::uint32_t q) {
      if(f_.label[i] < first_mark && f_.label[q] >= first_mark && f_.fits(f_.label[i], q))
        offers[q].emplace(f_.distance(f_.label[i], q) >> 16, f_.label[i]);
    };
    for(std::uint32_t i = 0; i < n; ++i)
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        make(i, q);
        make(q, i);
      });
    std::vector<std::uint32_t> label = f_.label, expected = label, absorbed(n), expected_absorbed;
    for(std::uint32_t i = 0; i < n; ++i)
      if(!offers[i].empty()) {
        expected[i] = offers[i].begin()->second;
        expected_absorbed.push_back(i);
      }
    std::vector<std::uint8_t> state(n, 0);
    std::vector<std::uint64_t> offer(n, no_offer);
    std::uint32_t size = 0;
    backend_.for_each(n, Offer<Backend>{f_.cloud, label.data(), state.data(), f_.plane.data(), offer.data(), f_.tolerance});
    backend_.for_each(n, Accept_offers<Backend>{label.data(), state.data(), offer.data(), absorbed.data(), &size});
    absorbed.resize(size);
    std::sort(absorbed.begin(), absorbed.end());
    check_lists(label, expected, name_ + ": absorption");
    check_lists(absorbed, expected_absorbed, name_ + ": absorbed points");
  }

  void test_reassignment()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::int64_t> size;
    std::vector<std::uint8_t> may_lose, may_gain, state(n, 0);
    for(std::size_t s = 0; s < f_.plane.size(); ++s) {
      size.push_back(std::int64_t(s * 7 % 10));
      may_lose.push_back(s % 3 != 0);
      may_gain.push_back(s % 4 != 0);
    }
    std::vector<std::uint32_t> chosen(n), expected = f_.label;
    for(std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t own = f_.label[i];
      if(own >= first_mark || !may_lose[own])
        continue;
      std::set<std::pair<std::int64_t, std::uint32_t>> choice = {{-size[own], own}};
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = f_.label[q];
        if(t < first_mark && may_gain[t] && f_.fits(t, i))
          choice.emplace(-size[t], t);
      });
      expected[i] = choice.begin()->second;
    }
    backend_.for_each(n, Choose_largest{f_.cloud, f_.label.data(), state.data(), f_.plane.data(), size.data(), may_lose.data(),
                                        may_gain.data(), chosen.data(), f_.tolerance});
    check_lists(chosen, expected, name_ + ": reassignment");
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
    find_components(backend_, f_.cloud, f_.label.data(), component.data());
    check_lists(component, expected, name_ + ": components");
  }

  void test_sums()
  {
    std::vector<Shared_moments> sum(f_.plane.size()), expected(f_.plane.size());
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
      if(f_.label[i] < first_mark)
        add_point(expected[f_.label[i]], f_.point[i], 1);
    backend_.template for_each_cell<Moment_table>(f_.cells.size(),
                                                  Sum_moments<Backend>{f_.cloud, f_.cells.data(), f_.label.data(), sum.data()});
    check_moments(sum, expected, name_ + ": sums");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

template <class Backend>
void test(Backend backend, const std::string& scene, std::size_t size, int k, std::size_t cell_size)
{
  const std::string name = std::string(Backend::name()) + ", " + scene + ", leaves of " + std::to_string(cell_size);
  const Fixture fixture = make_fixture(scene, size, k, cell_size);
  Bodies<Backend>(backend, name, fixture).run();
}

template <class Backend>
void test_all(const Backend& backend)
{
  test(backend, "house", 4000, 12, 8192);  // more shapes than a table of a leaf has slots
  test(backend, "village", 9000, 8, 9000);
  test(backend, "indoor", 6000, 16, 300);
  test(backend, "cube", 12, 12, 64);       // rows that end early
}

int main()
{
  test_all(Sequential_backend());
#ifdef CGAL_LINKED_WITH_TBB
  test_all(Tbb_backend());
#endif
  for(std::uint64_t seed : {1, 2, 3})
    test_all(Shuffled_backend(seed));
  return report();
}
