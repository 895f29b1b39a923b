#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes the picture of the README, doc/Shape_regularization_tandem/fig/building.png, from
# the demo. Or of another result:
#   render.sh SHAPES.ply PICTURE.png [azimuth elevation]

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build/release}

fail() { echo "render.sh: $*" >&2; exit 1; }

[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || command -v convert > /dev/null || "$root/scripts/install_dependencies.sh" imagemagick
if [ $# -eq 0 ]; then
  "$root/scripts/demo.sh"
  mkdir -p "$root/doc/Shape_regularization_tandem/fig"
  set -- "$build/demo/building_shapes.ply" "$root/doc/Shape_regularization_tandem/fig/building.png" 40 30
fi
[ $# -eq 2 ] || [ $# -eq 4 ] || fail "usage: render.sh [SHAPES.ply PICTURE.png [azimuth elevation]]"

cmake -S "$root" -B "$build" > /dev/null && cmake --build "$build" --target render_ply > /dev/null || fail "the build failed"
shapes=$1; picture=$2; shift 2
"$build/examples/Shape_regularization_tandem/render_ply" "$shapes" "$picture.ppm" "$@"
convert "$picture.ppm" -filter Box -strip -define png:compression-level=9 +dither -colors 128 "$picture"
rm "$picture.ppm"
echo "Picture: $picture"
