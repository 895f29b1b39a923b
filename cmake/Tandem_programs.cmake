# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# For the programs of this repository: warnings, what they share, and Tandem itself where the
# folder of examples, tests or benchmarks is configured on its own.

set(tandem_programs_dir "${CMAKE_CURRENT_LIST_DIR}")
set(tandem_testing_dir "${CMAKE_CURRENT_LIST_DIR}/../test/Shape_regularization_tandem/testing")
option(TANDEM_BUILD_MODELS "Build what needs the models: outlines, surfaces and facts" ON)
option(TANDEM_LONG_TESTS "Build what takes long to compile, too: each header alone, examples beside other packages of CGAL" ON)
option(TANDEM_WARNINGS_AS_ERRORS "Warnings are errors in the programs of Tandem" ON)

if(NOT TARGET Tandem::tandem)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
  endif()
  include("${CMAKE_CURRENT_LIST_DIR}/Tandem_dependencies.cmake")
  find_package(Tandem QUIET OPTIONAL_COMPONENTS engine models cuda mpi)
  if(TARGET Tandem::tandem)
    message(STATUS "Tandem is the installed one: ${Tandem_DIR}")
  else()
    foreach(part IN ITEMS EXAMPLES TESTS INSTALL)
      set(TANDEM_BUILD_${part} OFF)
    endforeach()
    add_subdirectory("${CMAKE_CURRENT_LIST_DIR}/.." "${CMAKE_BINARY_DIR}/Tandem")
    if(TARGET tandem_cuda)
      tandem_enable_cuda() # in this folder, too
    endif()
  endif()
endif()

include("${CMAKE_CURRENT_LIST_DIR}/Tandem_engine.cmake")
if(NOT TARGET Tandem::tandem_engine) # it is installed without
  tandem_add_engine(tandem_engine EXCLUDE_FROM_ALL)
  add_library(Tandem::tandem_engine ALIAS tandem_engine)
endif()
include("${CMAKE_CURRENT_LIST_DIR}/Tandem_models.cmake")
if(NOT TARGET Tandem::tandem_models)
  tandem_add_models(tandem_models EXCLUDE_FROM_ALL)
  add_library(Tandem::tandem_models ALIAS tandem_models)
endif()
find_package(Threads REQUIRED)
find_package(Eigen3 3.1.0 QUIET)
include(CGAL_Eigen3_support)

# For tests by mpiexec: Open MPI has to be told that root may start it, and that there may be more processes than processors. It leaves memory
# of modules that it has unloaded, which LeakSanitizer could not tell from ours.
set(tandem_mpi_environment OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
    OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_btl_vader_single_copy_mechanism=none ASAN_OPTIONS=detect_leaks=0)

# tandem_add_program(name source...)
function(tandem_add_program name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE Tandem::tandem)
  tandem_set_warnings(${name})
endfunction()

function(tandem_set_warnings target)
  if(MSVC)
    target_compile_options(${target} PRIVATE /W3)
  else()
    target_compile_options(${target} PRIVATE -Wall -Wextra $<$<BOOL:${TANDEM_WARNINGS_AS_ERRORS}>:-Werror>)
  endif()
endfunction()

foreach(library IN ITEMS tandem_engine tandem_models)
  get_target_property(is_imported Tandem::${library} IMPORTED)
  if(NOT is_imported)
    tandem_set_warnings(${library})
  endif()
endforeach()

# Programs that offer the CUDA back end where it is built.
function(tandem_link_cuda target)
  if(TARGET Tandem::tandem_cuda)
    target_link_libraries(${target} PRIVATE Tandem::tandem_cuda)
  endif()
endfunction()

# tandem_add_shared(name source...): a library for some of the programs of this repository.
function(tandem_add_shared name)
  add_library(${name} STATIC EXCLUDE_FROM_ALL ${ARGN})
  target_link_libraries(${name} PUBLIC Tandem::tandem Threads::Threads)
  if(TARGET CGAL::Eigen3_support)
    target_link_libraries(${name} PUBLIC CGAL::Eigen3_support)
  endif()
  tandem_set_warnings(${name})
endfunction()

# Scenes ("scenes/scenes.h") and criteria ("testing/evaluate.h"), which tests and benchmark share, and the headers of the
# benchmark ("criteria/table.h").
function(tandem_share_testing target)
  if(NOT TARGET tandem_testing)
    file(GLOB sources CONFIGURE_DEPENDS "${tandem_testing_dir}/../scenes/*.cpp")
    tandem_add_shared(tandem_testing ${sources})
    target_include_directories(tandem_testing PUBLIC
      "${tandem_testing_dir}/.." "${tandem_programs_dir}/../benchmark/Shape_regularization_tandem")
  endif()
  target_link_libraries(${target} PRIVATE tandem_testing)
endfunction()

# What is linked with tandem_cuda, also through other libraries, is compiled with the flags of that, and so is what it
# shares: sets the variable to the end of their names. All libraries are linked before.
function(tandem_find_suffix target suffix)
  set(${suffix} "" PARENT_SCOPE)
  get_target_property(libraries ${target} LINK_LIBRARIES)
  set(seen "")
  while(libraries)
    list(GET libraries 0 library)
    list(REMOVE_AT libraries 0)
    if(library MATCHES "^(Tandem::)?tandem_cuda$")
      set(${suffix} _with_cuda PARENT_SCOPE)
      return()
    elseif(TARGET ${library} AND NOT library IN_LIST seen)
      list(APPEND seen ${library})
      get_target_property(further ${library} INTERFACE_LINK_LIBRARIES)
      if(further)
        list(APPEND libraries ${further})
      endif()
    endif()
  endwhile()
endfunction()

# The engine takes longest to compile: it comes from its library.
function(tandem_link_engine target)
  tandem_find_suffix(${target} suffix)
  set(engine Tandem::tandem_engine${suffix})
  if(NOT TARGET ${engine})
    tandem_add_engine(tandem_engine_with_cuda EXCLUDE_FROM_ALL)
    add_library(Tandem::tandem_engine_with_cuda ALIAS tandem_engine_with_cuda)
    tandem_link_cuda(tandem_engine_with_cuda)
    tandem_set_warnings(tandem_engine_with_cuda)
  endif()
  target_link_libraries(${target} PUBLIC ${engine}) # what uses a library of it is compiled alike
endfunction()

# Sets the variable to whether a source calls the models, and has to be left out where they are not built.
function(tandem_find_models result source)
  file(STRINGS "${source}" lines REGEX
       "include (<CGAL/Shape_regularization_tandem(_models[.]h|/models/|/(lines|polygons|closed_surface|shape_facts|select_shapes))|.outlines/)")
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()

# For programs without flags of their own: they share a precompiled header. Not with ccache, which does not keep what is
# compiled with one: there its declarations, which spare instances of the engine, are included. Libraries are linked to
# a target before this is called, as their flags choose the header.
function(tandem_share_engine target)
  tandem_link_engine(${target})
  if(CMAKE_DISABLE_PRECOMPILE_HEADERS OR CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    target_compile_options(${target} PRIVATE "SHELL:-include \"${tandem_programs_dir}/precompiled.h\"")
    return()
  endif()
  tandem_find_suffix(${target} suffix)
  set(shared tandem_precompiled${suffix})
  if(NOT TARGET ${shared})
    tandem_add_shared(${shared} "${tandem_programs_dir}/precompiled.cpp")
    if(shared MATCHES cuda)
      tandem_link_cuda(${shared})
    endif()
    tandem_link_engine(${shared})
    target_precompile_headers(${shared} PRIVATE "${tandem_programs_dir}/precompiled.h")
  endif()
  target_precompile_headers(${target} REUSE_FROM ${shared})
endfunction()
