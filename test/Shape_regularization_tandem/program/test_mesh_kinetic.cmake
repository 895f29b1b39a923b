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

# Four small planes far above each other.
expect_shell(0 "^$" "awk 'BEGIN { for(i = 0; i < 30; ++i) for(j = 0; j < 30; ++j) for(k = 0; k < 4; ++k)
    print i / 30, j / 30, 10 * k }' > tower.xyz")
expect(1 "no volume was found that the planes enclose" tower.xyz ${epsilon} --mesh open.off)
expect_no_file(open.off)
finish()
