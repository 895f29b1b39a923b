# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Texts that detect_planes refuses since they would be read as others: commas within numbers, lines that end in a
# carriage return alone, and lines without an end. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

set(tables xyz txt csv pts pwn)
set(ply_rows "ply\nformat ascii 1.0\nelement vertex 2\n${positions}end_header\n")
set(pcd_rows "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA ascii\n")

# --- Commas
# expect_refused(row): the first one, a later one, one below names, and one whose columns are named.
macro(expect_refused row)
  foreach(format IN ITEMS xyz csv)
    file(WRITE "${WORK_DIR}/first.${format}" "${row}\n${row}\n")
    file(WRITE "${WORK_DIR}/later.${format}" "0.5 1 2\n\n# comment\n${row}\n")
    file(WRITE "${WORK_DIR}/names.${format}" "x y z\n0.5 1 2\n${row}\n")
    expect(1 "first.${format}: row 1 .*with a decimal point" first.${format})
    expect(1 "later.${format}: row 4 .*with a decimal point" later.${format})
    expect(1 "names.${format}: row 3 .*with a decimal point" names.${format})
    expect(1 "first.${format}: row 1 .*with a decimal point" first.${format} --columns "x y z")
  endforeach()
endmacro()
expect_refused("1,5 2,5 3,5")
expect_refused("1,5\t2,5\t3,5")
expect_refused(" -1,5  2,5  3,5 ")
expect_refused("1,5 2 3")
expect_refused("1 2 3,5")
expect_refused("1,5 2,5 3,5 0 0 1")
expect_refused("1,5 2,5 3,5 255 0 0")
expect_refused("1,5;2,5;3,5")
expect_refused("1,5 ; 2 ; 3")
expect_refused("1,5, 2,5, 3,5")
expect_refused("1,5 ,2,5 ,3,5")
expect_refused("1,05,2,5,3,5")
expect(1 "first.csv: row 1 has a number with a leading 0 behind a comma, .*write numbers with a decimal point" first.csv)
expect_refused("1.234,5;2;3")
expect_refused("1.234,5 2.345,6 3.456,7")
expect_refused("1,234.5 2,345.6 3,456.7")
expect_refused("1,234.5\t2\t3")
expect_refused("1,034.5,2,345.6,3,456.7")
expect_refused("1 234,5;2 345,6;3 456,7")
expect_refused("1,234,567.5 2 3")

# More values than names, or another number of them in each row
file(WRITE "${WORK_DIR}/names.csv" "x,y,z\n1,5,2,5,3,5\n")
file(WRITE "${WORK_DIR}/ragged.csv" "1,5,2,5,3,5\n1,5,2,3,5\n")
expect(1 "names.csv: row 2 has more than 3 values.*with a decimal point" names.csv)
expect(1 "names.csv: row 2 has more than 3 values .name all its columns by --columns, also those to pass over, by _."
       names.csv --columns "x y z")
expect(1 "ragged.csv: row 1 has more than 3 values" ragged.csv --columns "x y z")
expect(1 "ragged.csv: row 1 has more than 5 values" ragged.csv --columns "x _ y z _")
expect(1 "ragged.csv: row 2 has 5 values instead of 6.*with a decimal point" ragged.csv)

# Integers with commas only may be numbers with decimal commas, or with separators of thousands: a warning says what
# they are read as. Colors above 255 are none.
foreach(row IN ITEMS "4,4,17,4,1,1" "1,5,2,5,3,5" "-4,4,-17,4,+1,1" "4,4,17,4,1,1,0,5" "4,4,17,4,1,1,0,0,0,0,1,0")
  string(REGEX REPLACE "[^,]+" "1" first "${row}")
  file(WRITE "${WORK_DIR}/pairs.csv" "${first}\n${row}\n")
  set(pairs "warning: pairs.csv: each row is of integers with commas between them, read as x y z r g b[_ ]*: write numbers with a decimal point if ")
  expect_shell(0 "${pairs}.*\"warnings\": .\"pairs.csv: each row" "exec \"$P\" pairs.csv --maximum-distance 1 --report /dev/stdout 2>&1")
endforeach()
foreach(row IN ITEMS "5,426,18,369,2,112" "4,4,17,400,1,1")
  string(REGEX REPLACE "[^,]+" "1" first "${row}")
  file(WRITE "${WORK_DIR}/pairs.csv" "${first}\n${row}\n")
  expect(1 "pairs.csv: each row is of integers .*, read as x y z r g b with values above 255 of r g b: write" pairs.csv)
endforeach()

# In formats whose numbers are separated by blanks
foreach(row IN ITEMS "1,5 2,5 3,5" "1,234.5 2 3" "1 2 3,5" "1,2,3")
  file(WRITE "${WORK_DIR}/comma.off" "OFF\n2 0 0\n0 0 0\n${row}\n")
  file(WRITE "${WORK_DIR}/comma.ply" "${ply_rows}0 0 0\n${row}\n")
  file(WRITE "${WORK_DIR}/comma.pcd" "${pcd_rows}0 0 0\n${row}\n")
  expect(1 "comma.off: row 4 has a comma .write numbers with a decimal point" comma.off)
  expect(1 "comma.ply: row 2 of 'vertex' has a comma .write numbers with a decimal point" comma.ply)
  expect(1 "comma.pcd: row 7 has '[0-9,.]+' where a number is expected.*with a decimal point" comma.pcd)
endforeach()
file(WRITE "${WORK_DIR}/more.pcd" "${pcd_rows}0 0 0\n0 0 0 1\n")
file(WRITE "${WORK_DIR}/less.pcd" "${pcd_rows}0 0 0\n0.25 0.25\n")
expect(1 "more.pcd: row 7 has more than 3 values" more.pcd)
expect(1 "less.pcd: row 7 has 2 values instead of 3" less.pcd)

# Commas and semicolons between values are read, also those of integers.
# expect_columns(columns rows argument...). Few points have no shape, which is the only warning.
macro(expect_columns columns rows)
  file(WRITE "${WORK_DIR}/right.csv" "${rows}")
  execute_process(COMMAND "${PROGRAM}" right.csv --maximum-distance 1 ${ARGN} WORKING_DIRECTORY "${WORK_DIR}"
                  RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT "${status}${out}" MATCHES "^0.*columns +${columns}\n" OR "${err}" MATCHES "right.csv")
    complain("${rows}: no columns ${columns}: ${status} ${out}${err}")
  endif()
endmacro()
expect_columns("x y z" "1,2,3\n4,5,6\n")
expect_columns("x y z" "1.5, 2.5, 3.5\n4, 5,6 ,\n")
expect_columns("x y z" "1.5 2.5 3.5\n4 ,, 5\n")
expect_columns("x y z" "1;2.5; 3\r\n4; 5;6;\r\n")
expect_columns("x y z r g b" "1,-5,2,5,3,5\n0,10,20,0,0,0\n")
expect_columns("x y z r g b" "1,5,2,5,3,5\n0,.5,20,0,0,0\n")
expect_columns("x y z r g b" "1,5,2,5,3,500\n" --columns "x y z r g b")
expect_columns("x y z r g b" "x,y,z,r,g,b\n1,5,2,5,3,5\n")
expect_columns("x y z r g b" "1;5;2;500;3;5\n0;10;20;0;0;0\n")
expect_columns("x y z r g b" "1,5,2.5,500,3,5\n0,10,20,0,0,0\n")
expect_columns("x y z r g b" "100, 20,300,  5, 10, 15\n  1,  2,  3,  5, 10,100\n")
expect_columns("_ x y z" "scan 05,1,2,3\nscan 06,1,2,3\n" --columns "_ x y z")
expect_columns("x y z _" "1,2,3,05\n1,2,3,06\n" --columns "x y z _")
expect_columns("x _ y z _ _" "1,0,2,3,4,5,\n" --columns "x _ y z _ _")
expect_columns("x y z" "1 2 3 4\n" --columns "x y z")
expect_columns("x y z" "1;2;3;4\n" --columns "x y z")
expect_columns("x _ y z" "x,,y,z\n1,a b,2,3\n")

# --- Carriage returns
file(WRITE "${WORK_DIR}/plain" "${cube}")
file(WRITE "${WORK_DIR}/plain.off" "OFF\n${n} 0 0\n${cube}")
file(WRITE "${WORK_DIR}/plain.ply" "${ply_header}${positions}${normals}end_header\n${cube}")
file(WRITE "${WORK_DIR}/plain.pcd" "FIELDS x y z normal_x normal_y normal_z\nSIZE 8 8 8 8 8 8\nTYPE F F F F F F\n"
     "POINTS ${n}\nDATA ascii\n${cube}")
foreach(format IN LISTS tables)
  configure_file("${WORK_DIR}/plain" "${WORK_DIR}/plain.${format}" COPYONLY)
endforeach()
foreach(format IN ITEMS ${tables} off ply pcd)
  expect_shell(0 "points +${n}"
               "sed 's/$/\\r/' plain.${format} > crlf.${format}; exec \"$P\" crlf.${format} --maximum-distance .004")
  expect_shell(1 "cr.${format}: row 1 ends in a carriage return alone"
               "tr '\\n' '\\r' < plain.${format} > cr.${format}; exec \"$P\" cr.${format}")
  expect_shell(1 "note.${format}: row 1 ends in a carriage return alone"
               "{ printf '# comment\\r'; cat plain.${format}; } > note.${format}; exec \"$P\" note.${format}")
  # Of a row of the points
  expect_shell(1 "row.${format}: row [0-9]+ (of 'vertex' )?ends in a carriage return alone"
               "sed '1000 s/ /\\r/2' plain.${format} > row.${format}; exec \"$P\" row.${format}")
endforeach()
expect_shell(1 "body.ply: row 1 of 'vertex' ends in a carriage return alone"
             "{ head -n 10 plain.ply; tail -n +11 plain.ply | tr '\\n' '\\r'; } > body.ply; exec \"$P\" body.ply")
expect_shell(0 "points +1," "printf '1 2 3\\r' > end.xyz; exec \"$P\" end.xyz --maximum-distance 1 2>&1")

# --- A byte 0, as of UTF-16: the message is whole
foreach(format IN ITEMS ${tables} off pcd)
  expect_shell(1 "zero.${format}: row 21 has a byte 0, which no text has but one of UTF-16"
               "{ head -n 20 plain.${format}; head -c 1 /dev/zero; tail -n +21 plain.${format}; } > zero.${format}; exec \"$P\" zero.${format}")
endforeach()

# --- Lines without an end. What has no bytes on the disk is 4 GB of zeros.
string(REGEX REPLACE " [01] [01] [01]\n" "\n" bare "${cube}")
string(REPEAT " " 65000 blanks)
string(REPEAT " 1" 100000 items)
set(strip "element strip 1\nproperty list int int vertex_indices\n")
file(WRITE "${WORK_DIR}/wide.xyz" "0 0${blanks}0\n1 0 0\n")
file(WRITE "${WORK_DIR}/strip.ply" "${ply_header}${positions}${strip}end_header\n${bare}100000${items}\n")
expect_shell(0 "points +2," "exec \"$P\" wide.xyz --maximum-distance 1 2>&1")
expect(0 "points +${n}," strip.ply ${epsilon}) # no line of points
set(limit "more than 65536 bytes, the limit of a")
find_program(timeout timeout)
find_program(truncate truncate)
if(timeout AND truncate)
  macro(expect_limit row name text)
    file(WRITE "${WORK_DIR}/${name}" "${text}")
    expect_shell(1 "${name}: ${row} has ${limit}" "truncate -s 4G ${name}; exec timeout -k 1 10 \"$P\" ${name}")
    file(REMOVE "${WORK_DIR}/${name}")
  endmacro()
  foreach(format IN LISTS tables)
    expect_limit("row 1" head.${format} "")
    expect_limit("row 3" rows.${format} "0 0 0\n1 0 0\n0 1 0")
    expect_limit("row 2" note.${format} "0 0 0\n# comment")
  endforeach()
  expect_limit("row 1" head.off "")
  expect_limit("row 2" count.off "OFF\n1")
  expect_limit("row 4" rows.off "OFF\n2 0 0\n0 0 0\n1 0 0")
  expect_limit("row 4" face.off "OFF\n1 1 0\n0 0 0\n1 0")
  expect_limit("row 1" head.ply "")
  expect_limit("row 3" note.ply "ply\nformat ascii 1.0\ncomment")
  expect_limit("row 2 of 'vertex'" rows.ply "${ply_rows}0 0 0\n1 0 0")
  expect_limit("row 1 of 'strip'" strip.ply "${ply_header}${positions}${strip}end_header\n${bare}1 ")
  expect_limit("row 1" head.pcd "")
  expect_limit("row 3" size.pcd "# comment\nFIELDS x y z\nSIZE 4")
  expect_limit("row 7" rows.pcd "${pcd_rows}0 0 0\n1 0 0")
endif()
find_program(gzip gzip)
if(gzip)
  expect_shell(1 "line.xyz.gz: (row 1 has ${limit}|this program was built without zlib)"
               "head -c 100000000 /dev/zero | gzip > line.xyz.gz; exec \"$P\" line.xyz.gz")
endif()

finish()
