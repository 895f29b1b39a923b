// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Threads that stay awake between the loops of one thread, the leader. Beside a device most loops are over shapes and
// take some ten microseconds, and to wake the threads of oneTBB takes 15 to 60.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_HOST_TEAM_H
#define CGAL_TANDEM_INTERNAL_BACKEND_HOST_TEAM_H

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <thread>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

class Host_team {
public:
  Host_team() = default;
  Host_team(const Host_team&) = delete;
  Host_team& operator=(const Host_team&) = delete;

  // As long as it lives, the thread that has made it leads the team (null: none).
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

  // What other threads do, from any time on: they take part in the loops until the team is dissolved.
  void help() noexcept
  {
    for(std::uint64_t done = 0; !is_dissolved_.load(std::memory_order_relaxed);) {
      std::uint64_t state = state_.load(std::memory_order_relaxed);
      if((state & is_open) == 0 || state >> 32 == done) {
        std::this_thread::yield();
      } else if(state_.compare_exchange_weak(state, state + 1, std::memory_order_acquire, std::memory_order_relaxed)) {
        done = state >> 32;
        take_items();
        state_.fetch_sub(1, std::memory_order_release);
      }
    }
  }

  void dissolve() { is_dissolved_.store(true, std::memory_order_relaxed); }

  // By the leader: calls f(i) for i in [0, n), in any order, many at a time. Throws what one of them has thrown;
  // others may be left out then.
  template <class F>
  void run(std::size_t n, F f)
  {
    const Leadership none(nullptr); // loops within f are not for the team
    item_ = [](void* body, std::size_t i) { (*static_cast<F*>(body))(i); };
    body_ = &f;
    size_ = n;
    next_.store(0, std::memory_order_relaxed);
    has_failed_.store(false, std::memory_order_relaxed);
    state_.store(++loops_ << 32 | is_open, std::memory_order_release);
    take_items();
    state_.fetch_and(~is_open, std::memory_order_relaxed);
    while((state_.load(std::memory_order_acquire) & members) != 0)
      std::this_thread::yield();
    if(failure_)
      std::rethrow_exception(std::exchange(failure_, nullptr));
  }

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
  // Of the state: who comes may take part; and how many do. Above them, the number of the loop.
  static constexpr std::uint64_t is_open = std::uint64_t(1) << 31;
  static constexpr std::uint64_t members = is_open - 1;

  static Host_team*& led()
  {
    thread_local Host_team* team = nullptr;
    return team;
  }

  void take_items() noexcept
  {
    for(std::size_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < size_;) {
      try {
        item_(body_, i);
      } catch(...) {
        if(!has_failed_.exchange(true, std::memory_order_relaxed))
          failure_ = std::current_exception();
        next_.store(size_, std::memory_order_relaxed);
      }
    }
  }

  // To open the state publishes the loop, and the leader sees what members have written when they are gone. The
  // number of the loop keeps a member that is late out of the next one.
  alignas(64) std::atomic<std::uint64_t> state_{0};
  alignas(64) std::atomic<std::size_t> next_{0}; // item
  std::atomic<bool> has_failed_{false};
  std::atomic<bool> is_dissolved_{false};
  std::uint64_t loops_ = 0;
  void (*item_)(void*, std::size_t) = nullptr;
  void* body_ = nullptr;
  std::size_t size_ = 0;
  std::exception_ptr failure_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_HOST_TEAM_H
