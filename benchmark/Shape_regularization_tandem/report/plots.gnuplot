# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws the experiments whose CSV files are in the current folder: NAME.csv becomes NAME.svg or NAME-*.svg.

set datafile separator comma
set datafile columnheaders
set datafile missing NaN
set grid linecolor rgb "#dddddd" linetype 1
set border 3
set tics nomirror
# Colors that the color-blind can tell apart (Okabe and Ito).
array colors[7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555"]
do for [i = 1:7] {
  set style line i linewidth 2 linecolor rgb colors[i] pointtype 3 + i pointsize 0.8
}

# A plot shows the rows of `data` in which the column `filter` is `wanted`; all rows, if `filter` is empty.
# Each value of the column `series` is a curve over the column `abscissa`. Rows with the same abscissa become one
# point, their mean.
lines = "smooth unique with linespoints"
filter = ""; wanted = ""; series = "contestant"; style = lines
is_there(name) = int(system("test -f ".name.".csv && echo 1 || echo 0"))
is_shown(name) = filter eq "" || stringcolumn(filter) eq wanted
is_of(name) = is_shown(name) && stringcolumn(series) eq name
add_name(name) = strstrt(names, "'".name."'") ? 0 : (names = names." '".name."'", 0)

# begin(picture, title, columns, rows), then panels, then finish. They are commands for `eval`.
begin(picture, title, m, n) = sprintf("names = ''; \
  stats data using (is_shown('') ? add_name(stringcolumn(series)) : 0) nooutput; \
  set terminal svg size %d,%d noenhanced background 'white' font 'sans-serif,13'; set output '%s.svg'; \
  set multiplot layout %d,%d title '%s' margins char 10,char 2,char 5,char 4 spacing char 11,char 5.5; \
  set key at screen 0.5,%g center vertical maxrows 1 samplen 1.5 font ',11'", \
  400 * m, 300 * n + 70, picture, n, m, title, 1 - 40.0 / (300 * n + 70))
panel(y, label, from) = sprintf("set ylabel '%s'; set yrange [%s:*]; plot for [i = 1:words(names)] data \
  using (is_of(word(names, i)) ? column(abscissa) : NaN):(column('%s')) %s linestyle i title word(names, i); \
  unset key", label, from, y, style)
log_panel(y, label) = "set logscale y; ".panel(y, label, "*")."; unset logscale y"
# Names instead of the numbers 0, 1, 2 ... of the abscissa.
add_tic(name, place) = strstrt(tics, "'".name."'") ? 0 : (tics = tics.sprintf(", '%s' %d", name, place), 0)
name_tics(column) = sprintf("tics = ''; stats data using (add_tic(stringcolumn('%s'), column(abscissa))) nooutput; \
  eval 'set xtics rotate by 25 right ('.tics[3:*].')'", column)
finish = "unset multiplot; unset output; set xtics norotate autofreq; set xrange [*:*]; unset logscale; unset xlabel"

data = "table1.csv"
if (is_there("table1")) {
  abscissa = "position"; style = "with points"
  eval name_tics("category")
  set xrange [-0.4:5.4]
  eval begin("table1", "One cloud of each category", 2, 2)
  eval log_panel("seconds", "time (s)")
  eval panel("coverage_percent", "coverage (%)", "*")
  eval panel("complexity_relaxed", "complexity", "0")
  eval panel("violating_percent", "beyond tolerances (%)", "0")
  eval finish
  style = lines
}

data = "robustness.csv"
if (is_there("robustness")) {
  abscissa = "percent"; filter = "sweep"
  do for [wanted in "noise own-normals outliers"] {
    set xlabel wanted eq "outliers" ? "outliers (% of the points)" : "noise, sigma (% of the diagonal)"
    eval begin("robustness-".wanted, "Robustness: ".wanted, 3, 2)
    eval panel("face_f1_50", "faces found, F1 at IoU .5", "0")
    eval panel("point_precision", "point precision", "*")
    eval panel("coverage_percent", "coverage (%)", "*")
    eval panel("directions_relaxed", "directions", "0")
    eval panel("complexity_relaxed", "complexity", "0")
    eval panel("violating_percent", "beyond tolerances (%)", "0")
    eval finish
  }
}

data = "regularity.csv"
if (is_there("regularity")) {
  abscissa = "beta"; filter = "cloud"
  do for [wanted in system("awk -F, 'NR > 1 { print $4 }' regularity.csv | sort -u")] {
    set xlabel "angle tolerance beta (degrees)"
    eval begin("regularity-".wanted, "Regularity: ".wanted, 3, 2)
    eval panel("coverage_percent", "coverage (%)", "*")
    eval panel("complexity_relaxed", "complexity", "0")
    eval panel("mean_distance_in_epsilons", "mean distance (epsilons)", "0")
    eval panel("orthogonal_kept_relaxed", "true orthogonal pairs kept", "0")
    eval panel("parallel_false_relaxed", "false parallel pairs", "0")
    eval panel("violating_percent", "beyond tolerances (%)", "0")
    eval finish
  }
}
filter = ""

data = "cell-size.csv"
if (is_there("cell-size")) {
  abscissa = "points_in_a_cell"; series = "cloud"
  set logscale x
  set xlabel "largest number of points in a cell"
  eval begin("cell-size", "Size of the cells: time and quality of Tandem", 2, 2)
  eval panel("seconds", "time (s)", "0")
  eval panel("stage_growth", "of which growth (s)", "0")
  eval panel("coverage_percent", "coverage (%)", "*")
  eval panel("complexity_exact", "complexity", "0")
  eval finish
}

data = "synergy.csv"
if (is_there("synergy")) {
  abscissa = "position"; series = "series"
  set xlabel "rounds between regularity steps"
  eval name_tics("period")
  eval begin("synergy", "Synergy: regularized in the loop, afterwards, or never", 3, 2)
  eval panel("face_f1_75", "faces found, F1 at IoU .75", "*")
  eval log_panel("directions_exact", "directions")
  eval panel("parallel_kept_exact", "true parallel pairs exact", "*")
  eval panel("angle_error_deg", "angle error (degrees)", "*")
  eval panel("complexity_exact", "complexity", "*")
  eval panel("coverage_percent", "coverage (%)", "*")
  eval finish
}
series = "contestant"

data = "stability.csv"
if (is_there("stability")) {
  abscissa = "epsilon_percent"
  set logscale x
  set xlabel "epsilon (% of the diagonal)"
  eval begin("stability", "Stability: balls and drums on a plate", 3, 2)
  eval panel("shapes", "shapes", "0")
  eval panel("directions_relaxed", "directions", "0")
  eval panel("coverage_percent", "coverage (%)", "*")
  eval panel("complexity_relaxed", "complexity", "0")
  eval panel("mean_distance_in_epsilons", "mean distance (epsilons)", "0")
  eval panel("violating_percent", "beyond tolerances (%)", "0")
  eval finish
}

data = "scaling.csv"
if (is_there("scaling")) {
  abscissa = "value"; filter = "sweep"
  do for [wanted in "points k threads"] {
    set logscale x
    set xlabel wanted eq "k" ? "neighbors" : wanted
    eval begin("scaling-".wanted, "Time and memory over ".wanted, 3, 1)
    eval log_panel("seconds", "time (s)")
    eval log_panel("user_seconds", "processor time (s)")
    eval log_panel("peak_mib", "peak memory (MiB)")
    eval finish
  }
}
