#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The page of made-up results, with a view in 3D or without, and, where gnuplot is installed, the picture of a cloud of
# eight points.
#   test_report.sh FOLDER    works in FOLDER, which it empties

set -eu

root=$(cd "$(dirname "$0")/../../.." && pwd)
work=$1
TANDEM_SKIP_INSTALL=1
export TANDEM_SKIP_INSTALL

fail() { echo "test_report.sh: $*" >&2; exit 1; }
page_has() { grep -qF "$1" "$work/index.html" || fail "the page has not: $1"; }
page_has_not() { ! grep -qF "$1" "$work/index.html" || fail "the page has: $1"; }

make_results()
{
  mkdir -p "$work/pictures"
  cat > "$work/comparison.csv" << EOD
cloud,points,normals,description,seconds,>eps,recall,date,commit,processor,error
hut,8,given,Tandem,2.00,0,-,2026,abc,"A & B, C",
hut,8,given,"peer, quick",1.00*,7,-,2026,abc,"A & B, C",
hut,8,own,Tandem,2.00,0,-,2026,abc,"A & B, C",
barn,9,given,Tandem,4.00,0,.5,2026,abc,"A & B, C",
barn,9,given,"peer, quick",5.00,7,.6*,2026,abc,"A & B, C",
barn,9,given,slow,-,-,-,2026,abc,"A & B, C",took <long>
EOD
  cat > "$work/scaling.csv" << EOD
sweep,value,contestant,seconds,user_seconds,peak_mib
points,100,tandem,1,1,10
points,1000,tandem,10,10,20
points,100,peer,2,2,10
k,6,tandem,3,3,5
threads,1,tandem,4,,5
threads,1,tandem,4,4,5
EOD
}

# make_views STATUS: a program in place of detect_planes, whose pages are its arguments, and files for it.
make_views()
{
  mkdir -p "$work/views"
  cat > "$work/viewer" << EOD
#!/bin/sh
[ $1 -ne 0 ] || echo "\$*" > "\$4"
exit $1
EOD
  chmod +x "$work/viewer"
  touch "$work/views/hut.ply"
  echo '--maximum-distance 0.04 --k-neighbors 12' > "$work/views/hut.options"
}

check_views()
{
  page_has_not '<iframe loading'
  make_views 0
  "$page" "$work" "$work/viewer" > /dev/null
  page_has '<a href="views/hut.html">'
  page_has '<iframe loading=lazy src="views/hut.html" title="hut"></iframe>'
  page_has_not 'views/barn.html'
  grep -qx 'views/hut.ply --quiet --view views/hut.html --maximum-distance 0.04 --k-neighbors 12' \
    "$work/views/hut.html" || fail "the view is of something else"
  [ ! -e "$work/views/hut.ply" ] || fail "the cloud is left over"
  cp "$work/views/hut.html" "$work/views/barn.html"
  "$page" "$work" > /dev/null
  page_has '<a href="views/barn.html">'
  page_has_not 'src="views/barn.html"'
  rm -r "$work/views"
  make_views 2 # as without three.js
  "$page" "$work" "$work/viewer" > /dev/null
  page_has_not '<iframe loading'
  page_has_not 'views/'
  make_views 1
  ! "$page" "$work" "$work/viewer" > /dev/null 2>&1 || fail "a view that failed is no failure"
}

# point PLACE COLOR_AND_SHAPE, in octal escapes; the normal is 0 0 1.
point()
{
  # shellcheck disable=SC2059
  printf "$1\000\000\000\000\000\000\000\000\000\000\200\077$2"
}

# A unit square at the height 0 (blue, shape 1), and one above it at the height 1 (red, shape 0).
make_cloud()
{
  zero='\000\000\000\000'
  one='\000\000\200\077'
  printf 'ply\nformat binary_little_endian 1.0\nelement vertex 8\n'
  for name in x y z nx ny nz; do echo "property float $name"; done
  for name in red green blue; do echo "property uchar $name"; done
  printf 'property int shape\nend_header\n'
  for x in $zero $one; do
    for y in $zero $one; do
      point "$x$y$one" '\377\000\000\000\000\000\000'
      point "$x$y$zero" '\000\000\377\001\000\000\000'
    done
  done
}

# pixels PICTURE CONDITION: how many there are of the kind, by red $1, green $2 and blue $3.
pixels()
{
  gnuplot 2>&1 << EOD
set terminal png
set output '/dev/null'
n = 0
plot '$1' binary filetype=png using (n = n + ($2), \$1):2:3 with rgbimage
print n
EOD
}

check_picture()
{
  make_cloud > "$work/pictures/hut.tandem.ply"
  "$root/scripts/render.sh" "$work/pictures/hut.tandem.ply" "$work/up.png" --alone --elevation 90 > /dev/null
  "$root/scripts/render.sh" "$work/pictures/hut.tandem.ply" "$work/down.png" --alone --elevation -90 > /dev/null
  "$root/scripts/render.sh" "$work/pictures/hut.tandem.ply" "$work/low.png" --alone --elevation 90 --top .5 > /dev/null
  # shellcheck disable=SC2016
  red='$1 > 120 && $3 < 60'
  # shellcheck disable=SC2016
  blue='$1 < 60 && $3 > 120'
  [ "$(pixels "$work/up.png" "$red")" -gt 50 ] || fail "the upper square is not seen from above"
  [ "$(pixels "$work/up.png" "$blue")" -eq 0 ] || fail "the lower square shines through"
  [ "$(pixels "$work/down.png" "$blue")" -gt 50 ] || fail "the lower square is not seen from below"
  [ "$(pixels "$work/low.png" "$blue")" -gt 50 ] || fail "--top does not open the cloud"
  ! "$root/scripts/render.sh" "$work/comparison.csv" "$work/no.png" 2> /dev/null || fail "a CSV file is drawn"
  ! "$root/scripts/render.sh" "$work/pictures/hut.tandem.ply" "$work/no.png" --up x 2> /dev/null || fail "--up x"
}

rm -rf "$work"
make_results
! command -v gnuplot > /dev/null || check_picture
page=$root/benchmark/Shape_regularization_tandem/report/page.sh
"$page" "$work" > /dev/null
page_has '<th>&gt;eps</th>'
page_has '<th>peer, quick</th><td class=ahead>1.00*</td><td>7</td>'
page_has '<th>hut</th><td>2.00</td><td class=ahead>1.00*</td><td>-</td>'
page_has '<th>seconds</th><td class=ahead>1 of 2</td><td>-</td>'
page_has '<th>recall</th><td class=ahead>1 of 1</td><td>-</td>'
page_has_not '0 of 2'
page_has 'A &amp; B, C'
page_has 'did not finish: took &lt;long&gt;'
page_has 'Each with its own normals'
page_has_not 'robustness'
if command -v gnuplot > /dev/null; then
  page_has 'src="pictures/hut.tandem.png"'
  page_has 'src="scaling-points.svg"'
  [ -s "$work/pictures/hut.tandem.png" ] || fail "there is no picture"
  grep -q '>peer<' "$work/scaling-points.svg" || fail "a curve is missing"
  ! grep -q '>peer<' "$work/scaling-k.svg" || fail "a curve is of another sweep"
  grep -q 'peak memory (MiB)' "$work/scaling-threads.svg" || fail "a panel is missing"
fi
check_views
