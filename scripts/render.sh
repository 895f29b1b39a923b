#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes the picture of the README, doc/Shape_regularization_tandem/fig/building.png, from
# the demo. Or of another result of detect_planes --output, with the options of the
# program render (render.sh --help lists them):
#   render.sh SHAPES.ply PICTURE.png [--azimuth DEGREES] [--elevation DEGREES] ...

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build/release}

fail() { echo "render.sh: $*" >&2; exit 1; }

[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] ||
  "$root/scripts/install_dependencies.sh" g++ make cmake libcgal-dev libeigen3-dev libboost-program-options-dev libpng-dev
if [ $# -eq 0 ]; then
  "$root/scripts/demo.sh"
  mkdir -p "$root/doc/Shape_regularization_tandem/fig"
  set -- "$build/demo/building_shapes.ply" "$root/doc/Shape_regularization_tandem/fig/building.png" --width 720 --height 560
fi

cmake -S "$root/benchmark/Shape_regularization_tandem" -B "$build/render" > /dev/null &&
  cmake --build "$build/render" --target render > /dev/null || fail "the build failed"
"$build/render/render" "$@"
case $1 in
  -*) ;;
  *) echo "Picture: $2" ;;
esac
