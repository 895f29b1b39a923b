# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# detect_planes by several processes: they write the bytes of one, and leave no file that looks complete if one of them
# fails or is killed. PROGRAM is tested in WORK_DIR, started by MPIEXEC.

cmake_minimum_required(VERSION 3.19)

if(NOT MPIEXEC)
  message(STATUS "skipped: the program was built without MPI")
  return()
endif()
include("${CMAKE_CURRENT_LIST_DIR}/tiles_support.cmake")

# Open MPI asks who wants it as root, or with more processes than processors.
foreach(variable IN ITEMS ALLOW_RUN_AS_ROOT ALLOW_RUN_AS_ROOT_CONFIRM MCA_rmaps_base_oversubscribe
                 MCA_mpi_yield_when_idle)
  set(ENV{OMPI_${variable}} 1)
endforeach()
set(ENV{OMPI_MCA_hwloc_base_binding_policy} none)

# expect_ranks(n code pattern argument...). What mpirun says of a failure comes with the one line of the program.
macro(expect_ranks n code pattern)
  execute_process(COMMAND "${MPIEXEC}" -n ${n} "${PROGRAM}" ${ARGN} WORKING_DIRECTORY "${WORK_DIR}" TIMEOUT 100
                  RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  check_ranks("${code}" "${pattern}" "${n} ranks: ${ARGN}")
endmacro()

macro(check_ranks code pattern what)
  expect_equal("${what}\n${out}${err}\n  exit code" "${status}" "${code}")
  if(NOT "${out}${err}" MATCHES "${pattern}")
    complain("${what}\n  output does not match '${pattern}': ${out}${err}")
  endif()
  string(REPLACE ";" "," lines "${err}")
  string(REGEX REPLACE "detect_planes: warning: [^\n]+\n" "" lines "${lines}")
  string(REGEX MATCHALL "detect_planes: [^\n]+\n" lines "${lines}")
  list(LENGTH lines count)
  if(NOT "${code}" STREQUAL "0" AND NOT count EQUAL 1)
    complain("${what}\n  not one line of error: '${err}'")
  endif()
endmacro()

# --- A tile without points changes nothing, also where a process has no other
file(WRITE "${WORK_DIR}/ply.awk" [=[
BEGIN { printf "ply\nformat ascii 1.0\nelement vertex %d\n", n
        print "property float x\nproperty float y\nproperty float z\nproperty uchar classification\nend_header" }
n > 0 { print $1, $2, $3, 6 }
]=])
expect_shell(0 "^$" "for f in corner.pts last.xyz; do awk -v n=$(wc -l < $f) -f ply.awk $f > class_$f.ply; done")
expect_shell(0 "^$" "awk -v n=0 -f ply.awk corner.pts > class_none.ply")
set(class_tiles class_corner.pts.ply class_last.xyz.ply)
expect(0 "hash" ${class_tiles} ${parameters} --output-directory class_full)
foreach(n IN ITEMS 1 3)
  expect_ranks(${n} 0 "warning: class_none.ply: has no points" ${class_tiles} class_none.ply ${parameters}
               --output-directory class_${n})
  foreach(file IN LISTS class_tiles)
    expect_shell(0 "^$" "cmp class_full/${file} class_${n}/${file}")
  endforeach()
endforeach()
expect_shell(0 "property [a-z]+ classification" "cmp class_1/class_none.ply class_3/class_none.ply; cat class_3/class_none.ply")
expect_ranks(2 1 "none of the inputs has points" class_none.ply class_1/class_none.ply --planes none.txt)
expect_no_file(none.txt)

# --- The same sides: tiles of one shape are in several processes, which have viewpoints of their own
file(WRITE "${WORK_DIR}/pcd.awk" [=[
BEGIN { printf "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nVIEWPOINT %s 1 0 0 0\nPOINTS %d\nDATA ascii\n", from, n }
{ print $1, $2, $3 }
]=])
expect_shell(0 "^$" "awk -v n=$(wc -l < corner.pts) -v from='4 1.5 2' -f pcd.awk corner.pts > corner.pcd
  awk -v n=$(wc -l < last.xyz) -v from='4 -9 9' -f pcd.awk last.xyz > last.pcd")
foreach(inputs IN ITEMS "${tiles};--viewpoint;4,1.5,2" "corner.pcd;folder/Middle.XYZ;folder/sub/seam.csv;last.pcd")
  foreach(oriented IN ITEMS "" --oriented)
    foreach(n IN ITEMS 1 3)
      expect_ranks(${n} 0 "normals estimated, towards the viewpoint\n.*hash" ${inputs} ${parameters} ${oriented}
                   --output-directory sides_${n} --planes sides_${n}/planes)
    endforeach()
    expect_shell(0 "^$" "diff -r sides_1 sides_3; rm -r sides_1 sides_3")
  endforeach()
endforeach()
expect_ranks(2 1 "--viewpoint is for estimated normals, but the input has normals" class_1/class_corner.pts.ply
             class_1/class_last.xyz.ply ${parameters} --viewpoint 4,1.5,2)

# --- The same bytes
foreach(normals IN ITEMS estimated given)
  expect(0 "normals ${normals}.*hash" ${tiles} ${parameters} --output-directory one_${normals}
         --planes one_${normals}/planes --report one_${normals}/report)
  foreach(n IN ITEMS 1 2 3 6)
    set(folder ${n}_${normals})
    set(processes "execution +[a-z]+, ${n} processes of 1 thread,")
    if(n EQUAL 1)
      set(processes "execution +[a-z]+, 1 thread,")
    endif()
    expect_ranks(${n} 0 "normals ${normals}.*${processes}.*hash" ${tiles} ${parameters} --threads 1
                 --output-directory ${folder} --planes ${folder}/planes --report ${folder}/report)
    expect_same_results(one_${normals} ${folder})
  endforeach()
  if(normals STREQUAL "estimated") # what was written has some, but for .las
    list(REMOVE_ITEM outputs last.las)
    list(TRANSFORM outputs PREPEND one_estimated/ OUTPUT_VARIABLE tiles)
  endif()
endforeach()
expect_ranks(2 0 "execution +sequential, 2 processes of 1 thread" ${tiles} ${parameters} --backend sequential)
expect_ranks(2 0 "^$" ${tiles} ${parameters} --quiet)
expect_ranks(2 0 "^detect_planes .Tandem. [0-9.]+\n$" --version)

# --- Inputs that do not have the same
expect(0 "left out +normals, intensity, classification: not" ${tiles} last.las ${parameters} --output-directory mixed
       --planes mixed/planes --report mixed/report)
list(APPEND outputs last.las)
expect_ranks(3 0 "left out +normals, intensity, classification: not" ${tiles} last.las ${parameters} --output-directory mixed_3
             --planes mixed_3/planes --report mixed_3/report)
expect_same_results(mixed mixed_3)

# --- A part of the shapes, and of the points
list(REMOVE_ITEM outputs last.las)
set(selection ${tiles} ${parameters} --near-direction 0,0,1 --largest 2)
expect(0 "selection +[12] of [0-9]+ shapes" ${selection} --output-directory part --planes part/planes --report part/report)
string(REGEX MATCH "hash +[0-9a-f]+" hash "${out}")
expect_ranks(3 0 "selection +[12] of [0-9]+ shapes.*${hash}" ${selection} --output-directory part_3
             --planes part_3/planes --report part_3/report)
expect_same_results(part part_3)

# --- One message, and no file
expect_ranks(3 1 "nothere.ply: no such file" ${tiles} nothere.ply --output-directory none --planes none/planes)
expect_ranks(2 2 "--threads is 0" ${tiles} --threads 0 --output-directory none)
foreach(option IN ITEMS output labels vg polygons shapes mesh view)
  set(file out.ply)
  if(option STREQUAL "view")
    set(file out.html)
  elseif(option STREQUAL "shapes")
    set(file out.csv)
  endif()
  expect_ranks(2 2 "--${option} needs all points in one process: " ${tiles}
               --${option} ${file})
endforeach()
expect_ranks(2 2 "--by-plane needs all points in one process: " ${tiles} --by-plane)
if(NOT WITH_MPI_CUDA)
  expect_ranks(2 2 "--backend is 'cuda', which is for one process" ${tiles} --backend cuda)
endif()
expect_ranks(2 2 "--estimate-normals with a number needs all points" ${tiles} --estimate-normals 12)
foreach(option IN ITEMS planes-from minimum-area minimum-extent)
  expect_ranks(2 2 "--${option} needs all points in one process" ${tiles} --${option} 1)
endforeach()
file(MAKE_DIRECTORY "${WORK_DIR}/taken/seam.csv")
expect_ranks(3 1 "taken/seam.csv: is a directory" ${tiles} --output-directory taken --planes taken/planes)
expect_no_file(none out.ply out.html out.csv taken/corner.ply taken/Middle.XYZ taken/planes)
if(EXISTS /dev/full)
  foreach(i RANGE 1 5) # the folders that they make, too
    expect_ranks(3 1 "/dev/full: cannot be written completely .No space" ${tiles} ${parameters}
                 --output-directory made/one/two --planes /dev/full)
    expect_no_file(made)
  endforeach()
endif()

# --- The same warnings
expect_shell(0 "" "\"$P\" corner.pts folder/Middle.XYZ last.las --maximum-distance 1 --report warned --quiet 2>&1")
expect_ranks(3 0 "^detect_planes: warning: the maximum distance 1 is more than a tenth of the extent of the points, 7.9: [^\n]*\n$"
             corner.pts folder/Middle.XYZ last.las --maximum-distance 1 --report warned_3 --quiet)
file(STRINGS "${WORK_DIR}/warned" expected REGEX "warnings")
file(STRINGS "${WORK_DIR}/warned_3" found REGEX "warnings")
expect_equal("warnings" "${found}" "${expected}")

# --- The same tolerances: of the report and of the planes. Points at 0 0 0 are in one tile.
expect_shell(0 "^$" "{ cat corner.pts; for i in 1 2 3 4 5; do echo 0 0 0; done; } | awk '{ print $1, $2, $3 }' > zeros.xyz")
foreach(option IN ITEMS "--noise;0.01 + 0.001*r;--viewpoint;4,1.5,2" "--maximum-distance;auto-local")
  foreach(n IN ITEMS 1 3)
    expect_ranks(${n} 0 "; ignored: 5 at 0 0 0.*tolerances .* by (noise|auto-local)" zeros.xyz folder/Middle.XYZ last.xyz ${option}
                 --ignore-zeros --planes tolerances_${n}.planes --report tolerances_${n}.json)
    expect_shell(0 "^$" "sed -n '/\"tolerance\": {/,/}/p; /\"ignored_zeros\"/p' tolerances_${n}.json > tolerances_${n}.rows")
  endforeach()
  expect_shell(0 "^$" "cmp tolerances_1.planes tolerances_3.planes; diff tolerances_1.rows tolerances_3.rows; test -s tolerances_3.rows")
endforeach()

# --- A rank that gets a signal, once all tiles were read
file(WRITE "${WORK_DIR}/signals.sh" [=[
for tile in 0 1 2; do
  awk -v t=$tile 'BEGIN { for(i = 0; i < 60000; ++i) print t * 60 + i % 59, i % 997, i % 3 }' > slow$tile.xyz
done
rm -f rank* messages
"$MPIEXEC" -n 3 sh -c 'echo $$ > rank${OMPI_COMM_WORLD_RANK:-$PMI_RANK}
  exec "$P" slow0.xyz slow1.xyz slow2.xyz --quiet --maximum-distance .5 --output-directory never --planes never.planes' \
  > messages 2>&1 &
started=$!
while [ $(find . -name '*.part*' | wc -l) -lt 1 ] && kill -0 $started; do sleep .01; done
kill -$1 $(cat rank$2)
code=0
wait $started || code=$?
cat messages >&2
exit $code
]=])
set(ENV{MPIEXEC} "${MPIEXEC}")
set(ENV{P} "${PROGRAM}")
foreach(signal IN ITEMS KILL INT TERM)
  foreach(rank IN ITEMS 1 2)
    execute_process(COMMAND sh signals.sh ${signal} ${rank} WORKING_DIRECTORY "${WORK_DIR}" TIMEOUT 100
                    RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
    if(signal STREQUAL "KILL")
      if("${status}" STREQUAL "0" OR "${err}" STREQUAL "")
        complain("killed rank ${rank}: exit code ${status}, '${err}'")
      endif()
    else()
      check_ranks(1 "detect_planes: interrupted, nothing was written" "SIG${signal} for rank ${rank}")
    endif()
    file(GLOB found "${WORK_DIR}/never*/*")
    expect_equal("files of the run that SIG${signal} ended" "${found}" "")
    expect_no_file(never.planes)
  endforeach()
endforeach()

finish()
