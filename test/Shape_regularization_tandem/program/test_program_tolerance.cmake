# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The tolerance of each point: --tolerance-column in all formats, --noise, and --maximum-distance auto-local. PROGRAM is
# tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

# expect_tolerances(source minimum maximum ignored argument...): what the report says.
macro(expect_tolerances source minimum maximum ignored)
  expect(0 "^$" ${ARGN} --quiet --report t.json)
  file(READ "${WORK_DIR}/t.json" report)
  foreach(pair IN ITEMS "source;${source}" "minimum;${minimum}" "maximum;${maximum}")
    list(POP_FRONT pair name)
    string(JSON found GET "${report}" tolerance ${name})
    expect_equal("${name} of tolerances of ${ARGN}" "${found}" "${pair}")
  endforeach()
  string(JSON found GET "${report}" counts ignored_tolerances)
  expect_equal("ignored tolerances of ${ARGN}" "${found}" "${ignored}")
endmacro()

# --- Columns. Of the 1728 points of the cube, 24 have no tolerance, those of an edge have a small one.
file(WRITE "${WORK_DIR}/sigma.awk" [=[
{
  t = NR % 72 == 0 ? (NR % 144 ? 0 : -.25) : $1 > .02 ? .00390625 : .0078125
  print $1, $2, $3, before t
}
]=])
file(WRITE "${WORK_DIR}/cube.rows" "${cube}")
set(rows "awk -f sigma.awk cube.rows")
set(pcd "FIELDS x y z other Sigma\\nSIZE 8 8 8 4 8\\nTYPE F F F U F\\nPOINTS ${n}\\nDATA ascii\\n")
set(ply "ply\\nformat ascii 1.0\\nelement vertex ${n}\\nproperty double x\\nproperty double y\\nproperty double z\\n")
expect_shell(0 "^$" "${rows} > bare.xyz; awk -v before='7 ' -f sigma.awk cube.rows > other.rows
  { echo 'x y z scalar_Sigma'; cat bare.xyz; } > named.txt; { echo 'X,Y,Z,sigma'; tr ' ' , < bare.xyz; } > named.csv
  { printf '${pcd}'; cat other.rows; } > cloud.pcd
  { printf '${ply}property uchar other\\nproperty float sigma\\nend_header\\n'; cat other.rows; } > cloud.ply")
set(expected 0.00390625 0.0078125 24)
foreach(arguments IN ITEMS "named.txt" "named.csv" "cloud.pcd" "cloud.ply" "bare.xyz;--columns;x y z sigma")
  expect_tolerances("column sigma" ${expected} ${arguments} --tolerance-column sigma --labels t.labels)
  file(SHA256 "${WORK_DIR}/t.labels" found)
  if(NOT DEFINED labels)
    set(labels ${found})
  endif()
  expect_equal("labels of ${arguments}" "${found}" "${labels}")
endforeach()
# Of more than one input; also where an upper bound is given, and it is less.
expect_shell(0 "^$" "awk '/^[0-9]/ { $1 += 7 } 1' named.txt > second.txt")
expect_tolerances("column sigma" 0.00390625 0.0078125 48 named.csv second.txt --tolerance-column sigma)
expect_tolerances("column sigma" 0.00390625 0.0048828125 24 cloud.ply --tolerance-column sigma --maximum-distance 0.0048828125)
expect(0 "; ignored: 24 without a tolerance\n.*tolerances  0.003906 to 0.007812, by column sigma\n.*shapes +3 in" cloud.ply
       --tolerance-column sigma)
# They are written, and read again.
foreach(format IN ITEMS ply pcd xyz csv)
  expect(0 "^$" cloud.ply --tolerance-column sigma --output out.${format} --quiet)
  expect_tolerances("column tolerance" ${expected} out.${format} --estimate-normals --tolerance-column tolerance)
endforeach()
# Extra bytes of LAS: the shape of each point, as a number, is one more number.
expect(0 "^$" cloud.ply --maximum-distance 0.004 --output out.las --quiet)
expect_tolerances("column shape" 0.00390625 0.00390625 576 out.las --tolerance-column shape --maximum-distance 0.00390625)
expect(1 "out.las: has no extra dimension 'sigma', which --tolerance-column names; it has shape" out.las --tolerance-column sigma)

expect(1 "cloud.ply: has no property 'error', which --tolerance-column names; it has other, sigma\n" cloud.ply --tolerance-column error)
expect(1 "cloud.pcd: has no field 'error', .* it has x, y, z, other, Sigma\n" cloud.pcd --tolerance-column error)
expect(1 "named.csv: has no column 'error', .* it has X, Y, Z, sigma\n" named.csv --tolerance-column error)
expect(1 "named.csv: the column 'z' of --tolerance-column is a coordinate" named.csv --tolerance-column z)
expect(1 "bare.xyz: has no line of names, .*--columns names them" bare.xyz --tolerance-column sigma)
expect(2 ": --columns has no 'sigma', which --tolerance-column names" bare.xyz --columns "x y z _" --tolerance-column sigma)
expect(2 ": --columns has no '_', which --tolerance-column names" bare.xyz --columns "x y z _" --tolerance-column _)
expect(2 ": --columns has 'error', must be of" bare.xyz --columns "x y z error" --tolerance-column sigma)

# --- Noise: a multiple of it is the tolerance, which the help tells
expect_shell(0 "^$" "${rows} | cut -d ' ' -f -3 > plain.xyz
  awk 'BEGIN { for(i = 0; i < 40; ++i) for(j = 0; j < 40; ++j) print 3, 4 + i / 1e7, j / 1e7 }' > near.xyz")
file(WRITE "${WORK_DIR}/multiple.sh" [=[
multiple=$("$P" --help | tr -s ' \n' ' ' | sed 's/.*tolerance of each point is \([0-9.]*\) times that.*/\1/')
"$P" near.xyz --noise '0.3 r' --viewpoint 0,0,0 --report t.json --minimum-region-size 3 --quiet 2> /dev/null
grep -o '"minimum": [0-9.]*' t.json | awk -v m=$multiple '{ x = $2 / (.3 * 5 * m) } !(m > 1 && x > .99 && x < 1.01)'
]=])
expect_shell(0 "^$" ". ./multiple.sh")
expect(0 "tolerances  0.00[0-9]* to 0.01[0-9]*, by noise 0.001 . 0.02[*]r\n.*shapes +3 in" plain.xyz --noise "0.001 + 0.02*r"
       --viewpoint 0,0,0)
# Given normals have a side, so the place is only that of the sensor.
expect(0 "normals given\n.*by noise .001r.2\n" cube.ply --noise .001r^2 --viewpoint 1,1,1)
# Negative noise is none: points beyond a range of .1 are in no shape.
expect(0 "; ignored: [0-9]* without a tolerance\n" plain.xyz --noise "0.004 - 0.04*r" --viewpoint 0,0,0)
# The place of PCD files, if they have one.
set(head "SIZE 8 8 8\\nTYPE F F F\\nPOINTS ${n}\\nDATA ascii\\n")
expect_shell(0 "^$" "for v in '0 0 0 1 0 0 0' '0.1 0 0 1 0 0 0'; do
  { printf 'FIELDS x y z\\nVIEWPOINT %s\\n${head}' \"$v\"; cat plain.xyz; } > $(echo $v | cut -c -3 | tr -d ' ').pcd; done")
expect(0 "by noise .02r\n" 0.1.pcd --noise .02r)
expect(0 "by noise .02r\n" 00.pcd --noise .02r --viewpoint 0,0,0)
expect(1 "00.pcd: the VIEWPOINT is 0 0 0 1 0 0 0, .*: --noise needs it by --viewpoint X,Y,Z" 00.pcd --noise r)
expect(1 "plain.xyz: has no place of the sensor: --noise needs it by --viewpoint X,Y,Z" 0.1.pcd plain.xyz --noise r)
expect(2 ": --noise needs the place of the sensor: --viewpoint X,Y,Z .0,0,0 if it is the origin." plain.xyz --noise r)
foreach(text IN ITEMS r^3 "1 2" "a + b*r" "0.1 +" "0,1" 0)
  expect(2 ": --noise is '[^']*', which .*; it must be a sum of numbers and powers of the range r, as in " plain.xyz --noise "${text}"
         --viewpoint 0,0,0)
endforeach()

# A corridor, in which noise grows with the square of the range, is its walls and its end.
find_program(python3 python3)
if(python3)
  foreach(seed IN ITEMS 1 2 3)
    expect_shell(0 "^$" "\"${python3}\" \"${CMAKE_CURRENT_LIST_DIR}/sensor_clouds.py\" corridor ${seed} > corridor.xyz")
    expect(0 "shapes +5 in 5 planes of 3 directions" corridor.xyz --noise "0.0028*r^2" --viewpoint 1,2,3)
    expect(0 "estimate +The noise varies from .*: each point has a tolerance of its own .*by auto-local.*shapes +5 in 5 planes" corridor.xyz --report t.json)
    expect_shell(0 "\"note\": \"The noise varies" "grep note t.json")
  endforeach()
endif()

# --- One number, or one for each point
expect(0 "maximum distance 0.004, angle" plain.xyz --maximum-distance 0.004)
expect(0 "maximum distance [0-9.e-]* .estimated., angle" plain.xyz)
expect_shell(0 "^$" "\"$P\" plain.xyz --planes a.planes --quiet; \"$P\" plain.xyz --maximum-distance auto --planes b.planes --quiet; cmp a.planes b.planes")
expect(0 "tolerances .* by auto-local\n.*shapes +3 in" plain.xyz --maximum-distance auto-local)
expect(2 ": --maximum-distance is 'local', must be a number, auto or auto-local " plain.xyz --maximum-distance local)
expect(2 ": --tolerance-column and --noise both give " cloud.ply --tolerance-column sigma --noise r --viewpoint 0,0,0)
foreach(option IN ITEMS "--noise;r;--viewpoint;0,0,0" "--tolerance-column;sigma")
  expect(2 ": --maximum-distance auto-local and --[a-z-]* both give " cloud.ply --maximum-distance auto-local ${option})
endforeach()

finish()
