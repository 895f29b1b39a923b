# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Tables as people have them: names of maps, unknown names, a column that counts the rows, and extensions that tell the
# columns. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/room_support.cmake")

# expect_same(columns argument...): the result of the plain table.
macro(expect_same columns)
  expect(0 "columns +${columns}\n.*${hash}" ${ARGN})
endmacro()

# --- Names
expect_same("x y z" named.csv)
expect_same("_ x y z" units.csv)
expect_same("x y z" short.txt)
expect_same("x y z" named.csv --columns "x y z")
expect_same("x y z" strange.csv --columns "x,y,z")
expect(1 "strange.csv: row 1 is a line of names that do not tell x, y and z .name the columns by --columns.\n" strange.csv)
expect_shell(1 "twice.csv: row 2 is a line of names"
             "{ echo rechts,hoch,auf; cat strange.csv; } > twice.csv; exec \"$P\" twice.csv --columns 'x y z'")
foreach(columns IN ITEMS "" "--columns;x y z")
  expect_warnings(degrees.csv ${columns} WARNINGS "degrees.csv: x and y are columns of longitude and latitude")
endforeach()
# x, y and z are never others where a file has them.
file(WRITE "${WORK_DIR}/height.csv" "height,x,y,z\n9,1,2,3\n9,2,2,3\n9,3,4,3\n")
expect_shell(0 "columns +_ x y z\n" "exec \"$P\" height.csv --maximum-distance 1 2>&1")

# --- A column that counts the rows
expect_same("_ x y z .the first counts the rows." numbered.xyz)
expect_same("_ x y z .the first counts the rows." numbered.txt)
expect_same("_ x y z intensity .the first counts the rows." numbered.pts)
expect(0 "columns +x y z intensity\n" numbered.xyz --columns "x y z intensity")
expect_warnings(broken.xyz WARNINGS "broken.xyz: column 1 counts the rows until row 2001 goes on otherwise")
expect(0 "columns +x y z intensity\n" raster.xyz --maximum-distance .02)

# --- Extensions
expect_same("x y z" points.asc)
expect_same("x y z r g b" colors.xyzrgb)
expect(0 "normals estimated\n +columns +x y z nx ny nz\n" normals.xyzn) # all of them are zero
file(WRITE "${WORK_DIR}/raster.asc" "NCOLS 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n")
expect(1 "raster.asc: is a raster of ESRI .its first word is ncols., and no table" raster.asc)
expect(1 "raster.asc: is a raster of ESRI" raster.asc --columns "x y z")
file(WRITE "${WORK_DIR}/cloud.doc" "1 2 3\n")
expect(1 "cloud.doc: unknown format '.doc', expected .*\.pwn, .xyzn, .xyzrgb, .asc" cloud.doc)

# --- Decimal commas
expect_same("x y z" commas.csv --decimal-comma)
expect_same("x y z" commas.txt --decimal-comma)
expect(1 "commas.csv: row 1 .*commas are no part of numbers.* .or give --decimal-comma." commas.csv)
expect(1 "commas.txt: row 2 .*or give --decimal-comma." commas.txt --columns "x y z")
# expect_rows(columns rows): with decimal commas. Few points have no shape.
macro(expect_rows columns rows)
  file(WRITE "${WORK_DIR}/rows.txt" "${rows}")
  expect_shell(0 "columns +${columns}\n" "exec \"$P\" rows.txt --decimal-comma --maximum-distance 1 2>&1")
endmacro()
expect_rows("x y z" "1,5 -2,5 3,5e1\n,5 -,5 3\n1 2 3\n")
expect_rows("x y z" "1,5, 2,5, 3,5\n1,5, 2,5, 4,5\n")
expect_rows("z y x" "# z, y, x\n1,5;2;3\n1;2;3,25\n")
expect_rows("x y z _" "X;Y;Z;code 1.2\n1,5;2;3;a.1\n1,5;2;4;b\n")
foreach(row IN ITEMS "1.234,5;2;3" "1.5;2,5;3" "1 2.25 3" "1.5,2.5,3.5")
  file(WRITE "${WORK_DIR}/points.txt" "1;2;3\n${row}\n")
  expect(1 "points.txt: row 2 has '[0-9.,]+': with --decimal-comma, numbers have a comma, and neither a point nor"
         points.txt --decimal-comma)
endforeach()
foreach(row IN ITEMS "1,2,3" "1,5,2,5,3,5" "1,5; 2,5,5; 3")
  file(WRITE "${WORK_DIR}/many.txt" "1;2;3\n${row}\n")
  expect(1 "many.txt: row 2 has " many.txt --decimal-comma)
endforeach()
expect(2 "--decimal-comma is for text tables" cube.ply --decimal-comma)

finish()
