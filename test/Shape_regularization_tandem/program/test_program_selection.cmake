# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Parts of the result and of the input of detect_planes: --largest, --minimum-area, --minimum-extent, --near-direction and
# --crop. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

# A level face of 24 x 24 points, edge 0.161, a wall of 20 x 24 points, a wall of 16 x 24 points with a slope of 5 degrees,
# and 13 x 24 points of a roof of 45 degrees: by falling number of points.
expect_shell(0 "^$" "awk 'BEGIN { print \"x y z nx ny nz\"; s = sin(3.14159265 / 36); c = cos(3.14159265 / 36)
  for(i = 1; i <= 24; ++i) for(j = 1; j <= 24; ++j) { x = 7 * i / 1000; y = 7 * j / 1000
    print x, y, 0, 0, 0, 1; if(i <= 20) print x, 1, y, 0, 1, 0; if(i <= 16) print 1 + x * s, y, x * c, c, 0, -s
    if(i <= 13) print 2 + x * sqrt(.5), y, x * sqrt(.5), -sqrt(.5), 0, sqrt(.5) } }' > parts.xyz")
set(parts parts.xyz ${epsilon} --minimum-region-size 100)

# expect_sizes(sizes argument...): the numbers of points of the shapes by --labels, in their order, and what the report says.
function(expect_sizes sizes)
  execute_process(COMMAND "${PROGRAM}" ${parts} ${ARGN} --labels l.bin --planes p.txt --report r.json --output o.ply
                          --polygons o.obj --quiet
                  WORKING_DIRECTORY "${WORK_DIR}" RESULT_VARIABLE status ERROR_VARIABLE err)
  expect_equal("${ARGN}: exit code and errors" "${status}${err}" "0")
  execute_process(COMMAND sh -c "od -An -v -t d4 -w4 l.bin | sort -n | uniq -c | awk '$2 >= 0 {printf \"%s%d\", n++ ? \" \" : \"\", $1}'"
                  WORKING_DIRECTORY "${WORK_DIR}" OUTPUT_VARIABLE found)
  expect_equal("${ARGN}: sizes" "${found}" "${sizes}")
  string(REPLACE " " ";" list "${sizes}")
  list(LENGTH list shapes)
  file(STRINGS "${WORK_DIR}/p.txt" planes)
  list(LENGTH planes written)
  expect_equal("${ARGN}: planes" "${written}" "${shapes}")
  file(READ "${WORK_DIR}/r.json" report)
  string(JSON counted GET "${report}" counts shapes)
  expect_equal("${ARGN}: counts of shapes" "${counted}" "${shapes}")
  string(JSON assigned GET "${report}" counts assigned)
  string(JSON unselected GET "${report}" free unselected)
  string(JSON total GET "${report}" free total)
  string(REPLACE ";" "+" sum "${list}")
  math(EXPR sum "${sum}")
  expect_equal("${ARGN}: assigned" "${assigned}" "${sum}")
  math(EXPR sum "1752 - ${assigned}")
  expect_equal("${ARGN}: free points" "${total} ${unselected}" "${sum} ${sum}")
  if(NOT "${ARGN}" STREQUAL "")
    string(JSON detected GET "${report}" selection detected_shapes)
    string(JSON options GET "${report}" selection options)
    list(JOIN ARGN " " given)
    expect_equal("${ARGN}: selection" "${detected}, ${options}" "4, ${given}")
  endif()
  set(failures ${failures} PARENT_SCOPE)
endfunction()

expect_sizes("576 480 384 312")
expect_sizes("576" --largest 1)
expect_sizes("576 480 384" --largest 3)
expect_sizes("576 480 384 312" --largest 9)
expect_sizes("576" --near-direction 0,0,-2)
expect_sizes("576" --near-direction horizontal)
expect_sizes("480 384" --near-direction vertical)
expect_sizes("480" --near-direction vertical,4)
expect_sizes("480 384 312" --near-direction vertical,46)
expect_sizes("576 312" --near-direction horizontal,46)
expect_sizes("312" --near-direction "-1,0,1, 1")
expect_sizes("480" --largest 1 --near-direction vertical)
expect_sizes("576 480" --minimum-area 0.018)
expect_sizes("576 480 384" --minimum-area 0.0145)
expect_sizes("480" --largest 1 --minimum-area 0.0145 --near-direction vertical)
expect_sizes("576 480 384 312" --minimum-extent 0.16)
# The direction of symmetry is upward.
set(parts ${parts} --symmetry-direction 0,1,0)
expect_sizes("480" --near-direction horizontal)
expect_sizes("576 384 312" --near-direction vertical)
set(parts parts.xyz ${epsilon} --minimum-region-size 100)

# --- The summary says how many of how many; the outputs of what is left are those of any result
expect(0 "selection +1 of 4 shapes, with 576 of 1752 points .--largest 1.\n +shapes +1 in 1 planes" ${parts} --largest 1)
expect(0 "67[0-9.]* % of shapes that were not selected" ${parts} --largest 1)
expect(0 "shapes +4 in 4 planes" ${parts})
if("${out}" MATCHES "selection")
  complain("a selection without options: ${out}")
endif()
expect(0 "shapes +2" ${parts} --near-direction vertical --output o.csv)
expect_shell(0 "^-1 0 1 $" "sed 1d o.csv | awk -F, '{print $NF}' | sort -n | uniq | tr '\\n' ' '")

# --- With other options: one for each plane, sides, models and the page, whose warnings are about what is left
expect(0 "selection +1 of 4 shapes.*--by-plane --largest 1" ${parts} --by-plane --largest 1 --report r.json)
expect_shell(0 "\"options\": \"--by-plane --largest 1\"" "cat r.json")
expect(0 "selection +4 of 4 shapes, with 1752 of 1752 points .--by-plane." ${parts} --by-plane)
set_view(view v.html)
expect(0 "selection +2 of 4" ${parts} --near-direction vertical --oriented --planes p.txt --shapes s.csv
       ${view} --by-plane --vg o.vg --polygons o.geojson)
expect_shell(0 "^3\n$" "wc -l < s.csv")
expect_shell(0 "^2\n$" "grep -c '\"id\": [01],' o.geojson")
expect_shell(0 "^num_groups: 2\n$" "grep num_groups o.vg")
expect(0 "--minimum-area 0.020123456789 --minimum-extent 0.16" ${parts} --minimum-area 0.020123456789 --minimum-extent 0.16)

# --- Nothing is left: a warning, and files without shapes
expect_warnings(${parts} --minimum-extent 1 --labels l.bin --planes p.txt --polygons o.obj --vg o.vg --output o.ply
                WARNINGS "none of the 4 shapes fits --minimum-extent 1: the outputs have none")
file(SIZE "${WORK_DIR}/p.txt" size)
expect_equal("bytes of planes" "${size}" 0)
expect_shell(0 "^ *1752 -1\n$" "od -An -v -t d4 -w4 l.bin | sort | uniq -c | tr -s ' '")

# --- Wrong values
foreach(value IN ITEMS 0 -1 99999999999)
  expect(2 "--largest is ${value}, must be in .1, 2147483648." ${parts} --largest ${value})
endforeach()
foreach(option IN ITEMS minimum-area minimum-extent)
  foreach(value IN ITEMS 0 -2 nan inf 1e300)
    expect(2 "--${option} is .*, must be positive" ${parts} --${option} ${value})
  endforeach()
  expect(2 "--${option}" ${parts} --${option} wide)
endforeach()
foreach(value IN ITEMS up 0,0 0,0,0 0,0,1,91 0,0,1,-1 0,0,nan 0,0,inf 0,0,1,2,3 vertical,up "vertical," vertical,1,2 vertical,-1 0,0,1,)
  expect(2 "--near-direction is '${value}', must be X,Y,Z, not all 0, vertical or horizontal" ${parts} "--near-direction=${value}")
endforeach()

# --- Cropped input is as if the other points were not there
expect_shell(0 "^$" "awk 'NR == 1 || $1 <= 0.1' parts.xyz > low.xyz; grep -v e parts.xyz | awk '$1 >= 1.5' > high.xyz
                     echo nan 0 0 0 0 1 >> parts.xyz; sed 's/ /,/g' parts.xyz > parts.csv")
expect(0 "shapes" low.xyz ${epsilon} --labels low.bin --minimum-region-size 100)
string(REGEX MATCH "hash +[0-9a-f]+" hash "${out}")
foreach(box IN ITEMS 0,0,0,0.1,1,1 "-inf,-inf,-inf,0.1,inf,inf" "0, 0, 0, 0.1, 2, 2")
  expect(0 "${hash}" ${parts} --crop=${box} --labels l.bin)
endforeach()
expect_shell(0 "^$" "cmp low.bin l.bin")
expect(0 "${hash}" parts.csv ${epsilon} --minimum-region-size 100 --crop 0,0,0,0.1,1,1)
expect(0 "points +1753" ${parts})
expect(1 "parts.xyz: has no points in the box of --crop: its own is 0.007,0.007,0,2.06[0-9]*,1,0.168" ${parts} --crop 5,5,5,6,6,6)
expect_shell(0 "warning: low.xyz: has no points in the box of --crop: its own is 0.007" "$P low.xyz parts.xyz --crop 1.5,0,0,3,1,1 --maximum-distance 0.004 2>&1")
foreach(box IN ITEMS 0,0,0,1,1 0,0,0,1,1,1,1 0,0,0,-1,1,1 0,0,0,1,1,nan 0,0,0,1,1, a,b,c,d,e,f)
  expect(2 "--crop is '${box}', must be XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX" ${parts} "--crop=${box}")
endforeach()
# Points on the faces of a mesh, not its corners.
file(WRITE "${WORK_DIR}/square.off" "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
file(WRITE "${WORK_DIR}/square.ply" "ply\nformat ascii 1.0\nelement vertex 4\n${positions}element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
foreach(mesh IN ITEMS square.off square.ply)
  expect(0 "points +[23][0-9][0-9], normals given.*shapes +1 in" ${mesh} --sample 1000 --crop 0.25,0.25,-1,0.75,0.75,1 --maximum-distance .01 --output o.csv)
endforeach()
expect_shell(0 "^0$" "awk -F, 'NR > 1 && ($1 < .25 || $1 > .75 || $2 < .25 || $2 > .75)' o.csv | wc -l | tr -d ' \n'")
finish()
