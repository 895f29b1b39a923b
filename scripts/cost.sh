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
#   TANDEM_BUILD_DIR  parent of the build folder (default: build of this repository)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build}
work=$build/cost
benchmark=$root/benchmark/Shape_regularization_tandem
test=$root/test/Shape_regularization_tandem
table=$benchmark/cost.csv
cxx=${CXX:-c++}

# Functions that have a row, NAME(), beside the stages of Stage_times; calls by any stage count. A row that is gone, or
# new, is no fault.
functions='sort_points find_neighbors estimate_normals find_border order_seeds grow_cells collect_links
  sample_shapes merge_by_gain regularize_shapes apply_planes split_shapes raise_score regularize_finally choose_sides
  free_small_components center_shapes extract_shapes'

fail() { echo "cost.sh: $*" >&2; exit 1; }

# compare TABLE COUNTS: rows of TABLE are "cloud,stage,first,present", those of COUNTS "cloud,stage,count", the total of
# a cloud before its stages
compare()
{
  awk -F , '
    NR == FNR { if($4 ~ /^[0-9]/) { first[$1, $2] = $3; present[$1, $2] = $4 } next }
    { now[$1, $2] = $3 }
    !(($1, $2) in present) { print $1 ", " $2 " is new"; next }
    $2 == "total" {
      total = $3
      if(total == 0) {
        print $1 ": nothing was counted"
        exit failed = 1
      }
      printf "%s: %.0f million instructions, %.3f of those recorded, %.3f of the first ones\n", $1, total,
        total / present[$1, $2], total / first[$1, $2]
      product += log(total / first[$1, $2])
      ++clouds
    }
    $3 > 1.03 * present[$1, $2] && $3 > .01 * total {
      printf "%s, %s: %.1f million instructions, but %.1f are recorded\n", $1, $2, $3, present[$1, $2]
      failed = 1
    }
    END {
      for(row in present)
        if(!(row in now)) {
          split(row, name, SUBSEP)
          print name[1] ", " name[2] " is gone"
          failed = failed || row !~ /\(\)$/
        }
      if(clouds)
        printf "geometric mean of the clouds: %.3f of the first instructions\n", exp(product / clouds)
      exit failed
    }' "$1" "$2"
}

# expect VERDICT ROWS...: what compare() says of a cloud with these stages
expect()
{
  verdict=$1; shift
  printf 'x,%s\n' "$@" > "$work/counts.csv"
  if compare "$work/table.csv" "$work/counts.csv" > "$work/self_check.log"; then is=passes; else is=fails; fi
  [ "$is" = "$verdict" ] || fail "the comparison is wrong: it $is with $*"
}

check_itself()
{
  printf '%s\n' cloud,stage,first,present x,total,800,1000 x,growth,400,500 x,sort,9,9 'x,grow(),300,400' \
    > "$work/table.csv"
  expect passes total,1020 growth,514 sort,10 'grow(),411'
  expect passes total,900 growth,400 sort,9
  expect passes total,1000 growth,500 sort,9 'grow_fast(),400'
  expect fails total,1031 growth,500 sort,9 'grow(),400'
  expect fails total,1000 growth,516 sort,9 'grow(),400'
  expect fails total,1000 growth,500 sort,11 'grow(),400'
  expect fails total,1000 growth,500 sort,9 'grow(),413'
  expect fails total,1000 growth,500 'grow(),400'
  expect fails growth,500 sort,9 'grow(),400'
  expect fails total,0 growth,0 sort,0
}

# record TABLE COUNTS: the new table
record()
{
  awk -F , -v compiler="$compiler" '
    NR == FNR && /^#/ { is_same = substr($0, 3) == compiler; next }
    NR == FNR { first[$1, $2] = $3; present[$1, $2] = $4; next }
    FNR == 1 { print "# " compiler "\ncloud,stage,first,present" }
    {
      value = ($1, $2) in first ? first[$1, $2] : $3
      if(!is_same && present[$1, $2] > 0)
        value *= $3 / present[$1, $2]
      printf "%s,%s,%.1f,%s\n", $1, $2, value, $3
    }' "$1" "$2"
}

# Calls of the functions are counted where their callers are: "cfn=(ID) NAME" the first time, then "cfn=(ID)",
# "calls=..", and the position and the count.
count_functions()
{
  awk -v functions="$functions" '
    BEGIN { split(functions, list); for(i in list) wanted[list[i]] }
    FNR == 1 { split("", name) }
    function short(text) {
      sub(/^[^ ]* /, "", text)
      while(gsub(/<[^<>]*>/, "", text)) {
      }
      sub(/\(.*/, "", text)
      sub(/^.* /, "", text)
      return sub(/^CGAL::Tandem::internal::/, "", text) && text in wanted ? text : ""
    }
    /^c?fn=/ {
      id = $1
      sub(/^c?fn=/, "", id)
      if(NF > 1)
        name[id] = short($0)
      called = name[id]
    }
    is_count { if(called != "") count[called] += $2 }
    { is_count = /^calls=/ }
    END { for(i = 1; i in list; ++i) if(list[i] in count) printf "%s(),%.1f\n", list[i], count[list[i]] / 1e6 }' "$@"
}

# count_cloud NAME INPUT
count_cloud()
{
  rm -f "$work"/dump*
  valgrind -q --tool=callgrind --instr-atstart=no --dump-line=no "--callgrind-out-file=$work/dump" \
    "$work/cost" "$2" "$work/dump" > "$work/stages.csv" 2> "$work/valgrind.log" ||
    { cat "$work/valgrind.log" >&2; fail "the detection of $1 failed"; }
  count_functions "$work"/dump.* >> "$work/stages.csv"
  sed "s/^/$1,/" "$work/stages.csv"
}

is_recorded=
case ${1:-} in
  '') ;;
  --record) is_recorded=1 ;;
  *) fail "unknown option $1, see the head of this file" ;;
esac
mkdir -p "$work"
check_itself
compiler=$("$cxx" -dumpmachine)
compiler="$compiler $(echo __VERSION__ | "$cxx" -E -P -x c++ - | tr -d '"')"
# Others emulate std::fma(). What newer ones have, valgrind hides from the C library.
! grep -qsw fma /proc/cpuinfo || compiler="$compiler fma"
if [ -z "$is_recorded" ] && [ "$(head -1 "$table")" != "# $compiler" ]; then
  echo "cost.sh: nothing is compared, since the costs of $compiler are not recorded"
  exit 0
fi
[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" g++ libcgal-dev valgrind
"$root/scripts/sample_cloud.sh" "$work/building.ply"
# A function that is called once would lose its name.
"$cxx" -std=c++17 -O2 -DNDEBUG -fno-inline-functions-called-once "-I$root/include" "-I$benchmark" "-I$test" \
  "$benchmark/programs/cost.cpp" "$test"/scenes/*.cpp -o "$work/cost" -lgmp -lmpfr
{
  count_cloud building "$work/building.ply"
  count_cloud house house
  count_cloud scan scan
} > "$work/counts.csv"
if [ -n "$is_recorded" ]; then
  [ -s "$table" ] || echo '# none' > "$table"
  record "$table" "$work/counts.csv" > "$work/table.csv"
  cp "$work/table.csv" "$table"
fi
compare "$table" "$work/counts.csv" ||
  fail "costs have risen: make them fall, or record them (--record) in the commit that raises them, which says why"
