# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Runs PROGRAM with ARGUMENTS in WORK_DIR. It has to exit with 0 and to print the text of
# the file EXPECTED, in which * stands for what may differ: times, and what others compute.

cmake_minimum_required(VERSION 3.17)

file(MAKE_DIRECTORY "${WORK_DIR}")
execute_process(COMMAND "${PROGRAM}" ${ARGUMENTS} WORKING_DIRECTORY "${WORK_DIR}" RESULT_VARIABLE status
                OUTPUT_VARIABLE out ERROR_VARIABLE err)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "exit code ${status}: ${out}${err}")
endif()

file(READ "${EXPECTED}" expected)
string(REPLACE "\n" ";" expected_lines "${expected}")
string(REPLACE "\n" ";" lines "${out}")
list(LENGTH expected_lines expected_count)
list(LENGTH lines count)
if(NOT count EQUAL expected_count)
  message(FATAL_ERROR "${count} lines instead of ${expected_count}: ${out}")
endif()
foreach(expected_line line IN ZIP_LISTS expected_lines lines)
  string(REGEX REPLACE "([][+.()^$?|\\])" "\\\\\\1" pattern "${expected_line}")
  string(REPLACE "*" ".*" pattern "${pattern}")
  if(NOT line MATCHES "^${pattern}$")
    message(FATAL_ERROR "'${line}'\ninstead of\n'${expected_line}'")
  endif()
endforeach()
