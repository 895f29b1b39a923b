// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Threads that stay awake between the loops of one thread, the leader. Beside a device, a call has some thousand short
// loops over shapes. Waking the threads of oneTBB for each of them takes longer than the loop. Results do not depend on
// which thread takes which item.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_HOST_TEAM_H
#define CGAL_TANDEM_INTERNAL_BACKEND_HOST_TEAM_H

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <thread>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

class Host_team {
public:
  // For so many threads, the leader among them. Loops are complete also if fewer threads join.
  explicit Host_team(std::size_t seats)
    : number_of_seats_((std::max)(seats, std::size_t(1))), seat_(new Seat[number_of_seats_])
  {}
  Host_team(const Host_team&) = delete;
  Host_team& operator=(const Host_team&) = delete;

  // As long as it exists, the thread that made it leads the team (null: none). Back ends look up the team of the
  // calling thread.
  class Leadership {
  public:
    explicit Leadership(Host_team* team) : before_(std::exchange(led(), team)) {}
    ~Leadership() { led() = before_; }
    Leadership(const Leadership&) = delete;
    Leadership& operator=(const Leadership&) = delete;

  private:
    Host_team* before_;
  };

  // The team of the calling thread, if it leads one and is in none of its loops; else null.
  static Host_team* of_leader() { return led(); }

  // Called by the other threads: they take part in the loops, from any time on, until the team is dissolved. A thread
  // sets is_busy, then reads loop_ again; the leader closes the loop, then reads is_busy of all. These accesses are
  // sequentially consistent. So either the thread skips a closed loop, or the leader waits for the thread.
  void help() noexcept
  {
    const std::size_t mine = next_seat_.fetch_add(1, std::memory_order_relaxed);
    if(mine >= number_of_seats_)
      return;
    std::size_t waits = 0;
    for(std::uint64_t done = 0; !is_dissolved_.load(std::memory_order_relaxed);) {
      const std::uint64_t loop = loop_.load(std::memory_order_relaxed);
      if(loop == done || loop % 2 == 0) {
        wait_a_little(++waits);
        continue;
      }
      seat_[mine].is_busy.store(true);
      if(loop_.load() == loop)
        take_items(mine, loop);
      seat_[mine].is_busy.store(false, std::memory_order_release);
      done = loop;
    }
  }

  // Returns at once; threads leave help() when they notice.
  void dissolve() { is_dissolved_.store(true, std::memory_order_relaxed); }

  // Called by the leader: f(i) for i in [0, n), in any order, many at a time. If an f throws, one of the exceptions is
  // thrown again, and items may be left out. Loops within f do not use the team.
  template <class F>
  void run(std::size_t n, F f)
  {
    const Leadership none(nullptr); // loops within f are not for the team
    item_ = [](void* body, std::size_t i) { (*static_cast<F*>(body))(i); };
    body_ = &f;
    size_ = n;
    parts_ = (std::min)(next_seat_.load(std::memory_order_relaxed), number_of_seats_);
    has_failed_.store(false, std::memory_order_relaxed);
    const std::uint64_t loop = loop_.load(std::memory_order_relaxed) + 1;
    loop_.store(loop, std::memory_order_release);
    take_items(0, loop);
    loop_.store(loop + 1);
    for(std::size_t s = 1, waits = 0; s < number_of_seats_; ++s)
      while(seat_[s].is_busy.load())
        wait_a_little(++waits);
    if(failure_)
      std::rethrow_exception(std::exchange(failure_, nullptr));
  }

  // Sorts up to sixteen runs, then merges pairs of them. The last merges have few threads, which is enough for tables
  // of shapes.
  template <class Iterator, class Less>
  void sort(Iterator first, Iterator last, Less less)
  {
    const std::size_t n = std::size_t(last - first);
    const auto at = [&](std::size_t i) { return first + std::ptrdiff_t((std::min)(i, n)); };
    std::size_t sorted = (std::max)(n / 16 + 1, std::size_t(256));
    run((n + sorted - 1) / sorted, [&](std::size_t i) { std::sort(at(i * sorted), at((i + 1) * sorted), less); });
    for(; sorted < n; sorted *= 2)
      run((n + 2 * sorted - 1) / (2 * sorted), [&](std::size_t i) {
        std::inplace_merge(at(2 * i * sorted), at((2 * i + 1) * sorted), at((2 * i + 2) * sorted), less);
      });
  }

private:
  // The place of one thread. It begins with its own part of the items, and goes on with what is left of other parts.
  // The counters lie in separate cache lines. With one common counter, threads would wait for its line longer than most
  // items take.
  struct Seat {
    alignas(64) std::atomic<std::uint64_t> taken{0}; // loop << 32 | items of the part
    alignas(64) std::atomic<bool> is_busy{false};
  };

  static Host_team*& led()
  {
    thread_local Host_team* team = nullptr;
    return team;
  }

  // Beside threads that wait in `pause`, a serial computation of the leader is slowed less than with `yield`. At every
  // 64th time the thread yields, for machines with more threads than cores.
  static void wait_a_little(std::size_t waits)
  {
#if defined(__x86_64__) || defined(__i386__)
    if(waits % 64 != 0)
      return __builtin_ia32_pause();
#endif
    static_cast<void>(waits);
    std::this_thread::yield();
  }

  // The threads that had joined when the loop was opened have a part each. The leader visits all parts, since a thread
  // may be suspended; so do threads that joined later. The others visit only parts 1, 2, 4 ... seats further. So each
  // part has several helpers, and few threads contend for one cache line.
  void take_items(std::size_t mine, std::uint64_t loop) noexcept
  {
    const bool takes_all = mine == 0 || mine >= parts_;
    for(std::size_t distance = 0; distance < parts_;
        distance = takes_all || distance == 0 ? distance + 1 : 2 * distance) {
      const std::size_t s = (mine + distance) % parts_;
      const std::size_t first = size_ * s / parts_, last = size_ * (s + 1) / parts_;
      if(first < last)
        take_items_of(seat_[s].taken, loop, first, last);
    }
  }

  // Takes items of one part, one at a time, by compare and exchange. The number of the loop in the counter makes
  // counters of earlier loops count as 0, so they need no reset.
  void take_items_of(std::atomic<std::uint64_t>& taken, std::uint64_t loop, std::size_t first,
                     std::size_t last) noexcept
  {
    const std::uint64_t start = loop << 32;
    std::uint64_t before = taken.load(std::memory_order_relaxed);
    for(;;) {
      const std::size_t i = first + (before >> 32 == start >> 32 ? before - start : 0);
      if(i >= last || has_failed_.load(std::memory_order_relaxed))
        return;
      if(!taken.compare_exchange_weak(before, start + (i - first) + 1, std::memory_order_relaxed))
        continue;
      before = start + (i - first) + 1;
      try {
        item_(body_, i);
      } catch(...) {
        if(!has_failed_.exchange(true, std::memory_order_relaxed))
          failure_ = std::current_exception();
      }
    }
  }

  // The number of the loop, odd while it is open. Opening it with release order publishes the members below. The
  // writes of other threads are visible to the leader when their is_busy is false. Waiting threads read this line only,
  // so the leader can fill the next ones undisturbed.
  alignas(64) std::atomic<std::uint64_t> loop_{0};
  std::atomic<bool> is_dissolved_{false};
  alignas(64) std::atomic<bool> has_failed_{false};
  void (*item_)(void*, std::size_t) = nullptr;
  void* body_ = nullptr;
  std::size_t size_ = 0, parts_ = 1;
  const std::size_t number_of_seats_;
  const std::unique_ptr<Seat[]> seat_;
  std::exception_ptr failure_;
  alignas(64) std::atomic<std::size_t> next_seat_{1}; // seats; the first one is the leader's
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_HOST_TEAM_H
