// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a detection asks of a device: not more launches, waits and copied bytes than today. A change that makes fewer
// lowers the bounds.

#include "testing/cuda_support.h"

#include <CGAL/Tandem/internal/cuda/interface/cuda_api.h>

BOOST_AUTO_TEST_SUITE(test_cuda_work)

// About 5 % above the present numbers.
constexpr std::uint64_t most_launches = 626, most_waits = 93, most_bytes_of_point = 112;

void test_work(std::size_t points, Given given)
{
  using CGAL::Tandem::internal::cuda_work_of_thread;
  const std::string name = std::to_string(points) + (given == Given::normals ? " points" : " points, own normals");
  const Cloud cloud = make_cloud("indoor", points);
  const Parameters parameters = make_parameters(.02, 60);
  detect<Cuda_tag>(cloud, parameters, given); // the first one also asks for the address of each small loop
  const auto before = cuda_work_of_thread();
  const Shapes device = detect<Cuda_tag>(cloud, parameters, given);
  const auto after = cuda_work_of_thread();
  CHECK_AT(device.hash() == detect(cloud, parameters, given).hash(), name);
  const std::uint64_t launches = after.launches - before.launches, waits = after.waits - before.waits,
                      bytes = after.bytes_copied - before.bytes_copied;
  const std::string found = name + ": " + std::to_string(launches) + " launches, " + std::to_string(waits) +
                            " waits, " + std::to_string(bytes) + " bytes";
  std::cout << found << std::endl;
  CHECK_AT(launches > 0 && launches <= most_launches, found);
  CHECK_AT(waits > 0 && waits <= most_waits, found);
  // Coordinates go to the device, and labels come back.
  CHECK_AT(bytes >= (3 * sizeof(float) + sizeof(std::int32_t)) * points, found);
  CHECK_AT(bytes <= most_bytes_of_point * points, found);
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  if(!has_device())
    return;
  for(const std::size_t points : {20000, 200000})
    for(const Given given : {Given::normals, Given::nothing})
      test_work(points, given);
}

BOOST_AUTO_TEST_SUITE_END()
