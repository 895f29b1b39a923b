# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# detect_planes --planes-from labels points by known planes. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

# --- The planes of a part of a cloud for all of it
expect_shell(0 "^$" "awk '/end_header/ {is_point = 1; print \"x y z nx ny nz\"; next} is_point && n++ % 3 < 2' cube.ply > part.xyz")
expect(0 "shapes +2 in" part.xyz ${epsilon} --planes part.txt --labels part.bin)
expect(0 "points +1728, normals given.*shapes +2 in 2 planes of 2 directions, 1 orthogonal.*coverage 66.67 %"
       cube.ply ${epsilon} --planes-from part.txt --labels l.bin --planes p.txt --report r.json --output o.ply
       --polygons o.geojson --vg o.vg --output-directory tiles)
expect_shell(0 "^ 576 -1 576 0 576 1$" "cmp part.txt p.txt; od -An -v -t d4 -w4 l.bin | sort -n | uniq -c | tr -s ' \n' ' ' | sed 's/ $//'")
expect_shell(0 "^2\n$" "grep -c '.id.: [01],' o.geojson")
expect_shell(0 "^$" "cmp o.ply tiles/cube.ply")

# --- A normal decides where there is one; without, only the distance
expect_shell(0 "^$" "awk 'NR > 1 {print $1, $2, $3}' part.xyz > bare.xyz; printf '0 0 1 0\n1 0 0 -0.05\n' > two.txt")
expect(0 "normals none.*shapes +2 in 2 planes" bare.xyz ${epsilon} --planes-from two.txt --labels bare.bin)
expect(0 "normals none\n" bare.xyz ${epsilon} --planes-from two.txt --viewpoint 1,2,3 --oriented --planes p.txt --output o.csv --vg o.vg)
expect_shell(0 "^1\n" "awk -F, '$4 == 0 && $5 == 0 && $6 == 0' o.csv | wc -l | awk '{print $1 == 1152}'")
expect(0 "normals by PCA of 9" bare.xyz ${epsilon} --planes-from two.txt --estimate-normals 9)
expect(2 "--planes-from takes normals of the input, or by --estimate-normals K" bare.xyz --planes-from two.txt --estimate-normals)

# --- The same planes in other forms: with normals of any length, as a table, and turned
file(WRITE "${WORK_DIR}/long.txt" "# a comment\n\n  0 0 4   0\r\n\t0 -0.5 0 0\n")
file(WRITE "${WORK_DIR}/table.csv" "shape,d,points,c,b,a\n0,0,576,1,0,0\n1,-0,576,0,1,-0.0\n")
string(ASCII 239 187 191 utf8_mark)
file(WRITE "${WORK_DIR}/excel.csv" "${utf8_mark}a,b,c,d\r\n0,0,1,0\r\n0,1,0,0\r\n")
file(WRITE "${WORK_DIR}/pandas.csv" ",a,b,c,d\n0,0,0,1,0\n1,0,1,0,0\n")
foreach(file IN ITEMS long.txt table.csv excel.csv pandas.csv)
  expect(0 "shapes +2 in 2 planes of 2 directions, 1 orthogonal.*coverage 66.67 %" cube.ply ${epsilon} --planes-from ${file} --planes p.txt --labels l_${file}.bin)
endforeach()
expect_shell(0 "^$" "for i in table excel pandas; do cmp l_long.txt.bin l_$i.csv.bin; done")
expect_shell(0 "shapes +2 in 2 planes" "cat long.txt | $P cube.ply --maximum-distance 0.004 --planes-from /dev/stdin")
expect_shell(0 "^0 0 1 0\n0 1 0 0\n$" "cat p.txt")

# The table of --shapes has such columns.
expect(0 "shapes +2 in" part.xyz ${epsilon} --shapes shapes.csv)
expect(0 "coverage 66.67 %" cube.ply ${epsilon} --planes-from shapes.csv --planes p.txt)
expect_shell(0 "^$" "cmp part.txt p.txt")

# --- Planes without points are in the files, with their numbers
file(WRITE "${WORK_DIR}/more.txt" "0 0 1 -7\n0 0 1 0\n0 0 1 0\n0 0 -1 0\n0 1 0 0\n")
expect(0 "known +planes of more.txt, not detected.*shapes +5 in 3 planes of 2 directions" cube.ply ${epsilon}
       --planes-from more.txt --labels l.bin --planes p.txt --report r.json --vg o.vg --output o.ply)
expect_warnings(cube.ply ${epsilon} --planes-from more.txt --polygons o.obj WARNINGS "3 of 5 shapes cover too few points")
expect_shell(0 "^ 576 -1 576 1 576 4$" "od -An -v -t d4 -w4 l.bin | sort -n | uniq -c | tr -s ' \n' ' ' | sed 's/ $//'")
expect_shell(0 "^0 0 1 -7\n0 0 1 0\n0 0 1 0\n0 0 1 0\n0 1 0 0\n$" "cat p.txt")
file(READ "${WORK_DIR}/r.json" report)
string(JSON groups GET "${report}" relations coplanar_groups)
string(REGEX REPLACE "[ \n]" "" groups "${groups}")
expect_equal("coplanar groups" "${groups}" "[[0],[1,2,3],[4]]")
string(JSON name GET "${report}" planes_from)
expect_equal("planes_from" "${name}" "more.txt")
file(WRITE "${WORK_DIR}/far.txt" "0 0 1 -7\n")
set_view(view v.html)
expect_warnings(cube.ply ${epsilon} --planes-from far.txt ${view} --output far.ply
                WARNINGS "no point is within the tolerances of a plane of far.txt: a larger --maximum-distance")
expect(0 "shapes +5" cube.ply ${epsilon} --planes-from more.txt ${view} --shapes s.csv)
expect_shell(0 "^6\n$" "wc -l < s.csv")
expect(0 "shapes +3 in 3 planes" cube.ply ${epsilon} --planes-from more.txt --by-plane --planes p.txt)
expect(0 "selection +1 of 5 shapes" cube.ply ${epsilon} --planes-from more.txt --largest 1)

# --- Wrong files
expect(1 "--planes-from none.txt: cannot be opened .No such file" cube.ply --planes-from none.txt)
expect(1 "--planes-from tiles: is a directory" cube.ply --planes-from tiles)
if(EXISTS /proc/self/mem) # it opens, and nothing is at its begin
  expect(1 "--planes-from /proc/self/mem: cannot be read .Input/output error" cube.ply --planes-from /proc/self/mem)
endif()
file(WRITE "${WORK_DIR}/empty.txt" "# nothing\n\n")
expect(1 "--planes-from empty.txt: has no planes" cube.ply --planes-from empty.txt)
file(WRITE "${WORK_DIR}/header.csv" "a,b,c,d\n")
expect(1 "--planes-from header.csv: has no planes" cube.ply --planes-from header.csv)
foreach(row IN ITEMS "0 0 1" "0 0 1 0 0")
  file(WRITE "${WORK_DIR}/bad.txt" "0 0 1 0\n# x\n${row}\n")
  expect(1 "--planes-from bad.txt: row 3 has [35] values instead of 4" cube.ply --planes-from bad.txt)
endforeach()
foreach(word IN ITEMS x nan inf 1e999)
  file(WRITE "${WORK_DIR}/bad.txt" "0 0 1 0\n0 0 1 ${word}\n")
  expect(1 "--planes-from bad.txt: row 2 has '${word}' where a finite number is expected" cube.ply --planes-from bad.txt)
endforeach()
file(WRITE "${WORK_DIR}/bad.txt" "1,,0,0\n")
expect(1 "--planes-from bad.txt: row 1 has '' where a finite number is expected" cube.ply --planes-from bad.txt)
file(WRITE "${WORK_DIR}/bad.txt" "0 0 1 0\n0 0 1e-310 5\n")
expect(1 "--planes-from bad.txt: row 2 has a plane whose distance from the origin is not finite" cube.ply --planes-from bad.txt)
file(WRITE "${WORK_DIR}/bad.txt" "0 0 0 1\n")
expect(1 "--planes-from bad.txt: row 1 has a null vector as normal" cube.ply --planes-from bad.txt)
file(WRITE "${WORK_DIR}/bad.txt" "x y z\n0 0 1\n")
expect(1 "--planes-from bad.txt: row 1 has neither four numbers 'a b c d' nor names of columns with a, b, c and d" cube.ply --planes-from bad.txt)
expect(2 "the file two.txt is named twice" cube.ply --planes-from two.txt --planes two.txt)
finish()
