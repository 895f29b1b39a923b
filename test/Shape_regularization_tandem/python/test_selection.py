# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a result, and labels of further points by its planes."""

import numpy as np
import pytest

import tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room


def check(selected, indices):
    """The selection has these shapes of the room, in this order."""
    shapes, (points, _) = shapes_of_room(), room()
    assert selected.planes.tolist() == shapes.planes[indices].tolist()
    number = np.full(len(shapes) + 1, -1)
    number[indices] = np.arange(len(indices))
    assert selected.labels.tolist() == number[shapes.labels].tolist()
    for i, s in enumerate(indices):
        assert selected.points_of(i).tolist() == shapes.points_of(s).tolist()
    statistics = selected.statistics
    assert statistics["number_of_shapes"] == len(indices)
    assert statistics["free_points"]["total"] == np.count_nonzero(selected.labels < 0)
    assert tandem.find_violation(points, selected) is None


def test_indices():
    shapes = shapes_of_room()
    for indices in ([4, 0, 2], [], list(range(6)), np.array([1, 3], np.uint8)):
        check(tandem.select_shapes(shapes, indices), list(indices))
    is_first = shapes.parallel_groups == 0
    check(tandem.select_shapes(shapes, is_first), np.flatnonzero(is_first).tolist())
    check(tandem.select_shapes(tandem.select_shapes(shapes, [5, 2, 1]), [2, 0]), [1, 5])
    assert tandem.select_shapes(shapes, range(6)).hash == shapes.hash and len(shapes) == 6


def test_criteria():
    shapes = shapes_of_room()
    sizes = [len(shapes.points_of(s)) for s in range(6)]
    x, y, z = np.abs(shapes.planes[:, :3].T)
    for criteria, expected in (
            ({"near_direction": (0, 0, 2)}, z > .9), ({"orthogonal_direction": (0, 0, -1)}, z < .1),
            ({"near_direction": (1, 0, 1), "near_angle": 46}, y < .1),
            ({"largest": 2}, np.isin(range(6), sorted(range(6), key=lambda s: -sizes[s])[:2])),
            # Faces are 4 by 3, 4 by 2.5 and 3 by 2.5 meters.
            ({"minimum_area": 11}, z > .9), ({"minimum_extent": 3.5}, x < .1),
            ({"minimum_width": 2.8}, z > .9), ({"classes": ["wall"]}, z < .1), ({"classes": ["wall"], "largest": 9}, z < .1),
            ({"flat_only": True}, x >= 0), ({"classes": []}, x < 0), ({}, x >= 0), ({"minimum_area": 99}, x < 0)):
        check(tandem.select_shapes(shapes, **criteria), np.flatnonzero(expected).tolist())


def test_viewpoint():
    """A wall before another one, and a column of pixels between a near and a far one, from one place or that of each
    point."""
    random = np.random.default_rng(0)
    azimuth, elevation = (0.01 * steps.ravel() for steps in np.meshgrid(np.arange(-30, 31), np.arange(-30, 31)))
    rays = np.stack([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)], 1)
    is_near = np.arange(len(rays)) % 2 == 0
    walls = rays * (np.where(is_near, 2, 5) / rays[:, 0])[:, None]
    angle = np.repeat(0.01 * np.arange(-30, 31), 2)
    veil = np.stack([np.cos(angle), 0 * angle, np.sin(angle)], 1) * random.uniform(8, 10, (len(angle), 1))
    points = np.concatenate([walls, veil])
    shapes = tandem.detect_planes(points, maximum_distance=0.02, minimum_region_size=60)
    assert (shapes.labels[len(walls):] >= 0).any() and "behind" not in shapes.table()
    for viewpoint in ((0, 0, 0), np.zeros_like(points)):
        selected = tandem.select_shapes(shapes, viewpoint=viewpoint)
        assert (selected.labels[len(walls):] < 0).all() and len(selected) == 2
        near, far = selected.labels[is_near.argmax()], selected.labels[is_near.argmin()]
        behind = selected.table(viewpoint=viewpoint)["behind"]
        assert behind.dtype == np.int64 and behind[near] == -1 and behind[far] == near
    assert len(tandem.select_shapes(shapes, viewpoint=(np.nan, 0, 0))) == len(shapes)
    for wrong in ((0, 0), points[1:], "abc"):
        for function in (shapes.table, lambda viewpoint: tandem.select_shapes(shapes, viewpoint=viewpoint)):
            with pytest.raises(ValueError, match="viewpoint must be three numbers, or three for each of the"):
                function(viewpoint=wrong)


def test_errors():
    points, shapes = room()[0], shapes_of_room()
    for wrong, word in (([6], "no shape 6"), ([-1], "no shape -1"), ([1, 1], "twice"), ([True] * 5, "truth value"),
                        ([[1]], "list"), ([.5], "integers"), (2, "list")):
        with pytest.raises(ValueError, match=word):
            tandem.select_shapes(shapes, wrong)
    for function, given, wrong in (
            (tandem.select_shapes, [],
             {"largest": (0, -1), "near_angle": (91,), "minimum_area": (-1,), "minimum_extent": (np.nan,),
              "minimum_width": (-1, np.nan), "classes": (["door"], "wall"),
              "near_direction": ((0, 0, 0),), "orthogonal_direction": ((0, 1),)}),
            (tandem.label_points, [points], {"maximum_distance": (0,), "maximum_angle": (90,), "normals": (points[1:],),
                                             "reach": (0, np.nan, -np.inf), "maximum_distance_map": ([1],)})):
        for name, values in wrong.items():
            for value in values:
                with pytest.raises(ValueError, match=name):
                    function(shapes, *given, **{name: value})
    with pytest.raises(ValueError, match="together"):
        tandem.select_shapes(shapes, indices=[0], largest=1)
    with pytest.raises(ValueError, match="together"):
        tandem.select_shapes(shapes, indices=[0], flat_only=True)
    for call, word in ((lambda: tandem.select_shapes(shapes.labels, [0]), "shapes"),
                       (lambda: tandem.select_shapes(shapes, largest=1.5), "largest"),
                       (lambda: tandem.label_points(None, points), "shapes")):
        with pytest.raises(TypeError, match=word):
            call()


def test_nearest_plane():
    points, _ = room()
    shapes = shapes_of_room()
    distances = np.abs(points @ shapes.planes[:, :3].T + shapes.planes[:, 3])
    expected = np.where(distances.min(axis=1) <= .01, distances.argmin(axis=1), -1)
    labels = tandem.label_points(shapes, points, maximum_distance=.01, reach=np.inf)
    assert labels.dtype == np.int32 and labels.tolist() == expected.tolist()
    turned = tandem.label_points(shapes, points, np.roll(room()[1], 1, axis=1), maximum_distance=.01, reach=np.inf)
    assert (turned >= 0).mean() < .1  # normals decide where they are given
    tolerances = np.linspace(0, .02, len(points))
    expected = np.where((distances.min(axis=1) <= tolerances) & (tolerances > 0), distances.argmin(axis=1), -1)
    assert tandem.label_points(shapes, points, maximum_distance_map=tolerances, reach=np.inf).tolist() == expected.tolist()


def test_reach():
    points, _ = room()
    shapes = shapes_of_room()
    a, b, c, d = shapes.planes[0]
    far = points[shapes.points_of(0)[0]] + 100 * np.cross((a, b, c), (b, c, a))
    far -= (far @ (a, b, c) + d) * np.array((a, b, c))
    assert tandem.label_points(shapes, [far, (np.nan, 0, 0)], reach=np.inf).tolist() == [0, -1]
    assert tandem.label_points(shapes, [far]).tolist() == [-1]
    assert tandem.label_points(shapes, [far], reach=1e4).tolist() == [0]
    assert tandem.label_points(shapes, np.empty((0, 3))).tolist() == []
    points, normals = (np.array(array) for array in room())
    shapes = tandem.detect_planes(points, normals, maximum_distance=MAXIMUM_DISTANCE)
    points[shapes.points_of(0)[0]] += 1
    with pytest.raises(ValueError, match="is not on the plane of its shape 0"):
        tandem.label_points(shapes, points)
