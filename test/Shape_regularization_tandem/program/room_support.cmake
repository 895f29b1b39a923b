# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the tests of readers share: the corner of a room as people have its points, and the hash of its result.

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

need_python3()
expect_shell(0 "^$" "\"${python3}\" \"${CMAKE_CURRENT_LIST_DIR}/room_clouds.py\"")
expect(0 "columns +x y z\n.*shapes +3 in 3 planes .*hash +[0-9a-f]+" plain.xyz)
string(REGEX MATCH "hash +[0-9a-f]+" hash "${out}")
