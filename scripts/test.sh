#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds and runs all tests: the release build with TBB, then
# a choice of them without TBB, under ASan + UBSan, and under TSan; and the benchmark in small,
# which fails where a result of Tandem is wrong or differs between back ends; the micro-benchmarks
# have to compile, where there is Google Benchmark. The manual has to build without a warning.
#   test.sh [release] [sequential] [asan] [tsan] [cuda] [benchmark] [doc]    only these (default: all of them)
# Where there is a CUDA compiler, the CUDA back end is built, too, for one or two architectures;
# its tests are skipped without a device.
#   TANDEM_BUILD_DIR  parent of the build folders (default: build of this repository)
#   TANDEM_JOBS       compilers at a time (default: number of processors)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build}
jobs=${TANDEM_JOBS:-$(nproc 2> /dev/null || echo 2)}

# The tests that the other configurations build as well: they reach every part of the
# engine and are small, and compiling is what takes the time.
sequential='test_(bad_input|analytic_scenes|thread_backend)'
examples='^detect_planes(_of_vector)?$'
sanitized='test_(bad_input|analytic_scenes|callback|neighbors|regularize_planes|thread_backend)'

fail() { echo "test.sh: $*" >&2; exit 1; }

# configuration NAME CTEST_LABEL CMAKE_OPTIONS...
configuration()
{
  name=$1; label=$2; shift 2
  echo "== $name"
  cmake -S "$root" -B "$build/$name" -DTANDEM_BUILD_TESTS=ON -DTANDEM_BUILD_EXAMPLES=ON -DTANDEM_WITH_CUDA=OFF "$@" > /dev/null ||
    fail "cmake failed for $name"
  cmake --build "$build/$name" -j "$jobs" -- -k > "$build/$name/build.log" 2>&1 ||
    { grep -v "^\[" "$build/$name/build.log" >&2; fail "the build $name failed"; }
  (cd "$build/$name" && ctest --output-on-failure --no-tests=error -L "$label") || fail "tests of $name failed"
}

# Instrumented code draws false warnings of uninitialized values, so none is an error there.
sanitizer_flags='-O1 -g1 -fno-omit-frame-pointer'

# With the building of CGAL's data where it can be had, since two of its examples are tests.
run_release()
{
  [ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" gnuplot-nox ||
    echo "gnuplot cannot be installed: the pictures of the benchmark are not tested"
  "$root/scripts/sample_cloud.sh" "$build/release/examples/Shape_regularization_tandem/building.ply" ||
    echo "the sample cloud cannot be had: the examples of the building are not run"
  configuration release . -DCMAKE_BUILD_TYPE=Release
}

run_sequential()
{
  configuration sequential 'small|program' -DCMAKE_BUILD_TYPE=Release -DTANDEM_WITH_TBB=OFF "-DTANDEM_TESTS=$sequential" \
    "-DTANDEM_EXAMPLES=$examples"
}

run_asan()
{
  configuration asan small -DCMAKE_BUILD_TYPE=Debug -DTANDEM_WARNINGS_AS_ERRORS=OFF "-DTANDEM_TESTS=$sanitized" \
    "-DTANDEM_EXAMPLES=$examples" \
    "-DCMAKE_CXX_FLAGS_DEBUG=$sanitizer_flags -fsanitize=address,undefined -fno-sanitize-recover=all"
}

# The library of TBB is not instrumented, so TSan would call its hand-over of tasks a
# race. The tests labeled "threads" run the same bodies on threads of their own.
run_tsan()
{
  configuration tsan threads -DCMAKE_BUILD_TYPE=Debug -DTANDEM_WARNINGS_AS_ERRORS=OFF \
    -DTANDEM_WITH_TBB=OFF -DTANDEM_BUILD_EXAMPLES=OFF \
    "-DTANDEM_TESTS=test_(host_team|thread_backend)" "-DCMAKE_CXX_FLAGS_DEBUG=$sanitizer_flags -fsanitize=thread"
}

# For the device that is there; else for the oldest kind that can be used, and one of the year 2022.
run_cuda()
{
  command -v "${CUDACXX:-nvcc}" > /dev/null || { echo "== cuda: skipped, there is no CUDA compiler"; return; }
  architecture=$("$root/scripts/cuda_architecture.sh")
  configuration cuda cuda -DCMAKE_BUILD_TYPE=Release -DTANDEM_WITH_CUDA=ON \
    "-DCMAKE_CUDA_ARCHITECTURES=${architecture:-75-real;90-real}" -DTANDEM_TESTS=test_cuda \
    -DTANDEM_EXAMPLES=detect_planes_on_device
}

run_benchmark()
{
  echo "== benchmark"
  mkdir -p "$build"
  [ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" libbenchmark-dev libnanoflann-dev ||
    echo "Google Benchmark cannot be installed: the micro-benchmarks are not built"
  TANDEM_BUILD_DIR=$build/benchmark TANDEM_JOBS=$jobs "$root/scripts/benchmark.sh" --quick > "$build/benchmark.log" 2>&1 ||
    { cat "$build/benchmark.log" >&2; fail "the benchmark failed"; }
  cmake --build "$build/benchmark" -j "$jobs" --target micro_benchmarks > "$build/micro.log" 2>&1 ||
    { cat "$build/micro.log" >&2; fail "the micro-benchmarks do not build"; }
}

run_doc()
{
  echo "== doc"
  mkdir -p "$build"
  "$root/scripts/doc.sh" > "$build/doc.log" 2>&1 || { cat "$build/doc.log" >&2; fail "the manual has warnings"; }
}

[ $# -gt 0 ] || set -- release sequential asan tsan cuda benchmark doc
[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh"
for part in "$@"; do
  case $part in
    release | sequential | asan | tsan | cuda | benchmark | doc) "run_$part" ;;
    *) fail "unknown configuration $part; choose of release sequential asan tsan cuda benchmark doc" ;;
  esac
done
echo "test.sh: all tests passed ($*)"
