# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Outlines of the shapes, and closed surfaces by the cells that the planes cut."""

import itertools

import numpy as np
import pytest
from support import table, text_of


def square(n):
    """Centers of n by n fields of the unit square."""
    steps = (np.arange(n) + .5) / n
    return np.array(list(itertools.product(steps, steps)))


def faces(n, side):
    """Two opposite faces of the unit cube."""
    a, b = square(n).T
    return [np.insert(np.stack([a, b], axis=1), side, k, axis=1) for k in (0, 1)]


def box(n):
    return np.concatenate([face for side in range(3) for face in faces(n, side)])


def prepare(p):
    # Two boxes apart from each other, 1 by 1 by 1 and 1 by 1 by 2, without normals
    boxes = np.concatenate([box(40), box(40) * (1, 1, 2) + (2, .4, .3)])
    # The unit cube, and points on a line, whose normals make a plane of them
    normals = np.concatenate([np.tile(np.insert([0, 0], side, 2 * k - 1), (900, 1)) for side in range(3) for k in (0, 1)])
    line = np.array([(3, .5, i / 100, 1, 0, 0) for i in range(400)])
    # Four small planes far above each other
    tower = np.array([(i / 30, j / 30, 10 * k) for i in range(30) for j in range(30) for k in range(4)])
    # Nine boxes along a diagonal, whose lids have points on a part only. Each face is on a plane, and so the lid of the
    # box in the middle.
    lids = box(20)
    lids = lids[(lids[:, 2] < 1) | (lids[:, 0] < .4) | (lids[:, :2] % 1 == 0).any(axis=1)]
    row = np.concatenate([lids + 2 * m for m in range(9)])
    p.write({"boxes.xyz": text_of(boxes), "line.xyz": text_of(np.concatenate([np.column_stack([box(30), normals]), line])),
             "tower.xyz": text_of(tower), "row.xyz": text_of(row),
             "few.xyz": "".join(f"{i} {j} 0\n" for i in range(4) for j in range(3))})
    p(0, "shapes +3 in", "cube.ply E --polygons out.geojson")


def mesh(p, name):
    lines = p.lines(name)
    n = int(lines[1].split()[0])
    return (lines[1], np.array([line.split() for line in lines[2:2 + n]], float),
            [[int(word) for word in line.split()[1:]] for line in lines[2 + n:]])


def volume(points, faces):
    """Positive if the faces are counterclockwise, seen from outside"""
    return sum(points[f[0]] @ np.cross(points[b], points[c]) for f in faces for b, c in zip(f[1:], f[2:])) / 6


def test_polygons(p):
    """Each face of the cube is one square without holes: five corners with the first one again."""
    collection = p.json("out.geojson")
    assert collection["type"] == "FeatureCollection" and len(collection["features"]) == 3
    for i, feature in enumerate(collection["features"]):
        assert feature["properties"]["shape"] == i
        (ring,), = feature["geometry"]["coordinates"]
        assert ring[0] == ring[-1]
        # Rings are counterclockwise as seen from above, and upright ones about the normal of their plane.
        corners, normal = np.array(ring) - ring[0], np.array(feature["properties"]["plane"][:3])
        area = np.cross(corners[:-1], corners[1:]).sum(axis=0)
        assert area[2] > 0 if normal[2] ** 2 > 1e-18 else area @ normal > 0


def test_polygons_of_other_formats(p):
    p(0, "shapes +3 in", "cube.ply E --polygons out.obj --triangulate")
    assert all(len(line.split()) == 4 for line in p.lines("out.obj", "^f "))
    # Shapes share their corners: three faces of a cube have seven.
    p(0, "shapes +3 in", "cube.ply E --polygons out.off")
    assert p.lines("out.off")[2] == "7 3 0"
    # The name of the coordinate reference system, as it is given
    p(0, "shapes +3 in", "cube.ply E --polygons named.json --crs urn:ogc:def:crs:EPSG::25833")
    assert '"crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25833"}}' in p.read("named.json")
    # Shapes without a polygon are counted.
    p.warns("few.xyz --maximum-distance .1 --minimum-region-size 10 --polygons few.json",
            "1 of 1 shapes cover too few points for an outline")


@table("pattern, arguments", [
    ("crs needs --polygons with a name that ends in .geojson or .json",
     "cube.ply --polygons out.ply --crs EPSG:25833"),
    ("triangulate needs --polygons", "cube.ply --triangulate"),
    ("mesh-planes needs --mesh", "cube.ply --mesh-planes 10"),
    ("mesh-planes is 3, must be in .4, 1000.", "cube.ply --mesh m.off --mesh-planes 3"),
    ("mesh-planes is 1001, must be in .4, 1000.", "missing.ply --mesh m.off --mesh-planes 1001"),
    ("mesh is 'm.stl', must end in .off, .obj or .ply", "missing.ply --mesh m.stl"),
    ("named twice", "cube.ply --mesh m.ply --polygons m.ply")])
def test_bad_usage(p, pattern, arguments):
    p(2, pattern, arguments)


@table("name, planes, more, counts, expected", [
    # One face for each side, whatever the partition cuts it into
    ("boxes", 12, "E", "16 12 0", 3), ("row", 54, "E", None, 9),
    # The plane of points on a line is left out.
    ("line", 7, "--maximum-distance 0.01", "8 6 0", 1)])
def test_closed_surface(p, name, planes, more, counts, expected):
    p(0, f"in {planes} planes", f"{name}.xyz {more} --mesh {name}.off --planes planes.txt")
    found, points, faces = mesh(p, f"{name}.off")
    assert (counts is None or found == counts) and volume(points, faces) == pytest.approx(expected, abs=.005)
    heights = points @ p.planes("planes.txt")[:, :3].T + p.planes("planes.txt")[:, 3]
    assert all((abs(heights[face]) <= 1e-6).all(axis=0).any() for face in faces), "a face is on no plane"


OTHERS = ["planes", "labels", "ply", "json", "vg", "obj"]


@table("message, arguments", [
    ("no volume was found that 4 planes enclose", "tower.xyz E"),
    ("a closed surface needs four planes, and there are 3", "cube.ply E")])  # three planes have no inside
def test_no_closed_surface(p, message, arguments):
    """What is done is kept where there is no surface: all other outputs are complete."""
    p(1, rf"shapes .*{message}\n\Z", f"{arguments} --mesh open.off")
    options = dict(zip(OTHERS, ["planes", "labels", "output", "report", "vg", "polygons"]))
    p(1, rf"shapes .*{message}; the other files are complete\n\Z",
      f"{arguments} --mesh open.off " + " ".join(f"--{option} open.{name}" for name, option in options.items()))
    for name in OTHERS:
        assert p.path(f"open.{name}").stat().st_size > 0
        p.path(f"open.{name}").unlink()
    assert not p.has("open.off", "m.off", "m.stl")
