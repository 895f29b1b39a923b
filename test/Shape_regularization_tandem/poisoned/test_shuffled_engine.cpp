// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole method on a shuffled back end that works as late as it may, as a device does: loops of functors run when the
// host waits for what they write, and memory is released in the order of the loops. Only data() leads to the items of a
// buffer. So host code that does not wait, or reads a buffer itself, finds garbage. After each round, and at the end, it
// has the bits of what works at once, in another order. A difference is reported with the round in which it comes up.
// After -- an argument SEED repeats one random case. One engine is compiled here, which takes long; others compare back
// ends.

#include "testing/Shuffled_block.h"
#include "testing/patches_cloud.h"
#include "testing/property_case.h"
#include "testing/tolerances.h"

#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/result/group_points.h>

#include <functional>
#include <memory>

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
  Buffer<std::uint32_t> compact(std::size_t n, F is_kept, std::size_t size = unknown_size)
  {
    if(size == unknown_size)
      return Shuffled_backend::compact(n, is_kept);
    Buffer<std::uint32_t> kept(size);
    add([n, is_kept, to = kept.data()] {
      std::uint32_t* next = to;
      for(std::size_t i = 0; i < n; ++i)
        if(is_kept(std::uint32_t(i)))
          *next++ = std::uint32_t(i);
    });
    return kept;
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

BOOST_AUTO_TEST_SUITE(test_shuffled_engine)

using CGAL::Tandem::internal::Late_backend;
using CGAL::Tandem::internal::Work;

template <class Normal_map>
struct Traits : CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Normal_map, CGAL::Sequential_tag> {
  using Backend = Late_backend;
  using Execution = CGAL::Tandem::internal::Execution_on<Backend>;
  Traits(std::uint64_t s = 1, Work w = Work::late) : seed(s), work(w) {}
  Backend backend() const { return Backend(seed, work); }
  std::uint64_t seed;
  Work work;
};

// Returns the number of shapes. list: named parameters.
template <class Normal_map, class List>
std::size_t compare_lists(const std::string& name, const Cloud& cloud, const List& list, std::uint64_t seed)
{
  using Detection = CGAL::Tandem::Planar_shape_detection_3<Traits<Normal_map>>;
  Detection expected(cloud, list, {~seed, Work::at_once}), late(cloud, list, {seed, Work::late});
  const int failures_before = failures();
  const std::string name_and_seed = name + ", seed " + std::to_string(seed);
  compare_rounds(late, expected, name_and_seed);
  const std::string where = name_and_seed + ", after the end game";
  check_same(late.shapes(), expected.shapes(), where);
  CHECK_AT(late.shapes().hash() == expected.shapes().hash(), where + ": the normals differ");
  return failures() > failures_before ? 0 : expected.shapes().number_of_shapes();
}

std::size_t compare(const Property_case& c, std::uint64_t seed)
{
  const auto list = CGAL::Tandem::parameters::settings(c.parameters).point_map(First<Kernel>());
  return c.given == Given::normals
           ? compare_lists<Second<Kernel>>(c.name, c.cloud, list.normal_map(Second<Kernel>()), seed)
           : compare_lists<CGAL::Default>(c.name, c.cloud, list, seed);
}

// Points with tolerances of their own, of several octaves.
BOOST_AUTO_TEST_CASE(test_tolerances)
{
  scenes::Random random(1);
  const Corridor corridor(100, 80, 5, random);
  const auto list = CGAL::Tandem::parameters::point_map(First<Kernel>()).cell_size(500);
  const Range_tolerance map = {.002, .0065};
  CHECK(compare_lists<CGAL::Default>("tolerances", corridor.cloud, list.maximum_distance_map(map), 2) >= 4);
}

// Patches take several passes.
BOOST_AUTO_TEST_CASE(test_scenes)
{
  CHECK(compare({"patches", make_patches_cloud(100, .02), make_parameters(.05, 100), Given::normals}, 1) >= 2);
  std::uint64_t seed = 1;
  for(const char* name : {"house", "staircase", "indoor", "slope"}) {
    const scenes::Scene scene = scenes::make_scene(name, scene_options(6000, .001, .05));
    Parameters parameters = make_parameters(.004 * scene.diagonal, 40);
    parameters.cell_size = ++seed % 2 == 0 ? 8192 : 300;
    parameters.k_neighbors = 10 + 2 * seed;
    for(Given given : {Given::normals, Given::nothing})
      CHECK_AT(compare({name, to_cloud(scene), parameters, given}, seed) >= 2, name);
  }
}

BOOST_AUTO_TEST_CASE(test_random_cases)
{
  int with_shapes = 0;
  const std::uint64_t given = argument(1, 0), first = given > 0 ? given : 1, count = given > 0 ? 1 : 20;
  for(std::uint64_t seed = first; seed < first + count; ++seed)
    with_shapes += compare(Case_maker(seed).make_scene(6000), seed) >= 2;
  CHECK_AT(count == 1 || with_shapes >= 3, std::to_string(with_shapes) + " cases with shapes");
}

BOOST_AUTO_TEST_SUITE_END()
