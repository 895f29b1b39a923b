# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws the points of a PLY file in the colors of their shapes; called by draw.py.
# The projection is parallel, near points hide far ones, and the normals shade them. Arguments: the file, the picture,
# the layout of the file (number of points, bytes of the header, types of the columns, the first column of point and normal,
# those of the color and of the shape), and options as
# assignments: where the viewer stands (azimuth 0: in the direction of x, 90: of y), how high (elevation), pixels of one
# view (width, height), whether only the shapes are drawn (alone), not the cloud in grey beside them, whether only the
# sides of shapes are drawn that a sensor at the origin sees (inside), to look into rooms, and the size of points (0: by
# their number).

azimuth = 30; elevation = 35; width = 600; height = 450; alone = 0; inside = 0; size = 0
eval ARG3
eval ARG4

# Of the vector in the columns c, c + 1 and c + 2.
set angles degrees
away(c) = cos(azimuth) * column(c) + sin(azimuth) * column(c + 1)
picture_x(c) = cos(azimuth) * column(c + 1) - sin(azimuth) * column(c)
picture_y(c) = cos(elevation) * column(c + 2) - sin(elevation) * away(c)
nearness(c) = cos(elevation) * away(c) + sin(elevation) * column(c + 2)

# Light comes from the upper left, in steps: few colors make small files.
behind(c) = column(c) * column(point) + column(c + 1) * column(point + 1) + column(c + 2) * column(point + 2) > 0
is_drawn(c) = !inside || column(shape) < 0 || behind(c) != (nearness(c) > 0)
cosine(c) = abs(0.68 * nearness(c) + 0.60 * picture_y(c) - 0.42 * picture_x(c))
light(c) = 0.6 + 0.05 * floor(8 * cosine(c) + 0.5)
rgb(r, g, b) = 65536 * int(r) + 256 * int(g) + int(b)
shaded(l, r, g, b) = rgb(l * r, l * g, l * b)
grey(l) = shaded(l, 225, 228, 232)
color(l) = column(shape) < 0 ? rgb(205, 205, 205) : shaded(l, column(red), column(green), column(blue))

file = ARG1
layout = sprintf("binary record=%d skip=%d format='%s' endian=little", points, bytes, types)

# A few points far off do not make the picture small.
stats file @layout using (picture_x(point)):(picture_y(point)) nooutput
lower(least, mean, deviation) = least < mean - 4 * deviation ? mean - 4 * deviation : least
set xrange [lower(STATS_min_x, STATS_mean_x, STATS_stddev_x):-lower(-STATS_max_x, -STATS_mean_x, STATS_stddev_x)]
set yrange [lower(STATS_min_y, STATS_mean_y, STATS_stddev_y):-lower(-STATS_max_y, -STATS_mean_y, STATS_stddev_y)]
even = 0.17 * sqrt(1.0 * width * height / points)
size = size > 0 ? size : even < 0.22 ? 0.22 : even > 0.6 ? 0.6 : even

set terminal png size (alone ? 1 : 2) * width, height
set output ARG2
unset key; unset border; unset tics
set size ratio -1
set margins 1, 1, 1, 1
place = "(is_drawn(normal) ? picture_x(point) : NaN):(picture_y(point)):(nearness(point))"
style = "smooth zsort with points pointtype 5 pointsize variable linecolor rgb variable"
if (!alone) {
  set multiplot layout 1,2
  plot file @layout using @place:(size):(grey(light(normal))) @style
}
plot file @layout using @place:(column(shape) < 0 ? size / 3 : size):(color(light(normal))) @style
