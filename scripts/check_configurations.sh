#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Configures Tandem with all optional parts that are found, without each of them, with few, and with none; and the tests
# alone. This has to succeed, and what uses a precompiled header has to be compiled with its flags. Compiles nothing.
#   check_configurations.sh FOLDER   FOLDER: is made anew

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
folder=${1:?"check_configurations.sh: which folder?"}
packages='CUDAToolkit TBB MPI boost_mpi Eigen3 GLPK SCIP ZLIB boost_program_options nlohmann_json boost_unit_test_framework'
fail() { echo "check_configurations.sh: $*" >&2; exit 1; }

flags_of() { sed -n 's/^CXX_FLAGS = //p' "$1/flags.make" | tr ' ' '\n' | sort -u; }

# The makefiles say which header a target uses.
check_precompiled()
{
  files=$(grep -rl --include=flags.make '^# PCH options' "$folder") || fail "without $*: no precompiled header"
  for file in $files; do
    header=$(sed -n 's/^# PCH options.*;\(.*\)\/cmake_pch.hxx.*/\1/p' "$file" | head -n 1)
    [ "$(flags_of "${file%/*}")" = "$(flags_of "$header")" ] ||
      fail "without $*: the flags of ${file%/*} are not those of the precompiled header in $header"
  done
}

# configure SOURCES MISSING OPTIONS...
configure()
{
  sources=$1; lacks=$2; shift 2
  cmake -G 'Unix Makefiles' -S "$sources" -B "$folder" "$@" > "$folder/cmake.log" 2>&1 ||
    { cat "$folder/cmake.log" >&2; fail "cmake failed for $sources without$lacks"; }
  check_precompiled "$lacks"
}

# without "PACKAGES..." OPTIONS...
without()
{
  missing=" $1 "; shift
  for package in $packages; do
    case $missing in
      *" $package "*) set -- "$@" "-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON" ;;
      *) set -- "$@" "-DCMAKE_DISABLE_FIND_PACKAGE_$package=OFF" ;;
    esac
  done
  configure "$root" "$missing" "$@"
}

# The packages but those that are named.
all_but()
{
  for package in $packages; do
    case " $* " in
      *" $package "*) ;;
      *) echo "$package" ;;
    esac
  done | tr '\n' ' '
}

# With precompiled headers, which there are not with ccache.
options='-DCMAKE_CXX_COMPILER_LAUNCHER= -DCMAKE_CUDA_ARCHITECTURES=75'
rm -rf "$folder"
mkdir -p "$folder"
# shellcheck disable=SC2086
configure "$root/test/Shape_regularization_tandem" ' nothing' $options
rm -rf "$folder"
mkdir -p "$folder"
# shellcheck disable=SC2086
without '' $options
without '' -DTANDEM_BUILD_ENGINE=OFF
without '' -DTANDEM_BUILD_ENGINE=ON -DTANDEM_BUILD_MODELS=OFF
without TBB -DTANDEM_BUILD_MODELS=ON
for package in CUDAToolkit MPI boost_mpi Eigen3 GLPK ZLIB boost_program_options nlohmann_json boost_unit_test_framework; do
  without "$package"
done
without "$(all_but CUDAToolkit)"
without "$(all_but MPI boost_mpi)"
without "$packages" -DTANDEM_WITH_VIEW=OFF
