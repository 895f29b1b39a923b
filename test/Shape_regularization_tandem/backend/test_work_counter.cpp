// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each operation of a back end counts: its items once, however it is made of others.

#undef NDEBUG

#include "testing/host_backends.h"

#include <string>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Two steps a round, of which none is the last one.
struct Idle_rounds {
  static constexpr int steps = 2;
  static std::size_t few(int) { return 0; }
  void run(int, std::size_t, std::size_t, std::size_t) const {}
  bool is_last(std::size_t) const { return false; }
};

struct Has_every_tenth {
  bool has(std::uint32_t i) const { return i % 10 == 0; }
  std::uint32_t take(std::uint32_t i) const { return i; }
};

template <class Backend>
class Counts_of {
public:
  Counts_of(Backend& backend, const std::string& name) : backend_(backend), name_(name)
  {
    backend_.counter().set_points(points);
    backend_.counter().set_shapes(shapes);
  }

  void test()
  {
    const auto ignore = [](std::size_t) {};
    check("a loop", {2000}, [&] { backend_.for_each(2000, ignore); });
    check("a loop over a list", {0, 999}, [&] { backend_.for_each(999, ignore, 10); });
    check("a loop over shapes", {0, 0, 1}, [&] { backend_.for_each(shapes, ignore); });
    check("an empty loop", {}, [&] { backend_.for_each(0, ignore); });
    check("a loop on the host", {0, 500}, [&] { backend_.for_each_on_host(500, ignore, 10); });
    check("a buffer", {0, 70}, [&] { backend_.template make_buffer<int>(70, [](std::size_t i) { return int(i); }); });
    check("pieces", {3000}, [&] { backend_.for_each_piece(3000, 100, [](std::size_t, std::size_t) {}); });
    check("cells", {points}, [&] { backend_.template for_each_cell<int>(7, [](auto&, int&, std::uint32_t) {}); });
    check("no cells", {}, [&] { backend_.template for_each_cell<int>(0, [](auto&, int&, std::uint32_t) {}); });
    check("a compaction", {1500}, [&] { backend_.compact(1500, [](std::uint32_t i) { return i < 9; }); });
    check(
      "a collection", {1500, 150}, [&] { backend_.template collect<std::uint32_t>(1500, Has_every_tenth()); }, 2);
    check("a sum", {0, 900}, [&] { backend_.template sum<1>(900, [](std::size_t, std::int64_t* sum) { ++*sum; }); });
    check("rounds", {0, 400}, [&] { backend_.run_rounds(3, 400, Idle_rounds()); });
    test_sorts();
  }

private:
  static constexpr std::size_t points = 1000, shapes = 50;

  void test_sorts()
  {
    Host_sort_table table(1200);
    for(std::size_t i = 0; i < table.size(); ++i)
      table.view().set(i, 5 * i % 1201, std::uint32_t(i));
    check("a sort", {1200}, [&] { backend_.sort(table); });
    std::vector<std::uint64_t> key = {3, 2, 1, 5, 4};
    key.resize(points + 5);
    const Range ranges[] = {{0, 3}, {3, 5}, {5, std::uint32_t(points + 5)}};
    check("ranges", {points + 5}, [&] { backend_.sort_ranges(key.data(), ranges, 3, key.size(), points); });
  }

  // f() counts as this, and as one operation if it has any items, unless another number is given.
  template <class F>
  void check(const std::string& what, const Work_counts& expected, F f, std::uint64_t launches = 1)
  {
    const Work_counts before = backend_.work();
    f();
    const Work_counts after = backend_.work();
    const bool is_any = expected.items_of_points + expected.items_of_lists + expected.loops_over_shapes > 0;
    const std::string where = name_ + ", " + what;
    check_equal(after.items_of_points - before.items_of_points, expected.items_of_points, where + ": points");
    check_equal(after.items_of_lists - before.items_of_lists, expected.items_of_lists, where + ": lists");
    check_equal(after.loops_over_shapes - before.loops_over_shapes, expected.loops_over_shapes, where + ": shapes");
    check_equal(after.launches - before.launches, is_any ? launches : 0, where + ": launches");
    check_equal(after.waits + after.bytes_copied, std::uint64_t(0), where + ": waits and bytes");
  }

  Backend& backend_;
  const std::string name_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

int main()
{
  using namespace CGAL::Tandem::internal;
  on_host_backends([](auto&& backend, const std::string& name) { Counts_of(backend, name).test(); });
  return report();
}
