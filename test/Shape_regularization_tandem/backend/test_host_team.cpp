// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loops of a leader whose members stay awake: each item once, seen by the leader, failures, loops within loops.

#undef NDEBUG

#include "testing/test_support.h"

#include <CGAL/Tandem/internal/backend/Host_team.h>
#include <CGAL/Tandem/internal/cuda/runtime/Host_side.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <numeric>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>

using namespace CGAL::Tandem::internal;

// Threads that help while a team works.
class Members {
public:
  Members(Host_team& team, int threads) : team_(team)
  {
    for(int i = 0; i < threads; ++i)
      threads_.emplace_back([&team] { team.help(); });
  }

  ~Members()
  {
    team_.dissolve();
    for(std::thread& thread : threads_)
      thread.join();
  }

private:
  Host_team& team_;
  std::vector<std::thread> threads_;
};

// What the items of one loop write, those of the next one read.
void test_loops(Host_team& team)
{
  std::vector<int> visits(300, 0);
  for(std::size_t loop = 0; loop < 1000; ++loop) {
    const std::size_t n = loop % visits.size();
    std::vector<int> expected = visits;
    team.run(n, [&](std::size_t i) { visits[i] += visits[i] % 3 + 1; });
    for(std::size_t i = 0; i < n; ++i)
      expected[i] += expected[i] % 3 + 1;
    CHECK(visits == expected);
  }
}

void test_failures(Host_team& team)
{
  for(std::size_t bad = 0; bad < 100; bad += 9) {
    bool is_thrown = false;
    try {
      team.run(100, [&](std::size_t i) {
        if(i % 10 == bad % 10)
          throw std::runtime_error("item");
      });
    } catch(const std::runtime_error&) {
      is_thrown = true;
    }
    CHECK(is_thrown);
    std::atomic<int> sum(0);
    team.run(100, [&](std::size_t i) { sum += int(i); });
    CHECK(sum == 4950);
  }
}

void test_sort(Host_team& team)
{
  std::mt19937 random(3);
  for(std::size_t n : {0, 1, 2, 255, 256, 257, 1000, 4096, 5000, 70000}) {
    std::vector<int> values(n);
    for(int& v : values)
      v = int(random() % 1000);
    std::vector<int> expected = values;
    std::sort(expected.begin(), expected.end(), std::greater<int>());
    team.sort(values.begin(), values.end(), std::greater<int>());
    CHECK(values == expected);
  }
}

// Members come late to loops that are over soon, and whose tables are gone then.
void test_short_loops()
{
  for(int round = 0; round < 100; ++round) {
    Host_team team(3);
    const Members members(team, 2);
    for(std::size_t loop = 0; loop < 1000; ++loop) {
      std::vector<int> visits(loop % 4, 0);
      team.run(visits.size(), [&](std::size_t i) { ++visits[i]; });
      CHECK(visits == std::vector<int>(loop % 4, 1));
    }
  }
}

// The leader waits for a member that is still at an item, also where nobody has come for most seats.
void test_slow_members(std::size_t seats)
{
  Host_team team(seats);
  const Members members(team, 1);
  const std::thread::id leader = std::this_thread::get_id();
  for(int loop = 0; loop < 20; ++loop) {
    std::atomic<bool> is_there(false);
    int visits[2] = {0, 0};
    team.run(2, [&](std::size_t i) {
      if(std::this_thread::get_id() == leader) {
        while(!is_there)
          std::this_thread::yield();
      } else {
        is_there = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
      visits[i] = 1;
    });
    CHECK(visits[0] == 1 && visits[1] == 1);
  }
}

// A thread leads only where it has said so, and not within a loop of the team.
void test_leadership(Host_team& team)
{
  CHECK(Host_team::of_leader() == nullptr);
  {
    const Host_team::Leadership leadership(&team);
    CHECK(Host_team::of_leader() == &team);
    std::atomic<int> leaders(0);
    team.run(50, [&](std::size_t) { leaders += Host_team::of_leader() != nullptr; });
    CHECK(leaders == 0);
    CHECK(Host_team::of_leader() == &team);
  }
  CHECK(Host_team::of_leader() == nullptr);
}

// The loops of the back end of the host, with the team and without it, one within the other.
void test_host_side()
{
  Host_side host;
  const auto check_loops = [&] {
    std::vector<int> visits(2000, 0);
    host.for_each_on_host(
      20,
      [&](std::size_t i) {
        host.for_each_on_host(
          100, [&](std::size_t j) { ++visits[100 * i + j]; }, 2);
      },
      2);
    CHECK(visits == std::vector<int>(2000, 1));
    host.for_each_on_host(
      8,
      [&](std::size_t) { // a sort within a loop waits for nobody of the team
        std::vector<int> own(1000);
        std::iota(own.rbegin(), own.rend(), 0);
        host.sort_on_host(own.begin(), own.end(), std::less<int>());
        CHECK(std::is_sorted(own.begin(), own.end()));
      },
      2);
    std::vector<int> values(visits.size());
    for(std::size_t i = 0; i < values.size(); ++i)
      values[i] = int(i * 7919 % 2000);
    host.sort_on_host(values.begin(), values.end(), std::less<int>());
    CHECK(std::is_sorted(values.begin(), values.end()));
  };
  std::vector<std::thread> callers;
  for(int caller = 0; caller < 3; ++caller)
    callers.emplace_back([&] {
      for(int i = 0; i < 50; ++i) {
        with_host_team(check_loops);
        check_loops();
        bool is_thrown = false;
        try {
          with_host_team([&] {
            host.for_each_on_host(
              9, [](std::size_t) { throw std::length_error("item"); }, 2);
          });
        } catch(const std::length_error&) {
          is_thrown = true;
        }
        CHECK(is_thrown);
      }
    });
  for(std::thread& caller : callers)
    caller.join();
}

int main()
{
  // Threads that help, and seats, the leader's among them.
  for(const auto& [threads, seats] : {std::pair(0, 1u), {1, 2u}, {3, 4u}, {1, 4u}, {3, 2u}, {2, 9u}, {8, 9u}}) {
    Host_team team(seats);
    const Members members(team, threads);
    test_loops(team);
    test_failures(team);
    test_sort(team);
    test_leadership(team);
  }
  test_short_loops();
  test_slow_members(2);
  test_slow_members(16);
  test_host_side();
  return report();
}
