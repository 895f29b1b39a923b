// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The blocks that have neighbors of a block, against sets of them, on several back ends. A row that has overflown has
// more blocks than fit, or neighbors of another rank.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/cloud/Block_rows.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_block_rows)

using namespace CGAL::Tandem::internal;

using Blocks = std::set<std::uint32_t>;

template <class Backend>
class Rows {
public:
  Rows(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    test(points.cloud, std::uint32_t(f_.point.size()), name_);
    if(f_.point.size() >= 1000)
      CHECK_AT(listed_ > 10, name_ + ": no row is listed");
    listed_ = overflown_ = 0;
    points.cloud.ghosts = f_.point.size() / 3; // the last ones belong to another rank
    const std::uint32_t own = std::uint32_t(points.cloud.size());
    test(points.cloud, own, name_ + ", ghosts");
    if(f_.point.size() >= 1000)
      CHECK_AT(listed_ > 10 && overflown_ > 2, name_ + ": no row has ghosts, or all have");
  }

private:
  void test(const Sorted_cloud<Backend>& cloud, std::uint32_t own, const std::string& name)
  {
    const Block_rows<Backend> blocks(backend_, cloud);
    const std::vector<Block_row> row = to_vector(backend_, blocks.row);
    const std::vector<Block_entries> entries = to_vector(backend_, blocks.of_point);
    check_equal(entries.size(), std::size_t(own), name + ": number of points");
    check_equal(row.size(), std::size_t((own + 63) / 64), name + ": number of blocks");
    std::vector<Blocks> expected(row.size());
    std::vector<bool> has_ghosts(row.size());
    for(std::uint32_t i = 0; i < own; ++i) {
      expected[i / 64].insert(i / 64);
      f_.for_each_neighbor(i, [&](std::uint32_t j) {
        if(j < own)
          expected[i / 64].insert(j / 64);
        else
          has_ghosts[i / 64] = true;
      });
    }
    for(std::size_t b = 0; b < row.size(); ++b) {
      const std::string where = name + ", block " + std::to_string(b);
      const bool is_listed = !has_ghosts[b] && expected[b].size() <= Block_row::capacity;
      check_equal(row[b].size <= Block_row::capacity, is_listed, where + ": whether its row is listed");
      if(is_listed && row[b].size <= Block_row::capacity) {
        check_equal(std::size_t(row[b].size), expected[b].size(), where + ": number of listed blocks");
        CHECK_AT(Blocks(row[b].block, row[b].block + row[b].size) == expected[b], where + ": listed blocks");
      }
      ++(is_listed ? listed_ : overflown_);
    }
    for(std::uint32_t i = 0; i < own; ++i)
      test_entries(row[i / 64], i, entries[i], name + ", point " + std::to_string(i));
  }

  // Those of its own block and of its neighbors. Where the row is not listed others may be among them.
  void test_entries(const Block_row& row, std::uint32_t i, Block_entries entries, const std::string& where)
  {
    Block_entries expected = 1;
    f_.for_each_neighbor(i, [&](std::uint32_t j) { expected = Block_entries(expected | row.entry(j / 64)); });
    if(row.size <= Block_row::capacity)
      check_equal(entries, expected, where + ": entries");
    else
      CHECK_AT((entries & 1) != 0, where + ": its own entry");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
  int listed_ = 0, overflown_ = 0;
};

// The first block has neighbors in so many other ones. The last one is not full, and its last point has one in the
// first.
void test_capacity(std::uint32_t others)
{
  const std::uint32_t blocks = others + 1, n = 64 * blocks - 20;
  Sequential_backend backend;
  Sorted_cloud<Sequential_backend> cloud;
  cloud.k = 1;
  cloud.point.reset(n);
  cloud.neighbor.reset(n);
  for(std::uint32_t i = 0; i < n; ++i)
    cloud.neighbor[i] = i < 64 ? 64 * (i % blocks) + 1 : i + 1 == n ? 0 : no_index;
  const auto row = to_vector(backend, Block_rows<Sequential_backend>(backend, cloud).row);
  const std::string where = std::to_string(others) + " other blocks";
  check_equal(row.size(), std::size_t(blocks), where + ": number of blocks");
  check_equal(row[0].size, (std::min)(blocks, Block_row::capacity + 1), where + ": size of the row");
  for(std::uint32_t b = 1; b < blocks; ++b)
    CHECK_AT(row[b].block[0] == b && row[b].size == 1 + (b == others) && (b < others || row[b].block[1] == 0),
             where + ": row of block " + std::to_string(b));
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  check_equal(number_of_blocks(0), std::size_t(0), "blocks of no point");
  for(std::size_t n : {std::size_t(1), std::size_t(64)})
    check_equal(number_of_blocks(n), std::size_t(1), "blocks of " + std::to_string(n) + " points");
  check_equal(number_of_blocks(65), std::size_t(2), "blocks of 65 points");
  for(std::uint32_t others : {0u, 1u, 14u, 15u, 40u})
    test_capacity(others);
  test_on_all_backends<Rows>();
}

BOOST_AUTO_TEST_SUITE_END()
