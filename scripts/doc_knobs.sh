#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Measures what the parameters simplicity and regularity change, and draws the curves of the manual. It writes
# doc/Shape_regularization_tandem/tables/knobs.csv and fig/simplicity_curves.png, fig/regularity_curves.png. Takes about
# ten minutes. The clouds are the building of CGAL's Debian package libcgal-demo, kinect_room.ply and the labeled clouds
# of the benchmark (labeled_frames).
#   doc_knobs.sh           measures and draws
#   doc_knobs.sh --draw    only draws
#   TANDEM_DATA       folder of kinect_room.ply or kinect_room.ply.xz
#   TANDEM_BUILD_DIR  where to build (default: build/knobs of this repository)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build/knobs}
doc=$root/doc/Shape_regularization_tandem
result=$build/result
table=$doc/tables/knobs.csv
program=$build/examples/detect_planes/detect_planes

fail() { echo "doc_knobs.sh: $*" >&2; exit 1; }

build_programs()
{
  echo "Building detect_planes and labeled_frames (some minutes) ..."
  cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DTANDEM_BUILD_TESTS=OFF -DTANDEM_BUILD_EXAMPLES=ON \
    -DTANDEM_BUILD_BENCHMARKS=ON -DTANDEM_WITH_CUDA=OFF > "$result/cmake.log" 2>&1 ||
    { cat "$result/cmake.log" >&2; fail "cmake failed"; }
  cmake --build "$build" --target detect_planes --target labeled_frames -j > "$result/build.log" 2>&1 ||
    { cat "$result/build.log" >&2; fail "the build failed"; }
  judge=$(find "$build" -name labeled_frames -type f -perm -u+x | head -n 1)
}

fetch_clouds()
{
  "$root/scripts/sample_cloud.sh" "$result/building.ply"
  data=${TANDEM_DATA:?is the folder of kinect_room.ply}
  if [ -r "$data/kinect_room.ply" ]; then
    cp "$data/kinect_room.ply" "$result/kinect_room.ply"
  else
    xz -dc "$data/kinect_room.ply.xz" > "$result/kinect_room.ply" || fail "no kinect_room.ply in $data"
  fi
}

# A row of the cloud $1 of clouds.csv, for the parameter $2 with the value $3. Normals are estimated where it has none.
measure_cloud()
{
  # shellcheck disable=SC2046
  set -- "$1" "$2" "$3" $(awk -F, -v name="$1" '$1 == name {
    printf "%s --maximum-distance %s --maximum-angle %s --minimum-region-size %s", $2, $11, $12, $13
  }' "$root/benchmark/Shape_regularization_tandem/clouds.csv")
  name=$1 knob=$2 value=$3 cloud=$result/$4
  shift 4
  "$program" "$cloud" "$@" "--$knob" "$value" --quiet --report "$result/report.json" || fail "detect_planes failed"
  tr -d ',"' < "$result/report.json" | awk -v start="$name,$knob,$value" '
    { value[$1] = $2 }
    END {
      printf "%s,%d,%.2f,%.4f,%d,,,,\n", start, value["shapes:"], 100 * value["coverage:"],
             value["mean_distance:"] / value["maximum_distance:"], value["degrees_of_freedom:"]
    }'
}

# A row of the labeled clouds: means over all of them, with given and with own normals.
measure_labels()
{
  "$judge" --csv "$result/labels.csv" "--$1" "$2" > "$result/labels.log" 2>&1 || fail "labeled_frames failed"
  awk -F, -v start="labels,$1,$2" '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
    $2 == "mean" || /^"/ { next } # of groups
    NR > 1 {
      for (name in column) {
        x = $column[name]
        if (x != "" && x == x + 0) { sum[name] += x; ++count[name] }
      }
    }
    function mean(name) { return sum[name] / count[name] }
    END {
      printf "%s,,,,,%.4f,%.4f,%.4f,%.1f\n", start, mean("segmentation_f"), mean("mean_kept"), mean("angle_error_deg"),
             mean("parallel_false_relaxed")
    }' "$result/labels.csv"
}

measure()
{
  echo "cloud,parameter,value,shapes,coverage_percent,mean_distance_in_epsilons,degrees_of_freedom,\
f_of_faces,kept_of_layers,angle_error_deg,false_parallels"
  for value in 0 0.02 0.04 0.06 0.1 0.15 0.2 0.3 0.5 1; do
    measure_cloud building simplicity "$value"
    measure_cloud kinect simplicity "$value"
    measure_labels simplicity "$value"
  done
  for value in 0 0.01 0.03 0.1 0.2 0.3 1 3 10; do
    measure_cloud building regularity "$value"
    measure_cloud kinect regularity "$value"
    measure_labels regularity "$value"
  done
}

mkdir -p "$result"
if [ "${1:-}" != --draw ]; then
  [ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" g++ make cmake libcgal-dev \
    libeigen3-dev libtbb-dev libboost-program-options-dev nlohmann-json3-dev gnuplot-nox xz-utils
  build_programs
  fetch_clouds
  measure > "$result/knobs.csv"
  mv "$result/knobs.csv" "$table"
fi
for knob in simplicity regularity; do
  gnuplot -c "$doc/figures/knobs.gnuplot" "$table" "$knob" "$doc/fig/${knob}_curves.png" || fail "gnuplot failed"
done
echo "Table and pictures: $table, $doc/fig"
