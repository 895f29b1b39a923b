# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Closed surfaces by the polygonal surface reconstruction, which needs a solver, and the end of that.

include("${CMAKE_CURRENT_LIST_DIR}/mesh_support.cmake")
require_method(polygonal)
expect(0 "in 12 planes" boxes.xyz ${epsilon} --mesh boxes.off --mesh-method polygonal)
expect_shell(0 "volume 3.00" "awk -f volume.awk boxes.off")

# The plane of points on a line is left out.
expect(0 "in 7 planes" line.xyz --maximum-distance 0.01 --mesh line.off --mesh-method polygonal)
expect_shell(0 "volume 1.00" "awk -f volume.awk line.off")
expect_shell(0 "^24 right angles, 0 others" "awk -f right_angles.awk line.off")

# What is done is kept where there is no surface: all other outputs are complete.
set(others --planes others.planes --labels others.labels --output others.ply --report others.json --vg others.vg
    --polygons others.obj)
macro(expect_others)
  foreach(file IN ITEMS planes labels ply json vg obj)
    if(NOT EXISTS "${WORK_DIR}/others.${file}")
      complain("others.${file} is not there")
    endif()
    file(REMOVE "${WORK_DIR}/others.${file}")
  endforeach()
  expect_no_file(never.off)
endmacro()
set(mesh --mesh never.off --mesh-method polygonal)
expect(1 "shapes .*no volume was found that 4 planes enclose\n$" tower.xyz ${epsilon} ${mesh})
expect(1 "shapes .*no volume was found that 4 planes enclose; the other files are complete\n$" tower.xyz ${epsilon} ${mesh}
       ${others})
expect_others()
expect(1 "shapes .*four planes, and there are 3; the other files are complete\n$" cube.ply ${epsilon} ${mesh} ${others})
expect_others()

# More planes than the method takes by default: those with most points, which is told. No more are asked for.
expect_shell(0 "^$" "awk 'BEGIN { for(m = 0; m < 3; ++m) for(k = 0; k < 2; ++k)
    for(i = 0; i < 40 - 8 * m; ++i) for(j = 0; j < 40 - 8 * m; ++j) {
    a = 3 * m + (i + .5) / 40; b = 3 * m + (j + .5) / 40; c = 3 * m + k * (1 - m / 5)
    print a, b, c; print a, c, b; print c, a, b } }' > three.xyz")
set(three "\"$P\" three.xyz --maximum-distance 0.004 --mesh three.off --mesh-method polygonal")
expect_shell(0 "warning: three.off: has 16 of 18 planes, those with most points: the method polygonal takes 16 by default, and up to 60 by --mesh-planes\n.*mesh +[0-9]+ faces, of 16 of 18 planes"
             "${three} --report three.json 2>&1")
file(READ "${WORK_DIR}/three.json" report)
string(JSON warning GET "${report}" warnings 0)
if(NOT warning MATCHES "^three.off: has 16 of 18 planes, those with most points: ")
  complain("warning of the report: ${warning}")
endif()
expect(0 "mesh +18 faces, of 18 of 18 planes" three.xyz ${epsilon} --mesh three.off --mesh-method polygonal --mesh-planes 18)
expect_shell(0 "volume 1.73" "awk -f volume.awk three.off")
expect_shell(0 "mesh +[0-9]+ faces, of 12 of 18 planes" "${three} --mesh-planes 12")
expect_shell(0 "volume 1.51" "awk -f volume.awk three.off")
expect(2 "--mesh-planes is 61, must be in .4, 60. for the method polygonal" missing.ply ${mesh} --mesh-planes 61)

# A grid of planes: the solver takes minutes.
expect_shell(0 "^$" "awk 'BEGIN { for(i = 0; i < 30; ++i) for(j = 0; j < 30; ++j) for(k = 0; k < 7; ++k) {
    a = i / 30 + .01; b = j / 30 + .01; print a, b, k / 6; print a, k / 6, b; print k / 6, a, b } }' > grid.xyz")
set(grid grid.xyz ${epsilon} --maximum-angle 10 ${mesh} ${others})
if(WITH_SCIP) # it has no limit
  expect(2 "mesh-seconds is for the solver GLPK" ${grid} --mesh-seconds 5)
else()
  list(APPEND grid --mesh-planes 18)
  expect(1 "no surface of 18 planes was found within 1 seconds of processor time: take fewer planes by --mesh-planes, or more time by --mesh-seconds; the other files are complete"
         ${grid} --mesh-seconds 1)
  expect_others()
  string(REPLACE ";" " " grid "${grid}")
  expect_shell(1 "interrupted; the other files are complete" "\"$P\" ${grid} & pid=$!
    while kill -0 $pid && ! [ -e others.json ]; do sleep .05; done; sleep .5; kill -INT $pid; wait $pid")
  expect_others()
endif()
finish()
