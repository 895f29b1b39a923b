#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds Tandem and the measuring programs, and compares Tandem with
# CGAL's own detectors, on the building of libcgal-demo and on generated scenes, or on your cloud:
#   compare.sh [CLOUD.ply EPSILON ALPHA MINIMUM [CLUSTER]]
#     EPSILON   largest distance of a point to its plane, in units of the cloud
#     ALPHA     largest angle between its normal and the plane's, in degrees
#     MINIMUM   points of the smallest shape
#     CLUSTER   cluster epsilon of RANSAC (default: -1, for CGAL's 1 % of the diagonal)
# The table is printed and written to table.md in the build folder.
#   TANDEM_BUILD_DIR  where to build (default: build/compare of this repository)
#   TANDEM_THREADS    threads of the parallel back end (default: 2)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build/compare}
threads=${TANDEM_THREADS:-2}
slow=10   # seconds; a program is not run again after a run that took longer
result=$build/result
detect_planes=$build/examples/Shape_regularization_tandem/detect_planes
benchmark=$build/benchmark/Shape_regularization_tandem

fail() { echo "compare.sh: $*" >&2; exit 1; }

# Cloud, epsilon, alpha, minimum, cluster epsilon of RANSAC (the best of some that were tried; -1: its default),
# options of make_scene.
cases()
{
  cat << END
building 0.15  25.842 100 -1
house    0.04  25.842 200 0.04 --points 1000000
village  0.12  25.842 200 1    --points 1000000 --noise 0.0003 --outliers 0.05 --normal-noise 4
indoor   0.015 25.842 200 0.08 --points 300000 --noise 0.0002 --outliers 0.02 --varying-density --normal-noise 4
part     0.02  25.842 200 0.04 --points 200000 --noise 0.0003 --normal-noise 3
END
}

build_programs()
{
  cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DTANDEM_BUILD_TESTS=OFF -DTANDEM_BUILD_EXAMPLES=ON \
    -DTANDEM_BUILD_BENCHMARKS=ON > "$result/cmake.log" 2>&1 ||
    { cat "$result/cmake.log" >&2; fail "cmake failed"; }
  echo "Building detect_planes and the measuring programs (a minute or two) ..."
  cmake --build "$build" -j 2 --target detect_planes make_scene peers evaluate > "$result/build.log" 2>&1 ||
    { cat "$result/build.log" >&2; fail "the build failed"; }
}

# tandem THREADS: one run, its seconds appended to tandem_THREADS.seconds
tandem()
{
  name=tandem_$1
  # shellcheck disable=SC2086
  "$detect_planes" "$cloud" $tolerances --threads "$1" --quiet --labels "$result/$name.labels" \
    --planes "$result/$name.planes" --report "$result/$name.json" || fail "detect_planes failed on $cloud"
  awk -F '[:,]' '$1 ~ /"total"/ { print $2 + 0 }' "$result/$name.json" >> "$result/$name.seconds"
}

# peer RESULT CLOCK METHOD OPTIONS...: one run, its seconds appended to CLOCK.seconds, and those
# with regularize_planes to CLOCK_regularized.seconds
peer()
{
  name=$1; clock=$2; method=$3; shift 3
  # shellcheck disable=SC2086
  "$benchmark/peers" "$method" "$cloud" $tolerances --k-neighbors 12 --labels "$result/$name.labels" \
    --planes "$result/$name.planes" "$@" > "$result/$name.log" || fail "peers $method failed on $cloud"
  awk -v clock="$result/$clock" '
    { for(i = 2; i < NF; i += 2) value[$i] = $(i + 1)
      print value["wall"] >> (clock ".seconds")
      print value["wall"] + value["regularize"] >> (clock "_regularized.seconds")
    }' "$result/$name.log"
}

is_slow()
{
  [ -f "$result/$1.seconds" ] && awk -v slow=$slow '$1 > slow { n = 1 } END { exit !n }' "$result/$1.seconds"
}

# Method by method three times over, so that a busy while does not hit one of them alone.
measure()
{
  rm -f "$result"/*.seconds
  for turn in 1 2 3; do
    is_slow "tandem_$threads" || tandem "$threads"
    [ "$threads" = 1 ] || is_slow tandem_1 || tandem 1
    is_slow growing || peer growing growing rg
    if [ $turn = 3 ]; then
      peer cleaned cached rg-cached --regularize --cleaned
    else
      is_slow cached || peer regularized cached rg-cached --regularize \
        --plain-labels "$result/cached.labels" --plain-planes "$result/cached.planes"
    fi
    is_slow ransac || peer ransac ransac ransac "--cluster-epsilon=$cluster"
  done
}

print_row()
{
  printf '%s\n' "$1" | awk -F '\t' '{
    printf "%-9.9s %-38s %8s %7s %6s %7s %7s %8s %9s %9s %6s\n", $1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11 }'
}

# What was used, which without oneTBB is one.
threads_of() { awk -F '[:,]' '$1 ~ /"threads"/ { print $2 + 0 }' "$result/tandem_$1.json"; }

# row NAME CLOCK DESCRIPTION: judges the files NAME.* and prints and keeps the row
row()
{
  seconds=$(sort -g "$result/$2.seconds" | awk '{ s[NR] = $1 }
    END { printf "%.2f%s", (s[int((NR + 1) / 2)] + s[int(NR / 2) + 1]) / 2, NR < 3 ? "*" : "" }')
  # shellcheck disable=SC2086
  "$benchmark/evaluate" "$cloud" $tolerances --labels "$result/$1.labels" --planes "$result/$1.planes" \
    --name cloud --csv --header > "$result/$1.csv" || fail "evaluate failed on $cloud"
  line=$(awk -F , -v OFS='\t' -v cloud="$title" -v method="$3" -v seconds="$seconds" '
    function get(name, format) { return name in column ? sprintf(format, $column[name]) : "-" }
    NR == 1 { for(i = 1; i <= NF; ++i) column[$i] = i }
    NR == 2 { print cloud, method, seconds, get("shapes", "%d"), get("directions within 1e-6", "%d"),
                    get("planes within 1e-6", "%d"), get("complexity within 1e-6", "%.2f"), get("coverage %", "%.1f"),
                    get("points beyond epsilon", "%d"), get("points beyond alpha", "%d"),
                    get("face F1 at .5", "%.3f") }' "$result/$1.csv")
  print_row "$line"
  printf '%s\n' "$line" >> "$result/rows.tsv"
}

# compare TITLE EPSILON ALPHA MINIMUM CLUSTER ORIGIN: all methods on $cloud
compare()
{
  title=$1; cluster=$5
  tolerances="--maximum-distance $2 --maximum-angle $3 --minimum-region-size $4"
  printf -- '- %s: %s; epsilon %s, alpha %s, at least %s points; cluster epsilon of RANSAC %s\n' \
    "$1" "$6" "$2" "$3" "$4" "$5" >> "$result/clouds.md"
  measure
  row "tandem_$threads" "tandem_$threads" "Tandem, threads: $(threads_of "$threads")"
  [ "$threads" = 1 ] || row tandem_1 tandem_1 'Tandem, threads: 1'
  row growing growing 'region growing'
  row cached cached 'region growing, neighbors cached'
  row regularized cached_regularized 'the same + regularize_planes'
  row cleaned cached_regularized 'the same + regularize_planes, cleaned'
  row ransac ransac 'Efficient RANSAC'
}

compare_samples()
{
  while read -r scene epsilon alpha minimum cluster options; do
    cloud=$result/$scene.ply
    if [ "$scene" = building ]; then
      "$root/scripts/sample_cloud.sh" "$cloud"
      origin="data/points_3/building.ply of libcgal-demo"
    else
      # shellcheck disable=SC2086
      "$benchmark/make_scene" "$scene" "$cloud" $options > "$result/scene.log" || fail "make_scene failed"
      origin="make_scene $scene $options"
    fi
    compare "$scene" "$epsilon" "$alpha" "$minimum" "$cluster" "$origin"
  done << END
$(cases)
END
}

check_own_cloud()
{
  [ -r "$1" ] || fail "cannot read $1"
  awk '/^property/ { sub(/\r$/, ""); names = names " " $NF } /^end_header/ { exit }
       END { exit !(names ~ / nx( |$)/ && names ~ / nz( |$)/) }' "$1" ||
    fail "$1 is not a PLY file with normals (properties nx, ny, nz)"
}

version_of_cgal()
{
  printf '#include <CGAL/version.h>\nCGAL_VERSION_STR\n' | "$compiler" -E -P -x c++ - 2> /dev/null |
    tail -n 1 | tr -d '"'
}

# note_use FILE: seconds of the clock, of all processors at work, and of the programs of this script
note_use()
{
  [ -r /proc/stat ] || return 0
  times > "$result/times"
  awk -v hertz="$(getconf CLK_TCK)" -v now="$(date +%s)" '
    FILENAME == "/proc/stat" { if($1 == "cpu") all = ($2 + $3 + $4 + $7 + $8 + $9) / hertz; next }
    { for(i = 1; i <= 2; ++i) { split($i, t, "[ms]"); own += 60 * t[1] + t[2] } }
    END { print now, all, own }' /proc/stat "$result/times" > "$1"
}

used_by_others()
{
  [ -r "$result/before" ] || { echo "an unknown number"; return; }
  awk 'NR == 1 { now = $1; all = $2; own = $3 }
    NR == 2 { x = ($2 - all - $3 + own) / ($1 - now + 1e-9); printf "%.1f", x < 0 ? 0 : x }' \
    "$result/before" "$result/after"
}

write_table()
{
  compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
  processor=$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo 2> /dev/null | head -n 1)
  commit=$(git -C "$root" describe --always --dirty 2> /dev/null || echo unknown)
  cat << END
Measured on $(date -u +%Y-%m-%d) by \`scripts/compare.sh\`, Tandem $commit, CGAL $(version_of_cgal),
$("$compiler" --version | head -n 1), Release; ${processor:-$(uname -m)}, $(getconf _NPROCESSORS_ONLN) processors.
Meanwhile other programs used $(used_by_others) of these processors on average (0: nothing disturbed).

END
  awk -F '\t' 'BEGIN {
      print "| cloud | method | seconds | shapes | directions | planes | complexity |" \
            " coverage % | beyond epsilon | beyond alpha | F1 of faces |"
      print "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|" }
    { name = $1 == last ? "" : $1; last = $1; printf "| %s |", name
      for(i = 2; i <= NF; ++i) printf " %s |", $i
      print "" }' "$result/rows.tsv"
  cat << END

Seconds: wall clock without reading and writing, the median of three runs, methods interleaved; * fewer runs, since
one took more than $slow s. Directions, planes and complexity (the paper's; smaller is more regular) count as equal
what is equal within 1e-6. Beyond epsilon, alpha: assigned points that violate the tolerances that the method was
given. Cleaned: these points are dropped, then shapes that have become too small. F1: of the true faces, matched at
intersection over union of one half. All methods have the same epsilon, alpha and minimum; region growing has 12
neighbors, its default, and regularize_planes the angle tolerance 8 degrees and the offset epsilon, those of Tandem.
The cluster epsilon of RANSAC is the best of some that were tried; -1: 1 % of the diagonal, its default.

END
  cat "$result/clouds.md"
}

[ $# -eq 0 ] || [ $# -eq 4 ] || [ $# -eq 5 ] || fail "usage: compare.sh [CLOUD.ply EPSILON ALPHA MINIMUM [CLUSTER]]"
[ $# -eq 0 ] || check_own_cloud "$1"
[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] ||
  "$root/scripts/install_dependencies.sh" g++ make cmake libcgal-dev libeigen3-dev libboost-program-options-dev \
    libtbb-dev
mkdir -p "$result"
build_programs
rm -f "$result/rows.tsv" "$result/clouds.md" "$result/before"
note_use "$result/before"

print_row "$(printf 'cloud\tmethod\tseconds\tshapes\tdirec.\tplanes\tcomplex\tcover. %%\t> epsilon\t> alpha\tF1')"
if [ $# -eq 0 ]; then
  compare_samples
else
  cloud=$1
  compare "$(basename "$1" .ply)" "$2" "$3" "$4" "${5:--1}" "given"
fi
note_use "$result/after"
write_table > "$build/table.md"
echo
echo "As Markdown, with notes: $build/table.md    (* fewer than three runs)"
