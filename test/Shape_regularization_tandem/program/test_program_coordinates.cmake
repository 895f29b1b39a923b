# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Coordinates that are none, or no longer what was measured: detect_planes leaves points at 0 0 0 out where it is asked
# to, and says what is wrong with others. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

need_python3()
set(clouds "\"${python3}\" \"${CMAKE_CURRENT_LIST_DIR}/sensor_clouds.py\"")
foreach(kind IN ITEMS far half floats degrees plain)
  foreach(seed IN ITEMS 1 2)
    expect_shell(0 "^$" "${clouds} ${kind} ${seed} > ${kind}${seed}.xyz")
  endforeach()
endforeach()
set(tolerance --maximum-distance 0.012)

# --- Points at 0 0 0
foreach(seed IN ITEMS 1 2)
  foreach(kind IN ITEMS far half)
    set(zeros 3000)
    if(kind STREQUAL "far")
      set(zeros 20)
    endif()
    expect(0 "; ignored: ${zeros} at 0 0 0\n.*shapes +3 in 3 planes" ${kind}${seed}.xyz --ignore-zeros ${tolerance} --report z.json
           --labels z.labels --output z.ply)
    file(READ "${WORK_DIR}/z.json" report)
    string(JSON count GET "${report}" counts ignored_zeros)
    string(JSON others GET "${report}" counts ignored_coordinates)
    expect_equal("zeros of ${kind}${seed}" "${count}, ${others}" "${zeros}, 0")
    # They are in no shape, and where they were.
    expect_shell(0 "^$" "\"$P\" ${kind}${seed}.xyz --ignore-zeros --maximum-distance 0.012 --output z.txt --quiet &&
      awk '!/^#/ && $1 == 0 && $2 == 0 && $3 == 0 { ++n; if($NF != -1) print } END { if(n != ${zeros}) print n }' z.txt | head -3")
    # The others are those of a cloud without them.
    expect_shell(0 "^$" "grep -v '^0 0 0$' ${kind}${seed}.xyz > without.xyz
      \"$P\" without.xyz --maximum-distance 0.012 --planes without.planes --quiet; \"$P\" ${kind}${seed}.xyz --maximum-distance 0.012 --ignore-zeros --planes z.planes --quiet
      cmp without.planes z.planes")
    expect_warnings(${kind}${seed}.xyz --ignore-zeros)
  endforeach()
  # Where they are not left out, a hint does not blame the tolerance.
  expect_warnings(half${seed}.xyz ${tolerance} WARNINGS "3000 points are exactly at 0 0 0, as invalid pixels are: --ignore-zeros")
endforeach()
expect_shell(1 "all points are at 0 0 0, which --ignore-zeros leaves out" "printf '0 0 0\\n0 0 0\\n0 0 0\\n' > zero.xyz
  exec \"$P\" zero.xyz --ignore-zeros")

# --- Rounded, and degrees
foreach(seed IN ITEMS 1 2)
  expect_warnings(plain${seed}.xyz ${tolerance})
  expect_warnings(plain${seed}.xyz)
  expect_warnings(floats${seed}.xyz --maximum-distance 0.2
                  WARNINGS "rounded, x in steps of 0.0625, y in steps of 0.5, while .* is 0.2: write doubles, or subtract an offset")
  expect_shell(0 "warning: the coordinates are rounded, .*y in steps of 0.5" "\"$P\" floats${seed}.xyz 2>&1") # whatever is estimated
  expect_shell(0 "warning: the coordinates look like degrees of longitude and latitude .*: project such coordinates first, to UTM"
               "\"$P\" degrees${seed}.xyz 2>&1")
endforeach()
expect_shell(0 "^$" "{ echo lon,lat,height; tr ' ' , < degrees1.xyz; } > named.csv")
expect_shell(0 "warning: named.csv: x and y are columns of longitude and latitude: planes need lengths, so project.*columns +x y z\n"
             "\"$P\" named.csv --maximum-distance 0.1 2>&1")

finish()
