# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Tiles of an area: --output-directory of detect_planes, by one process. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/tiles_support.cmake")

# --- Each input has its points in a file of its own, with shapes of the whole area
expect(0 "^corner.pts, .*points +9600.*hash" ${tiles} ${parameters} --output-directory new/one --planes planes --output all.csv)
file(GLOB found RELATIVE "${WORK_DIR}/new/one" "${WORK_DIR}/new/one/*")
list(SORT found)
set(expected ${outputs})
list(SORT expected)
expect_equal("files of the folder" "${found}" "${expected}")
file(STRINGS "${WORK_DIR}/planes" planes)
list(LENGTH planes count)
expect_equal("number of shapes" ${count} 4)
file(STRINGS "${WORK_DIR}/all.csv" all)
file(STRINGS "${WORK_DIR}/new/one/seam.csv" seam)
foreach(row IN LISTS seam)
  if(NOT row IN_LIST all)
    complain("of one tile only: ${row}")
    break()
  endif()
endforeach()
file(STRINGS "${WORK_DIR}/folder/sub/seam.csv" rows)
list(LENGTH rows expected)
list(LENGTH seam found)
expect_equal("rows of a tile" ${found} ${expected})
foreach(shape IN ITEMS 0 1 2 3)
  if(NOT seam MATCHES ",${shape}(;|$)")
    complain("shape ${shape} is not in each tile")
  endif()
endforeach()

# --- What is written is read again, and stays what it is
expect(0 "left out +normals" new/one/corner.ply new/one/last.las ${parameters} --colors shape --output-directory new/two)
expect(0 "^$" new/one/last.las ${parameters} --output-directory new/two --quiet)
expect_shell(0 "^$" "cmp new/one/last.las new/two/last.las")
expect(0 "^$" folder/Middle.XYZ ${parameters} --output-directory new/two --output middle.xyz --quiet)
expect_shell(0 "^$" "cmp middle.xyz new/two/Middle.XYZ")
find_program(gzip gzip)
if(gzip)
  expect_shell(0 "" "gzip -k folder/Middle.XYZ; \"$P\" folder/Middle.XYZ.gz --quiet --maximum-distance .01 \
    --minimum-region-size 100 --output-directory new/two 2> gz.log; status=$?; \
    cmp middle.xyz new/two/Middle.XYZ || exit; [ $status = 0 ] || grep 'built without zlib' gz.log")
endif()

# --- A tile without points has an output without points, and changes nothing
file(WRITE "${WORK_DIR}/classes.csv" "x,y,z,classification\n0,0,0,6\n1,0,0,6\n0,1,0,6\n1,1,0,2\n")
foreach(file IN ITEMS empty none)
  file(WRITE "${WORK_DIR}/${file}.ply" "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
       "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nend_header\n")
endforeach()
set(run "\"$P\" --maximum-distance .01 --minimum-region-size 100 --output-directory with_empty")
string(REPLACE ";" " " list "${tiles}")
expect_shell(0 "warning: empty.ply: has no points\n.*normals estimated" "${run} empty.ply ${list} 2>&1")
expect_shell(0 "^$" "for f in corner.ply Middle.XYZ seam.csv last.las; do cmp new/one/$f with_empty/$f; done")
expect(1 "with_empty/empty.ply: has no points" with_empty/empty.ply)
expect_shell(0 "warning: last.las: has no points of the --classes" "${run} last.las classes.csv --classes 6 2>&1")
expect(1 "with_empty/last.las: has no points" with_empty/last.las)
expect_shell(0 "warning: none.ply: has no points\n.*none of the inputs has points\n.*exit 1"
             "\"$P\" empty.ply none.ply --output-directory out 2>&1 || echo exit $?")
expect_no_file(out)

# --- Names
file(COPY "${WORK_DIR}/last.las" DESTINATION "${WORK_DIR}/folder")
expect(2 "last.las and folder/last.las would both become out/last.las" last.las folder/last.las --output-directory out)
expect(2 "corner.pts and corner.ply would both become out/corner.ply" corner.pts corner.ply --output-directory out)
expect_shell(0 "^$" "ln -s folder link; mkdir linked; ln -s ../folder/last.las linked/a.las; echo old > folder/last.ply
  cp folder/last.las folder/last.pts")
foreach(name IN ITEMS last.las last.pts ../folder/last.las sub/seam.csv)
  foreach(folder IN ITEMS folder/sub/.. ./folder/ folder/. link link/)
    if(NOT name MATCHES "sub")
      expect(2 "--output-directory is the folder of folder/${name}. take another folder" folder/${name} --output-directory ${folder})
      expect(2 "--output-directory is the folder of link/${name}. take another folder" link/${name} --output-directory ${folder})
    endif()
  endforeach()
endforeach()
foreach(folder IN ITEMS linked folder)
  expect(2 "--output-directory is the folder of linked/a.las. take another folder" linked/a.las --output-directory ${folder})
endforeach()
expect(2 "--output-directory is the folder of folder/last.las. take another folder" corner.pts folder/last.las --output-directory folder)
if(gzip) # its output would replace the file beside it
  file(COPY "${WORK_DIR}/last.las" DESTINATION "${WORK_DIR}/zipped")
  expect_shell(0 "^$" "gzip -k zipped/last.las && echo old > zipped/last.las")
  expect(2 "--output-directory is the folder of zipped/last.las.gz. take another folder" zipped/last.las.gz --output-directory zipped)
  expect_shell(0 "^old\n$" "cat zipped/last.las")
endif()
# By names through folders that are not there yet, which the run would make; and through those that lead elsewhere.
expect_shell(0 "^$" "ln -s folder/sub deep")
foreach(folder IN ITEMS folder/nn/.. folder/nn/../ folder/nn/mm/../../ ./folder/nn/./..// nn/../folder link/n/.. deep/n/../..
        link/n/../sub/m/../..)
  expect(2 "--output-directory is the folder of folder/last.pts" folder/last.pts --output-directory ${folder})
endforeach()
expect_shell(0 "^old\n$" "cat folder/last.ply")
expect_no_file(folder/nn folder/n folder/sub/n nn)
expect(0 "^$" last.las ${parameters} --quiet --output-directory folder/nn/../out)
expect_shell(0 "^$" "cmp new/one/last.las folder/out/last.las && rm -r folder/nn folder/out")
expect(2 "out/last.las is named twice" last.las --output-directory out --labels out/last.las)
expect(2 "--output-directory is '-'" last.las --output-directory -)
expect(1 "last.xyz: cannot be made" last.las --output-directory last.xyz)
file(MAKE_DIRECTORY "${WORK_DIR}/taken/last.las")
expect(1 "taken/last.las: is a directory" last.las corner.pts ${parameters} --output-directory taken)
expect(1 "nothere.las: no such file" corner.pts nothere.las --output-directory out)
expect_no_file(out taken/corner.ply)

# --- A run that fails leaves no folder that it made
set(run last.las ${parameters} --output-directory made/one/two)
expect(1 "no/planes: cannot be written" ${run} --planes no/planes)
expect(1 "--maximum-distance is 1e-09 while the extent" last.las --output-directory made/one --maximum-distance 1e-9)
expect(1 "last.las/two: cannot be made .Not a directory" last.las --output-directory last.las/two)
if(EXISTS /dev/full)
  expect(1 "/dev/full: cannot be written completely" ${run} --report /dev/full)
  expect_no_file(made)
  file(MAKE_DIRECTORY "${WORK_DIR}/made")
  expect(1 "/dev/full: cannot be written completely" ${run} --report /dev/full)
  expect_no_file(made/one)
  if(NOT EXISTS "${WORK_DIR}/made")
    complain("a folder that was there before is gone")
  endif()
endif()

# --- What mpirun would tell a program that cannot work with others
if(NOT MPIEXEC)
  expect_shell(1 "3 processes were started .OMPI_COMM_WORLD_SIZE., but this program was built without MPI"
               "OMPI_COMM_WORLD_SIZE=3 \"$P\" last.las")
  expect_shell(0 "^$" "OMPI_COMM_WORLD_SIZE=3 OMPI_COMM_WORLD_RANK=1 \"$P\" last.las")
endif()

finish()
