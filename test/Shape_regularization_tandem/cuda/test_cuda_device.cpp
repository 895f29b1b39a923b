// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuda_tag as a guest of its process: several threads, the current device, memory that
// is kept and given back, memory that is too small.
// After -- an argument RUNS: that so many runs do not lose memory.

#include "testing/cuda_support.h"

#include <CGAL/Tandem/internal/cuda/runtime/Loop_queue.cuh>

#include <cuda_runtime_api.h>

#include <cstdlib>
#include <thread>

// The first context is that of the last device, for the first case.
boost::test_tools::assertion_result has_last_device(boost::unit_test::test_unit_id id)
{
  int devices = 0;
  if(cudaGetDeviceCount(&devices) == cudaSuccess && devices > 1)
    static_cast<void>(cudaSetDevice(devices - 1));
  return has_device(id);
}

BOOST_AUTO_TEST_SUITE(test_cuda_device, *boost::unit_test::precondition(has_last_device))

using CGAL::Tandem::Cuda_if_available_tag;

std::size_t free_memory()
{
  std::size_t free = 0, total = 0;
  CHECK(cudaMemGetInfo(&free, &total) == cudaSuccess);
  return free;
}

int number_of_devices()
{
  int devices = 0;
  CHECK(cudaGetDeviceCount(&devices) == cudaSuccess);
  return devices;
}

// The last device is used, and that alone: the first of several has no context afterwards, of any thread. The first
// case, before something else has made one.
BOOST_AUTO_TEST_CASE(last_device)
{
  const int last = number_of_devices() - 1;
  const Cloud cloud = make_cloud("house", 300000);
  const Parameters parameters = make_parameters(.05, 100);
  CHECK(cudaSetDevice(last) == cudaSuccess);
  CHECK(detect<Cuda_tag>(cloud, parameters).hash() == detect(cloud, parameters).hash());
  CHECK(CGAL::Tandem::internal::has_context(last));
  CHECK(last == 0 || !CGAL::Tandem::internal::has_context(0));
  CHECK(cudaSetDevice(0) == cudaSuccess);
}

// All at the same time, each thread with a cloud of its own and once with the first, and on all devices.
BOOST_AUTO_TEST_CASE(threads_at_once)
{
  constexpr std::size_t number = 6;
  const char* names[number] = {"house", "village", "indoor", "part", "cube", "staircase"};
  const Parameters parameters = make_parameters(.03, 40);
  std::vector<Cloud> clouds;
  std::vector<std::uint64_t> expected;
  for(const char* name : names) {
    clouds.push_back(make_cloud(name, 20000));
    expected.push_back(detect(clouds.back(), parameters).hash());
  }
  std::vector<int> wrong(number, 0);
  std::vector<std::thread> threads;
  for(std::size_t t = 0; t < number; ++t)
    threads.emplace_back([&, t, device = int(t) % number_of_devices()] {
      wrong[t] += cudaSetDevice(device) != cudaSuccess;
      for(int run = 0; run < 4; ++run) {
        wrong[t] += detect<Cuda_tag>(clouds[t], parameters).hash() != expected[t];
        wrong[t] += detect<Cuda_tag>(clouds[0], parameters).hash() != expected[0];
      }
    });
  for(std::thread& thread : threads)
    thread.join();
  for(std::size_t t = 0; t < number; ++t)
    check_equal(wrong[t], 0, "wrong results of thread " + std::to_string(t));
}

// A detection that is made by one thread, on the last device, and finished by another one. The current device stays what
// it was.
BOOST_AUTO_TEST_CASE(moves_between_threads)
{
  const Cloud cloud = make_cloud("house", 20000);
  const auto list = CGAL::Tandem::parameters::settings(make_parameters(.05, 40))
                      .point_map(First<Kernel>())
                      .normal_map(Second<Kernel>());
  using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Second<Kernel>, Cuda_tag>;
  CHECK(cudaSetDevice(number_of_devices() - 1) == cudaSuccess);
  CGAL::Tandem::Planar_shape_detection_3<Traits> detection(cloud, list);
  CHECK(cudaSetDevice(0) == cudaSuccess);
  int device_of_thread = -1;
  std::thread([&] {
    detection.detect();
    CHECK(cudaGetDevice(&device_of_thread) == cudaSuccess);
  }).join();
  check_equal(device_of_thread, 0, "device of a thread that has chosen none, where the first one is in use");
  CHECK(detection.shapes().hash() == detect(cloud, make_parameters(.05, 40)).hash());
  int device = -1;
  CHECK(cudaGetDevice(&device) == cudaSuccess && device == 0 && cudaGetLastError() == cudaSuccess);
}

// No memory is lost, also where a map fails in the middle of the upload, and where a callback throws between rounds. The
// first runs find out how much is kept.
BOOST_AUTO_TEST_CASE(many_runs)
{
  const int runs = (std::max)(int(argument(1, 30)), 11);
  const Cloud cloud = make_cloud("house", 20000);
  const Parameters parameters = make_parameters(.05, 40);
  const std::uint64_t expected = detect(cloud, parameters).hash();
  const auto settings = CGAL::Tandem::parameters::settings(parameters).normal_map(Second<Kernel>());
  const auto fail_in_upload = [&] {
    const Failing_map map = {&cloud[cloud.size() / 2], [] { throw std::domain_error("no such point"); }};
    CGAL::Tandem::detect_planes<Cuda_tag>(cloud, settings.point_map(map));
  };
  const auto fail_between_rounds = [&] {
    int calls = 0;
    const CGAL::Tandem::Callback callback = [&](double) -> bool {
      return ++calls < 4 ? true : throw std::domain_error("no more");
    };
    CGAL::Tandem::detect_planes<Cuda_tag>(cloud, settings.point_map(First<Kernel>()).callback(callback));
  };
  std::size_t settled = 0;
  for(int run = 0; run < runs; ++run) {
    check_throws<std::domain_error>(fail_in_upload, {"no such point"}, __LINE__);
    check_throws<std::domain_error>(fail_between_rounds, {"no more"}, __LINE__);
    detect<Cuda_tag>(cloud, parameters, Given::nothing);
    CHECK_AT(detect<Cuda_tag>(cloud, parameters).hash() == expected, "run " + std::to_string(run));
    if(run == 9)
      settled = free_memory();
  }
  check_equal(free_memory(), settled, "free memory after " + std::to_string(runs) + " runs");
}

// What a run keeps for the next one is given back, as often as asked for.
BOOST_AUTO_TEST_CASE(release)
{
  const Cloud cloud = make_cloud("village", 300000);
  CGAL::Tandem::internal::release_cuda_memory();
  const Shapes first = detect<Cuda_tag>(cloud, make_parameters(.05, 100));
  const std::size_t before = free_memory();
  CGAL::Tandem::internal::release_cuda_memory();
  const std::size_t released = free_memory();
  CHECK_AT(released > before, std::to_string(before) + " bytes free before release_cuda_memory()");
  CGAL::Tandem::internal::release_cuda_memory();
  check_equal(free_memory(), released, "free memory after the second release_cuda_memory()");
  CHECK(detect<Cuda_tag>(cloud, make_parameters(.05, 100)).hash() == first.hash());
}

// Another user of the device leaves less memory than the tables of cells and shapes need.
BOOST_AUTO_TEST_CASE(too_large_cloud)
{
  const Cloud cloud = make_cloud("house", 120000);
  const Parameters parameters = make_parameters(.05, 100);
  const std::uint64_t expected = detect(cloud, parameters).hash();
  CGAL::Tandem::internal::release_cuda_memory();
  const std::size_t left = std::size_t(24) << 20;
  void* block = nullptr;
  CHECK(free_memory() > left && cudaMalloc(&block, free_memory() - left) == cudaSuccess);
  check_throws<std::length_error>([&] { detect<Cuda_tag>(cloud, parameters); },
                                  {"the cloud has 120000 points", "the CUDA device has memory for", "k_neighbors"},
                                  __LINE__);
  const Shapes on_host = detect<Cuda_if_available_tag>(cloud, parameters);
  CHECK(on_host.hash() == expected && on_host.statistics().backend != std::string("cuda"));
  CHECK(cudaFree(block) == cudaSuccess);
  const Shapes on_device = detect<Cuda_if_available_tag>(cloud, parameters);
  CHECK(on_device.hash() == expected && on_device.statistics().backend == std::string("cuda"));
}

BOOST_AUTO_TEST_SUITE_END()
