# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Outlines of the shapes and closed surfaces.

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

# Each face of the cube is one square without holes: five corners with the first one again.
expect(0 "shapes +3 in" cube.ply ${epsilon} --polygons out.geojson)
file(READ "${WORK_DIR}/out.geojson" text)
if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.19) # reads JSON
  string(JSON type GET "${text}" type)
  expect_equal("type" "${type}" "FeatureCollection")
  string(JSON count LENGTH "${text}" features)
  expect_equal("features" "${count}" 3)
  foreach(i RANGE 2)
    string(JSON shape GET "${text}" features ${i} properties shape)
    expect_equal("shape" "${shape}" ${i})
    string(JSON count LENGTH "${text}" features ${i} geometry coordinates)
    expect_equal("polygons" "${count}" 1)
    string(JSON count LENGTH "${text}" features ${i} geometry coordinates 0)
    expect_equal("rings" "${count}" 1)
    string(JSON first GET "${text}" features ${i} geometry coordinates 0 0 0)
    string(JSON count LENGTH "${text}" features ${i} geometry coordinates 0 0)
    math(EXPR last "${count} - 1")
    string(JSON last GET "${text}" features ${i} geometry coordinates 0 0 ${last})
    expect_equal("last corner" "${last}" "${first}")
  endforeach()
endif()

# Rings are counterclockwise as seen from above, and upright ones about the normal of their plane.
file(WRITE "${WORK_DIR}/rings.awk" [=[
/"plane":/ { split($0, parts, /"plane":\[/); split(parts[2], n, /[],]/) }
/^ *\[\[\[/ {
  gsub(/[][]/, " ")
  corners = split($0, c, ",") / 3
  for(k = 0; k < 3; ++k) {
    a = (k + 1) % 3 + 1
    b = (k + 2) % 3 + 1
    area[k] = 0
    for(i = 0; i + 1 < corners; ++i)
      area[k] += (c[3 * i + a] - c[a]) * (c[3 * i + 3 + b] - c[b]) - (c[3 * i + b] - c[b]) * (c[3 * i + 3 + a] - c[a])
  }
  if(n[3] * n[3] > 1e-18 ? area[2] <= 0 : n[1] * area[0] + n[2] * area[1] + n[3] * area[2] <= 0) print "clockwise: " $0
  ++found
}
END { if(found != 3) print found + 0 " rings" }
]=])
expect_shell(0 "^$" "awk -f rings.awk out.geojson")

# Shapes without a polygon are counted.
file(WRITE "${WORK_DIR}/few.xyz" "0 0 0\n0 1 0\n0 2 0\n1 0 0\n1 1 0\n1 2 0\n2 0 0\n2 1 0\n2 2 0\n3 0 0\n3 1 0\n3 2 0\n")
expect_warnings(few.xyz --maximum-distance .1 --minimum-region-size 10 --polygons few.json
  WARNINGS "1 of 1 shapes cover too few points for an outline")

expect(0 "shapes +3 in" cube.ply ${epsilon} --polygons out.obj --triangulate)
file(STRINGS "${WORK_DIR}/out.obj" faces REGEX "^f ")
list(FILTER faces EXCLUDE REGEX "^f [0-9]+ [0-9]+ [0-9]+$")
expect_equal("faces that are no triangles" "${faces}" "")

# Shapes share their corners: three faces of a cube have seven.
expect(0 "shapes +3 in" cube.ply ${epsilon} --polygons out.off)
file(STRINGS "${WORK_DIR}/out.off" lines)
list(GET lines 2 counts)
expect_equal("vertices and faces" "${counts}" "7 3 0")

# The name of the coordinate reference system, as it is given.
expect(0 "shapes +3 in" cube.ply ${epsilon} --polygons named.json --crs "urn:ogc:def:crs:EPSG::25833")
file(READ "${WORK_DIR}/named.json" text)
if(NOT text MATCHES "\"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"urn:ogc:def:crs:EPSG::25833\"}}")
  complain("no crs: ${text}")
endif()
expect(2 "crs needs --polygons with a name that ends in .geojson or .json" cube.ply --polygons out.ply --crs EPSG:25833)

expect(2 "triangulate needs --polygons" cube.ply --triangulate)
expect(2 "mesh-planes needs --mesh" cube.ply --mesh-planes 10)
expect(2 "mesh-planes is 3, must be in .4, 1000." cube.ply --mesh m.off --mesh-planes 3)
expect(2 "mesh is 'm.stl', must end in .off, .obj or .ply" missing.ply --mesh m.stl)
expect(2 "named twice" cube.ply --mesh m.ply --polygons m.ply)

# Three planes have no inside.
expect(1 "a closed surface needs four planes, and there are 3" cube.ply ${epsilon} --mesh m.off)
expect_no_file(m.off m.stl)
finish()
