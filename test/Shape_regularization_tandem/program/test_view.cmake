# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The page of detect_planes --view: it is one file, and has all of the result. PROGRAM is tested in WORK_DIR. EMBED is
# the script that makes the page a part of the program.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

# --- Without three.js
execute_process(COMMAND ${CMAKE_COMMAND} -DOUTPUT=${WORK_DIR}/page_parts.cpp -P "${EMBED}")
file(READ "${WORK_DIR}/page_parts.cpp" source)
string(REGEX MATCHALL "_data\\[\\] = {\n  nullptr}" empty "${source}")
list(LENGTH empty count)
expect_equal("empty parts of a page without three.js" ${count} 2)
execute_process(COMMAND "${PROGRAM}" cube.ply ${epsilon} --quiet --view page.html WORKING_DIRECTORY "${WORK_DIR}"
                RESULT_VARIABLE status ERROR_VARIABLE err)
if(status EQUAL 2)
  expect(2 "built without three.js; install libjs-three and build again" no_such.ply --view page.html)
  expect_no_file(page.html)
  finish()
  message(STATUS "skipped: the program was built without three.js")
  return()
endif()
expect_equal("exit code" "${status}: ${err}" "0: ")

# --- One file
file(READ "${WORK_DIR}/page.html" page)
foreach(pattern IN ITEMS "<(script|link|img|iframe)[^>]* (src|href) *=" "@import" "url\\(" "@[a-z]+(\\.js|\\.css)?@")
  if("${page}" MATCHES "${pattern}")
    complain("the page has '${CMAKE_MATCH_0}'")
  endif()
endforeach()
string(REGEX MATCHALL "https?://[A-Za-z0-9.-]+" addresses "${page}")
list(REMOVE_DUPLICATES addresses)
foreach(address IN LISTS addresses)
  if(NOT address MATCHES "^https?://(www.w3.org|graphics.stanford.edu|github.com|mrdoob.com|alteredqualia.com|erichaines.com)$")
    complain("the page has the address ${address}")
  endif()
endforeach()
if(NOT "${page}" MATCHES "^<!DOCTYPE html>" OR NOT "${page}" MATCHES "</html>\n$")
  complain("the page is not complete")
endif()

# --- Its data: expect_scene() sets the variable scene from the variable page, and checks the numbers.
macro(expect_scene)
  string(REGEX MATCH "id=\"scene\">({[^<]*)</script>\n<script type=\"text/plain\" id=\"points\">\n([^<]*)\n</script>"
         found "${page}")
  set(scene "${CMAKE_MATCH_1}")
  string(LENGTH "${CMAKE_MATCH_2}" length)
  math(EXPR expected "4 * ((24 + 7 * ${n}) / 3)") # a block without padding
  expect_equal("length of the points" ${length} ${expected})
  foreach(member IN ITEMS "points;${n}" "shown;${n}" "stride;1" "directions;3" "planes;3" "ignored;0")
    list(GET member 0 name)
    list(GET member 1 expected)
    string(JSON value GET "${scene}" ${name})
    expect_equal("${name} of the page" "${value}" "${expected}")
  endforeach()
  set(sum 0)
  foreach(i RANGE 3)
    string(JSON shown GET "${scene}" shapes shown ${i})
    math(EXPR sum "${sum} + ${shown}")
  endforeach()
  expect_equal("points shown of all shapes" ${sum} ${n})
  string(JSON pairs LENGTH "${scene}" orthogonal)
  expect_equal("orthogonal pairs" ${pairs} 3)
endmacro()
expect_scene()
foreach(i RANGE 2) # squares of 0.161, or a spacing wider where the planes of others bound them
  string(JSON area GET "${scene}" shapes area ${i})
  if(NOT "${area}" MATCHES "^0\\.02[5678]")
    complain("the area of shape ${i} is ${area}")
  endif()
  foreach(column IN ITEMS turned_deg shifted mean_distance) # the faces are planar
    string(JSON value GET "${scene}" shapes ${column} ${i})
    if(NOT "${value}" MATCHES "^0(\\.0)?$|e-(0[6-9]|[1-9][0-9])$")
      complain("${column} of shape ${i} is ${value}")
    endif()
  endforeach()
endforeach()

# --- Its layers: the faces meet in seven corners; an outline of at least four of them and two triangles for each face;
# colors where the input has any.
macro(expect_element id pattern)
  if(NOT "${page}" MATCHES "<script type=\"text/plain\" id=\"${id}\">\n(${pattern})</script>\n")
    complain("the element ${id} of the page does not match ${pattern}")
  endif()
  set(element "${CMAKE_MATCH_1}")
endmacro()
function(expect_bytes id least)
  expect_element(${id} "[A-Za-z0-9+/=]+\n")
  string(LENGTH "${element}" length)
  math(EXPR bytes "(${length} - 1) / 4 * 3")
  if(bytes LESS least)
    complain("the element ${id} of the page has ${bytes} bytes")
  endif()
  set(failures ${failures} PARENT_SCOPE)
endfunction()
expect_bytes(corners 84)   # 7 of 12 bytes
expect_bytes(loops 72)     # 3 x (1 number of loops, 1 of corners, 4 corners)
expect_bytes(triangles 84) # 3 x (1 number of triangles, 2 x 3 corners)
expect_element(input-colors "")
foreach(i RANGE 2)
  string(JSON side GET "${scene}" shapes outward ${i})
  if(NOT side MATCHES "^-?1$") # the normals are given
    complain("the outward side of shape ${i} is ${side}")
  endif()
endforeach()
string(REPLACE "\n" " 10 20 30\n" colored "${cube}")
set(channels "property uchar red\nproperty uchar green\nproperty uchar blue\n")
file(WRITE "${WORK_DIR}/colored.ply" "${ply_header}${positions}${normals}${channels}end_header\n${colored}")
expect(0 "^$" colored.ply ${epsilon} --quiet --view colored.html)
file(READ "${WORK_DIR}/colored.html" page)
expect_element(input-colors "(ChQe)+\n") # 10 20 30
string(LENGTH "${element}" length)
math(EXPR expected "4 * ${n} + 1")
expect_equal("length of the colors" ${length} ${expected})

# --- Large coordinates, and a name that is markup
make_cube(far_cube 4500000)
file(WRITE "${WORK_DIR}/<script>.ply" "${ply_header}${positions}${normals}end_header\n${far_cube}")
expect(0 "^$" "<script>.ply" ${epsilon} --quiet --view far.html)
file(READ "${WORK_DIR}/far.html" page)
expect_scene()
string(JSON value GET "${scene}" name)
expect_equal("name" "${value}" "<script>.ply")

# --- Bad names
expect(1 "no/page.html: cannot be written" cube.ply ${epsilon} --view no/page.html)
file(MAKE_DIRECTORY "${WORK_DIR}/a folder.html")
expect(1 "a folder.html: is a directory" cube.ply ${epsilon} --view "a folder.html")
expect(2 "must end in .html or .htm" cube.ply ${epsilon} --view cube.ply)
expect(2 "named twice" cube.ply ${epsilon} --view same.html --labels same.html)
expect(1 "labels: cannot be written" cube.ply ${epsilon} --view never.html --labels no/labels)
expect_no_file(never.html same.html)

finish()
