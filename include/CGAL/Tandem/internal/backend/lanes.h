// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How lanes share the items of a step of run_rounds(), where the host may not know how many there are; and how several
// lanes share an item that takes long.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_LANES_H
#define CGAL_TANDEM_INTERNAL_BACKEND_LANES_H

#include <CGAL/Tandem/internal/base/types.h>

namespace CGAL::Tandem::internal {

// f(i) for the items of one lane; all lanes together have [0, n). On a device, lanes beside each other read items
// beside each other. On the host, where a thread has one lane after the other, the items of a lane are consecutive.
template <class F>
CGAL_TANDEM_HD void for_items_of_lane(std::size_t lane, std::size_t lanes, std::size_t n, F f)
{
#ifdef __CUDA_ARCH__
  for(std::size_t i = lane; i < n; i += lanes)
    f(i);
#else
  const std::size_t last = n * (lane + 1) / lanes;
  for(std::size_t i = n * lane / lanes; i < last; ++i)
    f(i);
#endif
}

// The lanes that work on one item together: on the host one, on a device the 32 of a warp. All of them call what is
// here; code between these calls is uniform, as on a block. Sums are of integers. What is not said to be in order may
// run in any order.
class Lane_group {
public:
  CGAL_TANDEM_HD static constexpr std::uint32_t size()
  {
#ifdef __CUDA_ARCH__
    return 32;
#else
    return 1;
#endif
  }

  // Of this lane in its group.
  CGAL_TANDEM_HD static std::uint32_t rank()
  {
#ifdef __CUDA_ARCH__
    return threadIdx.x % 32;
#else
    return 0;
#endif
  }

  // Then all lanes see all writes.
  CGAL_TANDEM_HD static void sync()
  {
#ifdef __CUDA_ARCH__
    __syncwarp();
#endif
  }

  // f() once; then all lanes see its writes.
  template <class F>
  CGAL_TANDEM_HD static void single(F f)
  {
    sync();
    if(rank() == 0)
      f();
    sync();
  }

  // A bit for each lane, set where it is true.
  CGAL_TANDEM_HD static std::uint32_t bits(bool is_set)
  {
#ifdef __CUDA_ARCH__
    return __ballot_sync(0xffffffffu, is_set);
#else
    return is_set;
#endif
  }

  // The number of lanes for which it is true.
  CGAL_TANDEM_HD static std::uint32_t count(bool is_counted)
  {
#ifdef __CUDA_ARCH__
    return std::uint32_t(__popc(bits(is_counted)));
#else
    return is_counted;
#endif
  }

  // The value that a lane has.
  template <class T>
  CGAL_TANDEM_HD static T of_lane(const T& own, std::uint32_t lane)
  {
#ifdef __CUDA_ARCH__
    static_assert(sizeof(T) % sizeof(unsigned long long) == 0, "exchanged in words of 64 bits");
    unsigned long long word[sizeof(T) / sizeof(unsigned long long)];
    memcpy(word, &own, sizeof(T));
    for(unsigned long long& w : word)
      w = __shfl_sync(0xffffffffu, w, int(lane));
    T value;
    memcpy(&value, word, sizeof(T));
    return value;
#else
    static_cast<void>(lane); // there is only one
    return own;
#endif
  }

  // The sum of the own ones of all lanes, for all lanes. Sum has integers only, and +=.
  template <class Sum>
  CGAL_TANDEM_HD static Sum sum(Sum own)
  {
#ifdef __CUDA_ARCH__
    for(std::uint32_t distance = 16; distance > 0; distance /= 2)
      own += of_lane(own, rank() ^ distance);
#endif
    return own;
  }

  // f(value) for the values of the lanes that have one, in the order of the ranks. All lanes call f, with the same
  // values.
  template <class T, class F>
  CGAL_TANDEM_HD static void for_each_in_order(bool has_value, const T& value, F f)
  {
#ifdef __CUDA_ARCH__
    for(unsigned left = __ballot_sync(0xffffffffu, has_value); left != 0; left &= left - 1)
      f(of_lane(value, std::uint32_t(__ffs(int(left)) - 1)));
#else
    if(has_value)
      f(value);
#endif
  }
};

// f(i) by whole groups of lanes, for the items of one group that are marked, after these have been marked. All groups
// together have [0, n). is_marked is called once for each item, by one lane. `lanes` is a multiple of the size of a
// group.
template <class Predicate, class F>
CGAL_TANDEM_HD void for_items_of_group(std::size_t lane, std::size_t lanes, std::size_t n, Predicate is_marked, F f)
{
#ifdef __CUDA_ARCH__
  const std::size_t size = Lane_group::size(), group = lane / size, groups = lanes / size;
  for(std::size_t first = group; first < n; first += lanes) {
    const std::size_t own = first + Lane_group::rank() * groups;
    unsigned left = __ballot_sync(0xffffffffu, own < n && is_marked(own));
    Lane_group::sync();
    for(; left != 0; left &= left - 1)
      f(first + std::size_t(__ffs(int(left)) - 1) * groups);
  }
#else
  for_items_of_lane(lane, lanes, n, [&](std::size_t i) {
    if(is_marked(i))
      f(i);
  });
#endif
}

// f(i) by whole groups of lanes, as a round of one step.
template <class F>
struct Items_of_groups {
  static constexpr int steps = 1;

  F f;
  std::size_t n;

  static constexpr std::size_t few(int) { return 2; }
  CGAL_TANDEM_HD bool is_last(std::size_t) const { return false; }

  CGAL_TANDEM_HD void run(int, std::size_t, std::size_t lane, std::size_t lanes) const
  {
    for_items_of_group(
      lane, lanes, n, [](std::size_t) { return true; }, [&](std::size_t i) { f(i); });
  }
};

// f(i) for i in [0, n), each by a group of lanes: see Lane_group.
template <class Backend, class F>
void for_each_by_group(Backend& backend, std::size_t n, const F& f)
{
  backend.run_rounds(1, n, Items_of_groups<F>{f, n});
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BACKEND_LANES_H
