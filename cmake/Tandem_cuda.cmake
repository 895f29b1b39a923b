# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The library tandem_cuda, where there is a CUDA compiler. To be included by the
# file that makes the target tandem.

# As CMAKE_CUDA_ARCHITECTURES of the caller, or the environment variable CUDAARCHS, say;
# otherwise for all devices since 2018, the last of them with code for later ones.
macro(tandem_enable_cuda)
  cmake_policy(SET CMP0104 NEW)
  if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES AND NOT DEFINED ENV{CUDAARCHS})
    set(CMAKE_CUDA_ARCHITECTURES 75-real 80-real 86-real 90)
  endif()
  if(NOT DEFINED CMAKE_CUDA_HOST_COMPILER AND NOT DEFINED ENV{CUDAHOSTCXX})
    set(CMAKE_CUDA_HOST_COMPILER "${CMAKE_CXX_COMPILER}")
  endif()
  enable_language(CUDA)
  find_package(CUDAToolkit QUIET)
endmacro()

# tandem_add_cuda_library(name source): needs nothing of CGAL. No product is fused with a sum
# unless the code says so: the results are those of the other back ends, bit for bit.
function(tandem_add_cuda_library name source)
  add_library(${name} STATIC "${PROJECT_SOURCE_DIR}/include/CGAL/Tandem/internal/${source}")
  add_library(Tandem::${name} ALIAS ${name})
  if(NOT TANDEM_IS_TOP_LEVEL)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  set_target_properties(${name} PROPERTIES
    CUDA_STANDARD 17 CUDA_STANDARD_REQUIRED ON CUDA_RUNTIME_LIBRARY Static POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${name} PRIVATE
    --expt-relaxed-constexpr --fmad=false "SHELL:--default-stream per-thread" "SHELL:-Xcompiler -Wall,-Wextra")
  # What the host does between two kernels has many of these; without the instruction each one is
  # a call. The library has inline functions in common with its users, so they have it, too.
  if(TANDEM_CUDA_WITH_FMA AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_options(${name}
      PRIVATE "SHELL:-Xcompiler -mfma,-ffp-contract=off"
      INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-mfma> $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)
  endif()
  if(TARGET CGAL::TBB_support)
    target_link_libraries(${name} PRIVATE "$<BUILD_INTERFACE:CGAL::TBB_support>")
  endif()
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/include")
  target_link_libraries(${name} INTERFACE tandem PRIVATE CUDA::cudart_static)
endfunction()

if(NOT TANDEM_WITH_CUDA)
  set(without_cuda "TANDEM_WITH_CUDA is OFF")
elseif(CMAKE_VERSION VERSION_LESS 3.18)
  set(without_cuda "it needs CMake 3.18")
else()
  include(CheckLanguage)
  check_language(CUDA)
  if(NOT CMAKE_CUDA_COMPILER)
    set(without_cuda "there is no CUDA compiler")
  else()
    tandem_enable_cuda()
    if(NOT TARGET CUDA::cudart_static)
      set(without_cuda "there is no CUDA runtime library")
    endif()
  endif()
endif()
if(DEFINED without_cuda)
  message(STATUS "Tandem: the CUDA back end is not built: ${without_cuda}")
else()
  tandem_add_cuda_library(tandem_cuda cuda/tandem_cuda.cu)
  target_compile_definitions(tandem_cuda INTERFACE CGAL_TANDEM_USE_CUDA=1)
  message(STATUS "Tandem: the CUDA back end is built for ${CMAKE_CUDA_ARCHITECTURES} (target Tandem::tandem_cuda)")
endif()
