#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Gives mutated files and options to what reads them in detect_planes, until SECONDS are over or a fault is found. It
# starts from the corpus of the repository and from what earlier runs have found. Whoever mends a fault adds the input
# that caused it to the corpus.
#   fuzz.sh [TARGET [SECONDS [SEED]]]  TARGET: some of ply, xyz, off, las, pcd, ptx, options, or all (default: all);
#                                      SECONDS of each (default: 60); SEED of the mutations (default: another one each time)
#   TANDEM_BUILD_DIR  parent of the build folder `fuzz`, which gets new inputs in corpus/TARGET, and inputs that cause a
#                     fault in faults/ (default: build of this repository)
#   TANDEM_FUZZ_DIR   that folder; one that is configured keeps its options
#   CXX               clang++ (default)

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_FUZZ_DIR:-${TANDEM_BUILD_DIR:-$root/build}/fuzz}
sources=$root/test/Shape_regularization_tandem/fuzz
help=$root/doc/Shape_regularization_tandem/tables/help.out
targets=${1:-all}
[ "$targets" != all ] || targets='ply xyz off las pcd ptx options'

# Small files must not need much memory or time. In bytes, MB and seconds.
limits='-max_len=1024 -malloc_limit_mb=64 -rss_limit_mb=1024 -timeout=10'

mkdir -p "$build/faults"
alone='-DCMAKE_BUILD_TYPE=Debug -DTANDEM_BUILD_TESTS=OFF -DTANDEM_BUILD_EXAMPLES=OFF -DTANDEM_WITH_TBB=OFF -DTANDEM_WITH_CUDA=OFF'
[ ! -f "$build/CMakeCache.txt" ] || alone=
# shellcheck disable=SC2086
CXX=${CXX:-clang++} cmake -S "$root" -B "$build" -DTANDEM_BUILD_FUZZERS=ON $alone > "$build/cmake.log" 2>&1 ||
  { cat "$build/cmake.log" >&2; exit 1; }
for target in $targets; do
  cmake --build "$build" --target "fuzz_$target" -j "${TANDEM_JOBS:-1}" > "$build/build.log" 2>&1 ||
    { cat "$build/build.log" >&2; exit 1; }
  mkdir -p "$build/corpus/$target"
  log=$build/$target.log
  # Words of the dictionary and, for options, their names in the help that the manual has.
  { cat "$sources/$target.dict"; [ "$target" != options ] || sed -n 's/^  \(-[a-z] \[ \)\{0,1\}\(--[a-z-]*\).*/"\2"/p' "$help"; } \
    > "$build/$target.dict"
  # shellcheck disable=SC2086
  "$build/test/Shape_regularization_tandem/fuzz/fuzz_$target" $limits -max_total_time="${2:-60}" -seed="${3:-0}" \
    -dict="$build/$target.dict" -artifact_prefix="$build/faults/$target-" \
    "$build/corpus/$target" "$sources/corpus/$target" > "$log" 2>&1 || {
    grep -v '^#[0-9]\|NEW_FUNC' "$log" | tail -n 60 >&2
    echo "fuzz.sh: fuzz_$target has found a fault: see $build/faults and $log" >&2
    exit 1
  }
  # How many executions there were, and how many edges of the program were reached.
  echo "    fuzz_$target: $(sed -n 's/^#\([0-9]*\)[[:blank:]]*DONE *cov: \([0-9]*\).*/\1 executions, \2 edges/p' "$log")"
done
