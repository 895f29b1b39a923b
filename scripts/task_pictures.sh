#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Runs the first block of commands of each of the three task pages of the manual, draws what it writes, and keeps what it
# prints: doc/Shape_regularization_tandem/fig/{roofs,rooms,facade}.png and tables/{roofs,rooms,facade}.out.
#   task_pictures.sh          all of that
#   task_pictures.sh --check  draws and keeps nothing, and fails where other lines are printed than were kept
#   TANDEM_BUILD_DIR  where to build (default: build/figures of this repository)
#   TANDEM_PROGRAMS   a folder below which make_scene and detect_planes are built already

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
build=${TANDEM_BUILD_DIR:-$root/build/figures}
manual=$root/doc/Shape_regularization_tandem
programs=${TANDEM_PROGRAMS:-$build/outlines}
[ $# -eq 0 ] || [ "$*" = --check ] || { echo "usage: task_pictures.sh [--check]" >&2; exit 2; }
is_check=${1:-}
failures=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

if [ -z "${TANDEM_PROGRAMS:-}" ]; then
  mkdir -p "$build"
  cmake -S "$root" -B "$programs" -DTANDEM_BUILD_BENCHMARKS=ON -DTANDEM_WITH_CUDA=OFF > "$build/tasks.log"
  cmake --build "$programs" --target make_scene detect_planes >> "$build/tasks.log"
fi
for name in make_scene detect_planes; do
  ln -s "$(find "$programs" -name "$name" -type f -perm -u+x | head -1)" "$folder/$name"
done
ln -s "$root/scripts" "$folder/scripts"
cd "$folder"

# keep NAME: what was printed, or compares it with what was kept
keep()
{
  sed '/^Installing /d; /^  seconds /d; /^  execution /d; /^  hash /d' printed > kept
  if [ -n "$is_check" ]; then
    diff "$manual/tables/$1.out" kept || failures=1
  else
    cp kept "$manual/tables/$1.out"
  fi
}

# draw PAGE NAME OPTION...: OPTION... are those of draw_surfaces.py
draw()
{
  awk '/^\\endverbatim/ { exit } is_command { print } /^\\verbatim/ { is_command = 1 }' "$manual/$1.txt" > commands
  PATH=$folder:$PATH sh -eu commands > printed
  keep "$2"
  # The first block in Python, if it needs no module.
  awk '/^\\endcode/ { exit } is_code { print } /^\\code\{.py\}/ { is_code = 1 }' "$manual/$1.txt" > code.py
  if [ -s code.py ] && ! grep -q 'import .*tandem' code.py; then
    python3 code.py > printed
    keep "$2_code"
  fi
  [ -z "$is_check" ] || return 0
  picture=$manual/fig/$2.png
  shift 2
  scripts/draw_surfaces.py "$picture" "$@"
  echo "Picture: $picture"
}

draw Roofs roofs roofs.off 250 60 city.off 250 35
draw Rooms rooms rooms.off 250 60 walls.off 250 60
draw Facade facade facade.off 220 30 model.off 220 30
exit $failures
