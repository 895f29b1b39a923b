// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a detection asks of a device: not more launches and waits than today, and in the rounds the loops that the host
// has. A change that makes fewer lowers the bounds.

#include "testing/cuda_support.h"
#include "testing/work.h"

BOOST_AUTO_TEST_SUITE(test_cuda_work)

using CGAL::Tandem::Stage_work;
using CGAL::Tandem::Work;

// All three parts together, about 5 % above the present numbers.
constexpr std::size_t most_launches = 540, most_waits = 130;

std::size_t launches(const Stage_work& work)
{
  return work.prepare.launches + work.rounds.launches + work.finish.launches;
}

void print(const Work& w, const std::string& stage)
{
  std::cout << stage << ": " << w.passes_over_points << " passes over points, " << w.loops_over_shapes
            << " loops over shapes, " << w.launches << " launches, " << w.waits << " waits, " << w.bytes_copied
            << " bytes" << std::endl;
}

void test_work(std::size_t points, Given given)
{
  const std::string name = std::to_string(points) + (given == Given::normals ? " points" : " points, own normals");
  const Cloud cloud = make_cloud("indoor", points);
  const Parameters parameters = make_parameters(.02, 60);
  detect<Cuda_tag>(cloud, parameters, given); // the first one also asks for the address of each small loop
  const Shapes device = detect<Cuda_tag>(cloud, parameters, given), host = detect(cloud, parameters, given);
  CHECK_AT(device.hash() == host.hash(), name);
  const Stage_work &work = device.statistics().work, &expected = host.statistics().work;
  const auto& [prepare, rounds, finish] = work;
  print(prepare, name + ", preparation");
  print(rounds, name + ", rounds");
  print(finish, name + ", end");
  check_same_loops(rounds, expected.rounds, name + ", rounds");
  // What the host does alone, such as filling buffers, is no launch here, but a few stages have kernels of their own.
  check_at_most(double(rounds.launches), double(expected.rounds.launches), name + ", rounds: launches");
  check_at_most(double(launches(work)), double(launches(expected) + 40), name + ": launches beside the host");
  check_at_most(double(launches(work)), most_launches, name + ": launches");
  check_at_most(double(prepare.waits + rounds.waits + finish.waits), most_waits, name + ": waits");
  for(const Work* w : {&prepare, &rounds, &finish})
    CHECK_AT(w->launches > 0 && w->waits > 0 && w->bytes_copied > 0, name);
  // Coordinates go to the device, and labels come back; in a round, less than the labels is copied.
  CHECK_AT(prepare.bytes_copied >= 3 * sizeof(float) * points, name);
  CHECK_AT(finish.bytes_copied >= sizeof(std::int32_t) * points, name);
  check_at_most(double(rounds.bytes_copied),
                double(sizeof(std::int32_t) * points * device.statistics().number_of_rounds), name + ", rounds: bytes");
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
