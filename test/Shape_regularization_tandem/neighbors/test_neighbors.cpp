// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// find_neighbors() against brute force, and between the back ends of the host.

#undef NDEBUG

#include "testing/neighbor_clouds.h"

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>

#include <cstdio>

using namespace CGAL::Tandem::internal;

namespace {

int failures = 0;

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
  if(out.back() != 12345u) {
    ++failures;
    std::fprintf(stderr, "n = %zu, k = %d: wrote past the end\n", cloud.size(), k);
  }
  out.pop_back();
  return out;
}

// Rows `stride` apart are compared with brute force, all of them between the back ends.
void check(const std::string& name, const Grid_cloud& cloud, int k, std::size_t stride)
{
  const std::vector<std::uint32_t> found = neighbors<Sequential_backend>(cloud, k);
  if(neighbors<Tbb_backend>(cloud, k) != found) {
    ++failures;
    std::fprintf(stderr, "%s, k = %d: Sequential and TBB differ\n", name.c_str(), k);
  }
  for(std::size_t i = 0; i < cloud.size(); i += stride) {
    const std::vector<std::uint32_t> expected = brute_force(cloud, i, k);
    for(std::size_t j = 0; j < std::size_t(k); ++j)
      if(found[i * std::size_t(k) + j] != expected[j]) {
        ++failures;
        std::fprintf(stderr, "%s, n = %zu, k = %d: neighbor %zu of point %zu is %u, not %u\n", name.c_str(),
                     cloud.size(), k, j, i, found[i * std::size_t(k) + j], expected[j]);
        return;
      }
  }
}

} // namespace

int main()
{
  on_neighbor_clouds(check);
  if(failures > 0)
    std::fprintf(stderr, "test_neighbors: %d failures\n", failures);
  return failures > 0;
}
