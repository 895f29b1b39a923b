#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws the result of detect_planes --output SHAPES.ply, beside the cloud in grey, by gnuplot.
#   render.sh                                         the picture of the README, from the demo
#   render.sh SHAPES.ply PICTURE.png [OPTION...]      another one
# Options:
#   --azimuth DEGREES    where the viewer stands; 0: in the direction of x, 90: of y (default: 30)
#   --elevation DEGREES  how high above the horizon (default: 35)
#   --up AXIS            what points up: z, y or -y (default: z)
#   --top SHARE          draws the lower share of the height only; .85 opens a room (default: 1)
#   --width PIXELS, --height PIXELS    of one view (default: 600, 450)
#   --alone              only the shapes
# TANDEM_SKIP_INSTALL=1 trusts that everything is installed.

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
script=$root/doc/Shape_regularization_tandem/figures/picture.gnuplot

fail() { echo "render.sh: $*" >&2; exit 1; }

# Columns in the order of detect_planes; prints where they begin and what types they have.
layout()
{
  LC_ALL=C sed '/^end_header/q' "$1" | LC_ALL=C awk '
    { bytes += length($0) + 1 }
    /^format/ { format = $2 }
    /^element vertex/ { points = $3 }
    /^property/ { names = names " " $3; types = types ($2 == "int" ? "%int32" : "%" $2) }
    END {
      if (format != "binary_little_endian" || names !~ /^ x y z nx ny nz red green blue (shape|label)$/ || points < 1)
        exit 1
      printf "points = %d; bytes = %d; types = \"%s\"", points, bytes, types
    }'
}

case ${1:-} in
  --help | -h) sed -n '/^# Draws/,/^$/s/^# \{0,1\}//p' "$0"; exit 0 ;;
esac
[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" gnuplot-nox
if [ $# -eq 0 ]; then
  "$root/scripts/demo.sh"
  set -- "${TANDEM_BUILD_DIR:-$root/build/demo}/result/building_shapes.ply" \
    "$root/doc/Shape_regularization_tandem/fig/building.png" --width 720 --height 560
fi
[ $# -ge 2 ] || fail "needs SHAPES.ply and PICTURE.png (--help explains)"
cloud=$1
picture=$2
shift 2
options=
while [ $# -gt 0 ]; do
  case "$1 ${2:-}" in
    "--alone "*) options="$options alone = 1;"; shift; continue ;;
    "--up z" | "--up y" | "--up -y") options="$options up = \"$2\";" ;;
    *" " | *" "*[!0-9.-]*) fail "wrong option $1 ${2:-} (--help explains)" ;;
    "--azimuth "* | "--elevation "* | "--top "* | "--width "* | "--height "*) options="$options ${1#--} = $2;" ;;
    *) fail "unknown option $1 (--help explains)" ;;
  esac
  shift 2
done
[ -r "$cloud" ] || fail "$cloud cannot be read"
layout=$(layout "$cloud") || fail "$cloud is not a result of detect_planes --output"
gnuplot -c "$script" "$cloud" "$picture" "$layout" "$options" || fail "gnuplot failed"
echo "Picture: $picture"
