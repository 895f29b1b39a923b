# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# PLY with names and types of coordinates as people have them, and meshes: points on faces, or a refusal. PROGRAM is
# tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/room_support.cmake")

# --- Names and types. Binary and text files have the same result.
foreach(name IN ITEMS upper int uint short mixed big)
  expect(0 "points +3300, .*shapes +3 in 3 planes .*hash +[0-9a-f]+" ${name}.ply)
  string(REGEX MATCH "hash +[0-9a-f]+" hash "${out}")
  expect(0 "${hash}" ${name}_text.ply)
endforeach()

# write_ply(name properties rows...): a point in each row.
function(write_ply name properties)
  list(LENGTH ARGN count)
  string(REPLACE ";" "\nproperty " properties "${properties}")
  string(REPLACE ";" "\n" rows "${ARGN}")
  file(WRITE "${WORK_DIR}/${name}"
       "ply\nformat ascii 1.0\nelement vertex ${count}\nproperty ${properties}\nend_header\n${rows}\n")
endfunction()
# expect_points(name text argument...): the coordinates and all else, as a table of the output.
macro(expect_points name text)
  execute_process(COMMAND "${PROGRAM}" ${name} --maximum-distance 1 --output points.csv --colors input --quiet ${ARGN}
                  WORKING_DIRECTORY "${WORK_DIR}" RESULT_VARIABLE status ERROR_VARIABLE err)
  set(table "")
  if(EXISTS "${WORK_DIR}/points.csv")
    file(READ "${WORK_DIR}/points.csv" table)
    file(REMOVE "${WORK_DIR}/points.csv")
  endif()
  if(NOT "${table}" MATCHES "${text}")
    complain("${name}: no '${text}' in: ${table}${err}")
  endif()
endmacro()
set(three "float x;float y;float z")
set(rows "1 2 3 4" "5 6 7 8" "2 9 1 0")
write_ply(both.ply "float X;${three}" ${rows}) # x, not X
write_ply(list.ply "${three};list uchar int ids" "1 2 3 2 8 9" "5 6 7 0" "2 9 1 1 7")
write_ply(normals.ply "double X;int Y;short Z;float NX;float NY;float NZ;ushort R;ushort g;ushort b"
          "0.1 -20 30 0 0 1 300 0 65535" "1 2 3 0 0 1 0 1 2" "4 5 1 0 0 1 7 7 7")
write_ply(float.ply "float x;float y;float z" "0.1 1e-60 16777217" "1 2 3" "4 5 1")
write_ply(nan.ply "${three}" "nan 1 2" "+1 2. .3e1" "5 6 7" "2 9 1")
expect_points(both.ply "\n2,3,4,")
expect_points(list.ply "\n5,6,7,.*\n2,9,1,")
expect_points(normals.ply "x,y,z,nx,ny,nz,r,g,b,shape\n0.1,-20,30,0,0,1,[0-9]+,0,255,")
expect_points(float.ply "\n0.10000000149[0-9]*,0,16777216,")
expect_points(nan.ply "\nnan,1,2,.*\n1,2,3,")
foreach(value IN ITEMS 256 -1 1.5 1e2 x 99999999999999999999)
  write_ply(wrong.ply "uchar x;float y;float z" "1 2 3" "${value} 2 3")
  expect(1 "wrong.ply: unreadable after point 1 of 2 .a value is not of the type that the header says: '${value}' of the property 'x'."
         wrong.ply)
endforeach()
foreach(value IN ITEMS 1e39 1,5 1.5x 0x10 --1)
  write_ply(wrong.ply "float x;float y;float z" "1 2 3" "${value} 2 3")
  expect(1 "wrong.ply: (unreadable after point 1 of 2|row 2 of 'vertex' has a comma)" wrong.ply)
endforeach()
write_ply(missing.ply "float X;float Y;float W" "1 2 3" "1 2 3")
expect(1 "missing.ply: the points of the PLY file have no property 'z'" missing.ply)
expect(1 "both.ply: has no property 'error', which --tolerance-column names; it has X" both.ply --tolerance-column error)

# --- Meshes: a box of 4 x 3 x 2 with faces of three to four corners
set(corners "0 0 0\n4 0 0\n4 3 0\n0 3 0\n0 0 2\n4 0 2\n4 3 2\n0 3 2\n")
set(faces "4 0 3 2 1\n3 4 5 6\n3 4 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n")
set(box "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n")
file(WRITE "${WORK_DIR}/box.ply" "${box}element face 7\nproperty list uchar int vertex_indices\nend_header\n${corners}${faces}")
file(WRITE "${WORK_DIR}/box.off" "OFF\n8 7 0\n${corners}${faces}")
foreach(name IN ITEMS box.ply box.off)
  expect(1 "${name}: has 7 faces: --sample N puts N points on the faces of a mesh, --sample 0 takes their corners only\n" ${name})
  expect_shell(0 "points +8,.*sample +the corners of 7 faces" "exec \"$P\" ${name} --sample 0 --maximum-distance .1 2>&1")
  expect(0 "points +5200, normals given\n +sample +5200 points on 7 faces\n.*shapes +6 in 6 planes of 3 directions.*coverage 100 %.*hash +[0-9a-f]+"
         ${name} --sample 5200 --maximum-distance 0.01 --planes ${name}.txt --oriented)
  string(REGEX MATCH "hash +[0-9a-f]+" hash_of_${name} "${out}")
endforeach()
expect_equal("hash of OFF" "${hash_of_box.off}" "${hash_of_box.ply}")
# In proportion to the areas, 12, 8 and 6 of twice 26
file(STRINGS "${WORK_DIR}/box.ply.txt" planes)
list(LENGTH planes count)
expect_equal("planes" ${count} 6)
expect(0 "^$" box.off --sample 5200 --maximum-distance 0.01 --output box.csv --quiet)
file(STRINGS "${WORK_DIR}/box.csv" top REGEX "^[^,]*,[^,]*,2,0,0,1,")
file(STRINGS "${WORK_DIR}/box.csv" front REGEX "^[^,]*,-?0,[^,]*,-?0,-1,-?0,")
file(STRINGS "${WORK_DIR}/box.csv" side REGEX "^4,[^,]*,[^,]*,1,-?0,-?0,")
foreach(part IN ITEMS "top;1200" "front;800" "side;600")
  list(GET part 0 name)
  list(GET part 1 expected)
  list(LENGTH ${name} count)
  math(EXPR difference "${count} - ${expected}")
  if(difference GREATER 1 OR difference LESS -1)
    complain("${name} has ${count} points instead of ${expected}")
  endif()
endforeach()

# What is wrong
foreach(face IN ITEMS "3 0 1 8" "3 0 1 -1")
  file(WRITE "${WORK_DIR}/corner.ply" "${box}element face 1\nproperty list int int vertex_index\nend_header\n${corners}${face}\n")
  file(WRITE "${WORK_DIR}/corner.off" "OFF\n8 1 0\n${corners}${face}\n")
  expect(1 "corner.ply: face 1 has a corner that is none of the 8 points" corner.ply --sample 9)
  expect(1 "corner.off: face 1 has a corner that is none of the 8 points" corner.off --sample 9)
endforeach()
file(WRITE "${WORK_DIR}/flat.off" "OFF\n8 2 0\n${corners}3 0 0 1\n2 0 1\n")
file(WRITE "${WORK_DIR}/short.off" "OFF\n8 1 0\n${corners}4 0 1 2\n")
file(WRITE "${WORK_DIR}/infinite.off" "OFF\n3 1 0\n0 0 0\n1e200 0 0\n0 1e200 0\n3 0 1 2\n")
file(WRITE "${WORK_DIR}/strips.ply" "${box}element tristrips 1\nproperty list int int vertex_indices\nend_header\n${corners}3 0 1 2\n")
expect(1 "flat.off: has faces, but none that has an area" flat.off --sample 9)
expect(1 "short.off: face 1 is not the number of its corners" short.off --sample 9)
expect(1 "infinite.off: face 1 has no finite area" infinite.off --sample 9)
expect(1 "strips.ply: has 'tristrips' without the corners of single faces; --sample 0 takes" strips.ply --sample 9)
expect(1 "strips.ply: has 1 face: --sample N" strips.ply)
expect(1 "box.ply: has faces: the points .* have no 'classification', which --classes needs" box.ply --sample 9 --classes 1)
expect_warnings(cube.ply ${epsilon} --sample 9 WARNINGS "cube.ply: has no faces for --sample, its points are taken")
expect(2 "sample is -1, must be in .0, 1000000000." box.ply --sample -1)
expect(2 "sample is for meshes" plain.xyz --sample 9)

finish()
