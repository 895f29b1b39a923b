// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// find_neighbors() against brute force, and between the back ends of the host.

#include "testing/checks.h"
#include "testing/neighbor_clouds.h"

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>

#include <cstdio>

BOOST_AUTO_TEST_SUITE(test_neighbors)

using namespace CGAL::Tandem::internal;

namespace {

std::uint64_t squared_distance(const Grid_point& p, const Grid_point& q)
{
  const std::int64_t x = std::int64_t(p.x) - q.x, y = std::int64_t(p.y) - q.y, z = std::int64_t(p.z) - q.z;
  return std::uint64_t(x * x + y * y + z * z);
}

std::vector<std::uint32_t> brute_force(const Grid_cloud& cloud, std::size_t i, int k)
{
  std::vector<std::pair<std::uint64_t, std::uint32_t>> all;
  for(std::size_t j = 0; j < cloud.size(); ++j)
    if(j != i)
      all.emplace_back(squared_distance(cloud[i], cloud[j]), std::uint32_t(j));
  const std::size_t found = (std::min)(all.size(), std::size_t(k));
  std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(found), all.end());
  std::vector<std::uint32_t> row(std::size_t(k), no_index);
  for(std::size_t j = 0; j < found; ++j)
    row[j] = all[j].second;
  return row;
}

template <class Backend>
std::vector<std::uint32_t> neighbors(const Grid_cloud& cloud, int k)
{
  Backend backend;
  std::vector<std::uint32_t> out(cloud.size() * std::size_t(k) + 1, 12345u);
  find_neighbors(backend, cloud.data(), std::uint32_t(cloud.size()), k, out.data());
  CHECK_AT(out.back() == 12345u, "wrote past the end, k = " + std::to_string(k));
  out.pop_back();
  return out;
}

// Rows `stride` apart are compared with brute force, all of them between the back ends.
void check_rows(const std::string& name, const Grid_cloud& cloud, int k, std::size_t stride)
{
  const std::vector<std::uint32_t> found = neighbors<Sequential_backend>(cloud, k);
  CHECK_AT(neighbors<Tbb_backend>(cloud, k) == found, name + ", k = " + std::to_string(k));
  for(std::size_t i = 0; i < cloud.size(); i += stride) {
    const std::vector<std::uint32_t> expected = brute_force(cloud, i, k);
    for(std::size_t j = 0; j < std::size_t(k); ++j)
      if(found[i * std::size_t(k) + j] != expected[j])
        return fail(name + ", k = " + std::to_string(k) + ": neighbor " + std::to_string(j) + " of point " +
                    std::to_string(i));
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(all_cases) { on_neighbor_clouds(check_rows); }

BOOST_AUTO_TEST_SUITE_END()
