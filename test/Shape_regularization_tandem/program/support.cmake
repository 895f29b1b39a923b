# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the tests of the program detect_planes share: an empty WORK_DIR, a cloud, and the checks of a run.

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
  if("${err}" MATCHES "cannot be (written|made)" AND NOT "${err}" MATCHES "cannot be (written|made)( completely)? \\([A-Z]")
    complain("${what}\n  no reason: '${err}'")
  endif()
  if("${code}" STREQUAL "0" AND NOT "${err}" STREQUAL "")
    complain("${what}\n  unexpected error output: ${err}")
  endif()
endmacro()

# set_view(variable FILE): --view FILE where the program can write a page, else nothing
function(set_view variable file)
  execute_process(COMMAND "${PROGRAM}" --help OUTPUT_VARIABLE help)
  set(${variable} PARENT_SCOPE)
  if(help MATCHES "--view FILE")
    set(${variable} --view ${file} PARENT_SCOPE)
  endif()
endfunction()

# expect_warnings(argument... WARNINGS pattern...): each pattern matches a warning, and there are no others, also with
# --quiet, and in the report.
function(expect_warnings)
  cmake_parse_arguments(PARSE_ARGV 0 given "" "" "WARNINGS")
  execute_process(COMMAND "${PROGRAM}" ${given_UNPARSED_ARGUMENTS} --quiet --report w.json WORKING_DIRECTORY "${WORK_DIR}"
                  RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  file(READ "${WORK_DIR}/w.json" report)
  string(JSON count LENGTH "${report}" warnings)
  list(LENGTH given_WARNINGS expected)
  string(REGEX MATCHALL "detect_planes: warning: " lines "${err}")
  list(LENGTH lines printed)
  if(NOT "${status}${out}" STREQUAL "0" OR NOT count EQUAL expected OR NOT printed EQUAL expected)
    complain("${given_UNPARSED_ARGUMENTS}: ${status}, ${count} warnings instead of ${expected}: ${out}${err}")
  endif()
  foreach(pattern IN LISTS given_WARNINGS)
    if(NOT "${err}" MATCHES "${pattern}" OR NOT "${report}" MATCHES "${pattern}")
      complain("${given_UNPARSED_ARGUMENTS}: no '${pattern}' in: ${err}")
    endif()
  endforeach()
  set(failures ${failures} PARENT_SCOPE)
endfunction()

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

# No partial file may be left.
macro(finish)
  file(GLOB_RECURSE leftovers "${WORK_DIR}/*.part*")
  expect_equal("files left over" "${leftovers}" "")
  if(failures GREATER 0)
    message(FATAL_ERROR "${failures} failures")
  endif()
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

# Ends the test as skipped if there is no python3. A macro, so that the file that calls it returns.
macro(need_python3)
  find_program(python3 python3)
  if(NOT python3)
    message(STATUS "skipped: there is no python3")
    return()
  endif()
endmacro()

set(n 1728)
set(ply_header "ply\nformat ascii 1.0\nelement vertex ${n}\n")
set(positions "property double x\nproperty double y\nproperty double z\n")
set(normals "property double nx\nproperty double ny\nproperty double nz\n")

file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}/a folder")
make_cube(cube 0)
file(WRITE "${WORK_DIR}/cube.ply" "${ply_header}${positions}${normals}end_header\n${cube}")
set(epsilon --maximum-distance 0.004)
