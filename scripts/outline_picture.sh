#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws the picture of outlines of the manual, of the building of CGAL's Debian package libcgal-demo:
# doc/Shape_regularization_tandem/fig/outlines.png.
#   TANDEM_BUILD_DIR  where to build (default: build/figures of this repository)
#   OUTLINE_FIGURES   the program outline_figures, where it is built already

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build/figures}
picture=$root/doc/Shape_regularization_tandem/fig/outlines.png
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

mkdir -p "$build"
"$root/scripts/sample_cloud.sh" "$build/building.ply"
if [ -z "${OUTLINE_FIGURES:-}" ]; then
  cmake -S "$root" -B "$build/outlines" -DTANDEM_BUILD_BENCHMARKS=ON -DTANDEM_WITH_CUDA=OFF > "$build/outlines.log"
  cmake --build "$build/outlines" --target outline_figures >> "$build/outlines.log"
  OUTLINE_FIGURES=$(find "$build/outlines" -name outline_figures -type f)
fi
"$OUTLINE_FIGURES" "$build/building.ply" 0.15 25.842 100 "$folder"

# Three facades: shapes of the result, which is the same everywhere.
{
  echo "set terminal pngcairo size 1080,360 font ',10'"
  echo "set output '$picture'"
  echo "set multiplot layout 1,3 margins .01,.99,.02,.98 spacing .02"
  echo "unset key; unset tics; unset border; set size ratio -1"
  for shape in 2 3 5; do
    echo "plot '$folder/$shape.points' with dots lc rgb '#999999', \\"
    echo "     '$folder/$shape.outline' with lines lw 2 lc rgb '#0044aa'"
  done
} > "$folder/plot"
gnuplot "$folder/plot"
echo "Picture: $picture"
