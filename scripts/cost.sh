#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Counts the instructions of three detections by stage (sequential back end, -O2, valgrind's callgrind), and compares
# them with benchmark/Shape_regularization_tandem/cost.csv. Fails where a stage of more than 1 % of a run costs over 3 %
# more than the table says. Prints how much the costs have risen since they were first recorded. Nothing is compared
# where the compiler is not that of the table, or the processor lacks fused multiply-add.
#   cost.sh            compares
#   cost.sh --record   writes the table, where all rows keep their first values. Another compiler changes these as it
#                      changes the present ones; so it is recorded apart from changes of the sources.
# A commit that makes a detection cost more records the table and says why. One that makes it cost less records it,
# too, so that the gain is not lost again. In the same way, test_thread_backend.cpp bounds passes and loops, and
# test_cuda_work.cpp the launches of a device.
#   TANDEM_BUILD_DIR  parent of the build folder (default: build of this repository)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
work=${TANDEM_BUILD_DIR:-$root/build}/cost
benchmark=$root/benchmark/Shape_regularization_tandem
test=$root/test/Shape_regularization_tandem
table=$benchmark/cost.csv
cxx=${CXX:-c++}

fail() { echo "cost.sh: $*" >&2; exit 1; }

# count_cloud NAME INPUT: its total and stages, and dumps of the functions
count_cloud()
{
  rm -f "$work/dump.$1."*
  valgrind -q --tool=callgrind --instr-atstart=no --dump-line=no "--callgrind-out-file=$work/dump.$1" \
    "$work/cost" "$2" "$work/dump.$1" > "$work/$1.csv" 2> "$work/valgrind.log" ||
    { cat "$work/valgrind.log" >&2; fail "the detection of $1 failed"; }
}

[ $# -eq 0 ] || [ "$*" = --record ] || fail "unknown option $1, see the head of this file"
mkdir -p "$work"
compiler="$("$cxx" -dumpmachine) $(echo __VERSION__ | "$cxx" -E -P -x c++ - | tr -d '"')"
# Others emulate std::fma(). What newer ones have, valgrind hides from the C library.
! grep -qsw fma /proc/cpuinfo || compiler="$compiler fma"
if [ $# -eq 0 ] && [ "$(head -1 "$table")" != "# $compiler" ]; then
  echo "cost.sh: nothing is compared, since the costs of $compiler are not recorded"
  exit 0
fi
[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" g++ libcgal-dev valgrind python3
"$root/scripts/sample_cloud.sh" "$work/building.ply"
# A function that is called once would lose its name.
"$cxx" -std=c++17 -O2 -DNDEBUG -fno-inline-functions-called-once "-I$root/include" "-I$benchmark" "-I$test" \
  "$benchmark/programs/cost.cpp" "$test"/scenes/*.cpp -o "$work/cost" -lgmp -lmpfr
count_cloud building "$work/building.ply"
count_cloud house house
count_cloud scan scan
python3 "$root/scripts/cost.py" "$work" "$table" "$compiler" "$@" ||
  fail "costs have risen: make them fall, or record them (--record) in the commit that raises them, which says why"
