// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A shuffled back end that works as late as it may, as a device does: loops of functors run when the host waits for
// what they write, and memory is released in the order of the loops. Only data() leads to the items of a buffer. So host
// code that does not wait, or reads a buffer itself, finds garbage. Or it works at once, to be compared with.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_LATE_BACKEND_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_LATE_BACKEND_H

#include "Shuffled_block.h"

#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>
#include <CGAL/Tandem/internal/result/group_points.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// What is to be done, in its order. There is one list, as a thread has one stream.
struct Late_work {
  inline static std::vector<std::function<void()>> list;

  static void run()
  {
    for(const auto& work : std::exchange(list, {}))
      work();
  }
};

// Loops that have not run may still use the memory that is released.
template <class T>
class Late_buffer : Garbage_buffer<T> {
  using Memory = Garbage_buffer<T>;

public:
  using Memory::data;
  using Memory::Memory;
  using Memory::size;

  Late_buffer() = default;
  Late_buffer(Late_buffer&& other) noexcept : Memory(std::move(other)) {}
  ~Late_buffer() { release(); }

  Late_buffer& operator=(Late_buffer&& other) noexcept
  {
    release();
    Memory::operator=(std::move(other));
    return *this;
  }

  void reset(std::size_t size)
  {
    release();
    Memory::reset(size);
  }

  void release()
  {
    if(data() == nullptr)
      return;
    const auto memory = std::make_shared<Memory>(static_cast<Memory&&>(*this));
    Memory::release();
    Late_work::list.push_back([memory] { fill_with_garbage(memory->data(), memory->size()); });
  }
};

struct Late_sort_table : Late_buffer<Host_sort_table::Entry> {
  using View = Host_sort_table::View;
  using Late_buffer::Late_buffer;

  View view() const { return {const_cast<Host_sort_table::Entry*>(data())}; }
};

enum class Work { late, at_once };

// Loops on the host see what has run by then. Loops over pieces wait, since host stages read tables in them.
class Late_backend : public Shuffled_backend {
public:
  template <class T>
  using Buffer = Late_buffer<T>;
  using Sort_table = Late_sort_table;

  explicit Late_backend(std::uint64_t seed = 1, Work work = Work::late) : Shuffled_backend(seed), work_(work) {}
  Late_backend(const Late_backend&) = delete;
  Late_backend& operator=(const Late_backend&) = delete;
  ~Late_backend() { wait(); }

  static const char* name() { return "late"; }

  void wait() { Late_work::run(); }
  void begin_loop() override { wait(); }

  template <class T>
  void to_host(const T* source, std::size_t n, T* target)
  {
    wait();
    Shuffled_backend::to_host(source, n, target);
  }

  template <class T, class F>
  Buffer<T> make_buffer(std::size_t n, F f)
  {
    Buffer<T> items(n);
    for_each_on_host(n, [&](std::size_t i) { new(items.data() + i) T(f(i)); });
    return items;
  }

  template <class F>
  void for_each(std::size_t n, F f, std::size_t = 0)
  {
    add([=] { Shuffled_backend::for_each(n, f); });
  }

  template <class Scratch, class Body>
  void for_each_cell(std::size_t cells, Body body)
  {
    add([=] { Shuffled_backend::for_each_cell<Scratch>(cells, body); });
  }

  void sort(Sort_table& table, int = 63)
  {
    using Entry = Host_sort_table::Entry;
    Entry* const first = table.view().entry;
    Entry* const last = first + table.size();
    add([first, last] {
      std::reverse(first, last);
      std::sort(first, last, [](const Entry& a, const Entry& b) { return a.key < b.key; });
    });
  }

  void sort_ranges(std::uint64_t* key, const Range* range, std::size_t ranges, std::size_t n, std::size_t largest)
  {
    add([=] { Shuffled_backend::sort_ranges(key, range, ranges, n, largest); });
  }

  template <class F>
  Buffer<std::uint32_t> compact(std::size_t n, F is_kept)
  {
    return Shuffled_backend::compact(n, is_kept);
  }

  template <class T, class F>
  Buffer<T> collect(std::size_t n, F f)
  {
    return Shuffled_backend::collect<T>(n, f);
  }

  template <class Rounds>
  void run_rounds(std::size_t maximum_rounds, std::size_t items, const Rounds& rounds)
  {
    add([=] { Shuffled_backend::run_rounds(maximum_rounds, items, rounds); });
  }

private:
  void add(std::function<void()> work)
  {
    if(work_ == Work::late)
      Late_work::list.push_back(std::move(work));
    else
      work();
  }

  Work work_;
};

// The stages that need memory of the host.
template <>
struct Stage_overrides<Late_backend> : No_stage_overrides {
  static constexpr bool finds_neighbors = true, groups_points = true;

  static void find_neighbors(Late_backend& backend, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* out)
  {
    backend.wait();
    internal::find_neighbors(static_cast<Shuffled_backend&>(backend), point, n, k, out);
  }

  static void group_points(Late_backend& backend, Late_buffer<std::int32_t>&& shape_of, std::size_t shapes,
                           Engine_result& result)
  {
    Host_buffer<std::int32_t> table(shape_of.size());
    backend.to_host(shape_of.data(), shape_of.size(), table.data());
    result.points = internal::group_points(backend, table.data(), table.size(), shapes);
    result.shape_of = Shared_table<std::int32_t>(std::move(table));
  }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_LATE_BACKEND_H
