# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Runs PROGRAM with ARGUMENTS in WORK_DIR. It has to exit with 0 and to print the text of expected/NAME.txt, which is
# that of a run. Left out of both are the parts that expected/differs.txt lists: times, and what others compute.

cmake_minimum_required(VERSION 3.17)

file(MAKE_DIRECTORY "${WORK_DIR}")
execute_process(COMMAND "${PROGRAM}" ${ARGUMENTS} WORKING_DIRECTORY "${WORK_DIR}" RESULT_VARIABLE status
                OUTPUT_VARIABLE out ERROR_VARIABLE err)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "exit code ${status}: ${out}${err}")
endif()

set(folder "${CMAKE_CURRENT_LIST_DIR}/expected")
file(READ "${folder}/${NAME}.txt" expected)
file(STRINGS "${folder}/differs.txt" rules REGEX "^[^#]")
set(same "${out}")
set(same_expected "${expected}")
foreach(rule IN LISTS rules)
  string(REGEX MATCH "^([^ ]+) +(.+)$" rule "${rule}")
  set(differs "${CMAKE_MATCH_2}")
  if(NOT NAME MATCHES "^example_${CMAKE_MATCH_1}$")
    continue()
  endif()
  if(NOT expected MATCHES "${differs}")
    message(FATAL_ERROR "expected/${NAME}.txt has nothing like '${differs}'")
  endif()
  string(REGEX REPLACE "${differs}" "" same "${same}")
  string(REGEX REPLACE "${differs}" "" same_expected "${same_expected}")
endforeach()
if(NOT same STREQUAL same_expected)
  message(FATAL_ERROR "${out}\ninstead of\n${expected}")
endif()
