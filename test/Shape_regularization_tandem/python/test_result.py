# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result has, and that its arrays are views."""

import copy
import copyreg
import gc
import pickle
import unittest

import numpy as np

import tandem
from tandem import _tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room


class Guarantees(unittest.TestCase):
    def test_faces_and_relations(self):
        shapes = shapes_of_room()
        self.assertEqual((len(shapes), shapes.planes.shape), (6, (6, 4)))
        self.assertEqual(len(set(shapes.parallel_groups.tolist())), 3)
        self.assertEqual(sorted(shapes.coplanar_groups.tolist()), list(range(6)))
        self.assertEqual(shapes.orthogonal_pairs.tolist(), [[0, 1], [0, 2], [1, 2]])

    def test_points_are_near_their_planes(self):
        points, normals = room()
        shapes = shapes_of_room()
        has_shape = shapes.labels >= 0
        self.assertGreater(has_shape.mean(), 0.9)
        planes = shapes.planes[shapes.labels[has_shape]]
        distances = np.abs((planes[:, :3] * points[has_shape]).sum(axis=1) + planes[:, 3])
        self.assertLessEqual(distances.max(), MAXIMUM_DISTANCE * (1 + 1e-12))
        self.assertEqual(shapes.maximum_distance, MAXIMUM_DISTANCE)
        unit = normals[has_shape] / np.linalg.norm(normals[has_shape], axis=1)[:, None]
        cosines = np.abs((planes[:, :3] * unit).sum(axis=1))
        self.assertGreaterEqual(cosines.min(), np.cos(np.radians(shapes.parameters["maximum_angle"])) - 1e-12)

    def test_relations_are_exact(self):
        shapes = shapes_of_room()
        directions = {}
        for plane, group in zip(shapes.planes, shapes.parallel_groups):
            self.assertEqual(plane[:3].tobytes(), directions.setdefault(group, plane[:3]).tobytes())
            self.assertAlmostEqual(np.linalg.norm(plane[:3]), 1, places=14)
        for first, second in shapes.orthogonal_pairs:
            self.assertLessEqual(abs(directions[first] @ directions[second]), 1e-15)

    def test_uncertainties(self):
        points = room()[0]
        shapes = shapes_of_room()
        u = shapes.uncertainties
        for s, plane in enumerate(shapes.planes):
            own = points[shapes.points_of(s)]
            np.testing.assert_allclose(u["centroid"][s], own.mean(axis=0), atol=1e-3 * MAXIMUM_DISTANCE)
            noise = np.sqrt(((own @ plane[:3] + plane[3]) ** 2).sum() / (len(own) - 3))
            self.assertAlmostEqual(u["noise"][s], noise, delta=5e-3 * MAXIMUM_DISTANCE)
            self.assertAlmostEqual(u["offset_deviation"][s], u["noise"][s] / np.sqrt(len(own)))
            covariance = u["normal_covariance"][s]
            np.testing.assert_allclose(covariance @ plane[:3], 0, atol=1e-12 * np.trace(covariance))
            self.assertAlmostEqual(u["angle_deg"][s], np.degrees(np.sqrt(np.linalg.eigvalsh(covariance)[2])))

    def test_free_points(self):
        shapes = shapes_of_room()
        reasons = dict(shapes.statistics["free_points"])
        total = reasons.pop("total")
        self.assertEqual((total, sum(reasons.values())), (np.count_nonzero(shapes.labels == -1),) * 2)
        self.assertEqual(list(reasons), ["without_normal", "misfit", "without_neighbors", "in_small_regions", "clutter",
                                         "unselected"])

    def test_a_note_on_a_cosine(self):
        points, normals = room()
        shapes = tandem.detect_planes(points, normals, maximum_angle=0.9)
        expected = "maximum_angle is 0.9 degrees: if that was meant as a cosine, pass 25.8"
        self.assertEqual(shapes.statistics["angle_note"], expected)
        self.assertEqual(shapes_of_room().statistics["angle_note"], "")

    def test_points_of_shapes(self):
        shapes = shapes_of_room()
        for s in range(len(shapes)):
            self.assertEqual(shapes.points_of(s).tolist(), np.flatnonzero(shapes.labels == s).tolist())
            self.assertGreaterEqual(len(shapes.points_of(s)), shapes.minimum_region_size)
        self.assertEqual(shapes.points_of(-1).tolist(), shapes.points_of(5).tolist())
        for wrong in (6, -7):
            self.assertRaises(IndexError, shapes.points_of, wrong)

    def test_orientation(self):
        points, normals = room()
        shapes = shapes_of_room()
        oriented = np.where(shapes.is_flipped[:, None], -shapes.planes, shapes.planes)
        for s, plane in enumerate(oriented):
            self.assertGreater((normals[shapes.points_of(s)] @ plane[:3]).mean(), 0.9)

    def test_violations_are_found(self):
        points = room()[0]
        self.assertIsNone(tandem.find_violation(points, shapes_of_room()))
        moved = points.copy()
        moved[shapes_of_room().points_of(2)[0]] += 1
        self.assertIn("too far from its plane", tandem.find_violation(moved, shapes_of_room()))
        with self.assertRaisesRegex(ValueError, "^points has"):
            tandem.find_violation(points[1:], shapes_of_room())
        self.assertRaises(TypeError, tandem.find_violation, points, None)

    def test_estimated_normals(self):
        points = room()[0]
        shapes = tandem.detect_planes(points, maximum_distance=MAXIMUM_DISTANCE)
        self.assertTrue(shapes.statistics["has_estimated_normals"])
        self.assertEqual(shapes.normals.shape, points.shape)
        np.testing.assert_allclose(np.linalg.norm(shapes.normals, axis=1), 1, atol=1e-6)
        self.assertIsNone(tandem.find_violation(points, shapes))
        self.assertNotEqual(shapes.hash, shapes_of_room().hash)


class Objects(unittest.TestCase):
    def test_they_come_from_functions_only(self):
        class Derived(tandem.PlanarShapes):
            def __new__(cls):
                return tandem.PlanarShapes.__new__(cls)

        for made in (tandem.PlanarShapes, type(_tandem.default_settings())):
            for make in (made, lambda: made.__new__(made), lambda: made.__mro__[1].__new__(made), Derived,
                         lambda: object.__new__(made), lambda: copyreg.__newobj__(made)):
                with self.subTest(made=made), self.assertRaises(TypeError):
                    make()

    def test_they_are_not_copied(self):
        for function in (copy.copy, copy.deepcopy, pickle.dumps):
            self.assertRaises(TypeError, function, shapes_of_room())


class Views(unittest.TestCase):
    names = ("planes", "labels", "parallel_groups", "coplanar_groups", "orthogonal_pairs", "is_flipped", "normals")

    def test_estimated_normals_are_one(self):
        shapes = tandem.detect_planes(room()[0], maximum_distance=MAXIMUM_DISTANCE)
        self.assertTrue(np.shares_memory(shapes.normals, shapes.normals))
        self.assertIs(shapes.normals.base, shapes)
        self.assertRaises(ValueError, shapes.normals.setflags, write=True)

    def arrays(self, shapes):
        return [getattr(shapes, name) for name in self.names] + [shapes.points_of(0)]

    def test_read_only(self):
        for array in self.arrays(shapes_of_room()):
            self.assertFalse(array.flags.writeable)
            with self.assertRaisesRegex(ValueError, "read-only"):
                array[0] = 0
            self.assertRaises(ValueError, array.setflags, write=True)

    def test_no_copies(self):
        for first, second in zip(self.arrays(shapes_of_room()), self.arrays(shapes_of_room())):
            self.assertTrue(np.shares_memory(first, second))

    def test_types(self):
        kinds = [(array.dtype.str, array.ndim) for array in self.arrays(shapes_of_room())]
        self.assertEqual(kinds, [("<f8", 2), ("<i4", 1), ("<i4", 1), ("<i4", 1), ("<i4", 2), ("|b1", 1), ("<f8", 2),
                                 ("<u4", 1)])

    def test_they_outlive_the_result(self):
        shapes = tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE)
        arrays = self.arrays(shapes)
        self.assertTrue(all(array.base is shapes for array in arrays))
        copies = [array.copy() for array in arrays]
        del shapes
        gc.collect()
        tandem.detect_planes(*room(), maximum_distance=2 * MAXIMUM_DISTANCE)  # takes freed memory
        for array, copy in zip(arrays, copies):
            np.testing.assert_array_equal(array, copy)

    def test_text(self):
        self.assertRegex(repr(shapes_of_room()),
                         r"^<tandem.PlanarShapes: 6 shapes, 3 directions, 6 planes, \d+ of 9150 points>$")
        self.assertRegex(tandem.__version__, r"^\d+\.\d+\.\d+$")
        self.assertRegex(tandem.detect_planes.__doc__, r"points +\(n, 3\) numbers")
        self.assertIn("(m, 4) float64", tandem.PlanarShapes.planes.__doc__)


class Regularization(unittest.TestCase):
    def test_planes_of_another_detector(self):
        points = room()[0]
        labels = shapes_of_room().labels
        planes = []
        for s in range(6):
            part = points[labels == s]
            normal = np.linalg.svd(part - part.mean(axis=0), full_matrices=False)[2][2]
            planes.append([*normal, -normal @ part.mean(axis=0)])
        given = np.array(planes)
        relations = tandem.regularize_planes(points, labels, given, maximum_angle=5, maximum_offset=0.02)
        self.assertEqual(given.tolist(), np.array(planes).tolist())
        self.assertTrue(relations.is_changed.all() and not relations.is_rolled_back.any())
        self.assertEqual(len(set(relations.parallel_groups.tolist())), 3)
        self.assertEqual(relations.orthogonal_pairs.tolist(), [[0, 1], [0, 2], [1, 2]])
        apart = tandem.regularize_planes(points, labels, given, maximum_angle=5, maximum_offset=0.02, regularity=0)
        self.assertEqual(len(set(apart.parallel_groups.tolist())), 6)
        normals = relations.planes[:, :3]
        for s in range(6):
            for t in range(6):
                same = relations.parallel_groups[s] == relations.parallel_groups[t]
                dot = abs(normals[s] @ normals[t])
                self.assertTrue(abs(dot - 1) < 1e-14 if same else dot <= 1e-15)
        self.assertLess(relations.angles.max(), 5)
        self.assertLess(relations.largest_distances.max(), 0.1)
        self.assertGreater(relations.maximum_distance, 0)

    def test_unit_normals(self):
        """Related planes have unit normals, all others stay as they are."""
        random = np.random.default_rng(3)
        counts = {True: 0, False: 0}
        for _ in range(200):
            m = random.integers(1, 7)
            frame = np.linalg.qr(random.standard_normal((3, 3)))[0] if random.random() < .5 else np.eye(3)
            points, labels, planes = [np.zeros((0, 3))], [], []
            for s in range(m):
                normal = np.eye(3)[random.integers(3)] + random.choice([0, 0, .02, .5]) * random.standard_normal(3)
                normal = frame @ normal / np.linalg.norm(normal)
                n, offset = random.choice([0, 2, 3, 40, 40]), random.integers(3) * random.choice([.005, 1])
                points.append(offset * normal + random.random((n, 2)) @ np.linalg.svd(normal[None])[2][1:])
                labels += n * [s]
                planes.append(random.choice([1, 2, -3, 1e-200, 1e200, 0, np.nan]) * np.array([*normal, -offset]))
            planes = np.array(planes)
            given = {"fixed_directions": [frame[2]]} if random.random() < .3 else {}
            r = tandem.regularize_planes(np.concatenate(points), np.array(labels, int), planes,
                                         maximum_angle=random.choice([2, 10]), **given)
            paired = {g for pair in r.orthogonal_pairs.tolist() for g in pair}
            for s, group in enumerate(r.parallel_groups.tolist()):
                is_related = group in paired or (r.parallel_groups == group).sum() > 1
                if is_related or r.is_changed[s]:
                    self.assertAlmostEqual(np.linalg.norm(r.planes[s, :3]), 1, places=14)
                if not r.is_changed[s]:
                    self.assertEqual(r.planes[s].tobytes(), planes[s].tobytes())
                counts[is_related] += 1
        self.assertGreater(min(counts.values()), 100)

    def test_masked_arguments(self):
        points = np.ma.array([[x, y, 0.] for x in range(4) for y in range(4)])
        points[3, 1] = np.ma.masked
        labels = np.ma.zeros(16, np.uint64)
        labels[[2, 5]] = np.ma.masked
        points.data[2] = 1e3  # belongs to no plane
        relations = tandem.regularize_planes(points, labels, np.ma.array([[0, 0, 2, 0]]))
        self.assertEqual(relations.largest_distances.tolist(), [0])
        planes = np.ma.array([[0, 0, 1, 0], [1, 0, 0, 0]], mask=[4 * [False], [True, False, False, False]])
        relations = tandem.regularize_planes(points, labels, planes)
        self.assertTrue(np.isnan(relations.planes[1, 0]))
        self.assertEqual((relations.is_changed.tolist(), len(relations.orthogonal_pairs)), ([False, False], 0))

    def test_errors(self):
        points, labels, planes = np.zeros((4, 3)), [0, 0, 0, -1], [[0, 0, 1, 0]]
        self.assertEqual(tandem.regularize_planes(points, labels, planes).planes.tolist(), planes)
        self.assertEqual(len(tandem.regularize_planes(points, [-1] * 4, np.zeros((0, 4))).planes), 0)
        for arguments, name in (((points, labels[1:], planes), "labels"), ((points, [0, 0, 0, 1], planes), "labels"),
                                ((points, [0, 0, 0, -2], planes), "labels"), ((points, [0.5] * 4, planes), "labels"),
                                ((points, labels, [[0, 0, 1]]), "planes"), ((points[0], labels, planes), "points")):
            with self.subTest(name=name), self.assertRaisesRegex(ValueError, f"^{name}"):
                tandem.regularize_planes(*arguments)
        with self.assertRaisesRegex(ValueError, "^maximum_angle is 50"):
            tandem.regularize_planes(points, labels, planes, maximum_angle=50)


class GivenDirections(unittest.TestCase):
    def test_vertical(self):
        shapes = tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE, fixed_directions=[(0, 0, 3)])
        self.assertEqual(sorted(shapes.fixed_directions.tolist()), [-1, -1, 0])
        horizontal = shapes.fixed_directions[shapes.parallel_groups] == 0
        self.assertEqual(np.abs(shapes.planes[horizontal, :3]).tolist(), [[0, 0, 1], [0, 0, 1]])
        self.assertLessEqual(np.abs(shapes.planes[~horizontal, 2]).max(), 1e-15)
        self.assertEqual(shapes.symmetry_groups.tolist(), [-1, -1, -1])
        self.assertEqual(shapes.parameters["fixed_directions"], [(0, 0, 3)])
        self.assertIsNone(tandem.find_violation(room()[0], shapes))

    def test_axis_of_symmetry(self):
        shapes = tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE, symmetry_direction=(0, 0, 1))
        self.assertEqual(sorted(shapes.symmetry_groups.tolist()), [0, 0, 1])
        self.assertEqual(shapes.parameters["symmetry_direction"], (0, 0, 1))
        with self.assertRaisesRegex(ValueError, "^symmetry_direction"):
            tandem.detect_planes(room()[0], symmetry_direction=(0, 0))
        with self.assertRaisesRegex(ValueError, r"^fixed_directions\[0\] is \(0, 0, 0\)"):
            tandem.detect_planes(room()[0], fixed_directions=np.zeros((1, 3)))


if __name__ == "__main__":
    unittest.main()
