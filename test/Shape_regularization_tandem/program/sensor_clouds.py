# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# sensor_clouds.py KIND SEED: a text table of points as sensors and conversions make them; the truth is with each kind.

import math
import random
import struct
import sys


def room(count, corner, size=1.0):
    """Floor and two walls, pairwise orthogonal, of noise 4 mm: 3 planes."""
    for i in range(count):
        p = [4 * random.random(), 3 * random.random(), 2.5 * random.random()]
        p[2 - i % 3] = (0, 3, 4)[i % 3] + random.gauss(0, .004)
        yield tuple(c + size * x for c, x in zip(corner, p))


def corridor():
    """What a depth camera at (1, 2, 3) sees of a corridor; noise .0028 r^2 along the ray: 4 walls and an end, 5 planes."""
    walls = (((0, 1, 0), 1.2), ((-1, 0, 0), 1.2), ((1, 0, 0), 1.2), ((0, -1, 0), 1.3), ((0, 0, 1), 5.0))
    width, height = 160, 120
    for j in range(height):
        for i in range(width):
            d = ((i - width / 2) / (.9 * width), (j - height / 2) / (.9 * width), 1.0)
            norm = math.sqrt(sum(x * x for x in d))
            cosines = [sum(a * b for a, b in zip(d, n)) / norm for n, _ in walls]
            r = min(offset / c for c, (_, offset) in zip(cosines, walls) if c > 1e-6)
            r += random.gauss(0, .0028 * r * r)
            yield tuple(c + r * x / norm for c, x in zip((1, 2, 3), d))


def far():
    """A room in map coordinates and 20 invalid pixels at 0 0 0: 3 planes, the pixels in none."""
    yield from room(6000, (694386.2, 5155487.5, 380))
    for _ in range(20):
        yield (0, 0, 0)


def half():
    """A room seen by a depth camera, half of whose pixels are invalid: 3 planes, the pixels in none."""
    for p in room(3000, (-2, -1, .6)):
        yield p
        yield (0, 0, 0)


def floats():
    """A room in map coordinates that went through floats: y comes in steps of .5."""
    for p in room(6000, (694386.2, 5155487.5, 380)):
        yield tuple(struct.unpack('<f', struct.pack('<f', c))[0] for c in p)


def degrees():
    """A building in degrees of longitude and latitude, with heights in meters."""
    for x, y, z in room(3000, (0, 0, 0)):
        yield (11.57 + x / 7500, 48.14 + y / 11100, 515 + 4 * z)


def plain():
    """The room itself."""
    yield from room(6000, (694386.2, 5155487.5, 380))


if __name__ == '__main__':
    random.seed(int(sys.argv[2]))
    kinds = {f.__name__: f for f in (corridor, far, half, floats, degrees, plain)}
    for point in kinds[sys.argv[1]]():
        print('%.17g %.17g %.17g' % point)
