# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Closed surfaces by the cells that the planes cut, which need nothing else.

include("${CMAKE_CURRENT_LIST_DIR}/mesh_support.cmake")
expect(1 "a closed surface needs four planes, and there are 3" cube.ply ${epsilon} --mesh m.off)
expect_no_file(m.off)
expect(2 "mesh-method" missing.ply --mesh m.off --mesh-method cells)

# One face for each side, whatever the partition cuts it into.
expect(0 "in 12 planes" boxes.xyz ${epsilon} --mesh boxes.off)
file(STRINGS "${WORK_DIR}/boxes.off" lines LIMIT_COUNT 2)
expect_equal("size of the mesh" "${lines}" "OFF;16 12 0")
expect_shell(0 "volume 3.00" "awk -f volume.awk boxes.off")

# The plane of points on a line is left out.
expect(0 "in 7 planes" line.xyz --maximum-distance 0.01 --mesh line.off)
file(STRINGS "${WORK_DIR}/line.off" lines LIMIT_COUNT 2)
expect_equal("size of the mesh" "${lines}" "OFF;8 6 0")
expect_shell(0 "volume 1.00" "awk -f volume.awk line.off")

expect(0 "in 54 planes" row.xyz ${epsilon} --mesh row.off --planes row.txt)
expect_shell(0 "^0 faces on no plane" "awk -f walls.awk row.txt row.off")
expect_shell(0 "volume 9.00" "awk -f volume.awk row.off")

expect(1 "no volume was found that 4 planes enclose; the other files are complete" tower.xyz ${epsilon} --mesh open.off
       --planes open.planes)
expect_no_file(open.off)
file(STRINGS "${WORK_DIR}/open.planes" planes)
list(LENGTH planes count)
expect_equal("planes without a mesh" ${count} 4)

expect(2 "mesh-seconds" missing.ply --mesh m.off --mesh-seconds 5)
expect(2 "--mesh-planes is 1001, must be in .4, 1000." missing.ply --mesh m.off --mesh-planes 1001)
finish()
