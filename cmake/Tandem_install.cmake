# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The headers and a package config; afterwards find_package(Tandem) gives Tandem::tandem,
# and with the component cuda, if it was built, Tandem::tandem_cuda.

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(TANDEM_CONFIG_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/Tandem")

if(TARGET tandem_cuda)
  install(CODE "if(NOT EXISTS \"$<TARGET_FILE:tandem_cuda>\")
  message(FATAL_ERROR \"Build the target tandem_cuda before, or configure with TANDEM_WITH_CUDA=OFF\")
endif()")
endif()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(TARGETS tandem EXPORT Tandem_targets)
install(EXPORT Tandem_targets NAMESPACE Tandem:: DESTINATION "${TANDEM_CONFIG_DIR}")
set(TANDEM_HAS_CUDA FALSE)
if(TARGET tandem_cuda)
  set(TANDEM_HAS_CUDA TRUE)
  install(TARGETS tandem_cuda EXPORT Tandem_cuda_targets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  set(TANDEM_CUDA_USES_TBB FALSE)
  if(TARGET CGAL::TBB_support)
    set(TANDEM_CUDA_USES_TBB TRUE)
  endif()
  install(EXPORT Tandem_cuda_targets NAMESPACE Tandem:: DESTINATION "${TANDEM_CONFIG_DIR}")
  set(TANDEM_ARCH_INDEPENDENT "")
else()
  set(TANDEM_ARCH_INDEPENDENT ARCH_INDEPENDENT)
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
if(TARGET detect_planes)
  install(TARGETS detect_planes RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" OPTIONAL) # where it was built
endif()
