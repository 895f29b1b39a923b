# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# An empty or poor result of detect_planes is explained: by a sentence with the figure and the option to change, on
# standard error and in the report. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

expect_warnings(cube.ply ${epsilon})
expect_warnings(cube.ply)

# --- Nothing is found
expect_warnings(cube.ply ${epsilon} --minimum-region-size 1700
                WARNINGS "no shape was found: no 1700 connected points .--minimum-region-size., other than on a line or in one place, are within 0.004")
expect_shell(0 "^$" "awk 'BEGIN { for(i = 0; i < 300; ++i) print 1, 2, 3 }' > place.xyz
                     awk 'BEGIN { for(i = 0; i < 300; ++i) print i, 2 * i, 3 * i }' > line.xyz")
foreach(name IN ITEMS place line)
  expect_warnings(${name}.xyz --minimum-region-size 3 WARNINGS "no 3 connected points .*, other than on a line or in one place")
endforeach()
expect_warnings(cube.ply ${epsilon} --minimum-region-size 2000
                WARNINGS "no shape was found: the number of points is 1728, and a shape has at least 2000 .--minimum-region-size")

# --- The smallest cloud that has a shape
foreach(k IN ITEMS 6 12 20)
  foreach(n RANGE 3 13)
    expect_shell(0 "^$" "awk 'BEGIN { print \"x y z nx ny nz\"; for(i = 0; i < ${n}; ++i) print i % 4, (i * i + i) % 5, 0, 0, 0, 1
                               }' > few.xyz")
    expect_warnings(few.xyz --maximum-distance .01 --minimum-region-size 3 --k-neighbors ${k})
  endforeach()
endforeach()

# --- Too little is found
expect_shell(0 "^$" "awk 'BEGIN { srand(1); for(i = 0; i < 400; ++i) print i % 20 / 20, int(i / 20) / 20, 0
                             for(i = 0; i < 4000; ++i) print 3 * rand(), 3 * rand(), 1 + 3 * rand() }' > clutter.xyz")
expect_warnings(clutter.xyz --maximum-distance 0.001
                WARNINGS "only 9[0-9.]* % of the points are in shapes, and 8[0-9.]* % are alone: they are outliers, or --maximum-distance")

# --- Tolerances that do not fit the points
expect_warnings(cube.ply --maximum-distance 0.03
                WARNINGS "the maximum distance 0.03 is more than a tenth of the extent of the points, 0.1[0-9]*: a smaller --maximum-distance")
expect_shell(0 "^$" "awk 'BEGIN { srand(2); for(i = 0; i < 20000; ++i) print rand(), rand(), .02 * rand(), 0, 0, 1 }' > noisy.xyz")
set(noise "the maximum distance 0.0003 is less than a tenth of the noise of the points, 0.00[0-9]*: --maximum-distance should be two to three times")
expect_warnings(noisy.xyz)
expect_warnings(noisy.xyz --maximum-distance 0.002 WARNINGS "no shape|only")
expect_warnings(noisy.xyz --maximum-distance 0.0003 WARNINGS "no shape" "${noise}")
expect_warnings(noisy.xyz --maximum-distance 0.0003 --estimate-normals WARNINGS "no shape" "${noise}")
# Also where a few points, which are nearly on a plane by chance, make shapes.
expect_shell(0 "^$" "awk 'BEGIN { srand(3); for(i = 0; i < 20000; ++i) print rand(), rand(), .02 * rand(), 0, 0, 1
                             for(i = 0; i < 900; ++i) print i % 30 / 300 + 2, int(i / 30) / 300, 0, 0, 0, 1 }' > thin.xyz")
expect_warnings(thin.xyz --maximum-distance 0.0003 WARNINGS "only 4[0-9.]* % of the points are in shapes" "${noise}")
# Points without noise may have any tolerance.
expect_warnings(cube.ply --maximum-distance 0.00001)

# --- Angles that are cosines
expect_warnings(cube.ply ${epsilon} --maximum-angle 0.9
                WARNINGS "--maximum-angle is 0.9 degrees: if that was meant as a cosine, pass 25.8")
expect_warnings(cube.ply ${epsilon} --maximum-angle 1 --angle-tolerance 0.5)
expect_warnings(cube.ply ${epsilon} --angle-tolerance 0.99
                WARNINGS "--angle-tolerance is 0.99 degrees: if that was meant as a cosine, pass 8.1")

# --- What was read is warned of in the report, too
file(WRITE "${WORK_DIR}/none.ply" "ply\nformat ascii 1.0\nelement vertex 0\n${positions}${normals}end_header\n")
expect_warnings(cube.ply none.ply ${epsilon} WARNINGS "none.ply: has no points")
finish()
