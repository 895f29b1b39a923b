// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each back end of the host has to do: its operations, atomics, unions and rounds, the searches of blocks, and the
// steps before and after the loop, against naive versions.

#include "testing/backend_operations.h"
#include "testing/block_searches.h"
#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/backend/Union_find.h>
#include <CGAL/Tandem/internal/result/extract_shapes.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <numeric>
#include <thread>

BOOST_AUTO_TEST_SUITE(test_backends)

using namespace CGAL::Tandem::internal;

using Indices = std::vector<std::uint32_t>;

// f(backend, name) for all back ends of the host.
template <class F>
void on_host_backends(F f)
{
  f(Sequential_backend(), std::string("sequential"));
  for(unsigned threads : {1u, 8u})
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

// Threads add until they have met so often, each between two additions of another one.
template <class Backend>
void check_meetings()
{
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(5);
  std::uint32_t sum = 0;
  std::atomic<int> meetings{0};
  Indices added(3, 0);
  std::vector<std::thread> threads;
  for(std::uint32_t& own : added)
    threads.emplace_back([&] {
      for(std::uint32_t expected = 0; meetings < 200 && (own % 1024 > 0 || Clock::now() < end); ++own) {
        const std::uint32_t before = Backend::atomic_add(sum, 1u);
        meetings += own > 0 && before != expected;
        expected = before + 1;
      }
    });
  for(std::thread& t : threads)
    t.join();
  check_equal(sum, std::accumulate(added.begin(), added.end(), 0u), Backend::name() + std::string(": additions"));
}

BOOST_AUTO_TEST_CASE(meetings)
{
  check_meetings<Thread_backend>();
#ifdef CGAL_LINKED_WITH_TBB
  check_meetings<Tbb_backend>();
#endif
}

// Another thread comes between, once: it joins the root that is about to be joined.
struct Raced_backend : Sequential_backend {
  inline static std::function<void()> other_thread;

  template <class T>
  static T atomic_exchange_if(T& target, T expected, T value)
  {
    if(const auto other = std::exchange(other_thread, nullptr))
      other();
    return Sequential_backend::atomic_exchange_if(target, expected, value);
  }
};

BOOST_AUTO_TEST_CASE(races_of_unions)
{
  Indices order = {0, 1, 2};
  do {
    Indices parent = {0, 1, 2};
    const Union_find<Shared_parents<Raced_backend>> sets = {{parent.data()}};
    Raced_backend::other_thread = [&] { sets.unite((std::max)(order[0], order[1]), order[2]); };
    sets.unite(order[0], order[1]);
    for(const std::uint32_t i : order)
      CHECK_AT(sets.root(i) == 0, "root of " + std::to_string(i));
  } while(std::next_permutation(order.begin(), order.end()));
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

// Points that the integers leave open are decided by the caller's coordinates.
BOOST_AUTO_TEST_CASE(exact_check)
{
  on_fixtures([](auto& backend, const std::string& name, const Fixture& f) {
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

BOOST_AUTO_TEST_SUITE_END()
