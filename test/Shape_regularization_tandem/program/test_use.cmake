# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Another project uses Tandem, through find_package after an installation or through
# add_subdirectory: configured, built and run in WORK_DIR, a folder of its own. USE is
# find_package, add_subdirectory, or engine or cuda: with the library that BUILD_DIR has.

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${status}:\n${text}")
  endif()
endfunction()

# Engines take long to compile, so each user has one: that of several threads where the installation has to find oneTBB.
set(library Tandem::tandem)
set(tag CGAL::Parallel_if_available_tag)
set(common -DCMAKE_CXX_COMPILER=${CXX} -DTANDEM_WITH_TBB=${WITH_TBB} -DTANDEM_WITH_CUDA=OFF)
file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}/user")

# By its major and minor version.
file(STRINGS "${TANDEM_DIR}/include/CGAL/Shape_regularization_tandem/version.h" version REGEX "define CGAL_TANDEM_VERSION")
string(REGEX REPLACE ".*\"([0-9]+\\.[0-9]+).*" "\\1" version "${version}")

if(USE STREQUAL "find_package")
  run(${CMAKE_COMMAND} -S ${TANDEM_DIR} -B ${WORK_DIR}/tandem ${common} -DTANDEM_BUILD_EXAMPLES=OFF
      -DTANDEM_BUILD_ENGINE=OFF -DTANDEM_BUILD_MODELS=OFF -DTANDEM_WITH_MPI=OFF -DTANDEM_BUILD_TESTS=OFF -DCMAKE_INSTALL_PREFIX=${WORK_DIR}/prefix)
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/tandem --target install)
  set(get_tandem "find_package(Tandem ${version} REQUIRED)")
elseif(USE STREQUAL "engine")
  run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
  set(get_tandem "find_package(Tandem ${version} REQUIRED COMPONENTS engine)")
  set(library Tandem::tandem_engine)
elseif(USE STREQUAL "cuda")
  run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
  set(get_tandem "find_package(Tandem ${version} REQUIRED COMPONENTS cuda)")
  set(library Tandem::tandem_cuda)
  set(tag CGAL::Tandem::Cuda_tag)
else()
  set(get_tandem "add_subdirectory(\"${TANDEM_DIR}\" tandem)")
endif()

file(WRITE "${WORK_DIR}/user/CMakeLists.txt" "
cmake_minimum_required(VERSION 3.16)
project(user LANGUAGES CXX)
${get_tandem}
add_executable(user user.cpp)
target_link_libraries(user PRIVATE ${library})
")
file(WRITE "${WORK_DIR}/user/user.cpp" "
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Shape_regularization_tandem.h>
int main()
{
  using Kernel = CGAL::Simple_cartesian<double>;
  std::vector<std::pair<Kernel::Point_3, Kernel::Vector_3>> points;
  for(int i = 0; i < 400; ++i)
    points.emplace_back(Kernel::Point_3(i % 20, i / 20, 0), Kernel::Vector_3(0, 0, 1));
  CGAL::Tandem::Parameters settings;
  settings.maximum_distance = settings.maximum_offset = .1;
  settings.minimum_region_size = 100;
  CGAL::Tandem::check_parameters(settings);
  CGAL::Tandem::Detection_stage stage = CGAL::Tandem::Detection_stage::sort;
  const CGAL::Tandem::Callback callback = [&](double progress) {
    stage = CGAL::Tandem::stage_at(progress);
    return true;
  };
  using Map = CGAL::First_of_pair_property_map<std::pair<Kernel::Point_3, Kernel::Vector_3>>;
  using Normals = CGAL::Second_of_pair_property_map<std::pair<Kernel::Point_3, Kernel::Vector_3>>;
  try {
    const auto shapes = CGAL::Tandem::detect_planes<${tag}>(points,
      CGAL::Tandem::parameters::settings(settings).point_map(Map()).normal_map(Normals()).callback(callback));
    const CGAL::Tandem::Statistics& statistics = shapes.statistics();
    if(statistics.number_of_shapes != 1 || stage != CGAL::Tandem::Detection_stage::done)
      return 1;
    const CGAL::Tandem::Coefficients& plane = shapes.coefficients(0);
    return plane[2] * plane[2] == 1 && plane[3] == 0 ? 0 : 1;
  } catch(const std::runtime_error& e) {
    return std::string(e.what()).find(\"no CUDA device\") != std::string::npos ? 0 : 1;
  }
}
")
if(USE STREQUAL "add_subdirectory") # the rest of the headers is compiled by the others
  file(WRITE "${WORK_DIR}/user/user.cpp" "
#include <CGAL/Tandem/check_parameters.h>
int main()
{
  CGAL::Tandem::Parameters p;
  p.maximum_distance = p.maximum_offset = 1;
  p.minimum_region_size = 3;
  CGAL::Tandem::check_parameters(p);
}
")
endif()
run(${CMAKE_COMMAND} -S ${WORK_DIR}/user -B ${WORK_DIR}/build ${common} -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/user)
