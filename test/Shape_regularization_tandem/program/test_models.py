# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons and vertex groups for other programs, of a wall with a window, a second wall flush with it, and a floor, turned
and far from the origin: the same areas as faces in all formats; and closed surfaces by the cells that the planes cut."""

import itertools
import json
import re

import numpy as np
import pytest
from support import EPSILON, PROGRAM, ROWS, WARNS, cases, table, text_of, words_of

SCENE = "scene.xyz --maximum-distance .03 --minimum-region-size 200"
TURN = np.array([[.8, .6, 0], [-.6, .8, 0], [0, 0, 1]])
FAR = (4.5e5, 0, 0)
STEP = 4.5e5 * 2**-52


def box(n):
    """Centers of n by n fields of the faces of the unit cube"""
    steps = (np.arange(n) + .5) / n
    a, b = np.array(list(itertools.product(steps, steps))).T
    return np.concatenate([np.insert(np.stack([a, b], axis=1), side, k, axis=1) for side in range(3) for k in (0, 1)])


def is_in_window(points, margin):
    x, z = points[:, 0], points[:, 2]
    return (x > 1.5 + margin) & (x < 2.5 - margin) & (z > 1 + margin) & (z < 2 - margin)


def scene():
    rng = np.random.default_rng(3)
    wall, beside, floor = (rng.random((n, 3)) * size + corner for n, size, corner in (
        (6000, (4, .01, 3), (0, 0, 0)), (1500, (2, .01, 1.5), (5, 0, 0)), (5000, (4, 2.5, .01), (0, .1, 0))))
    wall = wall[~is_in_window(wall, 0)]
    normals = np.repeat([(1.2, -1.6, 0), (0, 0, 1)], [len(wall) + len(beside), len(floor)], axis=0)  # outward, not unit
    return text_of(np.column_stack([np.concatenate([wall, beside, floor]) @ TURN + FAR, normals]))


def prepare(p):
    # Two boxes apart from each other, 1 by 1 by 1 and 1 by 1 by 2, without normals
    boxes = np.concatenate([box(40), box(40) * (1, 1, 2) + (2, .4, .3)])
    # The unit cube, and points on a line, whose normals make a plane of them
    normals = np.repeat(np.concatenate([np.insert([0, 0], s, k)[None] for s in range(3) for k in (-1, 1)]), 900, axis=0)
    line = np.array([(3, .5, i / 100, 1, 0, 0) for i in range(400)])
    # Four small planes far above each other
    tower = np.array([(i / 30, j / 30, 10 * k) for i in range(30) for j in range(30) for k in range(4)])
    # Nine boxes along a diagonal, whose lids have points on a part only. Each face is on a plane, and so the lid of the
    # box in the middle.
    lids = box(20)
    lids = lids[(lids[:, 2] < 1) | (lids[:, 0] < .4) | (lids[:, :2] % 1 == 0).any(axis=1)]
    p.write({"boxes.xyz": text_of(boxes), "line.xyz": text_of(np.concatenate([np.column_stack([box(30), normals]), line])),
             "tower.xyz": text_of(tower), "row.xyz": text_of(np.concatenate([lids + 2 * m for m in range(9)])),
             "few.xyz": "".join(f"{i} {j} 0\n" for i in range(4) for j in range(3)),
             "scene.xyz": "x y z nx ny nz\nnan 0 0 0 0 1\n" + scene()})
    p(WARNS, "shapes +3 in 2 planes", f"{SCENE} --labels labels --oriented --planes planes --report report --polygons "
      "a.geojson --output out.xyz")


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
        kind, number, parameters, label, color, members, children = (values for _, values in file[4 + 7 * i:11 + 7 * i])
        assert (kind, number, len(label), len(color), children) == (["0"], ["4"], 1, 3, ["0"])
        assert (np.array(parameters, float) == planes[group[0]]).all() and all(0 <= float(c) <= 1 for c in color)
        members = np.array(members, int)
        assert members[0] == len(members) - 1 and sorted(members[1:]) == np.flatnonzero(np.isin(labels, group)).tolist()


def obj(text):
    vertices, faces, shape = [], [], -1
    for word, *rest in (line.split() for line in text.decode().splitlines()):
        shape += word == "g"
        if word == "v":
            vertices.append([float(x) for x in rest])
        elif word == "f":
            faces.append((shape, [int(i) - 1 for i in rest]))
    return vertices, faces


def off(text, colors=3):
    """The shapes by their colors, in the order of the faces."""
    lines = [line.split() for line in text.decode().splitlines() if not line.startswith("#")]
    count, faces, shapes = int(lines[1][0]), [], {}
    assert lines[0] == ["OFF"] and len(lines) == 2 + count + int(lines[1][1])
    for n, *rest in lines[2 + count:]:
        assert len(rest) == int(n) + colors
        faces.append((shapes.setdefault(tuple(rest[int(n):]), len(shapes)), [int(i) for i in rest[:int(n)]]))
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


def area_of(feature):
    """Of rings: they are counterclockwise as seen from above, and upright ones about the normal of their plane."""
    normal, area = np.array(feature["properties"]["plane"][:3]), 0
    for ring in itertools.chain(*feature["geometry"]["coordinates"]):
        corners = np.array(ring) - ring[0]
        assert ring[0] == ring[-1]
        area += np.cross(corners[:-1], corners[1:]).sum(axis=0) @ normal / 2
    return -area if normal[2] < -1e-9 else area


@table("arguments, polygons",
       [("cube.ply E --oriented", [1, 1, 1]), (f"{SCENE} --oriented", None), (f"{SCENE} --triangulate", None)])
def test_polygons(p, arguments, polygons):
    """Each face of the cube is one square without holes: five corners with the first one again."""
    p.run([PROGRAM, *words_of(f"{arguments} --polygons out.geojson")], {})
    collection = p.json("out.geojson")
    assert collection["type"] == "FeatureCollection"
    for i, feature in enumerate(collection["features"]):
        assert feature["properties"]["shape"] == i
        assert area_of(feature) == pytest.approx(feature["properties"]["area"], rel=1e-6)
    assert polygons in (None, [len(feature["geometry"]["coordinates"]) for feature in collection["features"]])


def test_polygons_of_other_formats(p):
    # Shapes share their corners: three faces of a cube have seven.
    p(0, "shapes +3 in", "cube.ply E --polygons out.off")
    assert p.lines("out.off")[2] == "7 3 0"
    # The name of the coordinate reference system, as it is given
    p(0, "shapes +3 in", "cube.ply E --polygons named.json --crs urn:ogc:def:crs:EPSG::25833")
    assert '"crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25833"}}' in p.read("named.json")
    # Shapes without a polygon are counted.
    p.warns("few.xyz --maximum-distance .1 --minimum-region-size 10 --polygons few.json",
            "1 of 1 shapes has too few points for an outline")


@table("exponent", [-520, 520])
def test_units(p, exponent):
    """In units whose squares, and even areas, are no doubles, polygons are the same, and no number is none but for these."""
    rows, unit = ROWS.copy(), 2. ** exponent
    rows[:, :3] *= unit
    p.write({"unit.xyz": text_of(ROWS), "scaled.xyz": text_of(rows)})
    places = []
    for name, factor in (("unit", 1), ("scaled", unit)):
        p(0, "shapes +3 in", f"{name}.xyz --maximum-distance {EPSILON * factor:.17g} --polygons {name}.json --vg {name}.vg")
        assert not re.search("nan|inf", p.read(f"{name}.vg"))
        features = p.json(f"{name}.json")["features"]
        assert "null" not in re.sub('"area":null', "", p.read(f"{name}.json")) and len(features) == 3
        places.append(np.array([feature["geometry"]["coordinates"] for feature in features]) / factor)
    assert (places[0] == places[1]).all()


test_bad_usage = cases([
    ("crs needs --polygons or --lines with a name that ends in .geojson or .json", "cube.ply --polygons out.ply --crs EPSG:25833"),
    ("triangulate needs --polygons", "cube.ply --triangulate"), ("mesh-planes needs --mesh", "cube.ply --mesh-planes 10"),
    ("mesh-components needs --mesh", "cube.ply --mesh-components 1"),
    ("base needs --mesh", "cube.ply --base 0"), ("footprint needs --mesh", "cube.ply --footprint f.geojson"),
    *((f"base is '{base}', must be a height or ground", f"cube.ply --mesh m.off --base {base}") for base in ("low", "nan")),
    ("footprint is seen along z, so --up must be 0,0,1", "cube.ply --mesh m.off --footprint f.geojson --up 0,1,0"),
    ("mesh-components is '0', must be all or a whole number", "missing.ply --mesh m.off --mesh-components 0"),
    ("mesh-seconds needs --mesh", "cube.ply --mesh-seconds 9"),
    ("mesh-planes is 3, allowed is .4, 2147483647.", "missing.ply --mesh m.off --mesh-planes 3"),
    ("mesh-seconds is 0, must be positive", "missing.ply --mesh m.off --mesh-seconds 0"),
    ("mesh is 'm.stl', must end in .off, .obj, .ply or .city.json", "missing.ply --mesh m.stl")], 2, absent=["m.off", "m.stl"])


def volume(points, faces):
    """Positive if the faces are counterclockwise, seen from outside"""
    return sum(points[f[0]] @ np.cross(points[b], points[c]) for f in faces for b, c in zip(f[1:], f[2:])) / 6


@table("name, planes, more, counts, expected", [
    # One face for each side, whatever the partition cuts it into
    ("boxes", 12, "E", (16, 12), 3), ("row", 54, "E", None, 9),
    # The plane of points on a line is left out.
    ("line", 7, "--maximum-distance 0.01", (8, 6), 1)])
def test_closed_surface(p, name, planes, more, counts, expected):
    p(0, f"in {planes} planes", f"{name}.xyz {more} --mesh {name}.off --planes planes.txt")
    points, faces = off(p.path(f"{name}.off").read_bytes(), colors=0)
    points, faces = np.array(points), [face for _, face in faces]
    assert counts in (None, (len(points), len(faces))) and volume(points, faces) == pytest.approx(expected, abs=.005)
    heights = points @ p.planes("planes.txt")[:, :3].T + p.planes("planes.txt")[:, 3]
    assert all((abs(heights[face]) <= 1e-6).all(axis=0).any() for face in faces), "a face is on no plane"


def test_parts_of_a_surface(p):
    """The largest component of two; and in PLY, how much of each face has points."""
    p(0, r"mesh +6 faces, of 6 of 12 planes, with 50 % of the points of shapes; \d+ % of its area has points", "boxes.xyz E --mesh one.ply --mesh-components 1")
    p(0, r"mesh +12 faces", "boxes.xyz E --mesh all.ply --mesh-components all")
    lines = p.lines("one.ply")
    assert "property double supported" in lines
    shares = [float(line.split()[-1]) for line in lines[-6:]]
    assert all(.5 < share <= 1 for share in shares)


def roofs():
    """Of two houses, without walls and ground"""
    x, y = (a.ravel() for a in np.meshgrid(np.arange(.1, 10, .2), np.arange(.1, 8, .2)))
    gable = np.column_stack([x, y, 9 - .75 * abs(y - 4) + .01 * np.sin(9 * x + 7 * y)])
    return np.vstack([gable, gable + [20, 0, -1]])


def test_ground(p):
    """Roofs are closed down to a base, and there is one solid for each footprint."""
    p.path("roofs.xyz").write_text("\n".join(" ".join(map(str, q)) for q in roofs()))
    square = [[[0, 0], [10, 0], [10, 8], [0, 8], [0, 0]]]
    feature = {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": square}}
    p.path("one.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    detect = "roofs.xyz --maximum-distance .05 --mesh roofs.off"
    for option, expected in {"--base 0": 1120, "--base ground": 320, "--footprint one.geojson --base 0": 600}.items():
        p(0, "mesh ", f"{detect} {option}")
        points, faces = off(p.path("roofs.off").read_bytes(), colors=0)
        assert volume(np.array(points), [face for _, face in faces]) == pytest.approx(expected, rel=.06), option
    p.path("bad.geojson").write_text('{"type": "Point", "coordinates": [1, 2]}')
    p(1, "--footprint bad.geojson: has no polygons", f"{detect} --footprint bad.geojson")
    p(1, "--footprint roofs.xyz: is no GeoJSON: .*parse error", f"{detect} --footprint roofs.xyz")
    # Ground that was scanned is no part of the model.
    x, y = (a.ravel() for a in np.meshgrid(np.arange(-10, 40, .4), np.arange(-10, 20, .4)))
    ground = np.column_stack([x, y, .01 * np.sin(9 * x + 7 * y)])
    p.path("roofs.xyz").write_text("\n".join(" ".join(map(str, q)) for q in np.vstack([roofs(), ground])))
    for base in ("0", "ground"):
        p(0, "mesh ", f"{detect} --base {base}")
        points, faces = off(p.path("roofs.off").read_bytes(), colors=0)
        assert volume(np.array(points), [face for _, face in faces]) == pytest.approx(1120, rel=.06)
    p(1, r"is --base below the roofs\?", f"{detect} --base 100")
    p(1, "--mesh: there is no surface within 1e-06 seconds; pass a larger number to --mesh-seconds; the other files are complete",
      f"{detect} --planes p.txt --mesh-seconds 1e-6")
    p(0, "mesh .* on the ground at 0;", f"{detect} --base 0 --mesh-seconds 1000")


OTHERS = {"planes": "planes", "labels": "labels", "output": "ply", "report": "json", "vg": "vg", "polygons": "obj"}


def test_no_closed_surface(p):
    """What is done is kept where there is no surface: all other outputs are complete."""
    p(1, r"shapes .*a closed surface needs four planes, but there are 3; --base HEIGHT closes roofs\n\Z", "cube.ply E --mesh open.off")
    p(1, r"shapes .*no volume was found that 4 planes enclose; --base HEIGHT closes roofs; the other files are complete\n\Z",
      "tower.xyz E --mesh open.off " + " ".join(f"--{option} open.{name}" for option, name in OTHERS.items()))
    assert not p.has("open.off") and all(p.path(f"open.{name}").stat().st_size > 0 for name in OTHERS.values())
