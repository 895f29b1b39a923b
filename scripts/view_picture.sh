#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# A picture of a page that detect_planes --view has written, by a Chromium without a window.
#   view_picture.sh                           the picture of the manual, from the demo
#   view_picture.sh PAGE.html PICTURE.png [ADDRESS [WIDTHxHEIGHT]]    another one
# ADDRESS is what address.js reads after '#', for example 'color=direction&theme=dark'.
# Exit code 77: there is no Chromium.

set -eu

fail() { echo "view_picture.sh: $*" >&2; exit 1; }

root=$(cd "$(dirname "$0")/.." && pwd)
if [ $# -eq 0 ]; then
  "$root/scripts/demo.sh"
  set -- "${TANDEM_BUILD_DIR:-$root/build/demo}/result/building.html" \
    "$root/doc/Shape_regularization_tandem/fig/view.png" "color=plane&direction=5&theme=light&layers=outlines,surface" 760x480
fi
[ $# -ge 2 ] && [ $# -le 4 ] || fail "needs PAGE.html and PICTURE.png"
[ -r "$1" ] || fail "$1 cannot be read"
browser=
for name in chromium chromium-browser google-chrome; do
  [ -n "$browser" ] || browser=$(command -v "$name" || true)
done
[ -n "$browser" ] || { echo "view_picture.sh: no chromium is installed" >&2; exit 77; }

page=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
size=$(echo "${4:-1280x800}" | tr x ,)
profile=$(mktemp -d)
trap 'rm -rf "$profile"' EXIT
sandbox=
[ "$(id -u)" -ne 0 ] || sandbox=--no-sandbox # it refuses to run as root with one
rm -f "$2"
"$browser" --headless=new $sandbox --user-data-dir="$profile" --no-first-run --disable-extensions \
  --use-angle=swiftshader --enable-unsafe-swiftshader --hide-scrollbars --window-size="$size" \
  --virtual-time-budget=20000 --screenshot="$2" "file://$page#${3:-}" > "$profile/log" 2>&1 ||
  { cat "$profile/log" >&2; fail "chromium failed"; }
[ -s "$2" ] || { cat "$profile/log" >&2; fail "chromium wrote no picture"; }
echo "Picture: $2"
