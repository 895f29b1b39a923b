# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The models as a library: outlines, closed surfaces and facts of shapes, in doubles whatever the caller's kernel is. What
# links it compiles in a fraction of the time, as it includes neither triangulations nor exact numbers of CGAL.

set(tandem_models_dir "${CMAKE_CURRENT_LIST_DIR}/../include/CGAL/Shape_regularization_tandem/models")

# tandem_add_models(name [EXCLUDE_FROM_ALL])
function(tandem_add_models name)
  add_library(${name} ${ARGN} "${tandem_models_dir}/tandem_models_outlines.cpp"
              "${tandem_models_dir}/tandem_models_surface.cpp")
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD OFF)
  target_link_libraries(${name} PUBLIC Tandem::tandem)
  target_compile_definitions(${name} PUBLIC CGAL_TANDEM_USE_MODELS=1)
  # g++ inlines the graph cut of Boost, and does not follow what it initializes.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endfunction()
