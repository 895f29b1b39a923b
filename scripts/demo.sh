#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the program detect_planes and runs it on the
# building of CGAL's Debian package libcgal-demo. It makes files of the result, a page that shows it in 3D, and a picture
# of the page where Chromium and Python are installed.
#   TANDEM_BUILD_DIR  where to build (default: build/demo of this repository)
#   TANDEM_WITH_TBB   OFF builds the sequential back end only
#   TANDEM_JOBS       compilers at a time (default: number of processors)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
# The CUDA back end takes a minute or so to compile for each architecture: only for the device that is there.
architecture=$("$root/scripts/cuda_architecture.sh")
cuda=${architecture:+-DTANDEM_WITH_CUDA=ON -DCMAKE_CUDA_ARCHITECTURES=$architecture}
build=${TANDEM_BUILD_DIR:-$root/build/demo}
jobs=${TANDEM_JOBS:-$(nproc 2> /dev/null || echo 2)}
program=$build/examples/detect_planes/detect_planes
result=$build/result
log=$result/build.log

install() { [ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" "$@"; }

mkdir -p "$result"
install g++ make cmake libcgal-dev libeigen3-dev libboost-program-options-dev nlohmann-json3-dev
[ "${TANDEM_WITH_TBB:-ON}" = OFF ] || install libtbb-dev || echo "demo.sh: going on without oneTBB"
# Debian 12 has no such package: what is not known is not searched for each time.
{ apt-cache show liblaszip-dev > /dev/null 2>&1 && install liblaszip-dev; } ||
  echo "demo.sh: this system has no package of LASzip, so the program will not read or write .laz"
install libjs-three || echo "demo.sh: going on without the page, which needs three.js"
"$root/scripts/sample_cloud.sh" "$result/building.ply"

# shellcheck disable=SC2086
build() {
  cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release ${cuda:--DTANDEM_WITH_CUDA=OFF} -DTANDEM_WITH_MPI=OFF \
    -DTANDEM_BUILD_TESTS=OFF -DTANDEM_BUILD_EXAMPLES=ON '-DTANDEM_EXAMPLES=^detect_planes$' \
    -DTANDEM_WITH_TBB="${TANDEM_WITH_TBB:-ON}" &&
    cmake --build "$build" --target detect_planes -j "$jobs" && echo "$built"
}
# The steps as they come: a loop of the shell reads lines, where others wait until they have a block.
built="detect_planes is built"
echo "Building detect_planes with $jobs compilers at a time, which takes about 5 minutes on 2 processors (all messages: $log)"
build 2>&1 | while IFS= read -r line; do
  printf '%s\n' "$line" >&3
  case $line in "["*) printf '%s\n' "$line" ;; esac
done 3> "$log"
[ "$(tail -n 1 "$log")" = "$built" ] || { cat "$log" >&2; echo "demo.sh: the build failed" >&2; exit 1; }

# Those of all figures of this building; the distance is the depth of its facade. What is not given is estimated.
set -- "$result/building.ply" --maximum-distance 0.15 --maximum-angle 25.842 --minimum-region-size 100 \
  --output "$result/building_shapes.ply" --planes "$result/building_planes.txt" \
  --labels "$result/building_labels.bin" --report "$result/building_report.json"
page=$result/building.html
picture=$result/building.png
rm -f "$page" "$picture"
"$program" "$@" --view "$page" || "$program" "$@" # without three.js it makes no page
[ ! -f "$page" ] || ! command -v python3 > /dev/null ||
  python3 "$root/doc/Shape_regularization_tandem/figures/draw.py" view "$page" "$picture" > "$result/picture.log" 2>&1 ||
  [ $? -eq 77 ] || cat "$result/picture.log" >&2

printf '\nFiles in %s (the page needs three.js, its picture Chromium):\n' "$result"
(cd "$result" && ls building_shapes.ply building_planes.txt building_report.json building*.html building*.png 2> /dev/null) || true
[ ! -f "$page" ] || echo "The page opens in a browser: xdg-open '$page'"
printf '\nThe program: %s\nTo try it, with your own cloud in place of building.ply:\n  %s\n' "$program" \
  "'$program' '$result/building.ply' -o '$result/shapes.ply'"
