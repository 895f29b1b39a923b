# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Closed surfaces by the kinetic partition, which needs CGAL 6.

include("${CMAKE_CURRENT_LIST_DIR}/mesh_support.cmake")
require_method(kinetic)

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

# Nine boxes along a diagonal, whose lids have points on a part only. Each face is on a plane, also where CGAL would
# halve the space by an octree, and so the lid of the box in the middle.
file(WRITE "${WORK_DIR}/row.awk" [=[
BEGIN {
  for(m = 0; m < 9; ++m) for(i = 0; i < 20; ++i) for(j = 0; j < 20; ++j) for(k = 0; k < 2; ++k) {
    a = 2 * m + (i + .5) / 20; b = 2 * m + (j + .5) / 20; c = 2 * m + k
    print a, c, b; print c, a, b
    if(!k || i < 8) print a, b, c
  }
}
]=])
file(WRITE "${WORK_DIR}/walls.awk" [=[
NR == FNR { a[NR] = $1; b[NR] = $2; c[NR] = $3; d[NR] = $4; planes = NR; next }
FNR == 2 { n = $1 }
FNR > 2 && FNR <= 2 + n { x[FNR - 3] = $1; y[FNR - 3] = $2; z[FNR - 3] = $3 }
FNR > 2 + n {
  is_wall = 1
  for(p = 1; p <= planes && is_wall; ++p) {
    is_wall = 0
    for(i = 2; i <= NF; ++i) {
      h = a[p] * x[$i] + b[p] * y[$i] + c[p] * z[$i] + d[p]
      if(h > 1e-6 || h < -1e-6) is_wall = 1
    }
  }
  walls += is_wall
}
END { printf "%d faces on no plane\n", walls }
]=])
expect_shell(0 "^$" "awk -f row.awk > row.xyz")
expect(0 "in 54 planes" row.xyz ${epsilon} --mesh row.off --planes row.txt)
expect_shell(0 "^0 faces on no plane" "awk -f walls.awk row.txt row.off")
expect_shell(0 "volume 9.00" "awk -f volume.awk row.off")

expect(1 "no volume was found that 4 planes enclose; the other files are complete" tower.xyz ${epsilon} --mesh open.off
       --planes open.planes)
expect_no_file(open.off)
file(STRINGS "${WORK_DIR}/open.planes" planes)
list(LENGTH planes count)
expect_equal("planes without a mesh" ${count} 4)

expect(2 "mesh-seconds is for the solver GLPK" missing.ply --mesh m.off --mesh-seconds 5)
expect(2 "--mesh-planes is 1001, must be in .4, 1000. " missing.ply --mesh m.off --mesh-planes 1001)
finish()
