# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The contract of the program detect_planes: outputs, exit codes, and one line on
# standard error for whatever goes wrong. PROGRAM is tested in WORK_DIR, whose path
# should have a blank.

cmake_minimum_required(VERSION 3.19)

set(failures 0)
function(complain text)
  message(SEND_ERROR "${text}")
  math(EXPR failures "${failures} + 1")
  set(failures ${failures} PARENT_SCOPE)
endfunction()

# expect(code pattern argument...): the exit code, and what the output matches.
macro(expect code pattern)
  execute_process(COMMAND "${PROGRAM}" ${ARGN} WORKING_DIRECTORY "${WORK_DIR}" RESULT_VARIABLE status
                  OUTPUT_VARIABLE out ERROR_VARIABLE err)
  check_run("${code}" "${pattern}" "${ARGN}")
endmacro()

# expect_shell(code pattern command): the same through sh, where $P is the program.
macro(expect_shell code pattern command)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env "P=${PROGRAM}" sh -c "${command}" WORKING_DIRECTORY "${WORK_DIR}"
                  RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  check_run("${code}" "${pattern}" "${command}")
endmacro()

macro(check_run code pattern what)
  if(NOT "${status}" STREQUAL "${code}")
    complain("${what}\n  exit code ${status} instead of ${code}: ${out}${err}")
  endif()
  if(NOT "${out}${err}" MATCHES "${pattern}")
    complain("${what}\n  output does not match '${pattern}': ${out}${err}")
  endif()
  if(NOT "${code}" STREQUAL "0" AND NOT "${err}" MATCHES "^detect_planes: [^\n]+\n$")
    complain("${what}\n  not one line of error: '${err}'")
  endif()
  if("${code}" STREQUAL "0" AND NOT "${err}" STREQUAL "")
    complain("${what}\n  unexpected error output: ${err}")
  endif()
endmacro()

macro(expect_equal what value expected)
  if(NOT "${value}" STREQUAL "${expected}")
    complain("${what} is ${value} instead of ${expected}")
  endif()
endmacro()

macro(expect_no_file)
  foreach(file IN ITEMS ${ARGN})
    if(EXISTS "${WORK_DIR}/${file}")
      complain("${file} must not exist")
    endif()
  endforeach()
endmacro()

# Three faces of a cube, 24 x 24 points each, that share no edge: their coordinates
# and, separately, the normals. `shift` is added to x.
function(make_cube lines_name shift)
  set(lines "")
  foreach(i RANGE 1 24)
    foreach(j RANGE 1 24)
      math(EXPR a "1000 + ${i} * 7")
      math(EXPR b "1000 + ${j} * 7")
      string(SUBSTRING ${a} 1 3 a)
      string(SUBSTRING ${b} 1 3 b)
      string(APPEND lines "${shift}.${a} 0.${b} 0 0 0 1\n${shift}.${a} 0 0.${b} 0 1 0\n${shift} 0.${a} 0.${b} 1 0 0\n")
    endforeach()
  endforeach()
  set(${lines_name} "${lines}" PARENT_SCOPE)
endfunction()

set(n 1728)
set(ply_header "ply\nformat ascii 1.0\nelement vertex ${n}\n")
set(positions "property double x\nproperty double y\nproperty double z\n")
set(normals "property double nx\nproperty double ny\nproperty double nz\n")

file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}/a folder")
make_cube(cube 0)
make_cube(far_cube 4500000)
string(REGEX REPLACE " [01] [01] [01]\n" "\n" bare_cube "${cube}")
file(WRITE "${WORK_DIR}/cube.ply" "${ply_header}${positions}${normals}end_header\n${cube}")
file(WRITE "${WORK_DIR}/far.ply" "${ply_header}${positions}${normals}end_header\n${far_cube}")
file(WRITE "${WORK_DIR}/bare.ply" "${ply_header}${positions}end_header\n${bare_cube}")
file(WRITE "${WORK_DIR}/a folder/cube.xyz" "${cube}")
file(WRITE "${WORK_DIR}/cube.PWN" "${cube}")
file(WRITE "${WORK_DIR}/bare.off" "OFF\n${n} 0 0\n${bare_cube}")
set(epsilon --maximum-distance 0.004)

# --- Outputs
expect(0 "shapes +3 in 3 planes of 3 directions, 3 orthogonal" cube.ply ${epsilon} --output "a folder/out.ply"
       --labels out.labels --planes out.planes --report out.json --backend sequential)
file(READ "${WORK_DIR}/out.json" report)
string(JSON shapes ERROR_VARIABLE json_error GET "${report}" counts shapes)
expect_equal("JSON error" "${json_error}" "NOTFOUND")
expect_equal("shapes of the report" "${shapes}" 3)
foreach(member IN ITEMS "parameters;maximum_distance;0.004" "parameters;minimum_region_size" "counts;points;${n}"
        "counts;ignored;0" "counts;assigned" "counts;directions;3" "counts;planes;3" "counts;rounds"
        "criteria;coverage" "criteria;mean_distance" "criteria;complexity" "seconds;read" "seconds;normals"
        "seconds;sort" "seconds;neighbors" "seconds;growth" "seconds;regularity" "seconds;final" "seconds;total"
        "memory;process_peak_bytes" "backend" "device;CPU" "hash" "relations;parallel_groups"
        "relations;orthogonal_pairs" "relations;coplanar_groups")
  list(LENGTH member length)
  set(path ${member})
  if(length EQUAL 3 OR member STREQUAL "device;CPU")
    list(POP_BACK path expected)
  endif()
  string(JSON value ERROR_VARIABLE json_error GET "${report}" ${path})
  expect_equal("JSON error" "${json_error}" "NOTFOUND")
  if(expected AND NOT "${value}" STREQUAL "${expected}" AND NOT "${value}" MATCHES "^${expected}00000000")
    complain("report: ${path} is ${value} instead of ${expected}")
  endif()
  unset(expected)
endforeach()
string(JSON pairs LENGTH "${report}" relations orthogonal_pairs)
expect_equal("number of orthogonal pairs" ${pairs} 3)
string(JSON hash GET "${report}" hash)

math(EXPR label_bytes "4 * ${n}")
file(SIZE "${WORK_DIR}/out.labels" size)
expect_equal("size of the labels" ${size} ${label_bytes})
file(READ "${WORK_DIR}/out.labels" labels HEX)
if(NOT "${labels}" MATCHES "^((0[0-2]000000)|(ffffffff))+$")
  complain("labels outside of -1 to 2")
endif()
file(STRINGS "${WORK_DIR}/out.planes" planes)
list(LENGTH planes count)
expect_equal("lines of planes" ${count} 3)
set(number "-?[0-9.]+(e-?[0-9]+)?")
foreach(plane IN LISTS planes)
  if(NOT plane MATCHES "^${number} ${number} ${number} ${number}$")
    complain("not a plane: ${plane}")
  endif()
endforeach()
file(STRINGS "${WORK_DIR}/a folder/out.ply" header LIMIT_COUNT 15)
if(NOT "${header}" MATCHES "binary_little_endian.*vertex ${n};.*double x;.*float nx|double x;.*nx;.*uchar red;.*property int shape;end_header")
  complain("header of the output: ${header}")
endif()

# The output is a cloud again and gives the same answer, whatever the back end.
set(backends sequential auto)
if(WITH_TBB)
  list(APPEND backends parallel)
endif()
foreach(backend IN LISTS backends)
  expect(0 "${hash}" "a folder/out.ply" ${epsilon} --backend ${backend} --threads 3)
endforeach()
if(NOT WITH_TBB)
  expect(1 "oneTBB" cube.ply --backend parallel)
endif()
expect(0 "shapes +3 in" far.ply ${epsilon} --output far_out.ply)
expect(0 "shapes +3 in" far_out.ply ${epsilon})
expect(0 "^$" cube.ply ${epsilon} --quiet)
expect(0 "shapes +3 in" cube.ply ${epsilon} --no-parallelism --no-orthogonality --no-coplanarity --angle-tolerance 0
       --k-neighbors 10 --cell-size 512 --maximum-angle 20 --maximum-offset 0.002 --minimum-region-size 50)

# --- Formats and normals
expect(0 "normals given" "a folder/cube.xyz" ${epsilon})
expect(0 "normals given" cube.PWN ${epsilon})
expect(0 "shapes +3 in.*" bare.off ${epsilon} --output bare_out.ply)
expect(0 "normals given" bare_out.ply ${epsilon})
expect(0 "normals estimated\n.*shapes +3 in" --estimate-normals bare.ply ${epsilon})
expect(0 "normals by PCA of 9 neighbors\n.*shapes +3 in" --estimate-normals 9 bare.ply ${epsilon})
expect(0 "normals estimated\n.*shapes +3 in" cube.ply ${epsilon} --estimate-normals)
expect(0 "at least [0-9]+ points" cube.ply)
expect(0 "usage: detect_planes INPUT.*--maximum-distance.*default.*--report" --help)

# --- Unreadable input: exit 1
string(LENGTH "${cube}" length)
math(EXPR half "${length} / 2")
string(SUBSTRING "${cube}" 0 ${half} half_cube)
file(WRITE "${WORK_DIR}/empty.ply" "")
file(WRITE "${WORK_DIR}/text.ply" "Once upon a time\nthere was a cloud\n")
file(WRITE "${WORK_DIR}/text.xyz" "Once upon a time\nthere was a cloud\n")
file(WRITE "${WORK_DIR}/cube.doc" "${cube}")
file(WRITE "${WORK_DIR}/half.ply" "${ply_header}${positions}${normals}end_header\n${half_cube}")
file(WRITE "${WORK_DIR}/half.off" "OFF\n${n} 0 0\n${half_cube}")
file(WRITE "${WORK_DIR}/head.ply" "${ply_header}${positions}")
file(WRITE "${WORK_DIR}/none.ply" "ply\nformat ascii 1.0\nelement vertex 0\n${positions}end_header\n")
file(WRITE "${WORK_DIR}/huge.ply" "ply\nformat ascii 1.0\nelement vertex 99999999999999\n${positions}end_header\n0 0 0\n")
file(WRITE "${WORK_DIR}/words.ply" "ply\nformat ascii 1.0\nelement vertex 2\n${positions}end_header\n0 0 0\n0 zero 0\n")
file(WRITE "${WORK_DIR}/flat.ply" "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n")
file(WRITE "${WORK_DIR}/int.ply" "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\nend_header\n0 0 0\n")
file(WRITE "${WORK_DIR}/type.ply" "ply\nformat ascii 1.0\nelement vertex 1\n${positions}property half q\nend_header\n0 0 0 0\n")
expect(1 "missing.ply: no such file" missing.ply)
expect(1 "a folder: is a directory" "a folder")
expect(1 "empty.ply: is empty" empty.ply)
expect(1 "text.ply: is not a PLY file" text.ply)
expect(1 "text.xyz: " text.xyz)
expect(1 "cube.doc: unknown format" cube.doc)
expect(1 "half.ply: (is truncated|unreadable after point [0-9]+ of ${n})" half.ply --output never.ply)
expect(1 "half.off: unreadable after point [0-9]+ of ${n}" half.off)
expect(1 "head.ply: the PLY header has no end" head.ply)
expect(1 "none.ply: has no points" none.ply)
expect(1 "huge.ply: is truncated" huge.ply)
expect(1 "words.ply: unreadable after point 1 of 2" words.ply)
expect(1 "flat.ply: .*no property 'z'" flat.ply)
expect(1 "int.ply: the coordinates" int.ply)
expect(1 "type.ply: unknown type 'half'" type.ply)
expect_shell(1 "cut.ply: is truncated" "head -c 20000 'a folder/out.ply' > cut.ply; exec \"$P\" cut.ply --output never.ply")
file(WRITE "${WORK_DIR}/nan.sh" [=[
{ printf 'ply\nformat binary_little_endian 1.0\nelement vertex 60\n'
  printf 'property float x\nproperty float y\nproperty float z\nend_header\n'
  i=0; while [ $i -lt 180 ]; do printf '\000\000\300\177'; i=$((i + 1)); done; } > nan.ply
]=])
expect_shell(1 "nan.ply: none of its 60 points has finite" ". ./nan.sh; exec \"$P\" nan.ply")
expect_no_file(never.ply)

# --- Outputs that cannot be written: exit 1, and nothing that looks complete
file(WRITE "${WORK_DIR}/old.labels" "old")
expect(1 "no/such.ply: cannot be written" cube.ply ${epsilon} --output no/such.ply)
expect(1 "a folder: is a directory" cube.ply ${epsilon} --planes "a folder")
if(EXISTS /dev/full)
  foreach(output IN ITEMS output labels planes report)
    expect(1 "/dev/full: cannot be written completely" cube.ply ${epsilon} --${output} /dev/full)
  endforeach()
  expect(1 "/dev/full" cube.ply ${epsilon} --labels old.labels --planes never.planes --report /dev/full)
  expect_shell(1 "standard output" "exec \"$P\" cube.ply --maximum-distance 0.004 > /dev/full")
endif()
# A limit of the file size is a disk that runs full in the middle of a file.
expect_shell(1 "never.ply: cannot be written completely" "trap '' XFSZ; ulimit -f 8
  exec \"$P\" cube.ply --maximum-distance 0.004 --labels old.labels --output never.ply")
file(READ "${WORK_DIR}/old.labels" old)
expect_equal("an output of before" "${old}" "old")
expect_no_file(never.ply never.planes)

# --- Bad usage: exit 2
expect(2 "no INPUT")
expect(2 "unrecognised option" cube.ply --no-such-option)
expect(2 "unrecognised option" cube.ply --max 3)
expect(2 "too many positional" cube.ply bare.ply)
expect(2 "maximum-distance" cube.ply --maximum-distance far)
expect(2 "maximum-distance" cube.ply --maximum-distance)
foreach(option IN ITEMS "distance 0" "distance -1" "distance nan" "distance inf" "angle 0" "angle 90" "offset -1")
  string(REPLACE " " ";" words "--maximum-${option}")
  expect(2 "maximum.(distance|angle|offset)" cube.ply ${words})
endforeach()
expect(2 "angle_tolerance is 45" cube.ply --angle-tolerance 45)
expect(2 "minimum_region_size is 2" cube.ply --minimum-region-size 2)
expect(2 "minimum-region-size is -5" cube.ply --minimum-region-size=-5)
expect(2 "k_neighbors is 2" cube.ply --k-neighbors 2)
expect(2 "cell_size is 1," cube.ply --cell-size 1)
expect(2 "threads is 0" cube.ply --threads 0)
expect(2 "backend is 'gpu'" cube.ply --backend gpu)
expect(2 "estimate-normals is 2" cube.ply --estimate-normals 2)
expect(2 "named twice" cube.ply --output ./cube.ply)
expect(2 "named twice" cube.ply --output new.ply --labels "a folder/../new.ply")
expect(2 "threads is 0" missing.ply --threads 0)
expect(1 "CUDA" cube.ply --backend cuda)

# --- Ctrl-C: exit 1 and no files. On a very fast machine the run may be over before.
find_program(timeout timeout)
if(timeout)
  expect_shell(1 "interrupted" "awk 'BEGIN { for(i = 0; i < 1200000; ++i) print i % 1009, i % 997, i % 3 }' > big.xyz
    \"$P\" big.xyz --maximum-distance 0.5 --output never.ply & pid=$!
    sleep 0.5; kill -INT $pid; wait $pid")
  file(REMOVE "${WORK_DIR}/big.xyz")
  expect_no_file(never.ply)
endif()

file(GLOB leftovers "${WORK_DIR}/*.part*" "${WORK_DIR}/a folder/*.part*")
expect_equal("files left over" "${leftovers}" "")
if(failures GREATER 0)
  message(FATAL_ERROR "${failures} failures")
endif()
