# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The cloud of these tests."""

import functools

import numpy as np

import tandem

MAXIMUM_DISTANCE = 0.03


@functools.lru_cache(maxsize=None)
def room(points_a_face=1500):
    """Points and normals of six faces, 4 by 3 by 2.5 meters, each turned a little, and of clutter."""
    random = np.random.default_rng(7)
    size = np.array([4, 3, 2.5])
    points, normals = [], []
    for axis in range(3):
        for side in range(2):
            face = random.random((points_a_face, 3))
            tilt = 0.0005 * random.standard_normal(2)
            face[:, axis] = side + face[:, [axis - 1, axis - 2]] @ tilt + 0.003 * random.standard_normal(points_a_face)
            normal = 0.05 * random.standard_normal((points_a_face, 3))
            normal[:, axis] += 2 * side - 1
            points.append(size * face)
            normals.append(normal)
    clutter = points_a_face // 10
    points.append(size * random.random((clutter, 3)))
    normals.append(random.standard_normal((clutter, 3)))
    return np.concatenate(points), np.concatenate(normals)


@functools.lru_cache(maxsize=None)
def shapes_of_room():
    return tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE)
