# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The library tandem_mpi, where there are MPI and Boost.MPI, and tandem_mpi_cuda, where there is the
# CUDA back end as well. To be included after these.

function(tandem_add_mpi_library)
  set(mpi_dir "${PROJECT_SOURCE_DIR}/include/CGAL/Tandem/internal/mpi")
  set(sources "${mpi_dir}/tandem_mpi_sequential.cpp")
  if(TARGET CGAL::TBB_support)
    list(APPEND sources "${mpi_dir}/tandem_mpi_parallel.cpp")
  endif()
  add_library(tandem_mpi STATIC ${sources})
  add_library(Tandem::tandem_mpi ALIAS tandem_mpi)
  if(NOT TANDEM_IS_TOP_LEVEL)
    set_target_properties(tandem_mpi PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  set_target_properties(tandem_mpi PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD OFF)
  target_link_libraries(tandem_mpi PUBLIC tandem_engine MPI::MPI_CXX Boost::mpi)
  # The C++ interface of old versions of MPI is not used.
  target_compile_definitions(tandem_mpi PUBLIC CGAL_TANDEM_USE_MPI=1 OMPI_SKIP_MPICXX=1 MPICH_SKIP_MPICXX=1)
endfunction()

# Each process has a CUDA device.
function(tandem_add_mpi_cuda_library)
  tandem_add_cuda_library(tandem_mpi_cuda mpi/tandem_mpi_cuda.cu)
  target_link_libraries(tandem_mpi_cuda PUBLIC tandem_mpi tandem_cuda)
  target_compile_definitions(tandem_mpi_cuda INTERFACE CGAL_TANDEM_USE_MPI_CUDA=1)
endfunction()

if(NOT TANDEM_WITH_MPI)
  set(without_mpi "TANDEM_WITH_MPI is OFF")
else()
  find_package(MPI QUIET COMPONENTS CXX)
  find_package(Boost QUIET COMPONENTS mpi)
  if(NOT TARGET MPI::MPI_CXX)
    set(without_mpi "there is no MPI")
  elseif(NOT TARGET Boost::mpi)
    set(without_mpi "there is no Boost.MPI")
  endif()
endif()
if(DEFINED without_mpi)
  message(STATUS "Tandem: the back end of many processes is not built: ${without_mpi}")
else()
  tandem_add_mpi_library()
  if(TARGET tandem_cuda)
    tandem_add_mpi_cuda_library()
  endif()
  message(STATUS "Tandem: the back end of many processes is built (target Tandem::tandem_mpi)")
endif()
