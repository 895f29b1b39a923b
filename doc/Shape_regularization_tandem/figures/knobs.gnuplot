# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Curves of one parameter, of the table that draw.py writes.
#   gnuplot -c knobs.gnuplot TABLE.csv PARAMETER PICTURE.png

data = ARG1; parameter = ARG2
set datafile separator comma
set datafile columnheaders
set datafile missing NaN
set terminal pngcairo size 1080,640 noenhanced font 'sans-serif,11' background 'white'
set output ARG3
set grid linecolor rgb "#dddddd" linetype 1
set border 3
set tics nomirror
set style line 1 linewidth 2 linecolor rgb "#0072b2" pointtype 7 pointsize 0.8
set style line 2 linewidth 2 linecolor rgb "#d55e00" pointtype 5 pointsize 0.8
set style line 3 linewidth 2 linecolor rgb "#009e73" pointtype 9 pointsize 0.9
set style line 4 linewidth 2 linecolor rgb "#cc79a7" pointtype 11 pointsize 0.9

# The values are names at equal distances, since 0 is one of them and they span decades.
values = system(sprintf("awk -F, '$1 == \"labels\" && $2 == \"%s\" { print $3 }' '%s'", parameter, data))
default = parameter eq "simplicity" ? "0.08" : "0.1"
place(value) = (n = 0, sum [i = 1:words(values)] (word(values, i) eq value ? i : 0))
tics = ""
do for [i = 1:words(values)] {
  tics = tics.sprintf("%s'%s' %d", i > 1 ? ", " : "", word(values, i), i)
}
eval "set xtics (".tics.") font ',9'"
set xrange [0.7:words(values) + 0.3]
set arrow from place(default), graph 0 to place(default), graph 1 nohead dashtype 2 linecolor rgb "#888888"
set xlabel parameter offset 0, 0.5
is_of(cloud) = stringcolumn("parameter") eq parameter && stringcolumn("cloud") eq cloud
curve(cloud, y, style, name) = sprintf("data using (is_of('%s') ? place(stringcolumn('value')) : NaN):(column('%s')) \
  smooth unique with linespoints linestyle %d title '%s'", cloud, y, style, name)
panel(y, label) = sprintf("set title '%s'; plot %s, %s", label, curve("building", y, 1, "building"), \
  curve("kinect", y, 2, "room"))
truth(y, label) = sprintf("set title '%s'; plot %s", label, curve("labels", y, 3, ""))

set multiplot layout 2,3 margins char 7,char 2,char 4,char 3 spacing char 9,char 6
set yrange [0:*]
set key bottom left samplen 1.5
eval panel("shapes", "shapes")
unset key
eval panel("degrees_of_freedom", "degrees of freedom")
set yrange [*:*]
eval panel("coverage_percent", "coverage (%)")
eval panel("mean_distance_in_epsilons", "mean distance / maximum_distance")
eval truth("f_of_faces", "labeled clouds: F of faces")
if (parameter eq "simplicity") {
  eval truth("kept_of_layers", "labeled layers: share of points kept")
} else {
  eval truth("angle_error_deg", "labeled clouds: error of normals (degrees)")
}
unset multiplot
