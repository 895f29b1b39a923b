# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Micro-benchmarks of single stages, built where Google Benchmark is found (Debian:
# libbenchmark-dev; libnanoflann-dev adds nanoflann to those of the neighbors).
# The target micro_benchmarks, which is there in any case, builds what can be built.

add_custom_target(micro_benchmarks)
find_package(benchmark QUIET)
if(NOT TARGET benchmark::benchmark)
  message(STATUS "Google Benchmark was not found: no micro-benchmarks")
  return()
endif()
find_path(TANDEM_NANOFLANN_INCLUDE_DIR nanoflann.hpp)
if(NOT TANDEM_NANOFLANN_INCLUDE_DIR)
  message(STATUS "nanoflann was not found: micro_neighbors compares with CGAL only")
endif()

foreach(program micro_neighbors micro_normals micro_growth micro_regularity)
  tandem_add_program(${program} micro/${program}.cpp)
  tandem_share_testing(${program})
  tandem_share_engine(${program})
  target_link_libraries(${program} PRIVATE benchmark::benchmark)
  add_dependencies(micro_benchmarks ${program})
endforeach()
if(TANDEM_NANOFLANN_INCLUDE_DIR)
  target_compile_definitions(micro_neighbors PRIVATE TANDEM_MICRO_NANOFLANN)
  target_include_directories(micro_neighbors SYSTEM PRIVATE "${TANDEM_NANOFLANN_INCLUDE_DIR}")
endif()
