#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws the pictures of the manual, of the building of CGAL's Debian package libcgal-demo, and writes the
# tables of their numbers: doc/Shape_regularization_tandem/fig/*.png and tables/*.md.
#   TANDEM_BUILD_DIR  where to build (default: build/figures of this repository)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build/figures}
doc=$root/doc/Shape_regularization_tandem

fail() { echo "doc_figures.sh: $*" >&2; exit 1; }

[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] ||
  "$root/scripts/install_dependencies.sh" g++ make cmake libcgal-dev libeigen3-dev libtbb-dev gnuplot-nox
"$root/scripts/sample_cloud.sh" "$build/building.ply"
echo "Building draw_figures (a minute or so) ..."
cmake -S "$doc/figures" -B "$build" > "$build/cmake.log" 2>&1 || { cat "$build/cmake.log" >&2; fail "cmake failed"; }
cmake --build "$build" --target draw_figures > "$build/build.log" 2>&1 ||
  { cat "$build/build.log" >&2; fail "the build failed"; }
mkdir -p "$build/clouds" "$doc/fig" "$doc/tables"
"$build/draw_figures" "$build/building.ply" 0.15 25.842 100 "$build/clouds" "$doc/tables"
for cloud in "$build"/clouds/*.ply; do
  picture=$doc/fig/$(basename "$cloud" .ply).png
  TANDEM_SKIP_INSTALL=1 "$root/scripts/render.sh" "$cloud" "$picture" --alone --width 330 --height 260
done
echo "Pictures and tables: $doc/fig, $doc/tables"
