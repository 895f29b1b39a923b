# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""An empty or poor result of detect_planes is explained: by a sentence with the figure and the option to change, on
standard error and in the report."""

import numpy as np
from support import NO_POINTS, NORMALS, ply, table, text_of

NOISE = ("the maximum distance 0.0003 is less than a tenth of the noise of the points, 0.00[0-9]*: --maximum-distance "
         "should be two to three times")
ALONE = "no 3 connected points .*, other than on a line or in one place"


def grid(n, step):
    return [(i % n * step, i // n * step, 0) for i in range(n * n)]


PLATES = "--maximum-distance .01 --minimum-region-size 50"


def plate(degrees):
    """Two sides of a thin plate, with normals that are turned at two edges, as those blended with the narrow faces."""
    sides = np.array([(x, y, z, 0, 0, 1) for x in np.arange(40) / 10 for y in np.arange(20) / 10 for z in (0, .3)])
    angle = np.radians(degrees) * ((sides[:, 1] == 0) | (sides[:, 1] == 1.9))
    sides[:, 4], sides[:, 5] = np.sin(angle), np.cos(angle)
    return sides


def prepare(p):
    rng = np.random.default_rng(2)
    clutter = np.concatenate([grid(20, 1 / 20), 3 * rng.random((4000, 3)) + (0, 0, 1)])
    noisy = np.column_stack([rng.random((20000, 3)) * (1, 1, .02), np.tile((0, 0, 1), (20000, 1))])
    p.write({"place.xyz": "1 2 3\n" * 300, "line.xyz": "".join(f"{i} {2 * i} {3 * i}\n" for i in range(300)),
             "clutter.xyz": text_of(clutter), "noisy.xyz": text_of(noisy),
             "none.ply": ply(NO_POINTS + NORMALS), **{f"turned{degrees}.xyz": text_of(plate(degrees))
                                                      for degrees in (0, 20, 45)}})


@table("arguments, patterns", [
    ("cube.ply E", []), ("cube.ply", []),
    # Nothing is found
    ("cube.ply E --minimum-region-size 1700",
     ["no shape was found: no 1700 connected points .--minimum-region-size., other than on a line or in one place, are "
      "within 0.004"]),
    ("place.xyz --minimum-region-size 3", [ALONE]), ("line.xyz --minimum-region-size 3", [ALONE]),
    ("cube.ply E --minimum-region-size 2000",
     ["no shape was found: the number of points is 1728, but a shape has at least 2000 .--minimum-region-size"]),
    # Too little is found
    ("clutter.xyz --maximum-distance 0.001",
     ["only 9[0-9.]* % of the points are in shapes, and 8[0-9.]* % are alone: they are outliers, or --maximum-distance"]),
    # Normals that keep points out of shapes, and such that do not
    (f"turned45.xyz {PLATES}",
     ["given normals keep 10 % of the points out of shapes on whose planes they are: --estimate-normals mostly adds "
      "about as many"]),
    (f"turned45.xyz {PLATES} --estimate-normals", []), (f"turned0.xyz {PLATES}", []), (f"turned20.xyz {PLATES}", []),
    # Tolerances that do not fit the points
    ("cube.ply --maximum-distance 0.03",
     ["the maximum distance 0.03 is more than a tenth of the extent of the points, 0.1[0-9]*: a smaller "
      "--maximum-distance"]),
    ("noisy.xyz", []), ("noisy.xyz --maximum-distance 0.002", ["no shape|only"]),
    ("noisy.xyz --maximum-distance 0.0003", ["no shape", NOISE]),
    ("noisy.xyz --maximum-distance 0.0003 --estimate-normals", ["no shape", NOISE]),
    # Points without noise may have any tolerance.
    ("cube.ply --maximum-distance 0.00001", []),
    # Angles that are cosines
    ("cube.ply E --maximum-angle 0.9",
     ["the maximum angle is 0.9 degrees: if that was meant as a cosine, pass 25.8"]),
    ("cube.ply E --maximum-angle 1 --angle-tolerance 0.5", []),
    # What was read is warned of in the report, too.
    ("cube.ply none.ply E", ["none.ply: has no points"])])
def test_warnings(p, arguments, patterns):
    p.warns(arguments, *patterns)


@table("k, n", [(6, 3), (12, 3), (12, 4), (12, 12), (12, 13), (20, 13)])
def test_the_smallest_cloud_that_has_a_shape(p, k, n):
    p.write({"few.xyz": "x y z nx ny nz\n" + "".join(f"{i % 4} {(i * i + i) % 5} 0 0 0 1\n" for i in range(n))})
    p.warns(f"few.xyz --maximum-distance .01 --minimum-region-size 3 --k-neighbors {k}")
