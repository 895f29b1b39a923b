# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What detect_planes() accepts as arrays and parameters, and what it raises; tolerances of points, and points at 0 0 0."""

import re

import numpy as np
import pytest

import tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room


def hash_of(points, normals):
    return tandem.detect_planes(points, normals, maximum_distance=MAXIMUM_DISTANCE).hash


def test_other_layouts_and_types_have_the_same_result():
    points, normals = room()
    expected = shapes_of_room().hash
    interleaved = np.concatenate([points, normals], axis=1)
    interleaved.flags.writeable = False
    for given in ((interleaved[:, :3], interleaved[:, 3:]), map(np.asfortranarray, room()),
                  (points.astype(">f8"), normals.tolist())):
        assert hash_of(*given) == expected
    short = points.astype(np.float32), normals.astype(np.float32)
    assert hash_of(*short) == hash_of(short[0].astype(float), short[1].astype(float))
    whole = np.round(1000 * points).astype(np.int64)
    shapes = tandem.detect_planes(whole, maximum_distance=1000 * MAXIMUM_DISTANCE)
    assert shapes.hash == tandem.detect_planes(whole.astype(float), maximum_distance=30).hash


def test_a_result_has_no_array_of_the_caller():
    points, normals = (array.copy() for array in room())
    for kind in (np.asarray, memoryview, np.ma.array):
        shapes = tandem.detect_planes(points, kind(normals), maximum_distance=MAXIMUM_DISTANCE)
        normals[:] = points[:] = 0
        assert np.array_equal(shapes.normals, room()[1]) and not np.shares_memory(shapes.normals, normals)
        points[:], normals[:] = room()
        assert tandem.find_violation(points, shapes) is None
    assert normals.flags.writeable


def test_masked_numbers_are_not_finite():
    points, normals = (np.ma.array(array) for array in room())
    assert hash_of(points, normals) == shapes_of_room().hash  # nothing is masked
    points[5, 1] = normals[7] = np.ma.masked
    points.mask[9, 2] = True
    masked = tandem.detect_planes(points, normals, maximum_distance=MAXIMUM_DISTANCE)
    plain = tandem.detect_planes(points.filled(np.nan), normals.filled(np.inf), maximum_distance=MAXIMUM_DISTANCE)
    assert masked.hash == plain.hash
    assert len(masked) == 6 and masked.labels[[5, 7, 9]].tolist() == [-1, -1, -1]
    assert masked.statistics["number_of_ignored_coordinates"] == 2
    assert masked.statistics["number_of_ignored_normals"] == 1
    assert tandem.find_violation(points, masked) is None
    whole = np.ma.array([[1, 2, 3], [4, 5, 6]], mask=[[0, 0, 1], [0, 0, 0]])
    assert tandem.detect_planes([whole[0], whole[1]]).statistics["number_of_ignored_coordinates"] == 1
    with pytest.raises(ValueError, match="^symmetry_direction is"):
        tandem.detect_planes(points, symmetry_direction=whole[0])


SWITCHES = ["regularize_parallelism", "regularize_orthogonality", "regularize_coplanarity"]


def test_refused():
    points, normals = room()
    n = len(points)
    for name, what, values in (
            ("points", "must",
             (points[:, :2], points[0], points[None], [], None, "text", points.astype(complex), points > 0, [[1, 2, 3], [4]])),
            ("normals", "must", (normals[:-1], normals[:, :1], "xyz")),
            ("maximum_distance_map", "must", (np.ones(n - 1), np.ones((n, 1)), 0.03, "text", np.ones(n) > 0)),
            ("maximum_distance", "is", (0, -1, np.nan)), ("maximum_angle", "is", (90,)), ("angle_tolerance", "is", (45,)),
            ("maximum_offset", "is", (-1,)), ("minimum_region_size", "is", (2, -3, 10**30)), ("k_neighbors", "is", (0, 65)),
            ("cell_size", "is", (1,)), ("threads", "is", (0, -1)), ("simplicity", "is", (-1, np.nan, 1e9)),
            ("symmetry_direction", "must", ((0, 0),)), ("fixed_directions", r"is \(0, 0, 0\) at index 0", (np.zeros((1, 3)),)),
            ("regularity", "is", (-1, np.nan, 1e9)), ("surfel_size", "is", (-1, 1)), ("backend", "is", ("fast", None)),
            *((name, "(is|must be) ", (np.array([1, 2]),)) for name in [*SWITCHES, "backend"])):
        for value in values:
            with pytest.raises(ValueError, match=f"^{name} ?{what}"):
                tandem.detect_planes(**{"points": points, name: value})
    for name, value in (("maximum_distance", "1"), ("maximum_angle", [1]), ("minimum_region_size", 100.0),
                        ("threads", "2"), ("progress", 3)):
        with pytest.raises(TypeError, match=f"^{name} must be"):
            tandem.detect_planes(points, **{name: value})
    with pytest.raises(ValueError, match=r"its type is object; of a cloud .* pass np.asarray\(cloud.points\)"):
        tandem.detect_planes(type("Cloud", (), {"points": points})())  # as that of Open3D
    with pytest.raises(ValueError, match="extent"):
        tandem.detect_planes(np.diag([1e9, 1e9, 1e9]).repeat(20, axis=0), maximum_distance=1e-3)


def test_few_points():
    for n in (0, 3):
        shapes = tandem.detect_planes(np.zeros((n, 3)))
        assert (len(shapes), shapes.labels.shape, shapes.normals.shape) == (0, (n,), (n, 3))
        assert (shapes.planes.shape, shapes.orthogonal_pairs.shape) == ((0, 4), (0, 2))


def test_huge_numbers():
    for name in ("maximum_distance", "maximum_offset", "maximum_angle", "angle_tolerance", "simplicity", "regularity",
                 "surfel_size", "minimum_region_size", "k_neighbors", "cell_size", "threads"):
        for value in (10**400, -10**400, -2**63 - 1):
            with pytest.raises(ValueError, match=f"^{name} (is|must be) "):
                tandem.detect_planes(np.zeros((1, 3)), **{name: value})


def test_parameter_error():
    with pytest.raises(tandem.ParameterError) as error:
        tandem.detect_planes(np.zeros((1, 3)), maximum_angle=95)
    assert (error.value.name, error.value.value) == ("maximum_angle", "95")
    assert error.value.range.startswith("[0.05, 90)") and isinstance(error.value, ValueError)


def test_they_are_used():
    given = {"maximum_distance": np.float32(0.05), "maximum_angle": 20, "angle_tolerance": 5, "maximum_offset": 0,
             "minimum_region_size": np.int64(200), "simplicity": 0.05, "regularity": 1, "fixed_regularity": 2,
             "surfel_size": 0.25, "k_neighbors": 15, "cell_size": 4096, **dict.fromkeys(SWITCHES, False),
             "fixed_directions": [(0, 1, 0)], "symmetry_direction": (0, 0, 2)}
    shapes = tandem.detect_planes(*room(), **given)
    assert shapes.parameters == given
    assert shapes.minimum_region_size == 200
    assert len(set(shapes.parallel_groups.tolist())) == len(shapes)
    for name in SWITCHES:  # each of its own
        given = {other: other != name for other in SWITCHES}
        parameters = tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE, **given).parameters
        assert {other: parameters[other] for other in SWITCHES} == given


# --- Tolerances of points


def test_points_are_within_their_own():
    """Half of the largest for half of the points; those that are not positive are counted."""
    points, normals = room()
    tolerances = np.ma.array(np.where(points[:, 0] > 2, 2 * MAXIMUM_DISTANCE, MAXIMUM_DISTANCE))
    tolerances[[3, 4, 5]] = [0, -1, np.nan]
    tolerances[6] = np.ma.masked
    expected = tandem.detect_planes(points, normals, maximum_distance_map=tolerances.filled(0).tolist()).hash
    shapes = tandem.detect_planes(points, normals, maximum_distance_map=tolerances)
    assert (len(shapes), shapes.maximum_distance, shapes.hash) == (6, 2 * MAXIMUM_DISTANCE, expected)
    assert shapes.labels[3:7].tolist() == [-1] * 4
    assert shapes.statistics["number_of_ignored_tolerances"] == 4
    assert shapes.statistics["number_of_ignored_coordinates"] == 0
    has_shape = shapes.labels >= 0
    planes = shapes.planes[shapes.labels[has_shape]]
    distances = np.abs((planes[:, :3] * points[has_shape]).sum(axis=1) + planes[:, 3])
    assert (distances <= tolerances[has_shape] * (1 + 1e-12)).all()
    tolerances[:] = 1e-9  # it has its own
    assert tandem.find_violation(points, shapes) is None


def test_the_number_is_the_upper_bound():
    wide = np.full(len(room()[0]), 10.0)
    shapes = tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE, maximum_distance_map=wide)
    assert shapes.maximum_distance == MAXIMUM_DISTANCE
    assert shapes.labels.tolist() == shapes_of_room().labels.tolist()


# --- Points at 0 0 0


def test_zeros_are_left_out():
    points, normals = room()
    with_zeros = np.concatenate([[[0.0, -0.0, 0.0]] * 3, points + 1, [[0.0] * 3] * 700, [[np.nan] * 3]])
    given = np.concatenate([[[0.0, 0, 1]] * 3, normals, [[0.0, 0, 1]] * 701])
    plain = tandem.detect_planes(points + 1, normals, maximum_distance=MAXIMUM_DISTANCE)
    shapes = tandem.detect_planes(with_zeros, given, ignore_zeros=True,
                                  maximum_distance_map=np.full(len(with_zeros), MAXIMUM_DISTANCE))
    assert shapes.planes.tobytes() == plain.planes.tobytes()
    assert shapes.labels.tolist() == [-1] * 3 + plain.labels.tolist() + [-1] * 701
    assert shapes.statistics["number_of_ignored_zeros"] == 703
    assert shapes.statistics["number_of_ignored_coordinates"] == 1
    assert tandem.find_violation(with_zeros, shapes) is None
    others = tandem.detect_planes(with_zeros, given, maximum_distance=MAXIMUM_DISTANCE)
    assert others.statistics["number_of_ignored_zeros"] == 0


def test_estimates():
    """Those of a detection, with a note if there is reason; points at 0 0 0 do not count if they are ignored."""
    points = room()[0] + 1
    shapes, estimate = tandem.detect_planes(points), tandem.estimate_parameters(points)
    assert estimate.maximum_distance == shapes.maximum_distance
    assert estimate.maximum_offset == shapes.parameters["maximum_offset"]
    assert estimate.minimum_region_size == shapes.minimum_region_size
    steps = np.random.default_rng(3).random((20000, 3)) * 2
    steps[:, 2] = np.round(0.12 * steps[:, 0] / 0.04) * 0.04
    assert re.search(".* coordinates are in steps.*[.]$", tandem.detect_planes(steps).statistics["estimate_note"])
    assert tandem.detect_planes(steps, maximum_distance=0.1).statistics["estimate_note"] == ""
    with_zeros = np.concatenate([[[0.0, -0.0, 0.0]] * 3, points, [[0.0] * 3] * 700, [[np.nan] * 3]])
    assert tandem.estimate_parameters(with_zeros, ignore_zeros=True) == estimate
    distances = tandem.estimate_local_distances(with_zeros, ignore_zeros=True)
    assert distances.shape == (len(with_zeros),)
    assert distances[3:-701].tobytes() == tandem.estimate_local_distances(points).tobytes()
    assert np.isnan(np.concatenate([distances[:3], distances[-701:]])).all()
