#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Configures Tandem with all optional parts that are found, without each of them, with few, and with none; without models;
# and the tests alone. This has to succeed, and what uses a precompiled header has to be compiled with its flags. Compiles
# nothing.
#   check_configurations.sh FOLDER   FOLDER: is made anew

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
folder=${1:?"check_configurations.sh: which folder?"}
packages='CUDAToolkit TBB MPI boost_mpi Eigen3 ZLIB boost_program_options nlohmann_json boost_unit_test_framework'

fail() { echo "check_configurations.sh: $*" >&2; exit 1; }

flags_of() { sed -n 's/^CXX_FLAGS = //p' "$1/flags.make" | tr ' ' '\n' | sort -u; }

# configure SOURCES OPTIONS...: the makefiles say which header a target uses. With precompiled headers, which there are not
# with ccache.
configure()
{
  sources=$1; shift
  cmake -G 'Unix Makefiles' -S "$sources" -B "$folder" -DCMAKE_CXX_COMPILER_LAUNCHER= -DCMAKE_CUDA_ARCHITECTURES=75 "$@" \
    > "$folder/cmake.log" 2>&1 || { cat "$folder/cmake.log" >&2; fail "cmake failed for $sources with $*"; }
  files=$(grep -rl --include=flags.make '^# PCH options' "$folder") || fail "no precompiled header with $*"
  for file in $files; do
    header=$(sed -n 's/^# PCH options.*;\(.*\)\/cmake_pch.hxx.*/\1/p' "$file" | head -n 1)
    [ "$(flags_of "${file%/*}")" = "$(flags_of "$header")" ] ||
      fail "the flags of ${file%/*} are not those of the precompiled header in $header with $*"
  done
}

# without "PACKAGES..." OPTIONS...: all others may be found
without()
{
  missing=" $1 "; shift
  for package in $packages; do
    case $missing in *" $package "*) is_missing=ON ;; *) is_missing=OFF ;; esac
    set -- "$@" "-DCMAKE_DISABLE_FIND_PACKAGE_$package=$is_missing"
  done
  configure "$root" "$@"
}

rm -rf "$folder"
mkdir -p "$folder"
configure "$root/test/Shape_regularization_tandem"
rm -rf "$folder"
mkdir -p "$folder"
without ''
without '' -DTANDEM_BUILD_MODELS=OFF
without '' -DTANDEM_BUILD_MODELS=ON -DTANDEM_BUILD_ENGINE=OFF
without TBB -DTANDEM_BUILD_ENGINE=ON
for package in $packages; do
  [ "$package" = TBB ] || without "$package"
done
without "$(echo "$packages" | sed 's/CUDAToolkit//')"
without "$(echo "$packages" | sed 's/MPI boost_mpi//')"
without "$packages" -DTANDEM_WITH_VIEW=OFF
