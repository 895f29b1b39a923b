# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What detect_planes reads: a file that does not have what it announces is an error, found at once and without much
# memory. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

# write_ply(name header rows): the header without its first two lines.
function(write_ply name header rows)
  file(WRITE "${WORK_DIR}/${name}" "ply\nformat ascii 1.0\n${header}end_header\n${rows}")
endfunction()

# write_binary_ply(name format header bytes): the bytes as printf of sh writes them.
function(write_binary_ply name format header bytes)
  execute_process(COMMAND printf "ply\\nformat binary_${format}_endian 1.0\\n${header}end_header\\n${bytes}"
                  OUTPUT_FILE "${WORK_DIR}/${name}")
endfunction()

set(cloud "element vertex ${n}\n${positions}${normals}")
set(two "element vertex 2\n${positions}")
set(list "property list uint float extra\n")
set(faces "element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\n")
set(face_rows "3 0 1 2 255\n4 0 1 2 3 255\n")
expect(0 "hash +[0-9a-f]+" cube.ply ${epsilon})
string(REGEX MATCH "hash +([0-9a-f]+)" hash "${out}")

# --- Other elements and lists do not change the result
write_ply(mesh.ply "${cloud}${faces}" "${cube}${face_rows}")
write_ply(camera.ply "element camera 1\nproperty list uchar float view\nproperty int id\n${cloud}" "2 .5 .5 7\n${cube}")
write_ply(blanks.ply "${cloud}${faces}" "\n${cube}\r\n \t3 0 1\n2 255\n\n4 0 1 2 3 255  \r\n\n")
string(REPLACE "\n" " 2 .5 .5 7\n" rows "${cube}")
write_ply(lists.ply "${cloud}${list}property int id\n" "${rows}")
foreach(name IN ITEMS camera lists)
  expect(0 "${hash}" ${name}.ply ${epsilon})
endforeach()
foreach(name IN ITEMS mesh blanks) # corners of faces
  expect(0 "${hash}" ${name}.ply ${epsilon} --sample 0)
endforeach()

# --- Elements without bytes take no time
set(nothing "element foo 1000000000000\n")
write_ply(before.ply "${nothing}${cloud}" "${cube}")
write_ply(after.ply "${cloud}${nothing}" "${cube}")
find_program(timeout timeout)
if(timeout)
  foreach(name IN ITEMS before after)
    expect_shell(0 "${hash}" "exec timeout -k 1 5 \"$P\" ${name}.ply --maximum-distance 0.004")
  endforeach()
endif()

# --- Numbers of items that the file cannot hold
write_ply(list.ply "${two}${list}" "0 0 0 1000000000\n0 0 0 0\n")
write_ply(negative.ply "${two}${list}" "0 0 0 -1\n0 0 0 0\n")
write_ply(words.ply "${two}${list}" "0 0 0 many\n0 0 0 0\n")
write_ply(small.ply "${two}property list uchar float extra\n" "0 0 0 300\n0 0 0 0\n")
write_ply(face.ply "${two}${faces}" "0 0 0\n0 0 0\n3 0 1 2 255\n9999 0 1 2 255\n")
write_ply(real.ply "${two}property list float float extra\n" "0 0 0 0\n0 0 0 0\n")
expect(1 "list.ply: row 1 of 'vertex' has 1000000000 items in the list 'extra', room for 5 at most" list.ply)
expect(1 "negative.ply: row 1 of 'vertex' has '-1' where the number" negative.ply)
expect(1 "words.ply: row 1 of 'vertex' has 'many' where the number" words.ply)
expect(1 "small.ply: row 1 of 'vertex' has 300 items" small.ply)
expect(1 "face.ply: row 2 of 'face' has 9999 items" face.ply)
expect(1 "real.ply: the number of items of the PLY list 'extra' must be an integer" real.ply)

set(zeros "\\000\\000\\000\\000")
set(point "${zeros}${zeros}${zeros}")
set(binary_point "element vertex 1\\nproperty float x\\nproperty float y\\nproperty float z\\n")
set(binary_list "${binary_point}property list int float extra\\n")
foreach(format IN ITEMS little big)
  write_binary_ply(huge.ply ${format} "${binary_list}" "${point}\\100\\000\\000\\100")
  write_binary_ply(below.ply ${format} "${binary_list}" "${point}\\377\\377\\377\\377")
  write_binary_ply(short.ply ${format} "${binary_list}" "${point}\\000\\000")
  expect(1 "huge.ply: row 1 of 'vertex' has 1073741888 items" huge.ply)
  expect(1 "below.ply: row 1 of 'vertex' has 4294967295 items" below.ply)
  expect(1 "short.ply: is truncated" short.ply)
endforeach()

# --- More in the file than announced
write_ply(row.ply "element vertex ${n}\n${positions}" "${cube}")
write_ply(late.ply "${two}" "0 0 0\n0 0 0 0\n")
write_ply(more.ply "${two}" "0 0 0\n0 0 0\n0 0 1\n")
write_ply(part.ply "${two}property int id\n" "0 0 0 1.5\n0 0 0 1\n")
write_ply(twice.ply "element vertex 1\n${positions}property int x\n" "0 0 0 0\n")
write_ply(again.ply "${two}${two}" "0 0 0\n0 0 0\n0 0 0\n0 0 0\n")
expect(1 "row.ply: row 1 of 'vertex' has more values than the header says .add the property" row.ply)
expect(1 "late.ply: row 2 of 'vertex' has more values" late.ply)
expect(1 "more.ply: is longer than its header says: 6 bytes follow .*correct the numbers of items" more.ply)
expect(1 "part.ply: .*a value is not of the type" part.ply)
expect(1 "twice.ply: .*two properties 'x'" twice.ply)
expect(1 "again.ply: .*two elements of points" again.ply)
write_binary_ply(long.ply little "${binary_point}" "${point}${zeros}")
write_binary_ply(line.ply little "${binary_point}" "${point}\\n")
expect(1 "long.ply: is longer than its header says: 4 bytes" long.ply)
expect_shell(0 "warning: no shape was found.*points +1," "\"$P\" line.ply 2>&1")

# --- Numbers of points below zero
file(WRITE "${WORK_DIR}/negative.off" "OFF\n-1 0 0\n${cube}")
file(WRITE "${WORK_DIR}/negative.xyz" "-1\n${cube}")
expect(1 "negative.off: announces -1 points" negative.off)
expect(1 "negative.xyz: announces -1 points" negative.xyz)

# --- Rows that are no points
file(WRITE "${WORK_DIR}/names.xyz" "x y z\n${cube}")
file(WRITE "${WORK_DIR}/short.xyz" "1 0\n${cube}")
file(WRITE "${WORK_DIR}/range.xyz" "1e999 0 0\n${cube}")
file(WRITE "${WORK_DIR}/count.xyz" "${n}\n${cube}")
file(WRITE "${WORK_DIR}/fewer.xyz" "2\n${cube}")
foreach(name short range)
  expect(1 "${name}.xyz: row 1 is neither a point, the number of points nor a line of names" ${name}.xyz)
endforeach()
expect(1 "names.xyz: row 2 has more than 3 values" names.xyz)
expect(0 "points +${n}," count.xyz ${epsilon})
expect(1 "fewer.xyz: has ${n} rows of points, 2 announced" fewer.xyz)
set(faces "3 0 1 2 255 0\n3 0 2 1 255 0\n")
file(WRITE "${WORK_DIR}/face.off" "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n${faces}")
file(WRITE "${WORK_DIR}/row.off" "OFF\n2 2 0\n0 0 0\n0 1b\n${faces}")
file(WRITE "${WORK_DIR}/beside.off" "OFF ${n} 2 0\n${cube}${faces}")
file(WRITE "${WORK_DIR}/color.off" "COFF\n${n} 0 0\n${cube}")
file(WRITE "${WORK_DIR}/many.off" "OFF\n99999999999999 0 0\n${cube}")
expect(1 "face.off: is truncated: less rows of faces" face.off)
expect(1 "row.off: unreadable after point 1 of 2" row.off --sample 0)
expect(0 "points +${n}," beside.off ${epsilon} --sample 0)
expect(1 "color.off: the first word is not OFF or NOFF" color.off)
expect(1 "many.off: is truncated: 99999999999999 points announced, ${n} rows found" many.off)

# --- Signals end the reading. The file takes no place on the disk.
find_program(truncate truncate)
if(timeout AND truncate)
  file(WRITE "${WORK_DIR}/long.ply" "ply\nformat binary_little_endian 1.0\nelement foo 4000000000\n"
       "property list uchar uchar a\nelement vertex 1\n${positions}end_header\n")
  expect_shell(1 "interrupted" "truncate -s 4G long.ply
    exec timeout --foreground --preserve-status -s INT -k 2 0.3 \"$P\" long.ply")
  file(REMOVE "${WORK_DIR}/long.ply")
endif()

finish()
