# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""--up and --upright: what is upward of houses and rooms in the frames of surveys, cameras and the earth, and walls and
floors that are exactly so."""

import numpy as np
from support import cases, table, text_of

OPTIONS = "--maximum-distance 0.05 --minimum-region-size 100"
LEAN = np.radians(.4)


def face(center, u, v, noise, rng, per_unit=60):
    """Evenly on the rectangle of the half sides u and v."""
    n = np.cross(u, v)
    count = int(4 * per_unit * np.linalg.norm(n))
    a, b = rng.uniform(-1, 1, (2, count, 1))
    return np.array(center) + a * u + b * v + rng.normal(0, noise, (count, 1)) * n / np.linalg.norm(n)


def house(noise=.004):
    """Ground, walls that lean outwards and a gable roof of 35 degrees whose ridge is along y."""
    rng, s, c, t = np.random.default_rng(3), np.sin(LEAN), np.cos(LEAN), np.tan(np.radians(35))
    faces = [((0, 0, 0), (8, 0, .03), (0, 9, 0))]
    for side in (-1, 1):
        faces += [((4 * side, 0, 2), (0, 6, 0), (2 * side * s, 0, 2 * c)),
                  ((0, 6 * side, 2), (4, 0, 0), (0, 2 * side * s, 2 * c)),
                  ((2 * side, 0, 4 + 2 * t), (0, 6, 0), (2, 0, -2 * side * t))]
    return np.concatenate([face(*np.array(f, float), noise, rng) for f in faces])


def camera_room(pitch):
    """Floor and two walls of a room turned by 30 degrees, seen by a camera that looks down: y is down, z forward."""
    rng, yaw, pitch = np.random.default_rng(4), np.radians(30), np.radians(pitch)
    points = np.concatenate([face(*np.array(f, float), .004, rng) for f in (
        ((0, 1.2, 3), (2, 0, 0), (0, 0, 2)), ((0, 0, 5), (2, 0, 0), (0, 1.2, 0)), ((-2, 0, 3), (0, 0, 2), (0, 1.2, 0)))])
    c, s, d, e = np.cos(yaw), np.sin(yaw), np.cos(pitch), np.sin(pitch)
    turn = np.array([[1, 0, 0], [0, d, -e], [0, e, d]]) @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    return points @ turn.T, (0, -d, -e)


def on_earth(points):
    """At 48 degrees north and 11 degrees east, x is east and y is north; the upward direction."""
    lat, lon, e2 = np.radians(48), np.radians(11), .00669437999014
    up = np.array([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])
    east = np.array([-np.sin(lon), np.cos(lon), 0])
    radius = 6378137 / np.sqrt(1 - e2 * up[2] ** 2)
    return points @ np.array([east, np.cross(up, east), up]) + radius * up * (1, 1, 1 - e2), up


EARTH, EARTH_UP = on_earth(house())


def prepare(p):
    p.write({"house.xyz": text_of(house()), "earth.xyz": text_of(EARTH), "level.xyz": text_of(camera_room(0)[0]),
             "down.xyz": text_of(camera_room(20)[0])})
    x, y = np.random.default_rng(5).uniform(0, 4, (2, 2000))
    p.write({"oblique.xyz": text_of(np.column_stack([x, y, .5 * x + .3 * y]))})


def up_of(p, run, source, pattern=""):
    p(0, f" up +[^\n]*{source}{pattern}", f"{run} {OPTIONS} --report r.json --shapes s.csv")
    up = p.json("r.json")["up"]
    assert up["source"] == source
    return np.array(up["direction"]), up


def degrees_between(a, b):
    return np.degrees(np.arcsin(np.linalg.norm(np.cross(a, b)))) if np.dot(a, b) > 0 else 180


@table("name, expected, tolerance", [
    ("house", (0, 0, 1), 0), ("earth", EARTH_UP, 1e-4), ("level", (0, -1, 0), .2), ("down", camera_room(20)[1], .2)])
def test_found(p, name, expected, tolerance):
    """The same with --upright, which makes walls and floors exactly so, and dips tell."""
    up, facts = up_of(p, f"{name}.xyz", "found", ": of the points in shapes, [0-9]+ % are level and [0-9]+ % upright\n")
    assert degrees_between(up, expected) <= tolerance and facts["seconds"] == 0
    is_house = name in ("house", "earth")
    assert not is_house or not np.isin(p.csv("s.csv")["dip_deg"], [0, 90]).any()
    again, facts = up_of(p, f"{name}.xyz --upright", "found")
    assert again.tolist() == up.tolist() and (facts["seconds"] > 0) != is_house
    csv = p.csv("s.csv")
    dips = csv["dip_deg"]
    roof = dips[(dips > 30) & (dips < 40)]
    assert (dips == 0).sum() == 1 and (dips == 90).sum() == (4 if is_house else 2)
    assert len(dips) == (7 if is_house else 3) and (not is_house or np.ptp(roof) < 1e-9)
    assert csv["highest"][dips == 0].max() < csv["highest"][dips == 90].min()


def test_ambiguous(p):
    assert up_of(p, "oblique.xyz", "assumed", "[^\n]*--up X,Y,Z")[0].tolist() == [0, 0, 1]
    assert up_of(p, "oblique.xyz --upright", "assumed")[0].tolist() == [0, 0, 1]


@table("options, expected, source", [
    ("--up=0,-2,0", [0, -1, 0], "given"), ("--symmetry-direction 0,1,0", [0, 1, 0], "given"),
    ("--up=0,-1,0 --symmetry-direction 0,1,0", [0, -1, 0], "given"),
    ("--up auto --symmetry-direction 0,1,0", [0, 0, 1], "found")])
def test_given(p, options, expected, source):
    assert up_of(p, f"house.xyz {options}", source)[0].tolist() == expected


def test_detection_is_the_same(p):
    """Unless --upright turns shapes."""
    plain = p.hash(f"house.xyz {OPTIONS}")
    p(0, plain, f"house.xyz {OPTIONS} --up 0,1,0")
    assert p.hash(f"house.xyz {OPTIONS} --upright") != plain
    p(0, p.hash(f"house.xyz {OPTIONS} --upright"), f"house.xyz {OPTIONS} --upright --up 0,0,3 --backend sequential")


test_bad_usage = cases([
    ("--up is 'down', must be three numbers .*, or auto", "house.xyz --up down"), ("--up is '0,0,0'", "house.xyz --up 0,0,0"),
    ("--upright is for detected planes", "house.xyz --planes-from s.csv --upright")], 2)
