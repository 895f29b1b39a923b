#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the program detect_planes and runs it on the
# building of CGAL's Debian package libcgal-demo. It makes files of the result, a page that shows it in 3D, and a picture
# of the page where Chromium is installed.
#   TANDEM_BUILD_DIR  where to build (default: build/demo of this repository)
#   TANDEM_WITH_TBB   OFF builds the sequential back end only
#   TANDEM_JOBS       compilers at a time (default: number of processors)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
# The CUDA back end takes a minute or so to compile for each architecture: only for the device that is there.
architecture=$("$root/scripts/cuda_architecture.sh")
cuda=${architecture:+-DTANDEM_WITH_CUDA=ON -DCMAKE_CUDA_ARCHITECTURES=$architecture}
cuda=${cuda:--DTANDEM_WITH_CUDA=OFF}
build=${TANDEM_BUILD_DIR:-$root/build/demo}
jobs=${TANDEM_JOBS:-$(nproc 2> /dev/null || echo 2)}
result=$build/result
cloud=$result/building.ply

fail() { echo "demo.sh: $*" >&2; exit 1; }

# Of the lines of make or ninja on standard input, how far they are, and on a terminal also at which file: there in one
# line, otherwise in steps of ten percent.
show_progress()
{
  is_terminal=0
  [ ! -t 1 ] || is_terminal=1
  awk -v is_terminal=$is_terminal '
    match($0, /^\[ *[0-9]+[%\/][0-9]*\]/) {
      split(substr($0, 2, RLENGTH - 2), part, /[%\/]/)
      percent = part[2] ? int(100 * part[1] / part[2]) : part[1] + 0
      name = $NF
      sub(/.*\//, "", name)
      if (is_terminal)
        printf "\r  %3d %% %-40.40s", percent, name
      else if (percent >= step) {
        printf "  %3d %%\n", percent
        step = percent - percent % 10 + 10
      }
      fflush()
    }
    END { if (is_terminal) print "" }'
}

install_packages()
{
  [ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] && return
  "$root/scripts/install_dependencies.sh" g++ make cmake libcgal-dev libeigen3-dev libboost-program-options-dev \
    nlohmann-json3-dev
  [ "${TANDEM_WITH_TBB:-ON}" = OFF ] || "$root/scripts/install_dependencies.sh" libtbb-dev ||
    echo "demo.sh: going on without oneTBB"
  "$root/scripts/install_dependencies.sh" libjs-three || echo "demo.sh: going on without the page, which needs three.js"
}

echo "This builds detect_planes and makes in $result:"
echo "  building_shapes.ply, building_planes.txt, building_labels.bin, building_report.json: the planes of a building"
echo "  building.html: a page that shows them in 3D; building.png: a picture of it"
mkdir -p "$result"
install_packages
"$root/scripts/sample_cloud.sh" "$cloud"

# shellcheck disable=SC2086
cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release $cuda -DTANDEM_WITH_MPI=OFF -DTANDEM_BUILD_TESTS=OFF \
  -DTANDEM_BUILD_EXAMPLES=ON '-DTANDEM_EXAMPLES=^detect_planes$' -DTANDEM_WITH_TBB="${TANDEM_WITH_TBB:-ON}" > "$result/cmake.log" 2>&1 ||
  { cat "$result/cmake.log" >&2; fail "cmake failed"; }
echo "Building detect_planes with $jobs compilers at a time (some minutes) ..."
built=$result/built
rm -f "$built"
{ cmake --build "$build" --target detect_planes -j "$jobs" 2>&1 && : > "$built"; } |
  tee "$result/build.log" | show_progress
[ -f "$built" ] || { cat "$result/build.log" >&2; fail "the build failed"; }
rm "$built"
program=$build/examples/detect_planes/detect_planes

# Those of all figures of this building; the distance is the depth of its facade. What is not given is estimated.
set -- "$cloud" --maximum-distance 0.15 --maximum-angle 25.842 --minimum-region-size 100 \
  --output "$result/building_shapes.ply" --planes "$result/building_planes.txt" \
  --labels "$result/building_labels.bin" --report "$result/building_report.json"
page=$result/building.html
"$program" "$@" --view "$page" || { page=; "$program" "$@"; } # without three.js it makes no page
rm -f "$result/building.png"
[ -z "$page" ] || "$root/scripts/view_picture.sh" "$page" "$result/building.png" > "$result/picture.log" 2>&1 ||
  { [ $? -eq 77 ] || cat "$result/picture.log" >&2; }

echo
[ -z "$page" ] || echo "In 3D:          $page    (open it in a browser, for example: xdg-open $page)"
[ ! -s "$result/building.png" ] || echo "Picture of it:  $result/building.png"
echo "Colored points: $result/building_shapes.ply"
echo "Planes:         $result/building_planes.txt"
echo "Report:         $result/building_report.json"
echo "Your own cloud: $program CLOUD.ply --output shapes.ply --view shapes.html    (--help lists the options)"
