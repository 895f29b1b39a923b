# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The outward sides of planes and of estimated normals: those of given normals, of --viewpoint, and of the VIEWPOINT of PCD
# files. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

# The cube, its corner at (1, 1, 1) or further along x, without normals and with such as point to the outside.
file(WRITE "${WORK_DIR}/move.awk" [=[
{
  printf "%.3f %.3f %.3f", $1 + 1 + shift, $2 + 1, $3 + 1
  if(with) printf " %d %d %d", -$4, -$5, -$6
  print ""
}
]=])
file(WRITE "${WORK_DIR}/cube.rows" "${cube}")
set(pcd "SIZE 8 8 8\\nTYPE F F F\\nPOINTS ${n}\\nDATA ascii\\n")
expect_shell(0 "^$" "awk -f move.awk cube.rows > bare.xyz; awk -v with=1 -f move.awk cube.rows > outside.xyz
  awk -v shift=4500000 -f move.awk cube.rows > far.xyz; awk -v shift=9 -f move.awk cube.rows > second.xyz
  pcd() { printf \"FIELDS x y z\\n$1${pcd}\" | cat - bare.xyz > $2.pcd; }
  pcd 'VIEWPOINT 5 6 7 1 0 0 0\\n' inside; pcd 'VIEWPOINT -1 0 -1e0 .7 0 .7 0\\n' behind; pcd 'VIEWPOINT 0 0 0 1 0 0 0\\n' default; pcd '' none
  pcd 'VIEWPOINT 0 0 0 0 1 0 0\\n' turned; pcd 'VIEWPOINT 5 6 7\\n' short; pcd 'VIEWPOINT 5 6 nan 1 0 0 0\\n' nan")

# Lines of planes, which go to standard output, normals of points after x y z, and parameters of groups.
file(WRITE "${WORK_DIR}/side.awk" [=[
function look(height, place) { if(height * side <= 0) print place ": " $0 }
BEGIN { split(from, v, ",") }
/^#/ { next }
kind == "planes" { look($1 * v[1] + $2 * v[2] + $3 * v[3] + $4, "plane"); ++count }
kind == "points" { look($4 * (v[1] - $1) + $5 * (v[2] - $2) + $6 * (v[3] - $3), "point"); ++count }
kind == "groups" && /^group_parameters/ { look($2 * v[1] + $3 * v[2] + $4 * v[3] + $5, "group"); ++count }
END { if(count < 3) print "only " count " " kind }
]=])
file(WRITE "${WORK_DIR}/same.awk" [=[
FNR == NR { for(i = 1; i <= 4; ++i) plane[FNR, i] = $i; next }
{ ++lines; for(i = 1; i <= 4; ++i) if($i != plane[FNR, i] && $i != -plane[FNR, i]) print "another plane: " $0 }
END { if(lines != 3) print lines " planes" }
]=])

# expect_side(side from input argument...): planes, normals and groups are on the side 1 of `from`, or on the other one, -1.
macro(expect_side side from)
  expect(0 "${hash}" ${ARGN} ${epsilon} --oriented --planes sided.planes --output sided.xyz --vg sided.vg)
  foreach(pair IN ITEMS "planes:sided.planes" "points:sided.xyz" "groups:sided.vg")
    string(REPLACE ":" ";" pair "${pair}")
    list(GET pair 0 kind)
    list(GET pair 1 file)
    expect_shell(0 "^$" "awk -v kind=${kind} -v side=${side} -v from=${from} -f side.awk ${file} | head -3")
  endforeach()
  expect_shell(0 "^$" "awk -f same.awk bare.planes sided.planes")
endmacro()

# expect_same(file argument...): a run with these arguments writes that file again.
macro(expect_same file)
  get_filename_component(extension "${file}" LAST_EXT)
  string(REGEX REPLACE "^bare" "again" again "${file}")
  set(option --output)
  if(extension MATCHES "planes|vg")
    string(REPLACE "." "--" option "${extension}")
  endif()
  expect(0 "${hash}" ${ARGN} ${epsilon} ${option} "${again}")
  expect_shell(0 "^$" "cmp '${file}' '${again}'")
endmacro()

expect(0 "normals estimated\n.*shapes +3 in" bare.xyz ${epsilon} --planes bare.planes --output bare.txt --vg bare.vg)
string(REGEX MATCH "hash +[0-9a-f]+" hash "${out}")

# --- --viewpoint
expect_side(1 5,6,7 bare.xyz --viewpoint 5,6,7)
expect_side(1 -2,-3,0.5 bare.xyz --viewpoint "-2, -3, .5")
expect_side(1 0,6,0 bare.xyz --viewpoint=0,6,0)
expect(0 "normals estimated, towards the viewpoint\n" bare.xyz ${epsilon} --viewpoint 5,6,7)
expect_same(bare.planes bare.xyz --viewpoint 5,6,7)
expect_same(bare.planes bare.xyz --viewpoint -2,-3,0)
expect_shell(0 "^detect_planes: warning: --oriented: no normals are given, and no viewpoint is known[^\n]*\n$"
             "\"$P\" bare.xyz --maximum-distance 0.004 --quiet --oriented --planes again.planes 2>&1")
expect_shell(0 "^$" "cmp bare.planes again.planes")

# Far away a step of float is half a unit.
set(hash_here "${hash}")
expect(0 "shapes +3 in" far.xyz ${epsilon} --planes bare.planes)
string(REGEX MATCH "hash +[0-9a-f]+" hash "${out}")
expect_side(1 4500001.25,2,2 far.xyz --viewpoint 4500001.25,2,2)
expect_side(1 4500000.75,2,2 far.xyz --viewpoint 4500000.75,2,2)
set(hash "${hash_here}")
expect(0 "${hash}" bare.xyz ${epsilon} --planes bare.planes)

# --- Given normals have a side
expect(1 "--viewpoint is for estimated normals, but the input has normals" outside.xyz ${epsilon} --viewpoint 5,6,7
       --planes none.planes)
expect_no_file(none.planes)
expect(0 "normals given\n" outside.xyz ${epsilon} --planes given.planes)
set(hash "hash")
expect_shell(0 "^$" "cp bare.planes kept.planes; cp given.planes bare.planes")
expect_side(-1 5,6,7 outside.xyz)
expect_same(bare.planes outside.xyz)
expect_shell(0 "^$" "cp kept.planes bare.planes")
set(hash "${hash_here}")
expect_side(1 5,6,7 outside.xyz --estimate-normals --viewpoint 5,6,7)
expect(0 "normals by PCA of 9 neighbors, towards the viewpoint\n" outside.xyz ${epsilon} --estimate-normals 9
       --viewpoint 5,6,7 --output pca.xyz)
expect_shell(0 "^$" "awk -v kind=points -v side=1 -v from=5,6,7 -f side.awk pca.xyz | head -3")

# --- VIEWPOINT of PCD files
expect_side(1 5,6,7 inside.pcd)
expect_side(-1 5,6,7 inside.pcd --viewpoint 0,0,0)
expect_side(1 -1,0,-1 behind.pcd)
expect_side(1 0,0,0 default.pcd)
expect_side(1 0,0,0 turned.pcd)
expect(0 "normals estimated, towards the viewpoint\n" inside.pcd ${epsilon} --output pcd.xyz --vg pcd.vg)
expect_shell(0 "^$" "awk -v kind=points -v side=1 -v from=5,6,7 -f side.awk pcd.xyz | head -3
                     awk -v kind=groups -v side=1 -v from=5,6,7 -f side.awk pcd.vg")
expect_same(bare.planes inside.pcd)
foreach(file IN ITEMS bare.planes bare.txt bare.vg)
  expect_same(${file} default.pcd)
  expect_same(${file} none.pcd)
endforeach()
foreach(name IN ITEMS short nan)
  expect_shell(0 "^detect_planes: warning: ${name}.pcd: the VIEWPOINT of the PCD header is not seven finite numbers[^\n]*\n$"
               "\"$P\" ${name}.pcd --maximum-distance 0.004 --quiet --output again.txt 2>&1; cmp again.txt bare.txt")
endforeach()
expect_shell(0 "^$" "{ printf 'FIELDS x y z normal_x normal_y normal_z\\nVIEWPOINT 5 6 7 1 0 0 0\\nSIZE 8 8 8 8 8 8\\n'
  printf 'TYPE F F F F F F\\nPOINTS ${n}\\nDATA ascii\\n'; cat outside.xyz; } > outside.pcd")
set(hash "normals given\n")
expect_shell(0 "^$" "cp given.planes bare.planes")
expect_side(-1 5,6,7 outside.pcd)
expect_shell(0 "^$" "cp kept.planes bare.planes")

# --- Several inputs: each has its own, or none
expect(0 "shapes +6 in" behind.pcd second.xyz ${epsilon} --output-directory two --planes two.planes)
expect(0 "shapes +6 in" none.pcd second.xyz ${epsilon} --output-directory none)
expect(0 "shapes +6 in" behind.pcd second.xyz ${epsilon} --oriented --planes two_sided.planes --output-directory again)
expect_shell(0 "^$" "cmp two/second.xyz none/second.xyz; cmp two/second.xyz again/second.xyz; cmp two/behind.pcd again/behind.pcd
  cmp -s two/behind.pcd none/none.pcd && echo 'the viewpoint is not used'
  cmp -s two.planes two_sided.planes && echo 'no plane was turned'; true")

# --- Areas: corners are in the order seen from the outward side, with or without --oriented
expect(0 "shapes +3 in" bare.xyz ${epsilon} --viewpoint 0,0,0 --triangulate --polygons sided.obj)
file(WRITE "${WORK_DIR}/faces.awk" [=[
/^v / { ++k; x[k] = $2; y[k] = $3; z[k] = $4 }
/^f / {
  a = $2; b = $3; c = $4; ++faces
  bx = x[b] - x[a]; by = y[b] - y[a]; bz = z[b] - z[a]; cx = x[c] - x[a]; cy = y[c] - y[a]; cz = z[c] - z[a]
  if((by * cz - bz * cy) * x[a] + (bz * cx - bx * cz) * y[a] + (bx * cy - by * cx) * z[a] > 0) print "inside out: " $0
}
END { if(faces < 6) print faces " faces" }
]=])
expect_shell(0 "^$" "awk -f faces.awk sided.obj | head -3")
expect(0 "shapes +3 in" bare.xyz ${epsilon} --viewpoint 0,0,0 --oriented --triangulate --polygons again.obj)
expect_shell(0 "^$" "cmp sided.obj again.obj")
expect(0 "shapes +3 in" bare.xyz ${epsilon} --viewpoint 0,0,0 --polygons plain.json)
expect(0 "shapes +3 in" bare.xyz ${epsilon} --viewpoint 0,0,0 --oriented --polygons sided.json --planes sided.planes)
expect_shell(0 "^$" "grep -o 'plane\":[^]]*' sided.json | tr -s '[,' '  ' | cut -d ' ' -f 2- > json.planes
  awk -f same.awk sided.planes json.planes; awk -v kind=planes -v side=1 -v from=0,0,0 -f side.awk json.planes
  cmp -s plain.json sided.json && echo 'no plane was turned'; true")

# --- The page
expect(0 "--viewpoint X,Y,Z .*--oriented " --help)
if(out MATCHES "--view FILE")
  expect(0 "shapes +3 in" bare.xyz ${epsilon} --viewpoint 0,0,0 --oriented --view sided.html)
  expect_shell(0 "^$" "grep -o '\"coefficients\":[^]]*' sided.html | tr -s '[,' '\\n\\n' | sed 1d | paste -d ' ' - - - - > view.planes
    awk -f same.awk sided.planes view.planes; awk -v kind=planes -v side=1 -v from=0,0,0 -f side.awk view.planes")
endif()

# --- Bad usage
foreach(value IN ITEMS 0,0 1,2 a,b,c "0 0 1" 0,0,1,0 0,0,1x 0,0,1e999 nan,0,1 1,inf,0 ,0,1 1,2, 1/2/3)
  expect(2 ": --viewpoint is '[^']*', must be three numbers .*, as in 2.5,-1,1.6 " bare.xyz --viewpoint "${value}")
endforeach()
expect_shell(2 "--viewpoint is empty" "exec \"$P\" bare.xyz --viewpoint ''")
expect(2 "viewpoint" bare.xyz --viewpoint)
expect(2 "viewpoint' cannot be specified more than once" bare.xyz --viewpoint 0,0,0 --viewpoint 0,0,1)

finish()
