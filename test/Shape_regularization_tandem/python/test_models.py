# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons and closed surfaces as arrays, what other packages make of them, and pickles of results."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest

import tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room


def wall(with_window=True, gap=0):
    """A wall in the plane x = 2, with a window of 1 by 1 meters, or of two parts."""
    y, z = (c.ravel() for c in np.meshgrid(np.arange(0, 4, 0.05), np.arange(0, 3, 0.05)))
    is_window = (abs(y - 2) < 0.5) & (abs(z - 1.5) < 0.5) & with_window
    return np.stack([np.full(y.size, 2.), y, z], axis=1)[~is_window & (abs(y - 2) >= gap / 2)]


def areas(vertices, triangles):
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return np.cross(b - a, c - a) / 2


def ring_area(ring):
    return np.cross(ring, np.roll(ring, -1, axis=0)).sum(axis=0) / 2


def check_kinds(model):
    """Some packages refuse arrays that cannot be written."""
    for name, array in model._asdict().items():
        if isinstance(array, np.ndarray):
            is_number = name in ("vertices", "face_supported")
            assert array.dtype == (np.float64 if is_number else np.int32), name
            assert array.shape[1:] == ((3,) if name in ("vertices", "triangles") else ()), name
            assert array.flags.writeable and array.flags.c_contiguous


def test_areas_of_polygons():
    shapes, polygons = shapes_of_room(), shapes_of_room().polygons()
    check_kinds(polygons)
    vectors = areas(polygons.vertices, polygons.triangles)
    of_shape = np.zeros((len(shapes), 3))
    np.add.at(of_shape, polygons.triangle_shape, vectors)
    np.testing.assert_allclose((of_shape * shapes.planes[:, :3]).sum(axis=1), shapes.table()["area"], rtol=1e-12)
    assert ((vectors * shapes.planes[polygons.triangle_shape, :3]).sum(axis=1) > 0).all()
    rings = polygons.rings()
    assert len(rings) == len(polygons.polygon_shape) == 6 and polygons.polygon_shape.tolist() == list(range(6))
    for s, loops in enumerate(rings):
        np.testing.assert_allclose(sum(ring_area(loop) for loop in loops), of_shape[s], atol=1e-12)
        for loop in loops:
            np.testing.assert_allclose(loop @ shapes.planes[s, :3] + shapes.planes[s, 3], 0, atol=1e-12)


def test_holes_and_parts():
    shapes = tandem.detect_planes(wall(), maximum_distance=0.02)
    polygons = shapes.polygons()
    [[outer, hole]] = polygons.rings()
    assert polygons.polygon_starts.tolist() == [0, 2] and polygons.loop_starts.tolist()[-1] == len(polygons.loop_vertices)
    normal = shapes.planes[0, :3]
    assert ring_area(outer) @ normal == pytest.approx(12, abs=0.5)
    assert ring_area(hole) @ normal == pytest.approx(-1, abs=0.2)
    parts = tandem.detect_planes(wall(False, gap=0.5), maximum_distance=0.02)
    assert (len(parts), set(parts.coplanar_groups.tolist())) == (2, {0})
    assert parts.polygons().polygon_shape.tolist() == [0, 1]
    joined = parts.polygons(one_for_each_plane=True)
    assert joined.polygon_shape.tolist() == [0, 0] and set(joined.triangle_shape.tolist()) == {0}
    assert np.abs(areas(joined.vertices, joined.triangles)[:, 0]).sum() == pytest.approx(sum(parts.table()["area"]))


def check_closed(surface):
    """Each directed edge is there once, and so is its opposite: of triangles and of faces."""
    faces = np.split(surface.face_vertices, surface.face_starts[1:-1])
    for cycles in (surface.triangles, faces):
        edges = [edge for cycle in cycles for edge in zip(cycle.tolist(), np.roll(cycle, -1).tolist())]
        assert len(set(edges)) == len(edges) and {(b, a) for a, b in edges} == set(edges)
    for f, face in enumerate(faces):
        own = surface.triangles[surface.triangle_face == f]
        assert len(own) == len(face) - 2 and set(own.ravel()) == set(face)


def volume(surface):
    a, b, c = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    return (a * np.cross(b, c)).sum() / 6


def test_closed_surface():
    shapes, surface = shapes_of_room(), shapes_of_room().closed_surface()
    check_kinds(surface)
    check_closed(surface)
    assert volume(surface) == pytest.approx(4 * 3 * 2.5, rel=0.01)
    assert (len(surface.vertices), sorted(surface.face_plane.tolist())) == (8, list(range(6)))
    np.testing.assert_allclose(areas(surface.vertices, surface.triangles).sum(axis=0), 0, atol=1e-12)
    assert 0.9 < surface.supported <= 1 and (surface.face_supported > 0.9).all()
    assert surface.number_of_planes == 6 and 0.99 < surface.number_of_points / (shapes.labels >= 0).sum() <= 1
    order = np.random.default_rng(1).permutation(len(room()[0]))
    points = room()[0][order]
    shuffled = tandem.detect_planes(points, room()[1][order], maximum_distance=MAXIMUM_DISTANCE).closed_surface()
    for one, other in zip(surface, shuffled):
        np.testing.assert_array_equal(one, other)


def test_arguments_of_surfaces():
    shapes = shapes_of_room()
    assert shapes.closed_surface(maximum_number_of_planes=10**12, maximum_number_of_components=1).number_of_planes == 6
    assert shapes.closed_surface(maximum_number_of_planes=5).number_of_planes == 5
    for error, given in ((tandem.ParameterError, {"maximum_number_of_planes": 3}),
                         (tandem.ParameterError, {"maximum_number_of_planes": -10**12}),
                         (tandem.ParameterError, {"maximum_number_of_components": -1}),
                         (ValueError, {"symmetry_direction": (0, 0, 0)}), (ValueError, {"symmetry_direction": (0, 1)}),
                         (TypeError, {"maximum_number_of_planes": 4.5})):
        with pytest.raises(error, match=f"^{next(iter(given))}"):
            shapes.closed_surface(**given)


def roof():
    """Two sides of a roof over 10 x 8, the ridge at 9, the eaves at 6"""
    x, y = (c.ravel() for c in np.meshgrid(np.arange(.1, 10, .2), np.arange(.1, 8, .2)))
    return np.stack([x, y, 9 - .75 * abs(y - 4) + .01 * np.sin(9 * x + 7 * y)], axis=1)


def test_ground():
    shapes = tandem.detect_planes(roof(), maximum_distance=0.05)
    rectangle = [(0, 0), (10, 0), (10, 8), (0, 8)]
    for arguments, expected in (({"base_height": 0}, 600), ({"base_height": 0, "footprints": [[rectangle]]}, 600),
                                ({"footprints": [[rectangle, [(2, 2), (2, 4), (4, 4), (4, 2)]]]}, 120 - 9)):
        surface = shapes.closed_surface(**arguments)
        check_closed(surface)
        assert volume(surface) == pytest.approx(expected, rel=.06)
    with pytest.raises(ValueError, match="shape"):
        shapes.closed_surface(footprints=[[[(0, 0, 0), (1, 0, 0), (0, 1, 0)]]])
    with pytest.raises(ValueError, match="footprints.*three corners"):
        shapes.closed_surface(footprints=[[[(0, 0), (1, 1), (1, 0), (0, 1)]]])
    with pytest.raises(tandem.ParameterError, match="base_height"):
        shapes.closed_surface(base_height=np.nan)


def test_lines():
    shapes = shapes_of_room()
    lines = shapes.lines()
    check_kinds(lines._replace(segments=lines.corners, segment_shapes=lines.corners))
    assert lines.segments.shape == lines.segment_shapes.shape == (12, 2) and len(lines.corners) == 8
    for shape in lines.segment_shapes.T:
        for end in lines.segments.T:
            planes = shapes.planes[shape]
            assert (abs((planes[:, :3] * lines.vertices[end]).sum(axis=1) + planes[:, 3]) < 1e-9).all()
    assert (np.diff(lines.corner_starts) == 3).all()
    assert shapes.upward_direction() == (0, 0, 1)


def test_without_shapes():
    with pytest.warns(tandem.TandemWarning, match="no shape was found"):
        shapes = tandem.detect_planes(np.zeros((3, 3)), maximum_distance=1)
    polygons, surface = shapes.polygons(), shapes.closed_surface()
    for model in (polygons, surface):
        check_kinds(model)
        assert len(model.vertices) == len(model.triangles) == 0
    assert polygons.rings() == [] and surface.face_starts.tolist() == [0] and surface.supported == 0


def test_points_that_have_changed():
    points = room()[0].copy()
    shapes = tandem.detect_planes(points, room()[1], maximum_distance=MAXIMUM_DISTANCE)
    points += 1
    for function in (shapes.table, shapes.polygons, shapes.closed_surface,
                     lambda: tandem.select_shapes(shapes, minimum_area=1)):
        with pytest.raises(ValueError, match="^points were changed after the detection"):
            function()


# --- The lines of the manual


def test_trimesh():
    trimesh = pytest.importorskip("trimesh")
    surface = shapes_of_room().closed_surface()
    mesh = trimesh.Trimesh(surface.vertices, surface.triangles, process=False)
    assert mesh.is_watertight and mesh.volume == pytest.approx(volume(surface))


def test_open3d():
    open3d = pytest.importorskip("open3d")
    surface, u = shapes_of_room().closed_surface(), open3d.utility
    mesh = open3d.geometry.TriangleMesh(u.Vector3dVector(surface.vertices), u.Vector3iVector(surface.triangles))
    assert mesh.is_watertight() and mesh.get_volume() == pytest.approx(volume(surface))


def test_shapely():
    geometry = pytest.importorskip("shapely.geometry")
    rings = tandem.detect_planes(wall()[:, [1, 2, 0]], maximum_distance=0.02).polygons().rings()
    [polygon] = [geometry.Polygon(outer[:, :2], [hole[:, :2] for hole in holes]) for outer, *holes in rings]
    assert polygon.is_valid and len(polygon.interiors) == 1 and polygon.area == pytest.approx(11, abs=0.5)


# --- Pickles


def check_equal(one, other):
    if isinstance(one, dict):
        assert one.keys() == other.keys()
        for name in one:
            check_equal(one[name], other[name])
    else:
        np.testing.assert_array_equal(one, other)


def test_pickles_and_copies():
    points, normals = room()
    some = dict(normals=normals, maximum_distance_map=np.full(len(points), MAXIMUM_DISTANCE),
                fixed_directions=[(0, 0, 1)], symmetry_direction=(0, 0, 1))
    zeros = np.concatenate([points, np.zeros((9, 3))])
    for shapes, cloud in ((shapes_of_room(), points), (tandem.detect_planes(points, **some), points),
                          (tandem.detect_planes(zeros, ignore_zeros=True), zeros),
                          (tandem.select_shapes(shapes_of_room(), [3, 1]), points)):
        for again in (pickle.loads(pickle.dumps(shapes)), copy.copy(shapes), copy.deepcopy(shapes)):
            assert again.hash == shapes.hash and again is not shapes and repr(again) == repr(shapes)
            for name in dir(shapes):
                if not name.startswith("_") and not callable(getattr(shapes, name)):
                    check_equal(getattr(again, name), getattr(shapes, name))
            check_equal(again.table(), shapes.table())
            check_equal(again.points_of(1), shapes.points_of(1))
            check_equal(again.polygons()._asdict(), shapes.polygons()._asdict())
            assert tandem.find_violation(cloud, again) is None
            assert tandem.select_shapes(again, largest=1).hash == tandem.select_shapes(shapes, largest=1).hash
            check_equal(tandem.label_points(again, points), tandem.label_points(shapes, points))
    for model in (shapes.polygons(), shapes.closed_surface()):
        again = pickle.loads(pickle.dumps(model))
        assert type(again) is type(model)
        check_equal(again._asdict(), model._asdict())


def test_another_process_and_refused_pickles(tmp_path):
    code = """import pickle, sys
shapes = pickle.load(open(sys.argv[1], "rb"))
print(shapes.hash, len(shapes.polygons().triangles), len(shapes.closed_surface().triangles))"""
    (tmp_path / "shapes").write_bytes(pickle.dumps(shapes_of_room()))
    other = subprocess.run([sys.executable, "-c", code, tmp_path / "shapes"], stdout=subprocess.PIPE, check=True, text=True)
    assert other.stdout.split() == [str(shapes_of_room().hash), str(len(shapes_of_room().polygons().triangles)), "12"]
    make, (version, data, points, *others) = shapes_of_room().__reduce__()
    for state, why in ((("0.1.0", data, points, *others), "a pickle of tandem 0.1.0"),
                       ((version, data[:-1], points, *others), "incomplete"), ((version, b"", points, *others), "incomplete"),
                       ((version, data + b" ", points, *others), "9150 points"),
                       ((version, data, points[1:], *others), "9149 points")):
        with pytest.raises(ValueError, match=why):
            make(*state)
