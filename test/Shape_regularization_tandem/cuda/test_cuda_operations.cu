// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is compiled for the device, beside the host: the operations of the back end, the sorting of ranges, the grouping
// of points by shape, and neighbors, on the clouds of test_neighbors and on large ones in which most points are queried in
// packets.

#undef NDEBUG

#include "testing/backend_operations.h"
#include "testing/neighbor_clouds.h"

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/cuda/execution/Cuda_backend.cuh>
#include <CGAL/Tandem/internal/cuda/neighbors/Cuda_neighbors.cuh>
#include <CGAL/Tandem/internal/cuda/stages/Cuda_stages.cuh>
#include <CGAL/Tandem/internal/result/group_points.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <random>

using namespace CGAL::Tandem::internal;

int failures = 0;

void check(bool is_right, const std::string& what)
{
  if(is_right)
    return;
  ++failures;
  std::fprintf(stderr, "wrong: %s\n", what.c_str());
}

// The same groups as on the host. Some points have no shape, and some shapes no point. More shapes than keys of 16 bits
// can tell need longer ones.
bool groups_as_host(Cuda_backend& cuda, std::size_t points, std::size_t shapes)
{
  std::mt19937 random(std::uint32_t(points + shapes));
  std::vector<std::int32_t> shape_of(points);
  for(std::int32_t& s : shape_of)
    s = random() % 4 == 0 ? -1 : std::int32_t(random() % (shapes + 1)) - 1;
  if(points > 0 && shapes > 0)
    shape_of.back() = std::int32_t(shapes) - 1;
  Sequential_backend host;
  const auto expected = group_points(host, shape_of.data(), points, shapes);
  Engine_result result;
  Stage_overrides<Cuda_backend>::group_points(cuda, to_buffer(cuda, shape_of), shapes, result);
  return result.points.first == expected.first && result.shape_of.size() == points &&
         std::equal(shape_of.begin(), shape_of.end(), result.shape_of.begin()) &&
         result.points.position.size() == expected.position.size() &&
         std::equal(expected.position.begin(), expected.position.end(), result.points.position.begin());
}

struct Add_items {
  const std::uint32_t* source;
  std::uint32_t* target;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { target[i] += source[i]; }
};

// More loops than one launch takes, of buffers that end before their loop is launched, so that the next ones have their
// memory.
bool runs_small_loops(Cuda_backend& cuda)
{
  const std::size_t n = 1000;
  auto sum = filled_buffer(cuda, n, std::uint32_t(0));
  for(std::uint32_t k = 0; k < 500; ++k) {
    const auto items = filled_buffer(cuda, n, k);
    cuda.for_each(n, Add_items{items.data(), sum.data()});
  }
  const std::vector<std::uint32_t> result = to_vector(cuda, sum);
  return std::count(result.begin(), result.end(), 500u * 499 / 2) == std::ptrdiff_t(n);
}

// Ranges of these sizes, one after the other, of keys below `keys`; every tenth is the largest there is.
bool is_sorted_alike(Cuda_backend& cuda, const std::vector<std::uint32_t>& sizes, std::uint64_t keys,
                     std::size_t largest)
{
  std::mt19937_64 random(7);
  std::vector<Range> ranges;
  for(std::uint32_t size : sizes) {
    const std::uint32_t first = ranges.empty() ? 0 : ranges.back().last;
    ranges.push_back({first, first + size});
  }
  std::vector<std::uint64_t> key(ranges.empty() ? 0 : ranges.back().last);
  for(std::uint64_t& k : key)
    k = random() % 10 == 0 ? ~std::uint64_t(0) : random() % keys;
  Device_buffer<std::uint64_t> keys_there = to_buffer(cuda, key);
  const Device_buffer<Range> ranges_there = to_buffer(cuda, ranges);
  cuda.sort_ranges(keys_there.data(), ranges_there.data(), ranges.size(), key.size(), largest);
  const std::vector<std::uint64_t> sorted = to_vector(cuda, keys_there.data(), key.size());

  for(const Range& r : ranges)
    std::sort(key.begin() + r.first, key.begin() + r.last);
  return sorted == key;
}

void check_sorting(Cuda_backend& cuda)
{
  std::vector<std::uint32_t> many(300);
  std::iota(many.begin(), many.end(), 1);
  for(const std::vector<std::uint32_t>& sizes :
      {std::vector<std::uint32_t>{}, {1}, {4095, 4096, 4097, 1, 8191, 8192}, {8193, 20000, 3, 65535, 65536}, many})
    for(std::uint64_t keys : {std::uint64_t(1), std::uint64_t(5), ~std::uint64_t(0)}) {
      const std::size_t most = sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end());
      for(std::size_t largest : {most, most + 1, std::size_t(65536)})
        check(is_sorted_alike(cuda, sizes, keys, largest),
              std::to_string(sizes.size()) + " ranges of up to " + std::to_string(most) + " keys");
    }
}

// The device has each cell once in whatever order they begin.
void check_searches()
{
  std::vector<Range> expected(45); // as many cells as there are, of other sizes
  for(std::uint32_t c = 0; c < expected.size(); ++c)
    expected[c] = {0, c * 7 % 11};
  for(std::uint32_t start : search_starts)
    for(std::uint32_t most : search_sizes) {
      Cuda_backend cuda;
      cuda.expect_cells(to_buffer(cuda, expected));
      check(count_wrong_searches(cuda, start, most) == 0, "searches for " + std::to_string(most) + " items");
    }
}

// The scratch holds garbage, and what is behind the rows stays as it is.
void check_neighbors(Cuda_backend& cuda, const std::string& name, const Grid_cloud& cloud, int k)
{
  constexpr std::uint32_t untouched = 12345u;
  const std::uint32_t n = std::uint32_t(cloud.size());
  std::vector<std::uint32_t> expected(n * std::size_t(k) + 1, untouched);
  Sequential_backend host;
  find_neighbors(host, cloud.data(), n, k, expected.data());
  const auto point = to_buffer(cuda, cloud);
  auto out = filled_buffer(cuda, expected.size(), untouched);
  auto scratch = filled_buffer(cuda, neighbor_scratch_bytes(n), (unsigned char)0x5b);
  cuda.wait();
  find_neighbors_cuda({point.data(), n, k, out.data()}, scratch.data(), nullptr);
  check(cudaDeviceSynchronize() == cudaSuccess && to_vector(cuda, out) == expected,
        name + ": neighbors of " + std::to_string(n) + " points, k = " + std::to_string(k));
}

// Faces with noise, edges between them, outliers, and a fifth of the points twice.
Grid_cloud noisy_box()
{
  Twister random(5);
  auto any = [&](std::int32_t r) { return uniform(random, -r, r); };
  Grid_cloud cloud = make_cloud(150000, [&](std::size_t i) {
    const std::int32_t r = 1 << 18;
    if(i % 50 == 0)
      return Grid_point{any(2 * r), any(2 * r), any(2 * r), 0};
    std::int32_t c[3] = {any(r), any(r), any(r)};
    c[i % 3] = (i % 2 ? r : -r) + any(200);
    return Grid_point{c[0], c[1], c[2], 0};
  });
  cloud.insert(cloud.end(), cloud.begin(), cloud.begin() + 30000);
  sort_along_curve(cloud);
  return cloud;
}

int main()
{
  int devices = 0;
  if(cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
    std::printf("skipped: no CUDA device\n");
    return 77;
  }
  Cuda_backend cuda;
  for(const std::string& what : Backend_operations<Cuda_backend>(cuda).run())
    check(false, what);
  check(runs_small_loops(cuda), "small loops");
  for(std::size_t points : {0, 1, 200000})
    for(std::size_t shapes : {0, 1, 65535, 65536, 70000})
      check(groups_as_host(cuda, points, shapes),
            std::to_string(points) + " points of " + std::to_string(shapes) + " shapes");
  check_sorting(cuda);
  check_searches();
  const Grid_cloud box = noisy_box();
  for(int k : {1, 3, 8, 9, 12, 13, 16, 17, 20, 21, 32, 33, 64})
    check_neighbors(cuda, "a noisy box", box, k);
  on_neighbor_clouds([&](const std::string& name, const Grid_cloud& cloud, int k, std::size_t) {
    check_neighbors(cuda, name, cloud, k);
  });
  std::printf("%d failures\n", failures);
  return failures != 0;
}
