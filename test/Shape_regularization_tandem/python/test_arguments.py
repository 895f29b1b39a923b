# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What detect_planes() accepts as arrays and parameters, and what it raises."""

import unittest

import numpy as np

import tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room


def hash_of(points, normals):
    return tandem.detect_planes(points, normals, maximum_distance=MAXIMUM_DISTANCE).hash


class Arrays(unittest.TestCase):
    def test_other_layouts_have_the_same_result(self):
        points, normals = room()
        expected = shapes_of_room().hash
        interleaved = np.concatenate([points, normals], axis=1)
        self.assertEqual(hash_of(interleaved[:, :3], interleaved[:, 3:]), expected)
        self.assertEqual(hash_of(np.asfortranarray(points), np.asfortranarray(normals)), expected)
        self.assertEqual(hash_of(points.astype(">f8"), normals), expected)
        every_other = np.repeat(points, 2, axis=0)[::2]
        self.assertEqual(hash_of(every_other, normals.tolist()), expected)

    def test_other_types_are_converted(self):
        points, normals = room()
        short = points.astype(np.float32), normals.astype(np.float32)
        self.assertEqual(hash_of(*short), hash_of(short[0].astype(float), short[1].astype(float)))
        whole = np.round(1000 * points).astype(np.int64)
        shapes = tandem.detect_planes(whole, maximum_distance=1000 * MAXIMUM_DISTANCE)
        self.assertEqual(shapes.hash, tandem.detect_planes(whole.astype(float), maximum_distance=30).hash)

    def test_contiguous_doubles_are_not_copied(self):
        points, normals = room()
        shapes = tandem.detect_planes(points, normals, maximum_distance=MAXIMUM_DISTANCE)
        self.assertTrue(np.shares_memory(shapes.normals, normals))
        self.assertFalse(shapes.normals.flags.writeable)
        self.assertTrue(normals.flags.writeable)

    def test_read_only_arrays(self):
        points = room()[0].copy()
        points.flags.writeable = False
        self.assertEqual(hash_of(points, room()[1]), shapes_of_room().hash)

    def test_wrong_arrays(self):
        points, normals = room()
        wrong_points = (points[:, :2], points[0], points[None], [], None, "text", points.astype(complex), points > 0,
                        [[1, 2, 3], [4]])
        wrong_normals = (normals[:-1], normals[:, :1], "xyz")
        for name, values in [("points", p) for p in wrong_points] + [("normals", n) for n in wrong_normals]:
            arguments = {"points": points, "normals": normals, name: values}
            with self.subTest(name=name, values=type(values)), self.assertRaisesRegex(ValueError, f"^{name} must"):
                tandem.detect_planes(**arguments)

    def test_few_points(self):
        for n in (0, 1, 2, 3):
            shapes = tandem.detect_planes(np.zeros((n, 3)))
            self.assertEqual((len(shapes), shapes.labels.shape, shapes.normals.shape), (0, (n,), (n, 3)))
            self.assertEqual((shapes.planes.shape, shapes.orthogonal_pairs.shape), ((0, 4), (0, 2)))

    def test_points_that_are_not_finite(self):
        points, normals = (array.copy() for array in room())
        points[5, 1] = np.nan
        points[6, 2] = np.inf
        normals[7] = 0
        shapes = tandem.detect_planes(points, normals, maximum_distance=MAXIMUM_DISTANCE)
        self.assertEqual(shapes.labels[5:8].tolist(), [-1, -1, -1])
        self.assertEqual(shapes.statistics["number_of_ignored_coordinates"], 2)
        self.assertEqual(shapes.statistics["number_of_ignored_normals"], 1)
        self.assertEqual(len(shapes), 6)
        self.assertEqual(tandem.detect_planes(points[:100]).normals[5].tolist(), [0, 0, 0])


class Parameters(unittest.TestCase):
    def test_out_of_range(self):
        for name, value in (
            ("maximum_distance", 0), ("maximum_distance", -1), ("maximum_distance", np.nan), ("maximum_angle", 90),
            ("angle_tolerance", 45), ("maximum_offset", -1), ("minimum_region_size", 2), ("minimum_region_size", -3),
            ("minimum_region_size", 10**30), ("k_neighbors", 0), ("k_neighbors", 65), ("cell_size", 1), ("threads", 0),
            ("threads", -1), ("backend", "fast"), ("backend", None)):
            with self.subTest(name=name, value=value), self.assertRaisesRegex(ValueError, f"^{name} is"):
                tandem.detect_planes(np.zeros((1, 3)), **{name: value})

    def test_wrong_types(self):
        for name, value in (("maximum_distance", "1"), ("maximum_angle", [1]), ("minimum_region_size", 100.0),
                            ("threads", "2"), ("progress", 3)):
            with self.subTest(name=name, value=value), self.assertRaisesRegex(TypeError, f"^{name} must be"):
                tandem.detect_planes(np.zeros((1, 3)), **{name: value})

    def test_they_are_used(self):
        given = {"maximum_distance": np.float32(0.05), "maximum_angle": 20, "angle_tolerance": 5, "maximum_offset": 0,
                 "minimum_region_size": np.int64(200), "k_neighbors": 15, "cell_size": 4096,
                 "regularize_parallelism": False, "regularize_orthogonality": False, "regularize_coplanarity": False,
                 "fixed_directions": [(0, 1, 0)], "symmetry_direction": (0, 0, 2)}
        shapes = tandem.detect_planes(*room(), **given)
        self.assertEqual(shapes.parameters, given)
        self.assertEqual(shapes.minimum_region_size, 200)
        self.assertEqual(len(set(shapes.parallel_groups.tolist())), len(shapes))

    def test_estimates_are_those_of_a_detection(self):
        points = room()[0]
        shapes = tandem.detect_planes(points)
        estimate = tandem.estimate_parameters(points)
        self.assertEqual(estimate.maximum_distance, shapes.maximum_distance)
        self.assertEqual(estimate.maximum_offset, shapes.parameters["maximum_offset"])
        self.assertEqual(estimate.minimum_region_size, shapes.minimum_region_size)

    def test_too_large_an_extent(self):
        with self.assertRaisesRegex(ValueError, "extent"):
            tandem.detect_planes(np.diag([1e9, 1e9, 1e9]).repeat(20, axis=0), maximum_distance=1e-3)


if __name__ == "__main__":
    unittest.main()
