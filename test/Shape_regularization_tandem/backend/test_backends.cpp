// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each back end of the host has to do: its operations, the searches of its blocks, the table of links, atomics,
// unions and rounds, against naive versions.

#include "testing/backend_operations.h"
#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/backend/Union_find.h>

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
  for(std::uint64_t seed : {1, 2})
    f(Shuffled_backend(seed), "shuffled " + std::to_string(seed));
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

BOOST_AUTO_TEST_SUITE_END()
