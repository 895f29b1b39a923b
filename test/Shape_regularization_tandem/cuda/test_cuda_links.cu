// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The device sums links as the host does, few and many.

#undef NDEBUG

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/cuda/stages/Cuda_links.cuh>

#include <cstdio>
#include <random>

using namespace CGAL::Tandem::internal;

// Links of which pairs have about `repeats`, most of them one relation.
Link_list random_links(std::size_t n, std::uint32_t ids, std::size_t repeats)
{
  std::mt19937 random(5);
  Link_list pairs(n / repeats + 1);
  for(Link& link : pairs) {
    std::uint64_t a = random() % (ids - 1), b = a + 1 + random() % (ids - 1 - a);
    link = {a << 32 | b, 0};
  }
  Link_list links(n);
  for(Link& link : links)
    link = {pairs[random() % pairs.size()].pair, random() % 4 == 0 ? std::uint32_t(random() % 1000) : 1u};
  return links;
}

bool is_same(const Link_list& a, const Link_list& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Link& x, const Link& y) { return x.pair == y.pair && x.count == y.count; });
}

int main()
{
  int devices = 0;
  if(cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
    std::printf("skipped: no CUDA device\n");
    return 77;
  }
  int failures = 0;
  Cuda_backend cuda;
  Sequential_backend host;
  for(std::size_t n : {0, 1, 100, 4095, 4096, 5000, 300000})
    for(std::uint32_t ids : {2u, 50u, 8192u, 0xffffffffu})
      for(std::uint32_t minimum : {1u, 2u, 700u, 0xffffffffu}) {
        const Link_list links = random_links(n, ids, 3);
        Device_buffer<Link> buffer(n);
        cuda.from_host(links.data(), n, buffer.data());
        const Link_list expected = sum_links_on_host(host, links.data(), n, minimum);
        if(is_same(sum_links_cuda(cuda, buffer.data(), n, ids, minimum), expected))
          continue;
        std::fprintf(stderr, "%zu links of %u ids with at least %u relations differ\n", n, ids, minimum);
        ++failures;
      }
  std::printf("%d failures\n", failures);
  return failures != 0;
}
