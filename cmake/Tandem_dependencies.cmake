# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Finds CGAL and, unless TANDEM_WITH_TBB is OFF, oneTBB (target CGAL::TBB_support).
# The sources and the installed package share this file.

if(NOT DEFINED TANDEM_WITH_TBB)
  set(TANDEM_WITH_TBB ON)
endif()

if(CMAKE_FIND_PACKAGE_NAME)
  include(CMakeFindDependencyMacro)
  find_dependency(CGAL 5.5)
else()
  find_package(CGAL 5.5 REQUIRED)
endif()

if(TANDEM_WITH_TBB)
  find_package(TBB QUIET)
  include(CGAL_TBB_support)
  if(NOT TARGET CGAL::TBB_support)
    message(STATUS "Tandem: oneTBB is not there, only the sequential back end is built")
  endif()
endif()
