#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws the picture of closed surfaces of the manual, doc/Shape_regularization_tandem/fig/surfaces.png: of the generated
# house, and of the building of CGAL's Debian package libcgal-demo.
#   TANDEM_BUILD_DIR  where to build (default: build/figures of this repository)
#   TANDEM_PROGRAMS   a folder below which make_scene and detect_planes are built already

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build/figures}
picture=$root/doc/Shape_regularization_tandem/fig/surfaces.png
programs=${TANDEM_PROGRAMS:-$build/outlines}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

mkdir -p "$build"
"$root/scripts/sample_cloud.sh" "$build/building.ply"
if [ -z "${TANDEM_PROGRAMS:-}" ]; then
  cmake -S "$root" -B "$programs" -DTANDEM_BUILD_BENCHMARKS=ON -DTANDEM_WITH_CUDA=OFF > "$build/surfaces.log"
  cmake --build "$programs" --target make_scene detect_planes >> "$build/surfaces.log"
fi
program() { find "$programs" -name "$1" -type f -perm -u+x | head -1; }

# surface CLOUD.ply DISTANCE SURFACE.off
surface()
{
  "$(program detect_planes)" "$1" --maximum-distance "$2" --maximum-angle 25 --minimum-region-size 100 --mesh "$3" > /dev/null
}

"$(program make_scene)" house "$folder/house.ply" --points 200000 --noise .0004 --normals exact > /dev/null
surface "$folder/house.ply" .03 "$folder/house.off"
surface "$build/building.ply" .15 "$folder/building.off"
"$root/scripts/draw_surfaces.py" "$picture" "$folder/house.off" 220 30 "$folder/building.off" 220 30
echo "Picture: $picture"
