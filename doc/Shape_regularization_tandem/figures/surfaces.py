# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws surfaces of OFF files side by side, shaded, with lines where planes meet, into a PNG. Backs are not drawn."""

import math
import struct
import zlib

import numpy as np

SAMPLES = 3  # in each direction of a pixel
WIDTH, HEIGHT, MARGIN = 460, 400, 10  # of one surface, in pixels
LIGHT = (-0.40, -0.55, 0.73)  # towards it: to the left, up, to the viewer
DARKEST, LINE = 0.42, 0.25
COLOR = (226, 217, 200)


def read_off(name):
    """Corners, and the corners of each face; colors behind these are left out."""
    lines = (line.split("#")[0].split() for line in open(name, encoding="ascii"))
    rows = [words for words in lines if words][1:]
    points, faces = int(rows[0][0]), int(rows[0][1])
    corners = np.array([[float(x) for x in words[:3]] for words in rows[1 : points + 1]])
    return corners, [[int(i) for i in words[1 : int(words[0]) + 1]] for words in rows[points + 1 : points + faces + 1]]


def axes(azimuth, elevation):
    """To the right, up, and to the viewer."""
    a, e = math.radians(azimuth), math.radians(elevation)
    viewer = (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))
    up = (-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e))
    return np.array([(-math.sin(a), math.cos(a), 0), up, viewer])


def covered(polygon, x, y):
    """Which places are in the polygon: those with an odd number of edges to the left."""
    inside = np.zeros((len(y), len(x)), bool)
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0)):
        rows = (p[1] <= y) != (q[1] <= y)
        crossing = p[0] + (y[rows] - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
        inside[rows] ^= crossing[:, None] <= x
    return inside


def visible_planes(corners, faces, columns, rows):
    """For each place the plane that is seen there, zeros for the background. The corners are in pixels."""
    seen, nearest = np.zeros((rows, columns, 4)), np.full((rows, columns), -np.inf)
    for face in faces:
        polygon = corners[face]
        normal = np.cross(polygon, np.roll(polygon, -1, axis=0)).sum(axis=0)
        length = np.linalg.norm(normal)
        if length == 0 or normal[2] < 1e-6 * length:
            continue
        normal /= length
        offset = normal @ polygon[0]
        (left, low), (right, high) = polygon[:, :2].min(axis=0).astype(int), polygon[:, :2].max(axis=0).astype(int) + 1
        box = slice(low, high), slice(left, right)
        x, y = np.arange(left, right), np.arange(low, high)
        z = (offset - normal[0] * x - normal[1] * y[:, None]) / normal[2]
        is_nearer = covered(polygon, x, y) & (z > nearest[box])
        nearest[box][is_nearer] = z[is_nearer]
        seen[box][is_nearer] = (*normal.round(6), round(offset, 1))
    return seen


def shaded(seen):
    """Colors of the pixels, each the mean of its samples."""
    colors = (DARKEST + (1 - DARKEST) * np.maximum(0, seen[..., :3] @ LIGHT))[..., None] * COLOR
    colors[~seen.any(axis=2)] = 255
    before = np.pad(seen, ((1, 0), (1, 0), (0, 0)), "edge")
    neighbors = before[1:, :-1], before[:-1, 1:], before[:-1, :-1]
    colors[np.any([(seen != other).any(axis=2) for other in neighbors], axis=0)] = np.multiply(LINE, COLOR)
    return colors.reshape(HEIGHT, SAMPLES, WIDTH, SAMPLES, 3).mean(axis=(1, 3))


def surface(name, azimuth, elevation):
    points, faces = read_off(name)
    points = (points - (points.min(axis=0) + points.max(axis=0)) / 2) @ axes(azimuth, elevation).T
    size = np.array([WIDTH, HEIGHT]) * SAMPLES
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    scale = ((size - 2 * MARGIN * SAMPLES) / (high - low)).min()
    flat = size / 2 + scale * (points[:, :2] - (low + high) / 2) * (1, -1)
    # Rows go down, which turns all faces around.
    return shaded(visible_planes(np.c_[flat, scale * points[:, 2]], [face[::-1] for face in faces], *size))


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def draw(output, *surfaces):
    """A surface is its file, and azimuth and elevation of the direction to the viewer, in degrees."""
    rows = np.hstack([surface(*s) for s in surfaces]).round().astype(np.uint8)
    data = b"".join(b"\0" + row.tobytes() for row in rows)
    with open(output, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", rows.shape[1], rows.shape[0], 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b""))
