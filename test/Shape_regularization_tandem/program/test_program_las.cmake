# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The LAS files that detect_planes writes: the grid of coordinates is fine for the distances, wherever the cloud is, and
# the coordinate system is declared as what it is. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

need_python3()
set(cases "\"${python3}\" \"${CMAKE_CURRENT_LIST_DIR}/las_cases.py\"")
string(REGEX REPLACE " [01] [01] [01]\n" "\n" bare "${cube}")
file(WRITE "${WORK_DIR}/bare.txt" "${bare}")

# --- The grid. Clouds of several sizes: around the origin, beside it, on one side of it, and far away.
macro(expect_grid size place)
  set(placed "{ print ($1 + p) * s, ($2 + p) * s, ($3 + p) * s }")
  expect_shell(0 "^$" "awk -v OFMT=%.17g -v p=${place} -v s=${size} '${placed}' bare.txt > placed.txt
    \"$P\" placed.txt --maximum-distance $(awk 'BEGIN { print 0.004 * ${size} }') --output placed.las --quiet &&
    ${cases} grid placed.las $(awk 'BEGIN { print 0.004 * ${size} }') placed.txt &&
    ! od -An -v -t x8 -j 155 -N 24 placed.las | grep 8000000000000000") # no offset is -0
endmacro()
foreach(size IN ITEMS 1e-6 1e-3 1 3000 4e6)
  foreach(place IN ITEMS -0.5 -0.57 0 -1 1000.25)
    expect_grid(${size} ${place})
  endforeach()
endforeach()
# As wide as the integers allow for that step
file(WRITE "${WORK_DIR}/wide.txt" "-340000 0 0\n340000 0 0\n${bare}")
expect_shell(0 "^$" "\"$P\" wide.txt --maximum-distance 0.8 --output wide.las --quiet &&
  ${cases} grid wide.las 0.8 wide.txt")

# The grid of an input is kept for its points, not for finer ones of other inputs.
file(WRITE "${WORK_DIR}/fine.txt" "0.1234567 0.2345678 0.3456789\n")
expect_shell(0 "^$" "${cases} make coarse.las 2 none 0 6 0.001 < bare.txt
  \"$P\" coarse.las --maximum-distance 0.004 --output kept.las --quiet && ${cases} grid kept.las 10 bare.txt &&
  cmp -i 131:131 -n 48 coarse.las kept.las")
expect_shell(0 "^$" "\"$P\" coarse.las fine.txt --maximum-distance 0.004 --output both.las --quiet &&
  ${cases} grid both.las 0.004 bare.txt fine.txt")

# --- The coordinate system: the records of the input, and the flag for what they hold
# expect_projection(format records flag class new_format new_flag)
macro(expect_projection format records flag class new_format new_flag)
  expect_shell(0 "^$" "${cases} make in.las ${format} ${records} ${flag} ${class} 0.001 < bare.txt
    \"$P\" in.las --maximum-distance 0.004 --output out.las --quiet &&
    ${cases} projection out.las ${new_format} ${new_flag} ${records}")
endmacro()
foreach(format IN ITEMS 2 7)
  foreach(flag IN ITEMS 0 1)
    expect_projection(${format} none ${flag} 6 2 0)
    expect_projection(${format} 34735 ${flag} 6 2 0)
    expect_projection(${format} 2112 ${flag} 6 7 1)
  endforeach()
  expect_projection(${format} 34735,2112 0 6 2 0)
  expect_projection(${format} 34735,2112 1 6 7 1)
endforeach()
# Classes from 32 on need the format 7.
foreach(flag IN ITEMS 0 1)
  expect_projection(7 none ${flag} 200 7 1)
  expect_projection(7 34735 ${flag} 200 7 0)
  expect_projection(7 2112 ${flag} 200 7 1)
endforeach()
expect_projection(7 34735,2112 0 200 7 0)
expect_projection(7 34735,2112 1 200 7 1)
# Of another input
file(WRITE "${WORK_DIR}/class.txt" "x y z r g b intensity classification\n0.5 0.5 0.5 0 0 0 0 77\n")
expect_shell(0 "^$" "${cases} make keys.las 2 34735 0 6 0.001 < bare.txt
  \"$P\" keys.las class.txt --maximum-distance 0.004 --output out.las --quiet && ${cases} projection out.las 7 0 34735")

finish()
