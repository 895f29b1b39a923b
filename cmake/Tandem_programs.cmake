# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# For the programs of this repository: warnings, and Tandem itself where the
# folder of examples, tests or benchmarks is configured on its own.

set(tandem_programs_dir "${CMAKE_CURRENT_LIST_DIR}")
option(TANDEM_WARNINGS_AS_ERRORS "Warnings are errors in the programs of Tandem" ON)

if(NOT TARGET Tandem::tandem)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
  endif()
  include("${CMAKE_CURRENT_LIST_DIR}/Tandem_dependencies.cmake")
  find_package(Tandem QUIET OPTIONAL_COMPONENTS cuda)
  if(TARGET Tandem::tandem)
    message(STATUS "Tandem is the installed one: ${Tandem_DIR}")
  else()
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

# tandem_share_engine(target source...): if one of the sources detects planes, the target takes the engine, which is
# what takes longest to compile, from a library. Not for what links tandem_cuda, which is compiled with other flags.
function(tandem_share_engine target)
  foreach(source IN LISTS ARGN)
    get_filename_component(source "${source}" ABSOLUTE)
    file(STRINGS "${source}" detects REGEX "include.*(<CGAL/Shape_regularization_tandem|\"testing/)")
    if(detects)
      if(NOT TARGET tandem_shared_engine)
        add_library(tandem_shared_engine STATIC EXCLUDE_FROM_ALL "${tandem_programs_dir}/shared_engine.cpp")
        target_link_libraries(tandem_shared_engine PRIVATE Tandem::tandem)
        tandem_set_warnings(tandem_shared_engine)
      endif()
      target_compile_options(${target} PRIVATE "SHELL:-include \"${tandem_programs_dir}/shared_engine.h\"")
      target_link_libraries(${target} PRIVATE tandem_shared_engine)
      return()
    endif()
  endforeach()
endfunction()

# What tests and benchmark share ("testing/scenes.h"), and the headers of the benchmark ("report/shape_colors.h").
function(tandem_share_testing target)
  target_include_directories(${target} PRIVATE
    "${tandem_programs_dir}/../test/Shape_regularization_tandem"
    "${tandem_programs_dir}/../benchmark/Shape_regularization_tandem")
endfunction()

# Contestants in processes of their own: in the benchmark, and in the test of it.
function(tandem_add_run_isolated target)
  if(NOT TARGET tandem_run_isolated)
    add_library(tandem_run_isolated OBJECT EXCLUDE_FROM_ALL
      "${tandem_programs_dir}/../benchmark/Shape_regularization_tandem/contestants/run_isolated.cpp")
    target_link_libraries(tandem_run_isolated PRIVATE Tandem::tandem)
    tandem_share_testing(tandem_run_isolated)
    tandem_set_warnings(tandem_run_isolated)
  endif()
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:tandem_run_isolated>)
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
