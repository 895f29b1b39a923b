// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// find_neighbors() against brute force, and between the back ends of the host.

#include "testing/checks.h"
#include "testing/neighbor_clouds.h"

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_neighbors)

using namespace CGAL::Tandem::internal;

std::vector<std::uint32_t> brute_force(const Grid_cloud& cloud, std::size_t i, std::size_t k)
{
  std::vector<std::pair<std::int64_t, std::uint32_t>> all; // by squared distance
  for(std::size_t j = 0; j < cloud.size(); ++j) {
    const Grid_point &p = cloud[i], &q = cloud[j];
    const std::int64_t x = std::int64_t(p.x) - q.x, y = std::int64_t(p.y) - q.y, z = std::int64_t(p.z) - q.z;
    if(j != i)
      all.emplace_back(x * x + y * y + z * z, std::uint32_t(j));
  }
  const std::size_t found = (std::min)(all.size(), k);
  std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(found), all.end());
  std::vector<std::uint32_t> row(k, no_index);
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
BOOST_AUTO_TEST_CASE(rows)
{
  on_neighbor_clouds([](const std::string& name, const Grid_cloud& cloud, int k, std::size_t stride) {
    const std::string where = name + ", k = " + std::to_string(k);
    const std::vector<std::uint32_t> found = neighbors<Sequential_backend>(cloud, k);
    CHECK_AT(neighbors<Tbb_backend>(cloud, k) == found, where);
    for(std::size_t i = 0; i < cloud.size(); i += stride) {
      const std::vector<std::uint32_t> expected = brute_force(cloud, i, std::size_t(k));
      CHECK_AT(std::equal(expected.begin(), expected.end(), found.begin() + std::ptrdiff_t(i * std::size_t(k))),
               where + ": neighbors of point " + std::to_string(i));
    }
  });
}

BOOST_AUTO_TEST_SUITE_END()
