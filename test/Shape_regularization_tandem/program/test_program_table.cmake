# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The table of detect_planes --shapes beside the labels and planes of the same run, coplanar shapes as one, and the name of
# the labels in clouds. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")
need_python3()
set(cases "\"${python3}\" \"${CMAKE_CURRENT_LIST_DIR}/table_cases.py\"")
set(run "\"$P\" faces.xyz --maximum-distance 0.01 --minimum-region-size 100 --quiet")
expect_shell(0 "^$" "${cases} make > faces.xyz")

# --- The table
set(files "--shapes t.csv --labels t.labels --planes t.planes")
foreach(option IN ITEMS "" "--oriented")
  expect_shell(0 "^$" "${run} ${files} ${option} && ${cases} check faces.xyz t.csv t.labels t.planes 4")
endforeach()
expect_shell(0 "^$" "${run} --shapes alone.CSV && mv alone.CSV alone && ${run} --shapes all.csv --polygons all.ply &&
  cmp alone all.csv")
expect_shell(0 "^shape,points,a,[^\n]*,coplanar_group\n$" "\"$P\" faces.xyz --maximum-distance 0.01 --quiet \
  --minimum-region-size 3000 --shapes none.csv 2> warnings; cat none.csv")


# The features of GeoJSON have the same rows.
expect_shell(0 "^4 rows\n$" "${run} --oriented --shapes t.csv --polygons t.geojson && ${cases} features t.csv t.geojson")

# Upward is the symmetry direction: the roof is level then.
expect_shell(0 "^1\n$" "${run} --symmetry-direction=0.5,0,0.8660254037844386 --shapes up.csv &&
  tail -n +2 up.csv | cut -d, -f 15 | awk '$1 < 0.1' | wc -l")

# --- Coplanar shapes as one, in all outputs
expect_shell(0 "^$" "${run} ${files} --by-plane --report t.json --vg t.vg --polygons t.geojson --output t.txt &&
  ${cases} check faces.xyz t.csv t.labels t.planes 3")
expect_shell(0 "^num_groups: 3\n$" "grep num_groups t.vg")
expect_shell(0 "^3\n$" "grep -c '\"id\": [012],' t.geojson")
expect_shell(0 "^0\n1\n2\n$" "sed 1d t.txt | awk '$NF >= 0 { print $NF }' | sort -u")
expect_shell(0 "\"shapes\": 3,\n.*\"planes\": 3,\n" "cat t.json")
expect_shell(0 "^num_groups: 3\nnum_groups: 4\n$" "${run} --vg a.vg --vg-by-plane && ${run} --vg b.vg && # as in 0.2.0
  cat a.vg b.vg | grep num_groups")

# --- The name of the labels: they are the same, and the file can be read again.
expect_shell(0 "^$" "${run} --labels t.labels")
foreach(extension IN ITEMS ply pcd txt csv las)
  expect_shell(0 "^$" "${run} --output named.${extension} --label-property Plane_id9 &&
    ${run} --output plain.${extension} && sed 's/Plane_id9/shape/' named.${extension} > renamed")
  expect_shell(0 "^[1-9][0-9]*\n$" "head -c 1000 named.${extension} | grep -c -a Plane_id9")
  if(NOT extension STREQUAL "las") # whose names have a fixed size
    expect_shell(0 "^$" "cmp renamed plain.${extension}")
  endif()
  expect_shell(0 "^$" "\"$P\" named.${extension} --maximum-distance 0.01 --minimum-region-size 100 --quiet \
    --labels again.labels && { [ ${extension} = las ] || cmp t.labels again.labels; }")
endforeach()

# --- What is refused, before the cloud is read
foreach(name IN ITEMS "a b" "a-b" "9a" "_a" "ä" "abcdefghijklmnopqrstuvwxyz1234567")
  expect(2 "--label-property is '${name}', must be letters, digits and _, a letter first, at most 32" missing.ply
         --output a.ply --label-property "${name}")
endforeach()
foreach(name IN ITEMS x NX normal_x Red rgb intensity scalar_Intensity classification tolerance gps_time)
  expect(2 "--label-property is '${name}', which is the name of something else in clouds" missing.ply --output a.ply
         --label-property ${name})
endforeach()
expect(2 "--label-property needs --output or --output-directory" missing.ply --label-property a)
expect(2 "--shapes is 'a.txt', must end in .csv" missing.ply --shapes a.txt)
expect(2 "--shapes is '-', must end in .csv" missing.ply --shapes -)
expect(2 "the file a.csv is named twice" missing.ply --shapes a.csv --output a.csv)
expect(1 "cannot be written" faces.xyz --shapes missing/a.csv)
expect_no_file(a.csv a.ply)
finish()
