# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Turns comparison.csv into a page of HTML. `files` has the names of the CSV files, plots, pictures and views beside it,
# one a line. A star behind a value means that the method is better than Tandem.

# Into cell[1], cell[2], ...; the number of them.
function split_csv(line,    n, i, c, is_quoted) {
  split("", cell)
  n = 1
  for (i = 1; i <= length(line); ++i) {
    c = substr(line, i, 1)
    if (c == "\"") is_quoted = !is_quoted
    else if (c == "," && !is_quoted) ++n
    else cell[n] = cell[n] c
  }
  return n
}

function escaped(text) {
  gsub(/&/, "\\&amp;", text)
  gsub(/</, "\\&lt;", text)
  gsub(/>/, "\\&gt;", text)
  return text
}

# tag("td class=x", "y") is <td class=x>y</td>.
function tag(opening, content,    name) {
  name = opening
  sub(/ .*/, "", name)
  return "<" opening ">" content "</" name ">"
}

function header(name) { return tag("th", escaped(name)) }

function is_tandem(method) { return method ~ /^Tandem/ }

function is_starred(value) { return value ~ /\*$/ }

function data(value) { return tag(is_starred(value) ? "td class=ahead" : "td", escaped(value == "" ? "-" : value)) }

function begin_table(caption) { print "<div><table><caption>" caption "</caption>" }

function end_table() { print "</table></div>" }

function remember(list, name) {
  if (!((list, name) in place)) {
    place[list, name] = ++size[list]
    item[list, size[list]] = name
  }
}

NR == 1 {
  columns = split_csv($0)
  for (i = 1; i <= columns; ++i) {
    column[i] = cell[i]
    if (cell[i] == "description") first = i + 1
    if (cell[i] == "date") last = i - 1
  }
  next
}

{
  ++rows
  columns = split_csv($0)
  for (i = 1; i <= columns; ++i) value[rows, column[i]] = cell[i]
  remember("clouds", value[rows, "cloud"])
  remember("normals", value[rows, "normals"])
  is_measured[value[rows, "cloud"], value[rows, "normals"]] = 1
  if (value[rows, "normals"] == "given") {
    method = value[rows, "description"]
    remember("methods", method)
    row_of[value[rows, "cloud"], method] = rows
  }
}

# The criterion of all methods on all clouds.
function print_overview(criterion,    c, m, line) {
  begin_table(criterion ", with the same normals")
  line = header("")
  for (m = 1; m <= size["methods"]; ++m) line = line header(item["methods", m])
  print tag("tr", line)
  for (c = 1; c <= size["clouds"]; ++c) {
    line = header(item["clouds", c])
    for (m = 1; m <= size["methods"]; ++m)
      line = line data(value[row_of[item["clouds", c], item["methods", m]], criterion])
    print tag("tr", line)
  }
  end_table()
}

# On how many clouds a method is better than Tandem, of those where it is known; only criteria where one is better.
function print_counts(    i, m, c, row, known, ahead, line, is_any_ahead) {
  begin_table("Clouds on which a method is better than Tandem, with the same normals")
  line = header("")
  for (m = 1; m <= size["methods"]; ++m)
    if (!is_tandem(item["methods", m])) line = line header(item["methods", m])
  print tag("tr", line)
  for (i = first; i <= last; ++i) {
    line = header(column[i])
    is_any_ahead = 0
    for (m = 1; m <= size["methods"]; ++m) {
      if (is_tandem(item["methods", m])) continue
      known = ahead = 0
      for (c = 1; c <= size["clouds"]; ++c) {
        row = row_of[item["clouds", c], item["methods", m]]
        known += value[row, column[i]] ~ /[0-9]/
        ahead += is_starred(value[row, column[i]])
      }
      is_any_ahead += ahead
      line = line tag(ahead ? "td class=ahead" : "td", known ? ahead " of " known : "-")
    }
    if (is_any_ahead) print tag("tr", line)
  }
  end_table()
}

# All methods on one cloud; criteria that are not known there are left out.
function print_cloud(cloud, normals,    i, r, line, is_known) {
  if (!((cloud, normals) in is_measured)) return
  begin_table(normals == "own" ? "Each with its own normals" : "With the same normals")
  line = header("")
  for (r = 1; r <= rows; ++r)
    if (value[r, "cloud"] == cloud && value[r, "normals"] == normals)
      for (i = first; i <= last; ++i) if (value[r, column[i]] ~ /[0-9]/) is_known[i] = 1
  for (i = first; i <= last; ++i) if (is_known[i]) line = line header(column[i])
  print tag("tr", line)
  for (r = 1; r <= rows; ++r) {
    if (value[r, "cloud"] != cloud || value[r, "normals"] != normals) continue
    line = ""
    for (i = first; i <= last; ++i) if (is_known[i]) line = line data(value[r, column[i]])
    if (value[r, "error"] != "") line = tag("td colspan=9", "did not finish: " escaped(value[r, "error"]))
    print tag("tr", header(value[r, "description"]) line)
  }
  end_table()
}

# The cloud as it came, and its true shapes, before the results.
function print_pictures(cloud,    pass, i, name) {
  print "<div class=pictures>"
  for (pass = 1; pass <= 2; ++pass)
    for (i = 1; i <= number_of_files; ++i) {
      if (index(file[i], "pictures/" cloud ".") != 1) continue
      name = substr(file[i], length("pictures/" cloud ".") + 1)
      sub(/\.png$/, "", name)
      if ((name ~ /^(input|truth)$/) == (pass == 1))
        print tag("figure", "<img src=\"" file[i] "\" alt=\"" name "\">" tag("figcaption", name))
    }
  print "</div>"
}

# The page of detect_planes, where there is one; the first one is seen here, too.
function print_view(cloud,    i, name) {
  name = "views/" cloud ".html"
  for (i = 1; i <= number_of_files; ++i) {
    if (file[i] != name) continue
    print tag("p", tag("a href=\"" name "\"", "in 3D, as detect_planes shows it"))
    if (++views == 1) print tag("iframe loading=lazy src=\"" name "\" title=\"" cloud "\"", "")
  }
}

END {
  gsub(/\.\//, "", files)
  number_of_files = split(files, file, "\n")
  print "<!doctype html><html lang=en><meta charset=utf-8><title>Tandem beside other detectors</title><style>"
  print "body { font: 15px/1.4 sans-serif; margin: 2em; } div { overflow-x: auto; } figure { margin: 0; }"
  print "table { border-collapse: collapse; margin: 1em 0; } caption { text-align: left; font-weight: bold; }"
  print "th, td { border-bottom: 1px solid #ddd; padding: .2em .5em; text-align: right; }"
  print "tr > th:first-child { text-align: left; } .ahead { background: #fdf0d5; } img { max-width: 100%; }"
  print ".pictures { display: flex; flex-wrap: wrap; }"
  print "iframe { width: 100%; height: 36em; border: 1px solid #ddd; }</style>"
  print "<h1>Tandem beside other detectors</h1>"
  if (rows) {
    print tag("p", escaped("Tandem " value[1, "commit"] ", CGAL " value[1, "cgal"] ", " value[1, "compiler"] "; " \
      value[1, "processor"] ", " value[1, "processors"] " processors; " value[1, "date"]))
    print "<p>Values that are better than those of Tandem have a star and a color. cpx: complexity, smaller is more"
    print "regular. mean/e, max/e: distance of the points to their planes, in epsilons. &gt;eps, &gt;alpha: points"
    print "that violate the tolerances; they are black in the pictures. Cleaned: without these points. F1: of the"
    print "true faces; prec.: of the points. again%, shuf.%: points in another shape when the method runs again"
    print "(RANSAC: with another seed), and when the points come in another order.</p>"
    print_overview("seconds")
    print_counts()
  }
  for (c = 1; c <= size["clouds"]; ++c) {
    print tag("h2", escaped(item["clouds", c]))
    print_pictures(item["clouds", c])
    print_view(item["clouds", c])
    for (n = 1; n <= size["normals"]; ++n) print_cloud(item["clouds", c], item["normals", n])
  }
  print "<h2>Experiments</h2>"
  for (i = 1; i <= number_of_files; ++i)
    if (file[i] ~ /\.svg$/) print "<p><img src=\"" file[i] "\" alt=\"" file[i] "\"></p>"
  print "<h2>All numbers</h2>\n<ul>"
  for (i = 1; i <= number_of_files; ++i)
    if (file[i] ~ /\.csv$/) print tag("li", tag("a href=\"" file[i] "\"", file[i]))
  print "</ul></html>"
}
