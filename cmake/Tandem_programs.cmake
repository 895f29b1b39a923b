# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# For the programs of this repository: warnings, and Tandem itself where the
# folder of examples, tests or benchmarks is configured on its own.

option(TANDEM_WARNINGS_AS_ERRORS "Warnings are errors in the programs of Tandem" ON)

if(NOT TARGET Tandem::tandem)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
  endif()
  include("${CMAKE_CURRENT_LIST_DIR}/Tandem_dependencies.cmake")
  find_package(Tandem QUIET OPTIONAL_COMPONENTS cuda)
  if(NOT TARGET Tandem::tandem)
    foreach(part IN ITEMS EXAMPLES TESTS INSTALL)
      set(TANDEM_BUILD_${part} OFF)
    endforeach()
    add_subdirectory("${CMAKE_CURRENT_LIST_DIR}/.." "${CMAKE_BINARY_DIR}/Tandem")
  endif()
endif()

# tandem_add_program(name source...)
function(tandem_add_program name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE Tandem::tandem)
  tandem_set_warnings(${name})
endfunction()

# Programs that offer the CUDA back end where it is built.
function(tandem_link_cuda target)
  if(TARGET Tandem::tandem_cuda)
    target_link_libraries(${target} PRIVATE Tandem::tandem_cuda)
  endif()
endfunction()

function(tandem_set_warnings target)
  if(MSVC)
    target_compile_options(${target} PRIVATE /W3)
  else()
    target_compile_options(${target} PRIVATE -Wall -Wextra $<$<BOOL:${TANDEM_WARNINGS_AS_ERRORS}>:-Werror>)
  endif()
endfunction()
