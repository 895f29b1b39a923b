// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Counts what a back end does: a few additions for each operation, none for an item. No result depends on it.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_WORK_COUNTER_H
#define CGAL_TANDEM_INTERNAL_BACKEND_WORK_COUNTER_H

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// Sums since the back end was made. The last three are of a device, as far as they are not 0.
struct Work_counts {
  std::uint64_t items_of_points = 0; // of loops over at least as many items as there are points
  std::uint64_t items_of_lists = 0;  // of smaller loops, over more items than there are shapes
  std::uint64_t loops_over_shapes = 0;
  std::uint64_t launches = 0;
  std::uint64_t waits = 0;
  std::uint64_t bytes_copied = 0;
};

// A loop is one over points, lists or shapes by its number of items. Operations are started by one thread at a time.
class Work_counter {
public:
  // From here on. The engine tells the points, the table of shapes the shapes.
  void set_points(std::size_t n) { points_ = n; }
  void set_shapes(std::size_t n) { shapes_ = n; }

  void add_loop(std::size_t n)
  {
    if(n == 0)
      return;
    if(n >= points_)
      counts_.items_of_points += n;
    else if(n > shapes_)
      counts_.items_of_lists += n;
    else
      ++counts_.loops_over_shapes;
    ++counts_.launches;
  }

  // Over all cells, or parts of them: together they have all points.
  void add_cells(std::size_t cells)
  {
    if(cells > 0)
      add_loop(points_);
  }

  const Work_counts& counts() const { return counts_; }

private:
  friend class One_loop;

  Work_counts counts_;
  std::size_t points_ = 0, shapes_ = 0;
};

// An operation that is made of others: until the end of this, all count as one loop over n items.
class One_loop {
public:
  One_loop(Work_counter& counter, std::size_t n) : counter_(counter)
  {
    counter_.add_loop(n);
    before_ = counter_.counts_;
  }
  One_loop(const One_loop&) = delete;
  One_loop& operator=(const One_loop&) = delete;
  ~One_loop() { counter_.counts_ = before_; }

private:
  Work_counter& counter_;
  Work_counts before_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_WORK_COUNTER_H
