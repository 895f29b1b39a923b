# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What detect_planes writes for other programs of a wall with a window, a second wall flush with it, and a floor, turned
and far from the origin: vertex groups to the bit, and the same areas as faces in all formats."""

import re

import numpy as np
import pytest
from support import WARNS, table, text_of

SCENE = "scene.xyz --maximum-distance .03 --minimum-region-size 200"
TURN = np.array([[.8, .6, 0], [-.6, .8, 0], [0, 0, 1]])
FAR = (4.5e5, 0, 0)
STEP = 4.5e5 * 2**-52


def prepare(p):
    rng = np.random.default_rng(3)
    wall, beside, floor = (rng.random((n, 3)) * size + corner for n, size, corner in (
        (6000, (4, .01, 3), (0, 0, 0)), (1500, (2, .01, 1.5), (5, 0, 0)), (5000, (4, 2.5, .01), (0, .1, 0))))
    wall = wall[~is_in_window(wall, 0)]
    points = np.concatenate([wall, beside, floor]) @ TURN + FAR
    normals = np.repeat([(1.2, -1.6, 0), (0, 0, 1)], [len(wall) + len(beside), len(floor)], axis=0)  # outward, not unit
    rows = text_of(np.column_stack([points, normals]))
    p.write({"scene.xyz": "x y z nx ny nz\nnan 0 0 0 0 1\n" + rows})
    p(WARNS, "shapes +3 in 2 planes", f"{SCENE} --labels labels --oriented --planes planes --report report --polygons "
      "a.geojson --output out.xyz")


def is_in_window(points, margin):
    x, z = points[:, 0], points[:, 2]
    return (x > 1.5 + margin) & (x < 2.5 - margin) & (z > 1 + margin) & (z < 2 - margin)


@pytest.fixture(scope="module")
def cloud(p):
    """Points, unit normals and labels, without the point that has no place; and the planes."""
    rows = np.loadtxt(p.path("out.xyz"))[1:]
    normals = rows[:, 3:6] / np.linalg.norm(rows[:, 3:6], axis=1, keepdims=True)
    return rows[:, :3], normals, p.labels("labels")[1:], p.planes("planes")


@table("more, groups", [("", [[0], [1], [2]]), ("--vg-by-plane", None)])
def test_vertex_groups(p, cloud, more, groups):
    points, normals, labels, planes = cloud
    groups = groups or p.json("report")["relations"]["coplanar_groups"]
    p(WARNS, "shapes +3", f"{SCENE} --vg a.vg {more}")
    words = re.split(r"(\w+):", p.read("a.vg"))
    file = [(key, values.split()) for key, values in zip(words[1::2], words[2::2])]
    (_, written), (_, colors), (_, vectors) = file[:3]
    assert int(written[0]) == int(vectors[0]) == len(points) and colors == ["0"]
    assert (np.array(written[1:], float).reshape(-1, 3) == points).all()
    assert np.allclose(np.array(vectors[1:], float).reshape(-1, 3), normals, atol=2e-4)
    assert file[3] == ("num_groups", [str(len(groups))]) and len(file) == 4 + 7 * len(groups)
    for i, group in enumerate(groups):
        entry = dict(file[4 + 7 * i:11 + 7 * i])
        assert (entry["group_type"], entry["num_group_parameters"], entry["num_children"]) == (["0"], ["4"], ["0"])
        assert (np.array(entry["group_parameters"], float) == planes[group[0]]).all() and entry["group_label"]
        assert all(0 <= float(c) <= 1 for c in entry["group_color"]) and len(entry["group_color"]) == 3
        count, *members = map(int, entry["group_num_points"])
        assert count == len(members) and sorted(members) == np.flatnonzero(np.isin(labels, group)).tolist()


def obj(text):
    vertices, faces, shape = [], [], -1
    for word, *rest in (line.split() for line in text.decode().splitlines()):
        shape += word == "g"
        if word == "v":
            vertices.append([float(x) for x in rest])
        elif word == "f":
            faces.append((shape, [int(i) - 1 for i in rest]))
    return vertices, faces


def off(text):
    """The shapes by their colors, in the order of the faces."""
    lines = [line.split() for line in text.decode().splitlines() if not line.startswith("#")]
    count, faces, colors = int(lines[1][0]), [], {}
    assert lines[0] == ["OFF"] and len(lines) == 2 + count + int(lines[1][1])
    for n, *rest in lines[2 + count:]:
        assert len(rest) == int(n) + 3
        faces.append((colors.setdefault(tuple(rest[int(n):]), len(colors)), [int(i) for i in rest[:int(n)]]))
    return [[float(x) for x in line] for line in lines[2:2 + count]], faces


def binary_ply(text):
    header, body = text.split(b"end_header\n", 1)
    vertices, faces = (int(n) for n in re.findall(rb"element \w+ (\d+)", header))
    size = "u1" if b"list uchar int" in header else "<i4"
    result, place = [], 24 * vertices
    for _ in range(faces):
        n = int(np.frombuffer(body, size, 1, place)[0])
        place += np.dtype(size).itemsize
        result.append((int(np.frombuffer(body, "<i4", 1, place + 4 * n + 3)[0]),
                       np.frombuffer(body, "<i4", n, place).tolist()))
        place += 4 * n + 7
    assert place == len(body)
    return np.frombuffer(body, "<f8", 3 * vertices).reshape(-1, 3).tolist(), result


@table("more", ["", "--triangulate"])
def test_faces_are_the_same_in_all_formats(p, cloud, more):
    planes = cloud[3]
    meshes = []
    for name, reader in (("a.obj", obj), ("a.off", off), ("a.ply", binary_ply)):
        p(WARNS, "shapes +3 in", f"{SCENE} --oriented --polygons {name} {more}")
        meshes.append(reader(p.path(name).read_bytes()))
    assert meshes[0] == meshes[1] == meshes[2]
    areas, vertices = np.zeros(3), np.array(meshes[0][0])
    for shape, face in meshes[0][1]:
        corners, (*normal, offset) = vertices[face], planes[shape]
        assert (np.abs(corners @ normal + offset) < 2 * STEP).all()
        vectors = corners - corners[0]
        areas[shape] += np.cross(vectors[1:-1], vectors[2:]).sum(axis=0) @ normal / 2
        if more:
            place = (corners.mean(axis=0, keepdims=True) - FAR) @ TURN.T
            assert place[0, 1] > .05 or not is_in_window(place, .15)[0], "a triangle in the window"
    features = p.json("a.geojson")["features"]
    assert np.allclose(areas, [feature["properties"]["area"] for feature in features])
    # The wall beside, the floor, and the wall less its window
    assert np.allclose(sorted(areas), [3, 10, 11], rtol=.07)
    # Borders are straightened: a point about every 5 cm would have made some 300 edges.
    for feature in features:
        assert 4 <= sum(len(ring) - 1 for polygon in feature["geometry"]["coordinates"] for ring in polygon) < 160
