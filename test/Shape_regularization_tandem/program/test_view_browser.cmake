# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The page of detect_planes --view in a browser: what it draws, a click, and a lost WebGL context. PROGRAM is tested in
# WORK_DIR. Skipped where Chromium or three.js is not installed.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

find_program(CHROMIUM NAMES chromium chromium-browser google-chrome)
if(NOT CHROMIUM)
  message(STATUS "skipped: no Chromium")
  return()
endif()
execute_process(COMMAND "${PROGRAM}" cube.ply ${epsilon} --quiet --view page.html WORKING_DIRECTORY "${WORK_DIR}"
                RESULT_VARIABLE status ERROR_VARIABLE err)
if(status EQUAL 2 AND err MATCHES "without three.js")
  message(STATUS "skipped: the program was built without three.js")
  return()
endif()

set(browser "${CHROMIUM}" --headless=new --no-sandbox "--user-data-dir=${WORK_DIR}/profile" --no-first-run
            --use-angle=swiftshader --enable-unsafe-swiftshader --window-size=800,500 --enable-logging=stderr)

# show(address) sets shown, colors, drawn and selected to what the page tells after '#check'.
macro(show address)
  execute_process(
    COMMAND ${browser} --virtual-time-budget=10000 --dump-dom "file://${WORK_DIR}/page.html#check&${address}"
    RESULT_VARIABLE status OUTPUT_VARIABLE page ERROR_VARIABLE log TIMEOUT 60)
  expect_equal("exit code of Chromium" "${status}" 0)
  string(REGEX MATCH "<body[^>]*>" body "${page}")
  foreach(name IN ITEMS shown colors drawn selected)
    if(NOT "${body}" MATCHES "data-${name}=\"([a-z0-9]+)\"")
      complain("${address}: the page says nothing of ${name}: ${body}\n${log}")
    endif()
    set(${name} "${CMAKE_MATCH_1}")
  endforeach()
  if("${log}" MATCHES "CONSOLE[^\n]*" OR "${body}" MATCHES "data-error[^>]*")
    complain("${address}: ${CMAKE_MATCH_0}")
  endif()
endmacro()

# A click on one of the three faces. All points are drawn, on a good part of the canvas: in the color of the face and the
# weak ones of the others, which are mixed with that of the background.
show("elevation=35&azimuth=45&theme=dark&pick=0.5,0.6")
expect_equal("points shown" "${shown}" ${n})
if(colors LESS 4 OR colors GREATER 12)
  complain("the page has ${colors} colors")
endif()
if(NOT selected MATCHES "^shape[0-2]$")
  complain("the click selects ${selected}")
endif()
if(drawn LESS 5000)
  complain("only ${drawn} pixels are drawn")
endif()
set(all ${drawn})

# A shape, with other colors: as many pixels as before.
show("elevation=35&azimuth=45&theme=dark&shape=2&color=distance")
expect_equal("selected" "${selected}" shape2)
expect_equal("pixels with one shape selected" "${drawn}" "${all}")

# A group that does not exist, and a size that no shape has.
show("plane=7&smallest=1000&unassigned=0")
expect_equal("selected" "${selected}" none)
expect_equal("points shown of large shapes" "${shown}" 0)
expect_equal("pixels drawn of them" "${drawn}" 0)

# The context is lost, and returns. In real time: virtual time does not wait for what is drawn.
file(READ "${WORK_DIR}/page.html" page)
file(READ "${CMAKE_CURRENT_LIST_DIR}/lose_context.js" script)
string(REPLACE "</body>" "<script>\n${script}</script>\n</body>" page "${page}")
file(WRITE "${WORK_DIR}/lost.html" "${page}")
set(waiting "\"$@\" 2> log & for i in $(seq 250); do grep -aq 'wrong: ' log && break; sleep 0.2; done; kill $!; wait")
execute_process(COMMAND sh -c "${waiting}" sh ${browser} "file://${WORK_DIR}/lost.html#elevation=35&azimuth=45"
                WORKING_DIRECTORY "${WORK_DIR}" TIMEOUT 100)
file(READ "${WORK_DIR}/log" log)
if(NOT "${log}" MATCHES "\"wrong: nothing\"")
  string(REGEX MATCH "\"wrong: [^\"]*" told "${log}")
  complain("a lost context: ${told}\n${log}")
endif()

finish()
