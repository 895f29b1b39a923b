#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws surfaces of OFF files side by side, shaded, with lines where planes meet, into a PNG. Backs are not drawn.

draw_surfaces.py OUTPUT.png SURFACE.off AZIMUTH ELEVATION [SURFACE.off AZIMUTH ELEVATION ...]
The angles, in degrees, are those of the direction to the viewer.
"""

import math
import struct
import sys
import zlib

SAMPLES = 3  # in each direction of a pixel
WIDTH, HEIGHT, MARGIN = 460, 400, 10  # of one surface, in pixels
LIGHT = (-0.40, -0.55, 0.73)  # towards it: to the left, up, to the viewer
DARKEST, LINE = 0.42, 0.25
COLOR = (226, 217, 200)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def read_off(name):
    """Corners, and the corners of each face; colors behind these are left out."""
    lines = (line.split("#")[0].split() for line in open(name, encoding="ascii"))
    rows = [words for words in lines if words][1:]
    points, faces = int(rows[0][0]), int(rows[0][1])
    corners = [[float(x) for x in words[:3]] for words in rows[1 : points + 1]]
    return corners, [[int(i) for i in words[1 : int(words[0]) + 1]] for words in rows[points + 1 : points + faces + 1]]


def axes(azimuth, elevation):
    """To the right, up, and to the viewer."""
    a, e = math.radians(azimuth), math.radians(elevation)
    right = (-math.sin(a), math.cos(a), 0)
    viewer = (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))
    up = (-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e))
    return right, up, viewer


def normal_of(corners):
    sums = [0, 0, 0]
    for p, q in zip(corners, corners[1:] + corners[:1]):
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            sums[k] += (p[i] - q[i]) * (p[j] + q[j])
    length = math.sqrt(dot(sums, sums))
    return [x / length for x in sums] if length > 0 else None


def spans(corners, columns, rows):
    """The rows of a polygon in the picture, each with its first column and the one behind its last."""
    edges = list(zip(corners, corners[1:] + corners[:1]))
    low, high = (f(p[1] for p in corners) for f in (min, max))
    for y in range(max(0, math.ceil(low)), min(rows, math.ceil(high))):
        crossings = sorted(
            p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) for p, q in edges if (p[1] <= y) != (q[1] <= y)
        )
        for left, right in zip(crossings[::2], crossings[1::2]):
            yield y, max(0, math.ceil(left)), min(columns, math.ceil(right))


def draw(corners, faces, columns, rows):
    """For each place the plane that is seen there, None for the background. The corners are in pixels."""
    seen, nearest = ([[start] * columns for _ in range(rows)] for start in (None, -math.inf))
    for face in faces:
        polygon = [corners[i] for i in face]
        normal = normal_of(polygon)
        if normal is None or normal[2] < 1e-6:
            continue
        offset = dot(normal, polygon[0])
        plane = tuple(round(x, 6) for x in normal) + (round(offset, 1),)
        for y, first, end in spans(polygon, columns, rows):
            z, step = (offset - normal[0] * first - normal[1] * y) / normal[2], -normal[0] / normal[2]
            for x in range(first, end):
                if z > nearest[y][x]:
                    nearest[y][x], seen[y][x] = z, plane
                z += step
    return seen


def brightness(seen, y, x):
    """None for the background."""
    plane = seen[y][x]
    if any(seen[max(y - i, 0)][max(x - j, 0)] != plane for i, j in ((0, 1), (1, 0), (1, 1))):
        return LINE
    return None if plane is None else DARKEST + (1 - DARKEST) * max(0, dot(plane[:3], LIGHT))


def pixels(seen, columns, rows):
    """Rows of colors, each the mean of its samples."""
    for y in range(0, rows, SAMPLES):
        row = []
        for x in range(0, columns, SAMPLES):
            samples = [brightness(seen, y + i, x + j) for i in range(SAMPLES) for j in range(SAMPLES)]
            row.append([sum(255 if b is None else b * c for b in samples) / len(samples) for c in COLOR])
        yield row


def picture(name, azimuth, elevation):
    points, faces = read_off(name)
    middle = [(min(x) + max(x)) / 2 for x in zip(*points)]
    points = [[dot(axis, [x - m for x, m in zip(p, middle)]) for axis in axes(azimuth, elevation)] for p in points]
    columns, rows = WIDTH * SAMPLES, HEIGHT * SAMPLES
    low, high = ([f(x) for x in zip(*points)] for f in (min, max))
    scale = min((n - 2 * MARGIN * SAMPLES) / (high[k] - low[k]) for k, n in ((0, columns), (1, rows)))
    center = [(low[k] + high[k]) / 2 for k in range(2)]
    corners = [
        [columns / 2 + scale * (x - center[0]), rows / 2 - scale * (y - center[1]), scale * z] for x, y, z in points
    ]
    # Rows go down, which turns all faces around.
    seen = draw(corners, [face[::-1] for face in faces], columns, rows)
    return list(pixels(seen, columns, rows))


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(name, rows):
    data = b"".join(b"\0" + bytes(round(c) for color in row for c in color) for row in rows)
    with open(name, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b""))


def main(output, *surfaces):
    parts = [
        picture(name, float(azimuth), float(elevation))
        for name, azimuth, elevation in zip(surfaces[::3], surfaces[1::3], surfaces[2::3])
    ]
    write_png(output, [sum(rows, []) for rows in zip(*parts)])


if __name__ == "__main__":
    if len(sys.argv) < 5 or len(sys.argv) % 3 != 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
