# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the place of a scanner tells: veils of mixed pixels become free, and shapes that it saw through a window have that
shape as `behind`. Also of two scans in one PTX file."""

import numpy as np
import pytest
from support import NOTHING, table, text_of

STATIONS = np.array([[0, 0, 0], [5, 11, 0.5]])
STEP = 0.01  # radians
COLUMNS, ROWS = np.meshgrid(np.arange(-45, 46), np.arange(-30, 31))
OPTIONS = "--maximum-distance 0.02 --minimum-region-size 40 --quiet"


def seen_from(station, seed):
    """What a scanner sees that looks along x: a window at 2, of which every other ray returns, before a room that ends at
    5, and beside the window a wall at 4; between both, two columns of pixels have any range. The points, and which of these
    parts they are of: 0 to 3."""
    random = np.random.default_rng(seed)
    azimuth, elevation = STEP * COLUMNS.ravel(), STEP * ROWS.ravel()
    rays = np.stack([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)], 1)
    column = COLUMNS.ravel()
    part = np.where(column >= 5, 2, np.where(column >= 3, 3, np.where((column + ROWS.ravel()) % 2 == 0, 0, 1)))
    depth = np.choose(part, [2., 5., 4., 0.]) / rays[:, 0]
    depth[part == 3] = random.uniform(2.1, 3.9, np.count_nonzero(part == 3))
    return rays * (depth + random.normal(0, 0.002, len(depth)))[:, None] + station, part


SCANS = [seen_from(station, seed) for seed, station in enumerate(STATIONS)]
POINTS, PARTS = np.concatenate([scan[0] for scan in SCANS]), np.concatenate([scan[1] for scan in SCANS])


def ptx(scans):
    """An empty pixel, and the points from where the scanner is."""
    text = ""
    for (points, _), station in zip(scans, STATIONS):
        place = "{} {} {}\n".format(*station)
        text += f"{len(points) + 1}\n1\n{place}1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n{place[:-1]} 1\n0 0 0 0\n"
        text += text_of(np.column_stack([points - station, np.zeros(len(points))]))
    return text


def prepare(p):
    p.write({"one.ptx": ptx(SCANS[:1]), "two.ptx": ptx(SCANS), "one.xyz": text_of(SCANS[0][0]), "two.xyz": text_of(POINTS)})


def check(p, parts):
    """No shape is of mixed pixels, and that which is behind another one is the room behind the window."""
    labels, behind = p.labels("l.bin"), p.csv("s.csv")["behind"]
    assert np.count_nonzero(labels[parts == 3] >= 0) < 0.05 * np.count_nonzero(parts == 3)
    part_of_shape = [np.bincount(parts[labels == s]).argmax() for s in range(len(behind))]
    assert {0, 1, 2} <= set(part_of_shape)
    for part, other in zip(part_of_shape, behind):
        assert (part == 1) == (other >= 0)
        assert part != 1 or part_of_shape[other] == 0


OUTPUTS = "--labels l.bin --shapes s.csv --report r.json"


@table("arguments, parts", [("one.xyz --viewpoint 0,0,0", SCANS[0][1]), ("one.ptx", SCANS[0][1]), ("two.ptx", PARTS)])
def test_stations(p, arguments, parts):
    p(0, NOTHING, f"{arguments} {OPTIONS} {OUTPUTS}")
    check(p, parts)
    veils = p.json("r.json")["veils"]
    assert veils["shapes"] > 0 and veils["points"] > 40 and p.json("r.json")["free"]["unselected"] == veils["points"]
    text = p(0, "", f"{arguments} {OPTIONS.replace(' --quiet', '')}")
    assert f"{veils['points']} points are free\n" in text
    # A shape that is not selected has no number: the window is small.
    for least, expected in ((0.001, set(p.csv("s.csv")["behind"]) - {-1} | {None}), (1.5, {None})):
        p(0, NOTHING, f"{arguments} {OPTIONS} --minimum-area {least} --polygons p.geojson")
        assert {feature["properties"]["behind"] for feature in p.json("p.geojson")["features"]} == expected


def test_unknown_place(p):
    """Without a place, and of one that is too far away to be that of a sensor, the veils are shapes."""
    for place in ("", "--viewpoint 0,0,1000 --oriented"):
        p(0, NOTHING, f"one.xyz {OPTIONS} {OUTPUTS} {place}")
        assert "behind" not in p.csv("s.csv").dtype.names and p.json("r.json")["veils"] == {"shapes": 0, "points": 0}
        assert np.count_nonzero(p.labels("l.bin")[SCANS[0][1] == 3] >= 0) > 40


@table("height", [400, 2000])
def test_walls_from_above(p, height):
    """A place above a tile is no sensor that saw the walls: they have more points than it has rays there."""
    random = np.random.default_rng(height)
    walls = [np.c_[20 + 45 * k + random.uniform(0, 15, 150), 50 + random.normal(0, 0.03, 150), random.uniform(0, 9, 150)]
             for k in range(4)]
    ground = np.c_[random.uniform(0, 200, (9000, 2)), random.normal(0, 0.03, 9000)]
    p.write({"tile.xyz": text_of(np.concatenate([ground, *walls]))})
    p(0, NOTHING, f"tile.xyz --maximum-distance 0.15 --minimum-region-size 60 --quiet --viewpoint 100,50,{height} --report r.json")
    assert p.json("r.json")["veils"]["shapes"] == 0 and p.json("r.json")["counts"]["shapes"] >= 5


def test_sensor_in_plane(p):
    """Nothing is behind a window in whose plane the sensor is."""
    p(0, NOTHING, f"one.xyz {OPTIONS} --viewpoint 2,0.03,0 --polygons p.geojson")
    assert {feature["properties"]["behind"] for feature in p.json("p.geojson")["features"]} == {None}


def test_only_veils(p):
    """Where most shapes would be veils, the place is not that of the sensor."""
    p.write({"veil.xyz": text_of(SCANS[0][0][SCANS[0][1] == 3])})
    p(0, NOTHING, f"veil.xyz {OPTIONS} --viewpoint 0,0,0 --report r.json")
    assert p.json("r.json")["veils"]["shapes"] == 0 and p.json("r.json")["counts"]["shapes"] > 0


def test_noise_of_each_station(p):
    """The tolerances are those of the distances from the own station."""
    p(0, NOTHING, "two.ptx --noise 0.001*r --maximum-distance 0.1 --minimum-region-size 40 --quiet --output o.xyz --report r.json")
    ranges = np.concatenate([np.linalg.norm(points - station, axis=1) for (points, _), station in zip(SCANS, STATIONS)])
    tolerance = p.json("r.json")["tolerance"]
    assert tolerance["minimum"] == pytest.approx(0.0025 * ranges.min(), rel=1e-6)
    assert tolerance["maximum"] == pytest.approx(0.0025 * ranges.max(), rel=1e-6)


def test_sides_of_each_station(p):
    """Planes look to their own stations, which are on different sides of the room at 5 of the first one."""
    p(0, "towards the viewpoint\n +scans +2, 2 pixels", "two.ptx --maximum-distance 0.02 --minimum-region-size 40 "
      "--oriented --planes p.txt --labels l.bin")
    labels, station = p.labels("l.bin"), np.repeat([0, 1], len(PARTS) // 2)
    for s, plane in enumerate(p.planes("p.txt")):
        place = STATIONS[np.bincount(station[labels == s]).argmax()]
        assert plane[:3] @ place + plane[3] > 0
