# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges of houses as lines in all formats, and the houses as buildings of CityJSON."""

import collections
import itertools

import numpy as np
import pytest
from support import cases, table, text_of

# Corners of a house with a gable roof, whose faces are convex, counterclockwise as seen from outside
CORNERS = np.array([*itertools.product((0, 4), (0, 3), (0, 2)), (0, 1.5, 3), (4, 1.5, 3)], float)
FACES = [(0, 2, 6, 4), (0, 4, 5, 1), (2, 3, 7, 6), (0, 1, 8, 3, 2), (4, 6, 7, 9, 5), (1, 5, 9, 8), (3, 8, 9, 7)]
FAR = np.array([4.5e5, 5.6e6, 100])
HOUSE = "house.xyz --maximum-distance .02 --minimum-region-size 200"


def points_on(face, step=.05):
    """The centers of squares in a convex polygon, with its outward normal"""
    corners = CORNERS[list(face)]
    along = corners[1] - corners[0]
    normal = np.cross(along, corners[2] - corners[1])
    along, normal = along / np.linalg.norm(along), normal / np.linalg.norm(normal)
    across = np.cross(normal, along)
    steps = np.arange(-6, 6, step) + step / 2
    points = corners[0] + np.array([a * along + b * across for a in steps for b in steps])
    for p, q in zip(corners, np.roll(corners, -1, axis=0)):
        points = points[(points - p) @ np.cross(normal, q - p) > 0]
    return np.hstack([points, np.broadcast_to(normal, points.shape)])


def prepare(p):
    house = np.concatenate([points_on(face) for face in FACES])
    house[:, :3] += FAR
    p.write({"house.xyz": text_of(house), "houses.xyz": text_of(np.concatenate([house, house + (9, 2, 0, 0, 0, 0)])[:, :3])})


def edges():
    """Pairs of corners, and the faces there"""
    faces = collections.defaultdict(set)
    for f, face in enumerate(FACES):
        for p, q in zip(face, face[1:] + face[:1]):
            faces[min(p, q), max(p, q)].add(f)
    return faces


def place_of(point):
    """The corner of the house that is there"""
    distance = np.linalg.norm(CORNERS - (np.array(point) - FAR), axis=1)
    assert distance.min() < 1e-3
    return int(distance.argmin())


def check(lines, corners):
    """Pairs of points and points are the edges and corners of the house, each once."""
    pairs = [tuple(sorted(map(place_of, line))) for line in lines]
    assert sorted(pairs) == sorted(edges())
    assert sorted(map(place_of, corners)) == list(range(10))
    return pairs


@table("more, convex", [("", True), ("--estimate-normals", None),
                        (f"--estimate-normals --viewpoint {FAR[0] + 2},{FAR[1] + 1.5},{FAR[2] + 1}", False)])
def test_geojson(p, more, convex):
    p(0, "shapes +7 in", f"{HOUSE} {more} --lines out.geojson --planes planes --crs EPSG:25832")
    collection, planes = p.json("out.geojson"), p.planes("planes")
    assert collection["crs"]["properties"]["name"] == "EPSG:25832"
    features = collections.defaultdict(list)
    for i, feature in enumerate(collection["features"]):
        assert feature["id"] == i
        features[feature["geometry"]["type"]].append((feature["properties"], feature["geometry"]["coordinates"]))
    lines, corners = features["LineString"], features["Point"]
    check([line for _, line in lines], [corner for _, corner in corners])
    for properties, (first, last) in lines:
        a, b = planes[properties["shapes"], :3]
        assert properties["length"] == pytest.approx(np.linalg.norm(np.subtract(first, last)))
        assert properties["angle"] == pytest.approx(np.degrees(np.arccos(abs(a @ b))))
        assert properties["convex"] is convex
    for properties, corner in corners:
        assert len(properties["shapes"]) == 3
        assert (abs(planes[properties["shapes"]] @ [*corner, 1]) < 1e-8).all()


def test_dxf(p):
    p(0, "shapes +7 in", f"{HOUSE} --lines out.dxf")
    text = p.lines("out.dxf")
    groups = list(zip(map(int, text[::2]), text[1::2]))
    assert len(text) % 2 == 0 and groups[:3] == [(999, "detect_planes of Tandem"), (0, "SECTION"), (2, "ENTITIES")]
    assert groups[-2:] == [(0, "ENDSEC"), (0, "EOF")]
    lines, corners = [], []
    starts = [i for i, (code, _) in enumerate(groups) if code == 0][1:-2]
    for first, last in zip(starts, [*starts[1:], len(groups) - 2]):
        entity = dict(groups[first:last])
        place = [[float(entity[code + i]) for code in (10, 20, 30)] for i in (0, 1) if 10 + i in entity]
        if entity[0] == "LINE":
            assert entity[8] == "LINES"
            lines.append(place)
        else:
            assert (entity[0], entity[8]) == ("POINT", "CORNERS")
            corners += place
    check(lines, corners)


def test_obj(p):
    p(0, "shapes +7 in", f"{HOUSE} --lines out.obj")
    of = collections.defaultdict(list)
    for word, *rest in (line.split() for line in p.lines("out.obj", "^[^#]")):
        of[word].append(rest)
    points = np.array(of["v"], float)
    assert len(points) == 10
    check(points[np.array(of["l"], int) - 1], points[np.array(of["p"], int)[:, 0] - 1])


def check_closed(shell):
    """Each directed edge is there once, and its opposite."""
    directed = [edge for (ring,) in shell for edge in zip(ring, ring[1:] + ring[:1])]
    assert len(set(directed)) == len(directed) and {(q, p) for p, q in directed} == set(directed)


def test_city_json(p):
    p(0, "mesh +14 faces", "houses.xyz --maximum-distance .02 --minimum-region-size 200 --mesh out.city.json "
      "--crs urn:ogc:def:crs:EPSG::25832")
    city = p.json("out.city.json")
    assert (city["type"], city["version"]) == ("CityJSON", "2.0")
    assert city["metadata"] == {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/25832"}
    vertices, transform = np.array(city["vertices"]), city["transform"]
    assert vertices.dtype.kind == "i" and (vertices.min(axis=0) == 0).all() and vertices.max() < 2**31
    assert transform["scale"] == [1e-7] * 3  # the extent is between 10 and 100
    points = vertices * transform["scale"] + transform["translate"]
    assert len(np.unique(vertices, axis=0)) == len(vertices) == 20 and len(city["CityObjects"]) == 2
    used = []
    for building in city["CityObjects"].values():
        assert building["type"] == "Building"
        (solid,) = building["geometry"]
        assert (solid["type"], solid["lod"]) == ("Solid", "2.2")
        (shell,), (values,), surfaces = solid["boundaries"], solid["semantics"]["values"], solid["semantics"]["surfaces"]
        check_closed(shell)
        assert sorted(values) == list(range(len(surfaces))) and len(values) == len(shell)
        kinds = collections.Counter(surfaces[value]["type"] for value in values)
        assert kinds == {"RoofSurface": 2, "WallSurface": 4, "GroundSurface": 1}
        volume = 0
        for (ring,), value in zip(shell, values):
            used += ring
            corners = points[ring] - points[0]
            area = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0) / 2
            volume += corners[0] @ area / 3
            normal = area / np.linalg.norm(area)
            kind = {0: "WallSurface", 1: "RoofSurface", -1: "GroundSurface"}[round(np.sign(normal[2]) * (abs(normal[2]) > .1))]
            assert surfaces[value]["type"] == kind and .5 < surfaces[value]["supported"] <= 1
        assert volume == pytest.approx(4 * 3 * 2.5, abs=1e-3)  # so faces are counterclockwise, seen from outside
    assert set(used) == set(range(20))


def test_cavity(p):
    """A room in a solid is a second shell, and its faces have no meaning."""
    cube = np.concatenate([np.insert(square, side, place, axis=1) for side in range(3) for place in (0, 1)
                           for square in [(np.array(list(itertools.product(range(40), repeat=2))) + .5) / 40]])
    p.write({"cavity.xyz": text_of(np.concatenate([cube, cube * .6 + .2]))})
    p(0, "mesh +12 faces", "cavity.xyz --maximum-distance .004 --mesh cavity.city.json")
    (building,) = p.json("cavity.city.json")["CityObjects"].values()
    (solid,) = building["geometry"]
    assert solid["semantics"]["values"] == [list(range(6)), [None] * 6]
    for shell in solid["boundaries"]:
        check_closed(shell)


test_bad_usage = cases([
    ("lines is 'l.stl', must end in .geojson, .json, .dxf or .obj", "house.xyz --lines l.stl"),
    ("mesh is 'm.json', must end in .off, .obj, .ply or .city.json", "house.xyz --mesh m.json"),
    ("crs is 'Gauss', which CityJSON cannot name; write it like EPSG:25833", "house.xyz --mesh m.city.json --crs Gauss"),
    ("crs needs --polygons or --lines .* or --mesh with .city.json", "house.xyz --lines l.dxf --crs EPSG:25832")],
                       2, absent=["l.stl", "m.json"])
