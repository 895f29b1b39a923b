#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds and runs the tests. CMakePresets.json has the configurations.
#   test.sh          style, and the preset dev: what .ci/run calls
#   test.sh all      what takes longer as well, before an issue is resolved: see `parts` below
#   test.sh PART...  only these
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

cd "$(dirname "$0")/.."
CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
CTEST_PARALLEL_LEVEL=$CMAKE_BUILD_PARALLEL_LEVEL
export CMAKE_BUILD_PARALLEL_LEVEL CTEST_PARALLEL_LEVEL
parts='style dev long detector configure bits asan fuzz tsan cuda tidy doc cost benchmark'

fail() { echo "test.sh: $*" >&2; exit 1; }
workflow() { cmake --workflow --preset "$1"; }
install() { [ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || scripts/install_dependencies.sh "$@"; }

# What every build needs, and the optional parts of nearly all.
install_for_builds()
{
  install
  install python3-pytest python3-dev python3-numpy pybind11-dev libjs-three libopenmpi-dev openmpi-bin libboost-mpi-dev
}

run_style()
{
  install clang-format
  find include examples test benchmark cmake doc \( -name '*.h' -o -name '*.cpp' -o -name '*.cuh' -o -name '*.cu' \) \
    -exec clang-format --dry-run --Werror {} +
  scripts/check_includes.sh
}

run_dev()
{
  scripts/sample_cloud.sh build/dev/examples/Shape_regularization_tandem/building.ply ||
    echo "the sample cloud cannot be had: its examples are not run"
  workflow dev
}

run_long()
{
  for package in help2man nodejs npm chromium dpkg-dev mmdebstrap; do
    install $package || echo "$package cannot be installed: some tests will be skipped"
  done
  scripts/install_playwright.sh build/playwright || echo "playwright-core cannot be installed: clicks are not tested"
  workflow long
}

run_detector() { workflow detector; }
run_configure() { scripts/check_configurations.sh build/configure; }

# The preset dev has O1.
run_bits()
{
  install clang
  for compiler in 'g++ -O3 -march=native' 'clang++ -O2'; do
    # shellcheck disable=SC2086
    $compiler -std=c++17 -DNDEBUG -DBOOST_TEST_DYN_LINK -Iinclude -Itest/Shape_regularization_tandem \
      test/Shape_regularization_tandem/testing/main.cpp test/Shape_regularization_tandem/engine/test_same_bits.cpp \
      -o build/bits -lboost_unit_test_framework -lgmp -lmpfr
    build/bits || fail "results depend on the compiler: $compiler"
  done
}

run_asan()
{
  install clang libclang-rt-dev
  workflow asan
}

# For some seconds, with the same mutations each time: a longer run finds more, see fuzz.sh.
run_fuzz()
{
  export TANDEM_FUZZ_DIR="$PWD/build/asan"
  scripts/fuzz.sh ply 4 1
  scripts/fuzz.sh 'xyz off las pcd ptx options' 2 1
}

run_tsan()
{
  install clang libclang-rt-dev
  workflow tsan
}

# For the oldest kind that can be used where there is no device, whose tests are skipped then: code that does not run
# need not be optimized.
run_cuda()
{
  command -v "${CUDACXX:-nvcc}" > /dev/null || { echo "skipped: there is no CUDA compiler"; return; }
  architecture=$(scripts/cuda_architecture.sh)
  [ -n "$architecture" ] ||
    set -- -DCMAKE_CUDA_FLAGS='-Xcicc -O1 -Xptxas -O0' -DCMAKE_CXX_FLAGS_RELEASE='-O0 -DNDEBUG'
  cmake --preset cuda -DCMAKE_CUDA_ARCHITECTURES="${architecture:-75-real}" "$@"
  cmake --build --preset cuda
  ctest --preset cuda
}

# All headers, through what the libraries are made of and a file for each public header. The compiler of the preset has
# this standard by default, clang an older one.
run_tidy()
{
  install clang-tidy
  cmake --preset long
  run-clang-tidy -quiet -p build/dev -extra-arg=-std=c++17 -extra-arg=-Wno-unknown-warning-option '/(include|headers)/.*\.cpp$' > build/tidy.log 2>&1 ||
    { cat build/tidy.log; fail "clang-tidy complains"; }
}

run_doc() { scripts/check_doc.sh; }

run_cost()
{
  scripts/seeded_faults.py --requests
  scripts/cost.sh
}

run_benchmark() { scripts/benchmark.sh --quick; }

[ "$*" != all ] || eval "set -- $parts"
[ $# -gt 0 ] || set -- style dev
for part in "$@"; do
  case " $parts " in *" $part "*) ;; *) fail "no part $part; there are: all $parts" ;; esac
done
trap 'echo "test.sh: $part failed" >&2' EXIT
mkdir -p build
start=$(date +%s)
[ "$*" = style ] || install_for_builds
for part in "$@"; do
  echo "test.sh: $part, after $(($(date +%s) - start)) s"
  ("run_$part")
done
trap - EXIT
echo "test.sh: all tests passed ($*) in $(($(date +%s) - start)) s"
