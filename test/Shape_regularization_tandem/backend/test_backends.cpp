// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each back end of the host has to do: its operations, atomics and rounds, the searches of blocks, and the steps
// before and after the loop, against naive versions.

#include "testing/backend_operations.h"
#include "testing/block_searches.h"
#include "testing/Reverse_backend.h"
#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/result/extract_shapes.h>

BOOST_AUTO_TEST_SUITE(test_backends)

using namespace CGAL::Tandem::internal;

using Indices = std::vector<std::uint32_t>;

// f(backend, name) for all back ends of the host.
template <class F>
void on_host_backends(F f)
{
  f(Sequential_backend(), std::string("sequential"));
  f(Reverse_backend(), std::string("reverse"));
  for(unsigned threads : {2u, 8u})
    f(Thread_backend(threads), std::to_string(threads) + " threads");
#ifdef CGAL_LINKED_WITH_TBB
  f(Tbb_backend(), std::string("parallel"));
#endif
  f(Shuffled_backend(), std::string("shuffled"));
}

BOOST_AUTO_TEST_CASE(operations)
{
  on_host_backends([](auto backend, const std::string& name) {
    for(const std::string& wrong : Backend_operations<decltype(backend)>(backend).run())
      fail(name + ": " + wrong);
  });
}

// Whatever is done at the same time, nothing is lost, and one item has each slot.
BOOST_AUTO_TEST_CASE(atomics)
{
  on_host_backends([](auto backend, const std::string& name) {
    using Backend = decltype(backend);
    constexpr std::size_t n = 1000000, slots = 1000; // long enough for threads to meet
    std::int64_t sum = 0;
    std::int32_t largest = 0;
    std::uint64_t smallest = n;
    std::uint32_t taken = 0;
    Indices slot(slots, no_index);
    backend.for_each(n, [&](std::size_t i) {
      Backend::atomic_add(sum, std::int64_t(i));
      Backend::atomic_max(largest, std::int32_t(i));
      Backend::atomic_min(smallest, std::uint64_t(n - i));
      if(Backend::atomic_exchange_if(slot[i % slots], +no_index, std::uint32_t(i)) == no_index)
        Backend::atomic_add(taken, 1u);
    });
    check_equal(sum, std::int64_t(n * (n - 1) / 2), name + ": sum");
    check_equal(largest, std::int32_t(n - 1), name + ": largest");
    check_equal(smallest, std::uint64_t(1), name + ": smallest");
    check_equal(taken, std::uint32_t(slots), name + ": slots that are taken");
    for(std::size_t s = 0; s < slots; ++s)
      CHECK_AT(Backend::atomic_load(slot[s]) % slots == s, name + ": slot " + std::to_string(s));
  });
}

// Sums up to each item, by distances that double in each round: a step needs all of the one before.
struct Prefix_sums {
  static constexpr int steps = 2;
  static constexpr std::size_t few(int) { return 3; }

  std::uint32_t *sum, *next;
  std::size_t size, last_round;

  bool is_last(std::size_t round) const { return round == last_round; }

  void run(int step, std::size_t round, std::size_t lane, std::size_t lanes) const
  {
    const std::size_t distance = std::size_t(1) << round;
    for_items_of_lane(lane, lanes, size, [&](std::size_t i) {
      if(step == 0)
        next[i] = sum[i] + (i < distance ? 0 : sum[i - distance]);
      else
        sum[i] = next[i];
    });
  }
};

// With fewer and with more lanes than items; the end by is_last(), before the last step, or by the number of rounds.
BOOST_AUTO_TEST_CASE(rounds)
{
  on_host_backends([](auto backend, const std::string& name) {
    constexpr std::uint32_t n = 700;
    const auto made =
      backend.template make_buffer<std::uint32_t>(n, [](std::size_t i) { return std::uint32_t(i % 7); });
    const std::pair<std::size_t, std::size_t> ends[] = {{12, 99}, {99, 12}, {3, 99}, {99, 3}, {0, 99}};
    for(const auto& end : ends)
      for(std::size_t items : {std::size_t(1), std::size_t(100), std::size_t(n), std::size_t(2 * n)}) {
        Indices sum(made.begin(), made.end()), next(n, 0), expected(n, 0);
        backend.run_rounds(end.first, items, Prefix_sums{sum.data(), next.data(), n, end.second});
        const std::uint32_t reach = 1u << (std::min)(end.first, end.second);
        for(std::uint32_t i = 0; i < n; ++i)
          for(std::uint32_t j = 0; j < reach && j <= i; ++j)
            expected[i] += (i - j) % 7;
        check_lists(sum, expected, name + ": rounds of steps");
        if(end.second < end.first && reach < n) // the step before the last one has run
          CHECK_AT(next[n - 1] > sum[n - 1], name + ": last round");
      }
  });
}

BOOST_AUTO_TEST_CASE(searches)
{
  on_body_backends([](auto backend, const std::string& name) {
    for(std::uint32_t start : search_starts)
      for(std::uint32_t most : search_sizes)
        CHECK_AT(count_wrong_searches(backend, start, most) == 0,
                 name + ": searches from " + std::to_string(start) + " on for " + std::to_string(most) + " items");
  });
}

// Many points of one code: each point 1 to 4 times, and the points between far outliers. Cells are those of one thread.
BOOST_AUTO_TEST_CASE(order)
{
  std::vector<Grid_point> point;
  const Fixture& f = fixtures().front();
  for(std::uint32_t i = 0; i < f.cloud.size; ++i)
    point.insert(point.end(), 1 + i % 4, f.point[i]);
  point.push_back({1 << 28, 1 << 28, 1 << 28, no_normal});
  point.push_back({-(1 << 28), -(1 << 28), -(1 << 28), no_normal});
  const Code_frame frame = make_code_frame(point.data(), point.size());
  auto key = [&](std::uint32_t i) {
    const Grid_point& p = point[i]; // equal points: the last one first
    return std::make_tuple(frame.code(p), frame.code_inside(p), p.x, p.y, p.z, p.normal, ~i);
  };
  std::vector<decltype(key(0))> sorted;
  for(std::uint32_t i = 0; i < point.size(); ++i)
    sorted.push_back(key(i));
  std::sort(sorted.begin(), sorted.end());
  Indices expected;
  for(const auto& k : sorted)
    expected.push_back(~std::get<6>(k));
  const auto sort_all = [&](auto& backend) {
    return sort_along_curve(backend, {point.data(), point.size()}, frame,
                            make_tie_order([](std::uint32_t i, std::uint32_t j) { return i > j; }, Nothing()));
  };
  const auto ends_of_cells = [&](auto& backend, const auto& table, std::size_t size) {
    Indices ends;
    for(const Range& cell : split_cells(backend, table, frame, size)) {
      CHECK(cell.first == (ends.empty() ? 0 : ends.back()));
      ends.push_back(cell.last);
    }
    return ends;
  };
  Sequential_backend sequential;
  const auto table = sort_all(sequential);
  on_body_backends([&](auto backend, const std::string& name) {
    const auto order = sort_all(backend);
    Indices got;
    for(std::size_t i = 0; i < order.size(); ++i)
      got.push_back(order.view().index(i));
    check_lists(got, expected, name + ": order along the curve");
    for(std::size_t size : {64, 700})
      check_lists(ends_of_cells(backend, order, size), ends_of_cells(sequential, table, size),
                  name + ": cells of " + std::to_string(size));
  });
}

// f(backend, name, fixture) where all points have one tolerance.
template <class F>
void on_plain_fixtures(F f)
{
  on_fixtures([&](auto& backend, const std::string& name, const Fixture& fixture) {
    if(fixture.level.empty())
      f(backend, name, fixture);
  });
}

BOOST_AUTO_TEST_CASE(border)
{
  on_plain_fixtures([](auto& backend, const std::string& name, const Fixture& f) {
    Labeled_cloud<std::decay_t<decltype(backend)>> points(backend);
    take_cloud(f, points);
    find_border(points);
    const auto& border = points.border;
    Indices expected;
    for(std::size_t c = 0; c < f.cells.size(); ++c) {
      const Range& cell = f.cells[c];
      check_equal(border.range[c].first, std::uint32_t(expected.size()), name + ": border of a cell");
      for(std::uint32_t i = cell.first; i < cell.last; ++i) {
        bool is_at_border = false;
        f.for_each_neighbor(i, [&](std::uint32_t q) { is_at_border |= q < cell.first || q >= cell.last; });
        if(is_at_border)
          expected.push_back(i);
      }
      check_equal(border.range[c].last, std::uint32_t(expected.size()), name + ": border of a cell");
    }
    check_lists(to_vector(backend, border.point), expected, name + ": border");
  });
}

// Twice: what has been added to the shapes is zero again.
BOOST_AUTO_TEST_CASE(deltas)
{
  on_plain_fixtures([](auto& backend, const std::string& name, const Fixture& f) {
    Shape_table<std::decay_t<decltype(backend)>> shapes;
    shapes.size = f.plane.size() + 5;
    shapes.table() = filled_buffer(backend, shapes.size, Shape());
    std::vector<Shared_moments> expected(shapes.size);
    for(int pass = 0; pass < 2; ++pass) {
      const std::string where = name + ": deltas of pass " + std::to_string(pass);
      std::vector<char> has_delta(shapes.size, 0);
      for(Shape& shape : shapes.table())
        shape.history.is_fitted = true;
      Shared_moments* sums = start_deltas(backend, shapes, shapes.size);
      for(std::uint32_t i = 0; i < f.cloud.size; ++i) {
        const std::uint32_t s = f.label[i];
        if(s >= first_mark || (pass == 1 && s % 3 == 0))
          continue;
        has_delta[s] = 1;
        add_point(sums[s], f.point[i], -1);
        add_point(expected[s], f.point[i], -1);
      }
      CHECK_AT(std::count(has_delta.begin(), has_delta.end(), 1) > 0, where + ": there are none");
      add_deltas(backend, shapes);
      check_moments(shapes, expected, where);
      for(std::size_t s = 0; s < shapes.size; ++s)
        CHECK_AT(shapes.table()[s].history.is_fitted == (has_delta[s] == 0), where + ": shapes to be fitted");
    }
    const std::size_t more = 2 * shapes.delta.size();
    const Shared_moments* const sums = start_deltas(backend, shapes, more);
    CHECK_AT(shapes.delta.size() >= more, name + ": room for deltas");
    CHECK_AT(std::none_of(sums, sums + more, is_any), name + ": deltas that are not zero");
  });
}

Labels_of_points labels_of_points(const Fixture& f) { return {f.cloud.surfels, f.label.data(), nullptr}; }

BOOST_AUTO_TEST_CASE(sizes_of_components)
{
  on_plain_fixtures([](auto& backend, const std::string& name, const Fixture& f) {
    const std::uint32_t n = f.cloud.size;
    Indices component(n), size(n, 0), expected(n, 0);
    for(std::uint32_t i = 0; i < n; ++i) {
      component[i] = i - i % (1 + i / 16 % 32); // more roots in a cell than its table has slots
      expected[component[i]] += f.label[i] < first_mark;
    }
    backend.template for_each_cell<Count_scratch>(
      f.cells.size(), Count_components<std::decay_t<decltype(backend)>>{f.cells.data(), labels_of_points(f),
                                                                        component.data(), size.data()});
    check_lists(size, expected, name);
  });
}

// Points that the integers leave open are decided by the caller's coordinates.
BOOST_AUTO_TEST_CASE(exact_check)
{
  on_plain_fixtures([](auto& backend, const std::string& name, const Fixture& f) {
    const std::uint32_t n = f.cloud.size;
    const Tolerance certain = {f.tolerance.distance / 2, f.tolerance.squared_cosine};
    const Exact_bounds bounds = {1200, 0};
    std::vector<CGAL::Tandem::Coefficients> plane;
    for(const Plane& p : f.plane)
      plane.push_back({double(p.nx) / normal_scale, double(p.ny) / normal_scale, double(p.nz) / normal_scale,
                       double(p.d) / normal_scale});
    std::vector<double> coordinates(3 * std::size_t(n)), normals(coordinates.size(), 1);
    Indices origin(n), label = f.label, expected = label;
    const std::vector<std::uint8_t> level = f.mixed_levels();
    std::size_t rejected = 0;
    for(std::uint32_t i = 0; i < n; ++i) {
      origin[i] = n - 1 - i;
      const double p[3] = {double(f.point[i].x), double(f.point[i].y), double(f.point[i].z)};
      std::copy(p, p + 3, &coordinates[3 * std::size_t(origin[i])]);
      if(label[i] < first_mark && !fits(f.plane[label[i]], f.point[i], certain.at(level[i])) &&
         !bounds.is_near(plane[label[i]], {p[0], p[1], p[2]}, level[i])) {
        expected[i] = locked_label;
        ++rejected;
      }
    }
    const Surfels_view points = {f.point.data(), nullptr, nullptr, level.data()};
    check_exactly(backend, {points, origin.data(), label.data(), n}, f.plane.data(), certain,
                  {{{coordinates.data(), false}, {normals.data(), false}}, plane.data(), bounds});
    check_lists(label, expected, name);
    CHECK_AT(rejected > 20 || n < 100, name + ": " + std::to_string(rejected) + " points rejected");
  });
}

// Every second label is a shape, all others are left out. Some points are farther away than epsilon.
BOOST_AUTO_TEST_CASE(measures)
{
  on_plain_fixtures([](auto& backend, const std::string& name, const Fixture& f) {
    Indices shape;
    for(const std::uint32_t s : f.label)
      shape.push_back(s < first_mark && s % 2 == 0 ? s : no_index);
    std::vector<std::uint64_t> opposed(f.plane.size(), 0), expected_opposed = opposed, found(Point_measures::size, 0),
                                                           expected = found;
    const std::vector<std::uint8_t> level = f.mixed_levels();
    for(std::uint32_t i = 0; i < f.cloud.size; ++i) {
      const std::uint32_t label = shape[i];
      f.for_each_neighbor(i, [&](std::uint32_t q) {
        if(shape[q] != label)
          ++expected[label == no_index || shape[q] == no_index ? Point_measures::free_links : Point_measures::links];
      });
      if(label == no_index)
        continue;
      const double units = double(Score_item::tolerance_units), exact = double(f.distance(label, i));
      const auto share = [&](const Tolerance& t) {
        return std::floor((std::min)(exact / double(t.distance), 1.) * units + .5);
      };
      const double own = share(f.tolerance.at(level[i]));
      expected[Point_measures::distance] += std::uint64_t(share(f.tolerance));
      expected[Point_measures::fit] += std::uint64_t(4096 - std::floor(4096 * own * own / units / units + .5));
      const Int_vector m = decode_normal(f.point[i].normal);
      const Plane& p = f.plane[label];
      expected_opposed[label] += double(p.nx) * m.x + double(p.ny) * m.y + double(p.nz) * m.z < 0;
    }
    Cloud_view cloud = f.cloud;
    cloud.surfels.level = level.data();
    const Measure_points<std::decay_t<decltype(backend)>> body = {cloud,          f.cells.data(), labels_of_points(f),
                                                                  f.plane.data(), shape.data(),   f.tolerance,
                                                                  opposed.data(), found.data()};
    backend.template for_each_cell<Measure_scratch>(f.cells.size(), body);
    check_lists(opposed, expected_opposed, name + ": opposed normals");
    check_lists(found, expected, name + ": distances, fit, and links");
  });
}

// Labels that are no shapes are left out.
BOOST_AUTO_TEST_CASE(groups)
{
  on_plain_fixtures([](auto& backend, const std::string& name, const Fixture& f) {
    const std::size_t shapes = f.plane.size() - 1;
    std::vector<std::int32_t> shape_of;
    std::vector<Indices> expected(shapes);
    for(std::uint32_t i = 0; i < f.cloud.size; ++i) {
      shape_of.push_back(f.label[i] < first_mark ? std::int32_t(f.label[i]) : -1);
      if(f.label[i] < shapes)
        expected[f.label[i]].push_back(i);
    }
    const auto groups = group_points(backend, shape_of.data(), shape_of.size(), shapes);
    const auto first = groups.position.begin();
    for(std::size_t s = 0; s < shapes; ++s)
      check_lists(Indices(first + groups.first[s], first + groups.first[s + 1]), expected[s],
                  name + ": points of shape " + std::to_string(s));
    CHECK_AT(groups.position.size() == groups.first[shapes], name);
  });
}

BOOST_AUTO_TEST_SUITE_END()
