#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes the page of a benchmark: plots and pictures by gnuplot, where it is installed, and tables from comparison.csv.
#   page.sh FOLDER [PROGRAM]    reads the --output of tandem_benchmark and writes FOLDER/index.html
# PROGRAM is detect_planes: the clouds of FOLDER/views become its pages, FOLDER/views/CLOUD.html.

set -eu

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)

fail() { echo "page.sh: $*" >&2; exit 1; }

draw_pictures()
{
  for cloud in pictures/*.ply; do
    [ -f "$cloud" ] || return 0
    name=${cloud#pictures/}
    view=$(awk -F, -v name="${name%%.*}" '$1 == name { print $NF }' "$here/../clouds.csv")
    # shellcheck disable=SC2086
    TANDEM_SKIP_INSTALL=1 "$root/scripts/render.sh" "$cloud" "${cloud%.ply}.png" \
      --alone --width 480 --height 360 $view || return 1
  done
}

# Without three.js the program ends with 2 and says so.
make_views()
{
  for options in views/*.options; do
    [ -f "$options" ] || return 0
    name=${options%.options}
    status=0
    # shellcheck disable=SC2046
    "$program" "$name.ply" --quiet --view "$name.html" $(cat "$options") || status=$?
    [ $status -ne 2 ] || return 0
    [ $status -eq 0 ] || return 1
  done
}

[ $# -eq 1 ] || [ $# -eq 2 ] || fail "needs the folder of the results, and maybe the program detect_planes"
program=
[ -z "${2:-}" ] || program=$(cd "$(dirname "$2")" && pwd)/$(basename "$2")
cd "$1" || exit 1
ls ./*.csv > /dev/null 2>&1 || fail "there are no results in $1"
failed=
if command -v gnuplot > /dev/null; then
  gnuplot "$here/plots.gnuplot" || failed=plots
  draw_pictures > /dev/null || failed="$failed pictures"
else
  echo "There are no plots and pictures: gnuplot is not installed (Debian: gnuplot-nox)"
fi
if [ -n "$program" ]; then
  make_views || failed="$failed views"
  rm -f views/*.ply views/*.options
fi
comparison=/dev/null
[ ! -f comparison.csv ] || comparison=comparison.csv
files=$(ls ./*.csv ./*.svg pictures/*.png views/*.html 2> /dev/null || true)
awk -v files="$files" -f "$here/page.awk" "$comparison" > index.html
echo "wrote $1/index.html"
[ -z "$failed" ] || fail "could not make all $failed"
