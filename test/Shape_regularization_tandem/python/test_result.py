# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result has, that its arrays are views, and the table of its shapes, which reads the array of the points."""

import gc
import re
import weakref

import numpy as np
import pytest

import tandem
from tandem import _tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room


def test_faces_and_relations():
    shapes = shapes_of_room()
    assert (len(shapes), shapes.planes.shape, shapes.maximum_distance) == (6, (6, 4), MAXIMUM_DISTANCE)
    assert (shapes.labels >= 0).mean() > 0.9 and sorted(shapes.coplanar_groups.tolist()) == list(range(6))
    assert shapes.orthogonal_pairs.tolist() == [[0, 1], [0, 2], [1, 2]]
    normals = {group: plane[:3] for plane, group in zip(shapes.planes, shapes.parallel_groups.tolist())}  # they are exact
    assert all((plane[:3] == normals[group]).all() for plane, group in zip(shapes.planes, shapes.parallel_groups.tolist()))
    normals = np.array([normals[group] for group in range(3)])
    np.testing.assert_allclose(normals @ normals.T, np.eye(3), rtol=0, atol=5e-15)


def test_statistics():
    shapes = shapes_of_room()
    reasons = dict(shapes.statistics["free_points"])
    total = reasons.pop("total")
    assert (total, sum(reasons.values())) == (np.count_nonzero(shapes.labels == -1),) * 2
    assert reasons["misaligned"] < 50
    assert tandem.detect_planes(room()[0], maximum_distance=MAXIMUM_DISTANCE).statistics["free_points"]["misaligned"] == 0
    assert "meant as a cosine" in tandem.detect_planes(*room(), maximum_angle=0.9).statistics["angle_note"]
    assert shapes.statistics["angle_note"] == ""


def test_uncertainties():
    points, shapes = room()[0], shapes_of_room()
    u = shapes.uncertainties
    for s, plane in enumerate(shapes.planes):
        own = points[shapes.points_of(s)]
        np.testing.assert_allclose(u["centroid"][s], own.mean(axis=0), atol=1e-3 * MAXIMUM_DISTANCE)
        covariance = u["normal_covariance"][s]
        np.testing.assert_allclose(covariance @ plane[:3], 0, atol=1e-12 * np.trace(covariance))
        np.testing.assert_allclose([u["angle_deg"][s], u["offset_deviation"][s]], rtol=0, atol=5e-8, desired=[
            np.degrees(np.sqrt(np.linalg.eigvalsh(covariance)[2])), u["noise"][s] / np.sqrt(len(own))])


def test_points_of_shapes():
    shapes = shapes_of_room()
    for s in range(len(shapes)):
        assert shapes.points_of(s).tolist() == np.flatnonzero(shapes.labels == s).tolist()
        assert len(shapes.points_of(s)) >= shapes.minimum_region_size
        outward = -shapes.planes[s] if shapes.is_flipped[s] else shapes.planes[s]
        assert (room()[1][shapes.points_of(s)] @ outward[:3]).mean() > 0.9
    assert shapes.points_of(-1).tolist() == shapes.points_of(5).tolist()
    for wrong, error in ((6, IndexError), (-7, IndexError), (10**5000, IndexError), (1.5, TypeError)):
        with pytest.raises(error):
            shapes.points_of(wrong)


def test_violations_are_found():
    points = room()[0]
    assert tandem.find_violation(points, shapes_of_room()) is None
    moved = points.copy()
    moved[shapes_of_room().points_of(2)[0]] += 1
    assert "too far from its plane" in tandem.find_violation(moved, shapes_of_room())
    with pytest.raises(ValueError, match="^points has"):
        tandem.find_violation(points[1:], shapes_of_room())
    with pytest.raises(TypeError):
        tandem.find_violation(points, None)


def test_they_come_from_functions_only():
    for made in (tandem.PlanarShapes, type(_tandem.default_settings())):
        for make in (made, lambda: made.__new__(made), lambda: object.__new__(made)):
            with pytest.raises(TypeError):
                make()


NAMES = ("planes", "labels", "parallel_groups", "coplanar_groups", "orthogonal_pairs", "is_flipped", "normals")


def arrays(shapes):
    return [getattr(shapes, name) for name in NAMES] + [shapes.points_of(0)]


def test_arrays_are_views_to_read():
    kinds = [("<f8", 2), ("<i4", 1), ("<i4", 1), ("<i4", 1), ("<i4", 2), ("|b1", 1), ("<f8", 2), ("<u4", 1)]
    for shapes in (shapes_of_room(), tandem.detect_planes(room()[0], maximum_distance=MAXIMUM_DISTANCE)):
        assert [(array.dtype.str, array.ndim) for array in arrays(shapes)] == kinds
        assert tandem.find_violation(room()[0], shapes) is None
        for array, again in zip(arrays(shapes), arrays(shapes)):
            assert np.shares_memory(array, again) and array.base is shapes
            with pytest.raises(ValueError, match="read-only"):
                array[0] = 0
            with pytest.raises(ValueError):
                array.setflags(write=True)
    # They outlive the result, which has estimated normals.
    np.testing.assert_allclose(np.linalg.norm(shapes.normals, axis=1), 1, atol=1e-6)
    assert shapes.statistics["has_estimated_normals"] and shapes.hash != shapes_of_room().hash
    views = arrays(shapes)
    copies = [array.copy() for array in views]
    del shapes, array, again
    gc.collect()
    tandem.detect_planes(*room(), maximum_distance=2 * MAXIMUM_DISTANCE)  # takes freed memory
    for array, copy in zip(views, copies):
        np.testing.assert_array_equal(array, copy)


def test_text():
    assert re.search(r"^<tandem.PlanarShapes: 6 shapes, 3 directions, 6 planes, \d+ of 9150 points>$", repr(shapes_of_room()))
    assert re.search(r"^\d+\.\d+\.\d+$", tandem.__version__)
    assert re.search(r"points +\(n, 3\) numbers", tandem.detect_planes.__doc__)
    assert "(m, 4) float64" in tandem.PlanarShapes.planes.__doc__


def test_planes_of_another_detector():
    points, labels = room()[0], shapes_of_room().labels
    planes = []
    for s in range(6):
        part = points[labels == s]
        normal = np.linalg.svd(part - part.mean(axis=0), full_matrices=False)[2][2]
        planes.append([*normal, -normal @ part.mean(axis=0)])
    given = np.array(planes)
    relations = tandem.regularize_planes(points, labels, given, maximum_angle=5, maximum_offset=0.02)
    assert given.tolist() == planes and relations.is_changed.all() and not relations.is_rolled_back.any()
    assert relations.orthogonal_pairs.tolist() == [[0, 1], [0, 2], [1, 2]]
    assert relations.angles.max() < 5 and relations.largest_distances.max() < 0.1 and relations.maximum_distance > 0
    apart = tandem.regularize_planes(points, labels, given, maximum_angle=5, maximum_offset=0.02, regularity=0)
    assert len(set(apart.parallel_groups.tolist())) == 6


def test_masked_arguments():
    points = np.ma.array([[x, y, 0.] for x in range(4) for y in range(4)])
    points[3, 1] = np.ma.masked
    labels = np.ma.zeros(16, np.uint64)
    labels[[2, 5]] = np.ma.masked
    points.data[2] = 1e3  # belongs to no plane
    planes = np.ma.array([[0, 0, 1, 0], [1, 0, 0, 0]], mask=[4 * [False], [True, False, False, False]])
    relations = tandem.regularize_planes(points, labels, planes)
    assert np.isnan(relations.planes[1, 0]) and relations.largest_distances[0] == 0
    assert (relations.is_changed.tolist(), len(relations.orthogonal_pairs)) == ([False, False], 0)


def test_errors():
    points, labels, planes = np.zeros((4, 3)), [0, 0, 0, -1], [[0, 0, 1, 0]]
    assert tandem.regularize_planes(points, labels, planes).planes.tolist() == planes
    assert len(tandem.regularize_planes(points, [-1] * 4, np.zeros((0, 4))).planes) == 0
    for name, wrong in (("labels", labels[1:]), ("labels", [0, 0, 0, 1]), ("labels", [0, 0, 0, -2]), ("labels", [0.5] * 4),
                        ("planes", [[0, 0, 1]]), ("points", points[0]), ("maximum_angle", 50), ("regularity", 10**400)):
        arguments = {"points": points, "labels": labels, "planes": planes, name: wrong}
        with pytest.raises(ValueError, match=f"^{name}"):
            tandem.regularize_planes(**arguments)


def test_directions():
    points, normals = room()
    arguments = {"maximum_distance": MAXIMUM_DISTANCE, "fixed_directions": [(0, 0, 3)], "symmetry_direction": (0, 0, 1)}
    shapes = tandem.detect_planes(points, normals, **arguments)
    assert sorted(shapes.fixed_directions.tolist()) == [-1, -1, 0] and sorted(shapes.symmetry_groups.tolist()) == [0, 0, 1]
    horizontal = shapes.fixed_directions[shapes.parallel_groups] == 0
    assert np.abs(shapes.planes[horizontal, :3]).tolist() == [[0, 0, 1], [0, 0, 1]]
    assert np.abs(shapes.planes[~horizontal, 2]).max() <= 1e-15
    assert {name: shapes.parameters[name] for name in arguments} == arguments
    assert shapes_of_room().symmetry_groups.tolist() == shapes_of_room().fixed_directions.tolist() == [-1, -1, -1]
    assert tandem.find_violation(points, shapes) is None


# --- The table of the shapes, whose numbers are those of the program: test_programs.py


def test_columns():
    shapes, table = shapes_of_room(), shapes_of_room().table()
    counts = ["shape", "points", "parallel_group", "coplanar_group"]
    assert {name: column.dtype for name, column in table.items()} == {
        name: np.dtype(np.int64 if name in counts else "U7" if name == "class" else np.float64) for name in table}
    np.testing.assert_array_equal(np.stack([table[name] for name in "abcd"], axis=1), shapes.planes)
    np.testing.assert_array_equal(table["coplanar_group"], shapes.coplanar_groups)
    np.testing.assert_array_equal(table["angle_deviation_deg"], shapes.uncertainties["angle_deg"])
    assert sorted(table["class"]) == ["ceiling", "floor"] + 4 * ["wall"] and (table["curved"] < .1).all()
    upward = tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE, symmetry_direction=(1, 0, 0)).table()
    np.testing.assert_allclose(np.sort(upward["highest"]), [0] + 5 * [4], atol=0.05)
    empty = tandem.detect_planes(np.zeros((0, 3)), maximum_distance=1).table()
    assert list(empty) == list(table) and not any(len(column) for column in empty.values())


def test_points_are_kept_and_may_change():
    points = room()[0].copy()
    shapes = tandem.detect_planes(points, room()[1], maximum_distance=MAXIMUM_DISTANCE)
    first = shapes.table()
    points += 1e-6
    assert shapes.table()["x"][0] == pytest.approx(first["x"][0] + 1e-6, rel=0, abs=5e-10)
    alive = weakref.ref(points)
    del points
    gc.collect()
    assert alive() is not None
    del shapes
    gc.collect()
    assert alive() is None
