# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The headers and a package config; afterwards find_package(Tandem) gives Tandem::tandem, and
# with the components engine, models, cuda and mpi, if they were built, Tandem::tandem_engine,
# Tandem::tandem_models, Tandem::tandem_cuda and Tandem::tandem_mpi.

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(TANDEM_CONFIG_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/Tandem")

# tandem_require_built(target option): the libraries are built before.
function(tandem_require_built target option)
  install(CODE "if(NOT EXISTS \"$<TARGET_FILE:${target}>\")
  message(FATAL_ERROR \"Build the target ${target} before, or configure with ${option}=OFF\")
endif()")
endfunction()
if(TARGET tandem_cuda)
  tandem_require_built(tandem_cuda TANDEM_WITH_CUDA)
endif()
if(TANDEM_BUILD_ENGINE)
  tandem_require_built(tandem_engine TANDEM_BUILD_ENGINE)
endif()
if(TANDEM_BUILD_MODELS)
  tandem_require_built(tandem_models TANDEM_BUILD_MODELS)
endif()
if(TARGET tandem_mpi AND TANDEM_BUILD_ENGINE)
  tandem_require_built(tandem_mpi TANDEM_WITH_MPI)
  if(TARGET tandem_mpi_cuda)
    tandem_require_built(tandem_mpi_cuda TANDEM_WITH_MPI)
  endif()
endif()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(TARGETS tandem EXPORT Tandem_targets)
install(EXPORT Tandem_targets NAMESPACE Tandem:: DESTINATION "${TANDEM_CONFIG_DIR}")
set(TANDEM_ARCH_INDEPENDENT ARCH_INDEPENDENT)
set(TANDEM_LIBRARIES_USE_TBB FALSE)
if(TARGET CGAL::TBB_support)
  set(TANDEM_LIBRARIES_USE_TBB TRUE)
endif()

# tandem_install_library(target has): sets the variable to whether it is installed.
function(tandem_install_library target has)
  install(TARGETS ${target} EXPORT ${target}_targets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(EXPORT ${target}_targets NAMESPACE Tandem:: DESTINATION "${TANDEM_CONFIG_DIR}")
  set(${has} TRUE PARENT_SCOPE)
  set(TANDEM_ARCH_INDEPENDENT "" PARENT_SCOPE)
endfunction()
set(TANDEM_HAS_ENGINE FALSE)
if(TANDEM_BUILD_ENGINE)
  tandem_install_library(tandem_engine TANDEM_HAS_ENGINE)
endif()
set(TANDEM_HAS_MODELS FALSE)
if(TANDEM_BUILD_MODELS)
  tandem_install_library(tandem_models TANDEM_HAS_MODELS)
endif()
set(TANDEM_HAS_CUDA FALSE)
if(TARGET tandem_cuda)
  tandem_install_library(tandem_cuda TANDEM_HAS_CUDA)
endif()

set(TANDEM_HAS_MPI FALSE)
if(TARGET tandem_mpi AND TANDEM_BUILD_ENGINE) # it needs the engine
  tandem_install_library(tandem_mpi TANDEM_HAS_MPI)
endif()
set(TANDEM_HAS_MPI_CUDA FALSE)
if(TARGET tandem_mpi_cuda AND TANDEM_BUILD_ENGINE)
  tandem_install_library(tandem_mpi_cuda TANDEM_HAS_MPI_CUDA)
endif()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/TandemConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/TandemConfig.cmake"
                              INSTALL_DESTINATION "${TANDEM_CONFIG_DIR}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/TandemConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion ${TANDEM_ARCH_INDEPENDENT})
install(FILES "${PROJECT_BINARY_DIR}/TandemConfig.cmake"
              "${PROJECT_BINARY_DIR}/TandemConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/Tandem_dependencies.cmake"
        DESTINATION "${TANDEM_CONFIG_DIR}")
