# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Micro-benchmarks of single stages, built where Google Benchmark is found (Debian:
# libbenchmark-dev; libnanoflann-dev adds nanoflann to those of the neighbors).

find_package(benchmark QUIET)
if(NOT TARGET benchmark::benchmark)
  message(STATUS "Google Benchmark was not found: no micro-benchmarks")
  return()
endif()
find_path(TANDEM_NANOFLANN_INCLUDE_DIR nanoflann.hpp)
if(NOT TANDEM_NANOFLANN_INCLUDE_DIR)
  message(STATUS "nanoflann was not found: micro_neighbors compares with CGAL only")
endif()
get_filename_component(tandem_include "${CMAKE_CURRENT_LIST_DIR}/../../include" ABSOLUTE)

foreach(program micro_neighbors micro_normals micro_growth micro_regularity)
  add_executable(${program} "${CMAKE_CURRENT_LIST_DIR}/${program}.cpp")
  target_compile_features(${program} PRIVATE cxx_std_17)
  target_include_directories(${program} PRIVATE "${tandem_include}")
  target_compile_options(${program} PRIVATE -Wall -Wextra)
  target_link_libraries(${program} PRIVATE CGAL::CGAL benchmark::benchmark)
  foreach(library CGAL::Eigen3_support CGAL::TBB_support)
    if(TARGET ${library})
      target_link_libraries(${program} PRIVATE ${library})
    endif()
  endforeach()
endforeach()
if(TANDEM_NANOFLANN_INCLUDE_DIR)
  target_compile_definitions(micro_neighbors PRIVATE TANDEM_MICRO_NANOFLANN)
  target_include_directories(micro_neighbors SYSTEM PRIVATE "${TANDEM_NANOFLANN_INCLUDE_DIR}")
endif()
