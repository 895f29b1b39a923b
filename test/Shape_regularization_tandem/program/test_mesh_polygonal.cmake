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

expect(1 "no volume was found that the planes enclose" tower.xyz ${epsilon} --mesh open.off --mesh-method polygonal)
expect_no_file(open.off)

# A grid of planes: the solver takes minutes.
expect_shell(0 "^$" "awk 'BEGIN { for(i = 0; i < 30; ++i) for(j = 0; j < 30; ++j) for(k = 0; k < 7; ++k) {
    a = i / 30 + .01; b = j / 30 + .01; print a, b, k / 6; print a, k / 6, b; print k / 6, a, b } }' > grid.xyz")
set(grid grid.xyz ${epsilon} --maximum-angle 10 --mesh grid.off --mesh-method polygonal)
expect(1 "takes too long for 21 planes: take fewer by --mesh-planes" ${grid})
expect_shell(0 "^$" "awk 'BEGIN { for(i = 0; i < 20; ++i) for(j = 0; j < 20; ++j) for(k = 0; k < 21; ++k) {
    a = i / 20 + .01; b = j / 20 + .01; print a, b, k / 4; print a, k / 4, b; print k / 4, a, b } }' > large.xyz")
expect(1 "takes too long for 63 planes: take fewer by --mesh-planes" large.xyz ${epsilon} --maximum-angle 10
       --mesh grid.off --mesh-method polygonal --mesh-planes 100)
find_program(timeout timeout)
if(WITH_SCIP) # it has no limit
  expect(2 "mesh-seconds is for the solver GLPK" ${grid} --mesh-seconds 5)
else()
  list(APPEND grid --mesh-planes 18)
  expect(1 "no surface was found within 1 seconds: take fewer planes by --mesh-planes" ${grid} --mesh-seconds 1)
  if(timeout)
    string(REPLACE ";" " " grid "${grid}")
    expect_shell(1 "interrupted" "exec timeout --foreground --preserve-status -s INT -k 20 2 \"$P\" ${grid}")
  endif()
endif()
expect_no_file(grid.off)
finish()
