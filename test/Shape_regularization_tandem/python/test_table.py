# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of the shapes, against their points, and which array of points it reads."""

import gc
import weakref

import numpy as np
import pytest

import tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room


def test_columns():
    shapes, table = shapes_of_room(), shapes_of_room().table()
    assert {column.shape for column in table.values()} == {(6,)}
    counts = [name for name, column in table.items() if column.dtype == np.int64]
    assert counts == ["shape", "points", "parallel_group", "coplanar_group"]
    assert {column.dtype for column in table.values()} == {np.dtype(np.int64), np.dtype(np.float64)}
    np.testing.assert_array_equal(table["shape"], np.arange(6))
    np.testing.assert_array_equal(np.stack([table[name] for name in "abcd"], axis=1), shapes.planes)
    np.testing.assert_array_equal(table["parallel_group"], shapes.parallel_groups)
    np.testing.assert_array_equal(table["coplanar_group"], shapes.coplanar_groups)
    u = shapes.uncertainties
    for name, other in (("noise", "noise"), ("offset_deviation", "offset_deviation"),
                        ("angle_deviation_deg", "angle_deg")):
        np.testing.assert_array_equal(table[name], u[other])


def test_numbers():
    points, shapes, table = room()[0], shapes_of_room(), shapes_of_room().table()
    for s, plane in enumerate(shapes.planes):
        own = points[shapes.points_of(s)]
        assert table["points"][s] == len(own)
        np.testing.assert_allclose([table[name][s] for name in "xyz"], own.mean(axis=0), atol=1e-12)
        heights = own @ plane[:3] + plane[3]
        assert table["rms_distance"][s] == pytest.approx(np.sqrt((heights ** 2).mean()), rel=0, abs=5e-8)
        assert table["mean_distance"][s] == pytest.approx(np.abs(heights).mean(), rel=0, abs=5e-8)
        assert (table["lowest"][s], table["highest"][s]) == (own[:, 2].min(), own[:, 2].max())
        sides = np.sort(np.array([4, 3, 2.5])[np.abs(plane[:3]) < 0.5])
        np.testing.assert_allclose([table["width"][s], table["length"][s]], sides, atol=0.05)
        np.testing.assert_allclose(table["area"][s], sides.prod(), rtol=0.06)
        outward = -plane if shapes.is_flipped[s] else plane
        assert table["tilt_deg"][s] == pytest.approx(np.degrees(np.arccos(outward[2])), rel=0, abs=5e-6)
    np.testing.assert_allclose(np.sort(table["tilt_deg"]), [0, 90, 90, 90, 90, 180], atol=0.1)


def test_upward():
    shapes = tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE, symmetry_direction=(1, 0, 0))
    table = shapes.table()
    np.testing.assert_allclose(np.sort(table["highest"]), [0] + 5 * [4], atol=0.05)


def test_nothing():
    table = tandem.detect_planes(np.zeros((0, 3)), maximum_distance=1).table()
    assert {column.shape for column in table.values()} == {(0,)}


def test_points_that_change():
    points = room()[0].copy()
    shapes = tandem.detect_planes(points, room()[1], maximum_distance=MAXIMUM_DISTANCE)
    first = shapes.table()
    points += 1e-6
    assert shapes.table()["x"][0] == pytest.approx(first["x"][0] + 1e-6, rel=0, abs=5e-10)
    points += 1
    with pytest.raises(ValueError, match="points were changed after the detection"):
        shapes.table()


def test_points_are_kept():
    points = room()[0].copy()
    shapes = tandem.detect_planes(points, room()[1], maximum_distance=MAXIMUM_DISTANCE)
    alive = weakref.ref(points)
    del points
    gc.collect()
    assert alive() is not None
    assert shapes.table()["points"].tolist() == shapes_of_room().table()["points"].tolist()
    del shapes
    gc.collect()
    assert alive() is None

