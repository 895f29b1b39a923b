#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds and runs all tests: first the style of the sources, and whether CMake takes what is
# found and does without the rest; then the release build with TBB and all tests; the bits of results from other
# compilers and options; a choice of tests under ASan + UBSan, with all outputs, and one under TSan, with nothing that is
# optional; the requests of stages and the instructions that detections take, see scripts/check_requests.sh and
# scripts/cost.sh; the fuzz targets for some seconds; with a CUDA compiler, all that is found (tests of a device are
# skipped without one); and the benchmark in small, which fails where a result of Tandem is wrong or differs between back
# ends. The manual has to build without a warning, see scripts/check_doc.sh.
#   test.sh [style] [configure] [release] [benchmark] [bits] [asan] [cost] [tsan] [fuzz] [cuda] [doc]   only these
#                     (default: all of them)
#   TANDEM_BUILD_DIR  parent of the build folders (default: build of this repository)
#   TANDEM_JOBS       compilers at a time (default: number of processors)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build}
jobs=${TANDEM_JOBS:-$(nproc 2> /dev/null || echo 2)}

# The tests that the other configurations build as well: small ones, which reach every part of the engine.
examples='^detect_planes(_of_vector)?$'
sanitized='test_(bad_input|cell_cutter|closed_surface|label_points|regularize_planes|select_shapes|shape_facts|output_file|outputs|polygons|shape_polygons|shared_vertices|regular_outlines|python|mpi_)'

fail() { echo "test.sh: $*" >&2; exit 1; }

. "$root/scripts/test_parts.sh"

now() { date +%s; }
minutes() { echo "$(($1 / 60)):$(printf %02d $(($1 % 60)))"; }

# begin PART PARTS...: says what comes, how long it took so far, and how long the parts may take.
begin()
{
  part=$1; shift
  number=$((number + 1))
  left=0
  for other in "$@"; do
    left=$((left + $(seconds_of "$other")))
  done
  elapsed=$(($(now) - start))
  [ "$typical" -eq 0 ] || left=$((left * elapsed / typical))
  typical=$((typical + $(seconds_of "$part")))
  echo "[$number/$parts] $part, after $(minutes $elapsed), about $(minutes $left) left"
}

step() { echo "    $part: $*, after $(minutes $(($(now) - start)))"; }

# configuration NAME CTEST_LABEL CMAKE_OPTIONS...
configuration()
{
  name=$1; label=$2; shift 2
  step build
  # A folder forgets its options where its compiler changes.
  compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/$name/CMakeCache.txt" 2> /dev/null || true)
  [ -z "$compiler" ] || [ "$compiler" = "$(command -v "${CXX:-c++}")" ] || rm -rf "${build:?}/$name"
  cmake -S "$root" -B "$build/$name" -DTANDEM_BUILD_TESTS=ON -DTANDEM_BUILD_EXAMPLES=ON -DTANDEM_WITH_CUDA=OFF \
    "$@" > /dev/null || fail "cmake failed for $name"
  cmake --build "$build/$name" -j "$jobs" -- -k > "$build/$name/build.log" 2>&1 ||
    { grep -v "^\[" "$build/$name/build.log" >&2; fail "the build $name failed"; }
  step tests
  (cd "$build/$name" && ctest --output-on-failure --no-tests=error -j "$jobs" -L "$label") ||
    fail "tests of $name failed"
}

# Format and lengths of all sources, order of the includes, and clang-tidy on the engine.
run_style()
{
  step format
  find "$root/include" "$root/examples" "$root/test" "$root/benchmark" "$root/cmake" "$root/doc" \
    \( -name '*.h' -o -name '*.cpp' -o -name '*.cuh' -o -name '*.cu' \) -exec clang-format --dry-run --Werror {} + ||
    fail "clang-format would change these files"
  step limits
  python3 "$root/test/Shape_regularization_tandem/scripts/test_check_limits.py" > "$build/limits.log" 2>&1 ||
    { cat "$build/limits.log" >&2; fail "check_limits.py does not see what is too long"; }
  "$root/scripts/check_limits.py" || fail "sources are longer than CONTRIBUTING.md allows"
  step includes
  "$root/scripts/check_includes.sh" || fail "includes run against the order of the folders"
  step clang-tidy
  clang-tidy --quiet "$root/include/CGAL/Tandem/internal/engine/tandem_engine_sequential.cpp" -- -std=c++17 "-I$root/include" \
    > "$build/tidy.log" 2>&1 || { cat "$build/tidy.log" >&2; fail "clang-tidy complains"; }
}

run_configure()
{
  step configure
  "$root/scripts/check_configurations.sh" "$build/configure" || fail "some optional parts cannot be missing"
}

# Not optimized: to compile takes longer than to run.
sanitizer_flags='-O0 -g1 -fno-omit-frame-pointer'

has_python()
{
  # shellcheck disable=SC2086
  if dpkg-query -W $python_packages > /dev/null 2>&1; then echo ON; else echo OFF; fi
}

# With the building of CGAL's data where it can be had, since its examples and the task pages are tests, and with the
# Python module where its packages are installed.
run_release()
{
  building=$build/release/examples/Shape_regularization_tandem/building.ply
  "$root/scripts/sample_cloud.sh" "$building" ||
    echo "the sample cloud cannot be had: the examples of the building and the task pages are not run"
  configuration release . -DCMAKE_BUILD_TYPE=Release -DTANDEM_BUILD_BENCHMARKS=ON \
    "-DTANDEM_BUILD_PYTHON=$(has_python)" -DPython3_EXECUTABLE=/usr/bin/python3 "-DTANDEM_PLAYWRIGHT_DIR=$build/playwright"
  step task pages
  [ ! -s "$building" ] || TANDEM_PROGRAMS=$build/release "$root/scripts/task_pictures.sh" --check ||
    fail "the task pages of the manual have other figures than their commands print"
}

# compile_bits NAME COMPILER FLAGS...: the test of equal bits, with these flags
compile_bits()
{
  name=$1; shift
  echo "$name $*" > "$build/bits/$name.log"
  "$@" -std=c++17 -DNDEBUG "-I$root/include" "-I$root/test/Shape_regularization_tandem" \
    "$root/test/Shape_regularization_tandem/engine/test_same_bits.cpp" -o "$build/bits/$name" -lgmp -lmpfr \
    >> "$build/bits/$name.log" 2>&1 || fail "see $build/bits/$name.log"
}

# The release build has O1 and O3.
run_bits()
{
  mkdir -p "$build/bits"
  step build
  cxx=${CXX:-c++}
  compile_bits native "$cxx" -O3 -march=native &
  others=$!
  compile_bits clang clang++ -O2
  wait "$others" || fail "the test of equal bits does not compile"
  step tests
  for program in native clang; do
    "$build/bits/$program" || fail "results depend on the compiler: $(head -1 "$build/bits/$program.log")"
  done
}

# By clang, which compiles this in half the time, with the fuzz targets. Fails where an output cannot be built.
run_asan()
{
  export CXX=clang++
  configuration asan small -DCMAKE_BUILD_TYPE=Debug "-DTANDEM_TESTS=$sanitized" "-DTANDEM_EXAMPLES=$examples" \
    -DTANDEM_REQUIRE_OUTPUTS=ON -DTANDEM_BUILD_FUZZERS=ON -DTANDEM_BUILD_PYTHON=ON \
    -DPython3_EXECUTABLE=/usr/bin/python3 \
    "-DCMAKE_CXX_FLAGS_DEBUG=$sanitizer_flags -fsanitize=address,undefined,fuzzer-no-link -fno-sanitize-recover=all"
}

run_cost()
{
  step requests
  mkdir -p "$build"
  "$root/scripts/check_requests.sh" > "$build/requests.log" 2>&1 ||
    { cat "$build/requests.log" >&2; fail "some requests of stages are not needed, or not tested"; }
  step count
  TANDEM_BUILD_DIR=$build TANDEM_SKIP_INSTALL=1 "$root/scripts/cost.sh" || fail "detections cost more than is recorded"
}

# With nothing that is optional. So there is no TBB, whose library is not instrumented: TSan would call its hand-over of
# tasks a race. The tests labeled "threads" run the same bodies on threads of their own. Bad input and the program are
# tested without TBB here, too.
run_tsan()
{
  export CXX=clang++
  set -- -DTANDEM_WITH_VIEW=OFF -DLASZIP_LIBRARY=OFF -DHELP2MAN=OFF
  for package in TBB MPI boost_mpi boost_unit_test_framework Eigen3 ZLIB; do
    set -- "$@" "-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"
  done
  configuration tsan 'threads|small' -DCMAKE_BUILD_TYPE=Debug "-DTANDEM_TESTS=test_(thread_backend|bad_input)" \
    "-DTANDEM_EXAMPLES=$examples" "-DCMAKE_CXX_FLAGS_DEBUG=$sanitizer_flags -fsanitize=thread" "$@"
}

# For some seconds, with the same mutations each time: a longer run finds more, see fuzz.sh. After asan in its folder,
# where the targets have been compiled.
run_fuzz()
{
  step run
  export TANDEM_BUILD_DIR="$build" TANDEM_JOBS="$jobs"
  ! grep -qs '^TANDEM_BUILD_FUZZERS:BOOL=ON' "$build/asan/CMakeCache.txt" || export TANDEM_FUZZ_DIR="$build/asan"
  "$root/scripts/fuzz.sh" ply 4 1 || fail "a fuzz target failed"
  "$root/scripts/fuzz.sh" 'xyz off las pcd ptx options' 2 1 || fail "a fuzz target failed"
}

# All that is found, with CUDA and MPI together: the libraries, the program and the Python module. For the device that
# is there; else for the oldest kind that can be used, and without tests of single kernels and of the device itself.
run_cuda()
{
  command -v "${CUDACXX:-nvcc}" > /dev/null || { echo "    skipped, there is no CUDA compiler"; return; }
  architecture=$("$root/scripts/cuda_architecture.sh")
  # Code that does not run need not be optimized. The bits of the results do not depend on how the engine is.
  cuda_flags=; cxx_flags=-O1; cuda_tests=cuda
  [ -n "$architecture" ] || {
    cuda_flags='-Xcicc -O1 -Xptxas -O0'; cxx_flags=-O0; cuda_tests='cuda_(parity|ranks|tags)'; }
  configuration cuda 'cuda|mpi|python' -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=$cxx_flags -DNDEBUG" \
    "-DCMAKE_CUDA_FLAGS=$cuda_flags" "-DCMAKE_CUDA_FLAGS_RELEASE=$cxx_flags -DNDEBUG" \
    -DTANDEM_WITH_CUDA=ON "-DCMAKE_CUDA_ARCHITECTURES=${architecture:-75-real}" "-DTANDEM_TESTS=test_($cuda_tests|python)" \
    '-DTANDEM_EXAMPLES=^detect_planes(_on_device|_by_ranks)?$' "-DTANDEM_BUILD_PYTHON=$(has_python)" \
    -DPython3_EXECUTABLE=/usr/bin/python3
}

# In the folder of the release build, where it has been compiled.
run_benchmark()
{
  step measure
  TANDEM_BUILD_DIR=$build/release TANDEM_JOBS=$jobs TANDEM_SKIP_INSTALL=1 \
    "$root/scripts/benchmark.sh" --quick > "$build/benchmark.log" 2>&1 ||
    { cat "$build/benchmark.log" >&2; fail "the benchmark failed"; }
}

run_doc()
{
  "$root/scripts/check_doc.sh" > "$build/doc.log" 2>&1 || { cat "$build/doc.log" >&2; fail "the manual is not as it should be"; }
}

all_parts='style configure release benchmark bits asan cost tsan fuzz cuda doc'
# shellcheck disable=SC2086
[ $# -gt 0 ] || set -- $all_parts
tested=$*
parts=$#; number=0; typical=0
for part in "$@"; do
  seconds_of "$part" > /dev/null
  command -v "run_$part" > /dev/null || fail "no function run_$part"
done
if [ "${TANDEM_SKIP_INSTALL:-0}" != 1 ]; then
  "$root/scripts/install_dependencies.sh"
  for part in "$@"; do
    install "$part"
  done
fi
start=$(now)
beside= # the part of one thread that runs beside the next one
wait_for_beside()
{
  [ -n "$beside" ] || return 0
  wait "$beside" || { cat "$build/beside.log"; fail "a part failed that ran beside others"; }
  sed 's/^/  /' "$build/beside.log"
  beside=
}
mkdir -p "$build"
while [ $# -gt 0 ]; do
  begin "$1" "$@"
  case $1 in
    style | configure | benchmark | cost)
      wait_for_beside
      "run_$1" > "$build/beside.log" 2>&1 &
      beside=$! ;;
    *) ("run_$1") ;;
  esac
  shift
done
wait_for_beside
echo "test.sh: all tests passed ($tested) in $(minutes $(($(now) - start)))"
