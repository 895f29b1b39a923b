# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the tests of the methods of --mesh share: clouds, and the volume in a mesh.

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

# Two boxes apart from each other, 1 by 1 by 1 and 1 by 1 by 2, without normals.
file(WRITE "${WORK_DIR}/boxes.sh" [=[
awk 'BEGIN {
  for(i = 0; i < 40; ++i) for(j = 0; j < 40; ++j) for(k = 0; k < 2; ++k) {
    a = (i + .5) / 40; b = (j + .5) / 40
    print a, b, k; print a, k, b; print k, a, b
    print a + 2, b + .4, 2 * k + .3; print a + 2, k + .4, 2 * b + .3; print k + 2, a + .4, 2 * b + .3
  }
}' > boxes.xyz
]=])

# The unit cube, and points on a line, whose normals make a plane of them.
file(WRITE "${WORK_DIR}/line.sh" [=[
awk 'BEGIN {
  for(i = 0; i < 30; ++i) for(j = 0; j < 30; ++j) for(k = 0; k < 2; ++k) {
    a = (i + .5) / 30; b = (j + .5) / 30; s = 2 * k - 1
    print a, b, k, 0, 0, s; print a, k, b, 0, s, 0; print k, a, b, s, 0, 0
  }
  for(i = 0; i < 400; ++i) print 3, .5, i / 100, 1, 0, 0
}' > line.xyz
]=])

# Four small planes far above each other.
file(WRITE "${WORK_DIR}/tower.sh" [=[
awk 'BEGIN { for(i = 0; i < 30; ++i) for(j = 0; j < 30; ++j) for(k = 0; k < 4; ++k) print i / 30, j / 30, 10 * k
}' > tower.xyz
]=])

# Positive if the faces are counterclockwise, seen from outside.
file(WRITE "${WORK_DIR}/volume.awk" [=[
NR == 2 { n = $1 }
NR > 2 && NR <= 2 + n { x[NR - 3] = $1; y[NR - 3] = $2; z[NR - 3] = $3 }
NR > 2 + n {
  a = $2
  for(i = 3; i <= $1; ++i) {
    b = $i; c = $(i + 1)
    sum += x[a] * (y[b] * z[c] - z[b] * y[c]) + y[a] * (z[b] * x[c] - x[b] * z[c]) + z[a] * (x[b] * y[c] - y[b] * x[c])
  }
}
END { printf "volume %.2f\n", sum / 6 }
]=])

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
expect_shell(0 "^$" ". ./boxes.sh && . ./line.sh && . ./tower.sh && awk -f row.awk > row.xyz")
