# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the tests of tiles share: the tiles of an area, in several formats, and the comparison of outputs.

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

# A hall of floor, walls and roof, which seams at x = 1, 4 and 5 cut.
file(WRITE "${WORK_DIR}/hall.awk" [=[
function add(x, y, z) { print x, y, z > (x < 1 ? "corner.pts" : x < 4 ? "folder/Middle.XYZ" : x < 5 ? "seam" : "last.xyz") }
BEGIN {
  for(i = 0; i < 80; ++i)
    for(j = 0; j < 30; ++j) {
      x = i / 10 + .02
      add(x, j / 10, (i * j) % 7 / 2000)
      add(x, (i * j) % 5 / 2000, j / 10)
      add(x, 3, j / 10 + .05)
      add(x, j / 10 + .03, 4 + j / 20)
    }
}
]=])
set(parameters --maximum-distance 0.01 --minimum-region-size 100)
file(MAKE_DIRECTORY "${WORK_DIR}/folder/sub")
expect_shell(0 "^$" "awk -f hall.awk && (echo x,y,z; tr ' ' , < seam) > folder/sub/seam.csv && rm seam")
expect(0 "^$" last.xyz ${parameters} --output last.las --quiet)
set(tiles corner.pts folder/Middle.XYZ folder/sub/seam.csv last.las)
set(outputs corner.ply Middle.XYZ seam.csv last.las)

set(result_members
    "\"(input|hash|maximum_distance|points|assigned|shapes|planes|mean_distance|.*groups|.*pairs)\":")

# The files of --output-directory and --planes are the same, byte for byte, and what reports tell of the result.
macro(expect_same_results first second)
  foreach(file IN ITEMS ${outputs} planes)
    file(SHA256 "${WORK_DIR}/${first}/${file}" expected)
    file(SHA256 "${WORK_DIR}/${second}/${file}" found)
    expect_equal("${second}/${file}" "${found}" "${expected}")
  endforeach()
  file(STRINGS "${WORK_DIR}/${first}/report" expected REGEX "${result_members}")
  file(STRINGS "${WORK_DIR}/${second}/report" found REGEX "${result_members}")
  expect_equal("report of ${second}" "${found}" "${expected}")
endmacro()
