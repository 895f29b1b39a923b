# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The headers and a package config; afterwards find_package(Tandem) gives Tandem::tandem.

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(TANDEM_CONFIG_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/Tandem")

install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(TARGETS tandem EXPORT Tandem_targets)
install(EXPORT Tandem_targets NAMESPACE Tandem:: DESTINATION "${TANDEM_CONFIG_DIR}")

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/TandemConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/TandemConfig.cmake"
                              INSTALL_DESTINATION "${TANDEM_CONFIG_DIR}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/TandemConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/TandemConfig.cmake"
              "${PROJECT_BINARY_DIR}/TandemConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/Tandem_dependencies.cmake"
        DESTINATION "${TANDEM_CONFIG_DIR}")
if(TARGET detect_planes)
  install(TARGETS detect_planes RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" OPTIONAL) # where it was built
endif()
