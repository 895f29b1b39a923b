# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tolerances of points, and points at 0 0 0."""

import re

import numpy as np
import pytest

import tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room


def tolerances_of(points):
    """Half of the largest for half of the points."""
    return np.where(points[:, 0] > 2, 2 * MAXIMUM_DISTANCE, MAXIMUM_DISTANCE)


def test_points_are_within_their_own():
    points, normals = room()
    tolerances = tolerances_of(points)
    expected = tandem.detect_planes(points, normals, maximum_distance_map=list(tolerances)).hash
    shapes = tandem.detect_planes(points, normals, maximum_distance_map=tolerances)
    assert (len(shapes), shapes.maximum_distance, shapes.hash) == (6, 2 * MAXIMUM_DISTANCE, expected)
    has_shape = shapes.labels >= 0
    planes = shapes.planes[shapes.labels[has_shape]]
    distances = np.abs((planes[:, :3] * points[has_shape]).sum(axis=1) + planes[:, 3])
    assert (distances <= tolerances[has_shape] * (1 + 1e-12)).all()
    tolerances[:] = 1e-9  # it has its own
    assert tandem.find_violation(points, shapes) is None


def test_one_that_is_not_positive_is_counted():
    points, normals = room()
    tolerances = np.ma.array(tolerances_of(points))
    tolerances[[3, 4, 5]] = [0, -1, np.nan]
    tolerances[6] = np.ma.masked
    shapes = tandem.detect_planes(points, normals, maximum_distance_map=tolerances)
    assert shapes.labels[3:7].tolist() == [-1] * 4
    assert shapes.statistics["number_of_ignored_tolerances"] == 4
    assert shapes.statistics["number_of_ignored_coordinates"] == 0
    assert tandem.find_violation(points, shapes) is None


def test_the_number_is_the_upper_bound():
    points, normals = room()
    wide = np.full(len(points), 10.0)
    shapes = tandem.detect_planes(points, normals, maximum_distance=MAXIMUM_DISTANCE, maximum_distance_map=wide)
    assert shapes.maximum_distance == MAXIMUM_DISTANCE
    assert shapes.labels.tolist() == shapes_of_room().labels.tolist()


def test_a_note_on_the_estimate():
    random = np.random.default_rng(3)
    points = random.random((20000, 3)) * 2
    points[:, 2] = np.round(0.12 * points[:, 0] / 0.04) * 0.04
    assert re.search(".* coordinates are in steps.*[.]$", tandem.detect_planes(points).statistics["estimate_note"])
    assert tandem.detect_planes(points, maximum_distance=0.1).statistics["estimate_note"] == ""


def test_wrong_ones():
    points = room()[0]
    for wrong in (np.ones(len(points) - 1), np.ones((len(points), 1)), 0.03, "text", np.ones(len(points)) > 0):
        with pytest.raises(ValueError, match="^maximum_distance_map must"):
            tandem.detect_planes(points, maximum_distance_map=wrong)


def test_local_distances():
    points = room()[0].copy()
    points[5] = np.nan
    distances = tandem.estimate_local_distances(points)
    assert (distances.shape, distances.dtype) == ((len(points),), np.float64)
    assert (np.delete(distances, 5) > 0).all()
    shapes = tandem.detect_planes(points, maximum_distance_map=distances)
    assert tandem.find_violation(points, shapes) is None
    assert shapes.statistics["number_of_ignored_coordinates"] == 1


def test_they_are_left_out():
    points, normals = room()
    with_zeros = np.concatenate([[[0.0, -0.0, 0.0]] * 3, points + 1, [[0.0] * 3] * 700, [[np.nan] * 3]])
    given = np.concatenate([[[0.0, 0, 1]] * 3, normals, [[0.0, 0, 1]] * 701])
    for more in ({}, {"maximum_distance_map": np.full(len(with_zeros), MAXIMUM_DISTANCE)}):
        shapes = tandem.detect_planes(with_zeros, given, maximum_distance=MAXIMUM_DISTANCE, ignore_zeros=True, **more)
        plain = tandem.detect_planes(points + 1, normals, maximum_distance=MAXIMUM_DISTANCE)
        assert shapes.planes.tobytes() == plain.planes.tobytes()
        assert shapes.labels[3:-701].tolist() == plain.labels.tolist()
        assert (np.concatenate([shapes.labels[:3], shapes.labels[-701:]]) == -1).all()
        assert shapes.statistics["number_of_ignored_zeros"] == 703
        assert shapes.statistics["number_of_ignored_coordinates"] == 1
        assert tandem.find_violation(with_zeros, shapes) is None


def test_estimates_of_the_others():
    points = room()[0] + 1
    with_zeros = np.concatenate([[[0.0, -0.0, 0.0]] * 3, points, [[0.0] * 3] * 700])
    copy = with_zeros.copy()
    plain = tandem.estimate_parameters(points)
    assert tandem.estimate_parameters(with_zeros, ignore_zeros=True) == plain
    distances = tandem.estimate_local_distances(with_zeros, ignore_zeros=True)
    assert distances[3:-700].tobytes() == tandem.estimate_local_distances(points).tobytes()
    assert np.isnan(np.concatenate([distances[:3], distances[-700:]])).all()
    assert with_zeros.tobytes() == copy.tobytes()


def test_not_by_default():
    points, normals = room()
    shapes = tandem.detect_planes(points * (np.arange(len(points)) != 7)[:, None], normals,
                                  maximum_distance=MAXIMUM_DISTANCE)
    assert shapes.statistics["number_of_ignored_zeros"] == 0
    assert shapes.statistics["number_of_ignored_coordinates"] == 0

