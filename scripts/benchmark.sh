#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds, and measures Tandem beside CGAL's own detectors and PCL, by the
# criteria and the experiments of the paper. Prints tables, and writes them as CSV files into a folder that it names at
# the end.
#   benchmark.sh                    everything: an hour or more
#   benchmark.sh --quick            everything in small: five minutes
#   benchmark.sh CLOUD...           the comparison on clouds of clouds.csv (building, house, ...)
#   benchmark.sh FILE [LABELS] EPSILON ALPHA MINIMUM [CLUSTER]    the comparison on a cloud of yours
#     FILE      PLY, or text: x y z or x y z nx ny nz in a line
#     LABELS    text: the true plane of each point, a number a line. Negative numbers are points of none; where
#               there are none, 0 is. Adds F, precision, recall, mean IoU, over- and under-segmentation
#     EPSILON   largest distance of a point to its plane, in units of the cloud
#     ALPHA     largest angle between its normal and the plane's, in degrees
#     MINIMUM   points of the smallest shape
#     CLUSTER   cluster epsilon of RANSAC (default: -1, for CGAL's 1 % of the diagonal)
# Environment:
#   TANDEM_DATA       folder of the clouds of clouds.csv that are files (PLY or PLY.xz)
#   TANDEM_BUILD_DIR  where to build (default: build/benchmark of this repository); a folder that is configured keeps
#                     its options, except for the CUDA back end
#   TANDEM_THREADS    threads of the parallel back end (default: all processors)
#   TANDEM_JOBS       compilers at a time (default: number of processors)
#   TANDEM_WITHOUT_PCL=1   does not install PCL, which is large; --quick never does
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
# The CUDA back end takes a minute or so to compile for each architecture: only for the device that is there.
architecture=$("$root/scripts/cuda_architecture.sh")
cuda=${architecture:+-DTANDEM_WITH_CUDA=ON -DCMAKE_CUDA_ARCHITECTURES=$architecture}
cuda=${cuda:--DTANDEM_WITH_CUDA=OFF}
build=${TANDEM_BUILD_DIR:-$root/build/benchmark}
jobs=${TANDEM_JOBS:-$(nproc 2> /dev/null || echo 2)}
program=$build/benchmark/Shape_regularization_tandem/tandem_benchmark

fail() { echo "benchmark.sh: $*" >&2; exit 1; }
usage() { sed -n '/^# Installs/,/^$/s/^# \{0,1\}//p' "$0"; }

install()
{
  "$root/scripts/install_dependencies.sh" g++ make cmake libcgal-dev libeigen3-dev libboost-program-options-dev \
    libtbb-dev xz-utils
  [ -n "$quick" ] || [ "${TANDEM_WITHOUT_PCL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" libpcl-dev ||
    echo "PCL cannot be installed: the comparison goes on without it"
}

build_program()
{
  mkdir -p "$result/clouds"
  alone="-DCMAKE_BUILD_TYPE=Release -DTANDEM_BUILD_TESTS=OFF"
  [ ! -f "$build/CMakeCache.txt" ] || alone=
  # shellcheck disable=SC2086
  cmake -S "$root" -B "$build" $alone $cuda -DTANDEM_BUILD_BENCHMARKS=ON > "$build/cmake.log" 2>&1 ||
    { cat "$build/cmake.log" >&2; fail "cmake failed"; }
  echo "Building the benchmark (a few minutes) ..."
  cmake --build "$build" -j "$jobs" --target tandem_benchmark > "$build/build.log" 2>&1 ||
    { cat "$build/build.log" >&2; fail "the build failed"; }
}

measure()
{
  # shellcheck disable=SC2086
  "$program" "$@" $quick --output "$result" --data "${TANDEM_DATA:-}" --threads "${TANDEM_THREADS:-0}" ||
    fail "tandem_benchmark $1 failed"
}

# A run that was measured before must not show up beside this one.
forget_results()
{
  rm -f "$result"/*.csv
}

quick=
result=$build/result
case ${1:-} in
  --help | -h) usage; exit 0 ;;
  --quick) quick=--quick; result=$build/result-quick; shift ;;
  -*) fail "unknown option $1 (--help lists them)" ;;
esac
[ $# -eq 0 ] || result=$build/result-chosen

[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || install
build_program
"$root/scripts/sample_cloud.sh" "$result/clouds/building.ply"

forget_results
measure compare "$@"
if [ $# -eq 0 ]; then
  measure robustness
  measure synergy
fi
echo "Tables: $result"
