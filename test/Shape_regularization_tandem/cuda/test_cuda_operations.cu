// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The operations of the back end on the device, the table of links, which all lanes fill at the same time, and the
// grouping of points by shape.

#undef NDEBUG

#include "testing/cuda_device.h"
#include "testing/backend_operations.h"
#include "testing/link_sets.h"

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/cuda/execution/Cuda_backend.cuh>
#include <CGAL/Tandem/internal/cuda/stages/Cuda_stages.cuh>
#include <CGAL/Tandem/internal/result/group_points.h>

#include <algorithm>
#include <cstdio>
#include <random>

using namespace CGAL::Tandem::internal;

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

int main()
{
  if(!has_device())
    return exit_skipped;
  Cuda_backend cuda;
  std::vector<std::string> wrong = Backend_operations<Cuda_backend>(cuda).run();
  for(const std::string& what : Link_sets<Cuda_backend>(cuda).run())
    wrong.push_back(what);
  if(!runs_small_loops(cuda))
    wrong.push_back("small loops");
  for(std::size_t points : {std::size_t(0), std::size_t(1), std::size_t(200000)})
    for(std::size_t shapes :
        {std::size_t(0), std::size_t(1), std::size_t(65535), std::size_t(65536), std::size_t(70000)})
      if(!groups_as_host(cuda, points, shapes))
        wrong.push_back(std::to_string(points) + " points of " + std::to_string(shapes) + " shapes");
  for(const std::string& what : wrong)
    std::fprintf(stderr, "wrong: %s\n", what.c_str());
  std::printf("%zu failures\n", wrong.size());
  return !wrong.empty();
}
