#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Prints a generated scan of three rooms with tables and a shelf, as a text table of points and normals, in meters.
# The noise is 3.7 millimeters.

import random

NOISE, POINTS_PER_SQUARE_METER = .0037, 750
# Boxes, from x, y, z to x, y, z.
ROOMS = [(0, 0, 0, 10.7, 3.5, 2.6), (0, 3.7, 0, 4.5, 8.7, 2.6), (4.7, 3.7, 0, 10.7, 8.7, 2.6)]
FURNITURE = [(1, 5, .1, 2.8, 6, .75), (3.9, 4, .1, 4.4, 6, 1.9), (7, 6, .1, 9, 7.2, .7), (6, 1, .1, 7.5, 1.8, .7)]


def turned(x, y, z):
    """Walls are not along x and y."""
    return (12 * x - 5 * y) / 13, (5 * x + 12 * y) / 13, z


random.seed(1)
print("x y z nx ny nz")
for box in ROOMS + FURNITURE:
    rows = []
    for axis in range(3):
        length, width = (box[i + 3] - box[i] for i in range(3) if i != axis)
        for k in range(int(2 * POINTS_PER_SQUARE_METER * length * width)):
            is_upper = k % 2  # of the two faces
            point, normal = [random.uniform(box[i], box[i + 3]) for i in range(3)], [0, 0, 0]
            point[axis] = box[axis + 3 * is_upper] + random.gauss(0, NOISE)
            normal[axis] = 1 if is_upper == (box in FURNITURE) else -1
            rows.append(" ".join(str(round(x, 4)) for x in turned(*point) + turned(*normal)))
    print("\n".join(rows))
