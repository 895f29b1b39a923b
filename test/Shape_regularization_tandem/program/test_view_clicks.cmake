# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Clicks, keys and fingers on the page of detect_planes --view: each test of click_*.js in a Chromium without a window.
# PROGRAM is tested in WORK_DIR, on a room. PLAYWRIGHT is the folder of scripts/install_playwright.sh. Skipped where
# that, node, Chromium or three.js is missing.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

find_program(CHROMIUM NAMES chromium chromium-browser google-chrome)
find_program(NODE NAMES node nodejs)
if(NOT CHROMIUM OR NOT NODE)
  message(STATUS "skipped: no Chromium or no node")
  return()
endif()
if(NOT EXISTS "${PLAYWRIGHT}/node_modules/playwright-core/package.json")
  message(STATUS "skipped: no playwright-core (scripts/install_playwright.sh ${PLAYWRIGHT})")
  return()
endif()
execute_process(COMMAND "${NODE}" "${CMAKE_CURRENT_LIST_DIR}/make_room.js" "${WORK_DIR}/room.ply"
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${PROGRAM}" room.ply --maximum-distance 0.02 --quiet --view room.html
                WORKING_DIRECTORY "${WORK_DIR}" RESULT_VARIABLE status ERROR_VARIABLE err)
if(status EQUAL 2 AND err MATCHES "without three.js")
  message(STATUS "skipped: the program was built without three.js")
  return()
endif()
expect_equal("exit code" "${status}: ${err}" "0: ")

foreach(name IN ITEMS select layers clip list save touch)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env "NODE_PATH=${PLAYWRIGHT}/node_modules" "CHROMIUM=${CHROMIUM}"
                          "${NODE}" "${CMAKE_CURRENT_LIST_DIR}/click_${name}.js" "${WORK_DIR}/room.html"
                  RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err TIMEOUT 300)
  if(NOT status EQUAL 0)
    complain("click_${name}.js: ${status}\n${out}${err}")
  endif()
endforeach()

finish()
