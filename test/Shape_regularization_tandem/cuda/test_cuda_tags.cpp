// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tags of the CUDA back end where there is a device, where there is none, and
// where the library is not linked: Cuda_if_available_tag works everywhere.

#include "testing/cuda_support.h"

struct Cube {
  const Cloud cloud = make_cloud("cube", 6000);
  const Parameters parameters = make_parameters(.02, 40);
};

BOOST_FIXTURE_TEST_SUITE(test_cuda_tags, Cube)

using CGAL::Tandem::Cuda_if_available_tag;

BOOST_AUTO_TEST_CASE(if_available)
{
  const std::string expected = CGAL::Tandem::cuda_available()
                                 ? "cuda"
                                 : CGAL::Tandem::internal::Backend_of<CGAL::Parallel_if_available_tag>::type::name();
  for(Given given : {Given::normals, Given::nothing}) {
    const Shapes shapes = detect<Cuda_if_available_tag>(cloud, parameters, given);
    CHECK_AT(shapes.statistics().backend == expected, shapes.statistics().backend);
    check_same(shapes, detect(cloud, parameters, given), "Cuda_if_available_tag");
    CHECK(shapes.number_of_shapes() >= 6);
  }
}

BOOST_AUTO_TEST_CASE(report_of_device)
{
  const std::string report = CGAL::Tandem::cuda_device_report();
#ifdef CGAL_TANDEM_USE_CUDA
  const char* words = CGAL::Tandem::cuda_available() ? "compute capability" : "no CUDA device";
#else
  const char* words = "built without CUDA";
  CHECK(!CGAL::Tandem::cuda_available());
#endif
  CHECK_AT(report.find(words) != std::string::npos, report);
}

#ifdef CGAL_TANDEM_USE_CUDA
BOOST_AUTO_TEST_CASE(without_device)
{
  if(!CGAL::Tandem::cuda_available())
    check_throws<std::runtime_error>([&] { detect<CGAL::Tandem::Cuda_tag>(cloud, parameters); },
                                     {"Cuda_tag", "no CUDA device", "Cuda_if_available_tag"}, __LINE__);
}
#endif

BOOST_AUTO_TEST_SUITE_END()
