# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The engine as a library: all that does not depend on the caller's kernel and range, for the back ends of the host.
# What links it compiles in a fraction of the time.

set(tandem_engine_dir "${CMAKE_CURRENT_LIST_DIR}/../include/CGAL/Tandem/internal/engine")

# tandem_add_engine(name [EXCLUDE_FROM_ALL])
function(tandem_add_engine name)
  set(sources "${tandem_engine_dir}/tandem_engine_sequential.cpp")
  if(TARGET CGAL::TBB_support)
    list(APPEND sources "${tandem_engine_dir}/tandem_engine_parallel.cpp")
  endif()
  add_library(${name} ${ARGN} ${sources})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD OFF)
  target_link_libraries(${name} PUBLIC Tandem::tandem)
  target_compile_definitions(${name} PUBLIC CGAL_TANDEM_USE_ENGINE=1)
endfunction()
