// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// find_neighbors_cuda() finds the rows of find_neighbors(), on the clouds of
// test_neighbors and on large ones in which most points are queried in packets.

#undef NDEBUG

#include "testing/cuda_device.h"
#include "testing/neighbor_clouds.h"

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/cuda/neighbors/Cuda_neighbors.cuh>

#include <cstdio>

using namespace CGAL::Tandem::internal;

namespace {

constexpr std::uint32_t untouched = 12345u;
int failures = 0;

void check_cuda(cudaError_t error)
{
  if(error == cudaSuccess)
    return;
  std::fprintf(stderr, "CUDA: %s\n", cudaGetErrorString(error));
  std::exit(EXIT_FAILURE);
}

// Memory that holds garbage before and after.
template <class T>
class Device_table {
public:
  explicit Device_table(std::size_t size) : size_(size)
  {
    check_cuda(cudaMalloc(&data_, (size + 1) * sizeof(T)));
    check_cuda(cudaMemset(data_, 0x5b, (size + 1) * sizeof(T)));
  }

  Device_table(const Device_table&) = delete;
  Device_table& operator=(const Device_table&) = delete;
  ~Device_table() { check_cuda(cudaFree(data_)); }

  T* data() { return data_; }
  void write(const T* source) { check_cuda(cudaMemcpy(data_, source, size_ * sizeof(T), cudaMemcpyHostToDevice)); }

  std::vector<T> read()
  {
    std::vector<T> copy(size_);
    check_cuda(cudaMemcpy(copy.data(), data_, size_ * sizeof(T), cudaMemcpyDeviceToHost));
    return copy;
  }

private:
  T* data_ = nullptr;
  std::size_t size_;
};

std::vector<std::uint32_t> device_neighbors(const Grid_cloud& cloud, int k)
{
  const std::uint32_t n = std::uint32_t(cloud.size());
  Device_table<Grid_point> point(n);
  Device_table<std::uint32_t> out(n * std::size_t(k) + 1);
  Device_table<unsigned char> scratch(neighbor_scratch_bytes(n));
  point.write(cloud.data());
  std::vector<std::uint32_t> rows(n * std::size_t(k) + 1, untouched);
  out.write(rows.data());
  find_neighbors_cuda({point.data(), n, k, out.data()}, scratch.data(), nullptr);
  rows = out.read();
  if(rows.back() != untouched) {
    ++failures;
    std::fprintf(stderr, "n = %u, k = %d: wrote past the end\n", n, k);
  }
  rows.pop_back();
  return rows;
}

void check(const std::string& name, const Grid_cloud& cloud, int k, std::size_t)
{
  Sequential_backend host;
  std::vector<std::uint32_t> expected(cloud.size() * std::size_t(k));
  find_neighbors(host, cloud.data(), std::uint32_t(cloud.size()), k, expected.data());
  const std::vector<std::uint32_t> found = device_neighbors(cloud, k);
  for(std::size_t at = 0; at < expected.size(); ++at)
    if(found[at] != expected[at]) {
      ++failures;
      std::fprintf(stderr, "%s, n = %zu, k = %d: neighbor %zu of point %zu is %u, not %u\n", name.c_str(), cloud.size(),
                   k, at % std::size_t(k), at / std::size_t(k), found[at], expected[at]);
      return;
    }
}

// Faces with noise, edges between them, outliers, and a fifth of the points twice.
void test_large_clouds()
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
  for(int k : {1, 3, 8, 9, 12, 13, 16, 17, 20, 21, 32, 33, 64})
    check("a noisy box", cloud, k, 1);
}

} // namespace

int main()
{
  if(!has_device())
    return exit_skipped;
  test_large_clouds();
  on_neighbor_clouds(check);
  if(failures > 0)
    std::fprintf(stderr, "test_cuda_neighbors: %d failures\n", failures);
  return failures > 0;
}
