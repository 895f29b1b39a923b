# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of tiles share: a hall of floor, walls and roof in several files and formats, and the comparison of
outputs."""

import numpy as np
from support import NOTHING

OPTIONS = "--maximum-distance 0.01 --minimum-region-size 100"
TILES = ["corner.pts", "folder/Middle.XYZ", "folder/sub/seam.csv", "last.las"]
OUTPUTS = ["corner.ply", "Middle.XYZ", "seam.csv", "last.las"]
MEMBERS = r'"(input|hash|maximum_distance|points|assigned|shapes|planes|mean_distance|.*groups|.*pairs)":'


def hall():
    """By tiles, which seams at x = 1, 4 and 5 cut"""
    i, j = (a.ravel() for a in np.mgrid[:80, :30])
    x, zero = i / 10 + .02, np.zeros(len(i))
    points = np.stack([np.stack(face, axis=1) for face in (
        (x, j / 10, (i * j) % 7 / 2000), (x, (i * j) % 5 / 2000, j / 10), (x, 3 + zero, j / 10 + .05),
        (x, j / 10 + .03, 4 + j / 20))], axis=1).reshape(-1, 3)
    tile = np.digitize(points[:, 0], (1, 4, 5))
    return [points[tile == k] for k in range(4)]


def write_tiles(p):
    corner, middle, seam, last = ("".join("{:.6g} {:.6g} {:.6g}\n".format(*row) for row in tile) for tile in hall())
    p.write({"corner.pts": corner, "folder/Middle.XYZ": middle, "last.xyz": last,
             "folder/sub/seam.csv": "x,y,z\n" + seam.replace(" ", ",")})
    p(0, NOTHING, f"last.xyz {OPTIONS} --output last.las --quiet")


def check_same_results(p, first, second, outputs=OUTPUTS):
    """The files of --output-directory and --planes are the same, byte for byte, and what reports tell of the result."""
    for file in [*outputs, "planes"]:
        assert p.is_same(f"{first}/{file}", f"{second}/{file}"), file
    assert p.lines(f"{first}/report", MEMBERS) == p.lines(f"{second}/report", MEMBERS)
