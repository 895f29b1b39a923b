// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The memory of back ends whose functors run on the host. Their tables are what the host has, so access to them copies
// nothing. Also the operations that such back ends share.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_HOST_MEMORY_H
#define CGAL_TANDEM_INTERNAL_BACKEND_HOST_MEMORY_H

#include <CGAL/Tandem/internal/memory/Host_buffer.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Access of functors to a table of the host: here, the same memory.
template <class T>
class Host_access {
public:
  explicit Host_access(T* data) : data_(data) {}

  T* data() const { return data_; }

  // Afterwards the host has what the functors wrote. Here it has it already.
  void copy_back() {}

private:
  T* data_;
};

// The operations that concepts.h lists under "Backend, memory".
class Host_memory {
public:
  // Whether freed tables of the host are kept for the next engine. Only beside a device: see Kept_pages.h.
  static constexpr bool keeps_pages = false;

  template <class T>
  using Buffer = Host_buffer<T>;
  using Sort_table = Host_sort_table;

  // The table must stay as it is while the access exists.
  template <class T, class Allocator>
  Host_access<const T> read_access(const std::vector<T, Allocator>& table)
  {
    return Host_access<const T>(table.data());
  }

  // The host must not use the table before copy_back().
  template <class T>
  Host_access<T> read_write_access(std::vector<T>& table)
  {
    return Host_access<T>(table.data());
  }

  // The same, where functors write each entry before they read it: nothing has to be copied to them.
  template <class T>
  Host_access<T> write_access(std::vector<T>& table)
  {
    return Host_access<T>(table.data());
  }

  // Waits for all work that was started. Here nothing is pending.
  void wait() {}

  // n items from a buffer to the host; from_host() copies them back.
  template <class T>
  void to_host(const T* source, std::size_t n, T* target)
  {
    copy(source, n, target);
  }

  template <class T>
  void from_host(const T* source, std::size_t n, T* target)
  {
    copy(source, n, target);
  }

protected:
  template <class T, class Backend, class F>
  static typename Backend::template Buffer<T> make_buffer_on(Backend& backend, std::size_t n, F f)
  {
    typename Backend::template Buffer<T> items(n);
    backend.for_each_on_host(n, [&](std::size_t i) { items[i] = f(i); });
    return items;
  }

  // The i in [0, n) with is_kept(i), ascending, on a back end with for_each_piece(). Counts in pieces, then writes each
  // piece at its place. is_kept is evaluated twice, so it has no side effects.
  template <class Backend, class F>
  static Host_buffer<std::uint32_t> compact_on(Backend& backend, std::size_t n, F is_kept)
  {
    constexpr std::size_t grain = 16384;
    std::vector<std::size_t> place((n + grain - 1) / grain + 1, 0);
    backend.for_each_piece(n, grain, [&](std::size_t first, std::size_t last) {
      std::size_t kept = 0;
      for(std::size_t i = first; i < last; ++i)
        kept += is_kept(std::uint32_t(i));
      place[first / grain + 1] = kept;
    });
    std::partial_sum(place.begin(), place.end(), place.begin());
    Host_buffer<std::uint32_t> result(place.back());
    backend.for_each_piece(n, grain, [&](std::size_t first, std::size_t last) {
      std::size_t to = place[first / grain];
      for(std::size_t i = first; i < last && to < place[first / grain + 1]; ++i)
        if(is_kept(std::uint32_t(i)))
          result[to++] = std::uint32_t(i);
    });
    return result;
  }

  // f.take(i) of the i in [0, n) with f.has(i), ascending. All has() come before any take(), which may change what
  // has() reads.
  template <class T, class Backend, class F>
  static Host_buffer<T> collect_on(Backend& backend, std::size_t n, F f)
  {
    const Host_buffer<std::uint32_t> found = compact_on(backend, n, [&](std::uint32_t i) { return f.has(i); });
    Host_buffer<T> items(found.size());
    backend.for_each_piece(found.size(), 1024, [&](std::size_t first, std::size_t last) {
      for(std::size_t k = first; k < last; ++k)
        items[k] = f.take(found[k]);
    });
    return items;
  }

  // Lanes beyond these cost more than they balance.
  static constexpr std::size_t maximum_lanes = 4096;

  // Steps one after the other; functors on the host, so what is_last() reads is there. Where the items of a step are
  // few, one thread has all lanes.
  template <class Backend, class Rounds>
  static void run_rounds_on(Backend& backend, std::size_t maximum_rounds, std::size_t items, const Rounds& rounds)
  {
    const std::size_t lanes = (std::max)((std::min)(items, maximum_lanes), std::size_t(1));
    for(std::size_t round = 0; round < maximum_rounds; ++round)
      for(int step = 0; step < Rounds::steps; ++step) {
        if(step + 1 == Rounds::steps && rounds.is_last(round))
          return;
        const std::size_t grain = items < Rounds::few(step) ? lanes : (lanes + 63) / 64;
        backend.for_each_piece(lanes, grain, [&](std::size_t first, std::size_t last) {
          for(std::size_t lane = first; lane < last; ++lane)
            rounds.run(step, round, lane, lanes);
        });
      }
  }

private:
  template <class T>
  static void copy(const T* source, std::size_t n, T* target)
  {
    if(n > 0)
      std::memcpy(target, source, n * sizeof(T));
  }
};

// The operations that are made of others in the same way on every back end of the host with several threads or another
// order. Sequential_backend has them one by one, and says what they do.
template <class Backend>
class Host_operations : public Host_memory {
public:
  template <class T, class F>
  auto make_buffer(std::size_t n, F f)
  {
    return make_buffer_on<T>(self(), n, f);
  }

  template <class F>
  auto compact(std::size_t n, F is_kept)
  {
    return compact_on(self(), n, is_kept);
  }

  template <class T, class F>
  auto collect(std::size_t n, F f)
  {
    return collect_on<T>(self(), n, f);
  }

  template <class Rounds>
  void run_rounds(std::size_t maximum_rounds, std::size_t items, const Rounds& rounds)
  {
    run_rounds_on(self(), maximum_rounds, items, rounds);
  }

private:
  Backend& self() { return static_cast<Backend&>(*this); }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_HOST_MEMORY_H
