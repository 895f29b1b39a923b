# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of --shapes beside the labels and planes of the same run, on faces of known place and size; coplanar shapes as
one; and the name of the labels in clouds."""

import re

import numpy as np
from support import NOTHING, WARNS, cases, table, text_of

STEP, COLUMNS, ROWS = 0.1, 41, 21
LENGTH, WIDTH = STEP * (COLUMNS - 1), STEP * (ROWS - 1)
# The center of each face, the axes of its length and width, tilt and azimuth. Two are parts of one floor.
FACES = [((0, 0, 0), (1, 0, 0), (0, 1, 0), 0, 0), ((6, 0, 0), (1, 0, 0), (0, 1, 0), 0, 0),
         ((0, 5, 3), (1, 0, 0), (0, 0, 1), 90, 180), ((0, 10, 5), (0, 1, 0), (-np.sqrt(.75), 0, .5), 30, 90)]
NAMES = ("shape points a b c d x y z area length width lowest highest tilt_deg dip_deg azimuth_deg rms_distance "
         "mean_distance turned_deg shifted curved class noise offset_deviation angle_deviation_deg parallel_group "
         "coplanar_group").split()
RUN = "faces.xyz --maximum-distance 0.01 --minimum-region-size 100 --quiet"


def points_and_normals():
    i, j = (a.ravel() for a in np.mgrid[:COLUMNS, :ROWS])
    noise = 0.001 * ((7 * i + 5 * j) % 11 - 5) / 5
    a, b = STEP * (i - (COLUMNS - 1) / 2), STEP * (j - (ROWS - 1) / 2)
    for center, u, v, _, _ in FACES:
        n = np.cross(u, v)
        yield np.column_stack([center + np.outer(a, u) + np.outer(b, v) + np.outer(noise, n), np.tile(n, (len(i), 1))])


CLOUD = np.concatenate(list(points_and_normals()))


def prepare(p):
    p.write({"faces.xyz": text_of(CLOUD)})
    p(0, NOTHING, f"{RUN} --labels plain.labels")
    for kind in ("ply", "pcd", "txt", "csv", "las"):
        p(0, NOTHING, f"{RUN} --output plain.{kind}")


@table("number, option", [(4, ""), (4, "--oriented"), (3, "--by-plane")])
def test_table(p, number, option):
    p(0, NOTHING, f"{RUN} --shapes t.csv --labels t.labels --planes t.planes --polygons t.geojson {option}")
    csv, labels, planes = p.csv("t.csv"), p.labels("t.labels"), p.planes("t.planes")
    assert p.lines("t.csv")[0].split(",") == NAMES
    assert len(csv) == len(planes) == labels.max() + 1 == number
    assert csv["shape"].tolist() == list(range(number))
    assert np.column_stack([csv[name] for name in "abcd"]).tolist() == planes.tolist()
    for row, plane in zip(csv, planes):
        is_own = labels == row["shape"]
        check_points(row, CLOUD[is_own, :3], plane)
        check_face(row, np.unique(np.flatnonzero(is_own) // (COLUMNS * ROWS)))
    assert len(set(csv["coplanar_group"][csv["dip_deg"] < 1])) == 1 and len(set(csv["parallel_group"])) == 3
    # The features of GeoJSON have the same rows.
    features = [feature["properties"] for feature in p.json("t.geojson")["features"]]
    assert features == [{**{name: row[name] for name in NAMES if name not in "abcd"}, "plane": plane.tolist()}
                        for row, plane in zip(csv, planes)]


def check_points(row, points, plane):
    heights = points @ plane[:3] + plane[3]
    squares = (heights ** 2).sum()
    for name, expected, tolerance in [
            ("points", len(points), 0), *zip("xyz", points.mean(axis=0), [1e-12] * 3),
            ("rms_distance", np.sqrt(squares / len(points)), 1e-12), ("mean_distance", abs(heights).mean(), 1e-12),
            ("noise", np.sqrt(squares / (len(points) - 3)), 1e-5), ("lowest", points[:, 2].min(), 0),
            ("highest", points[:, 2].max(), 0)]:
        assert abs(row[name] - expected) <= tolerance, name


def check_face(row, faces):
    center, _, _, tilt, azimuth = FACES[faces[0]]
    far = FACES[faces[-1]][0][0] - center[0]  # from one part of the floor to the other
    for name, expected, tolerance in [
            ("length", LENGTH + far, 1e-2), ("width", WIDTH, 1e-2), ("area", len(faces) * LENGTH * WIDTH, 0.05),
            ("tilt_deg", tilt, 0.05), ("dip_deg", tilt, 0.05), ("turned_deg", 0, 0.1), ("shifted", 0, 1e-3),
            ("angle_deviation_deg", 0, 0.1), *([("azimuth_deg", azimuth, 0.05)] if tilt > 0 else [])]:
        assert abs(row[name] - expected) <= tolerance, name


def test_coplanar_shapes_as_one(p):
    p(0, NOTHING, f"{RUN} --by-plane --report t.json --vg t.vg --polygons t.geojson --output t.txt")
    assert p.lines("t.vg", "num_groups") == ["num_groups: 3"] and len(p.lines("t.geojson", '"id": [012],')) == 3
    assert set(np.loadtxt(p.path("t.txt"))[:, -1]) - {-1} == {0, 1, 2}
    counts = p.json("t.json")["counts"]
    assert counts["shapes"] == counts["planes"] == 3


def test_tables_of_other_runs(p):
    p(1, "cannot be written", "faces.xyz --shapes missing/a.csv")
    p(WARNS, "", "faces.xyz --maximum-distance 0.01 --minimum-region-size 3000 --quiet --shapes none.csv")
    assert re.fullmatch("shape,points,a,[^\n]*,coplanar_group\n", p.read("none.csv"))
    # Upward is the symmetry direction: the roof is level then.
    p(0, NOTHING, f"{RUN} --symmetry-direction=0.5,0,0.8660254037844386 --shapes up.csv")
    assert np.count_nonzero(p.csv("up.csv")["tilt_deg"] < 0.1) == 1


@table("kind", ["ply", "pcd", "txt", "csv", "las"])
def test_name_of_the_labels(p, kind):
    """They are the same, and the file can be read again."""
    p(0, NOTHING, f"{RUN} --output named.{kind} --label-property Plane_id9")
    named = p.path(f"named.{kind}").read_bytes()
    assert b"Plane_id9" in named[:1000]
    if kind != "las":  # whose names have a fixed size
        assert named.replace(b"Plane_id9", b"shape") == p.path(f"plain.{kind}").read_bytes()
    p(0, NOTHING, f"{RUN} --labels again.labels".replace("faces.xyz", f"named.{kind}"))
    assert kind == "las" or p.is_same("plain.labels", "again.labels")


test_refused_before_the_cloud_is_read = cases([(pattern, f"missing.ply {arguments}") for pattern, arguments in (
    *((f"--label-property is '{name}', must be letters, digits and _, a letter first, at most 32",
       f"--output a.ply --label-property '{name}'")
       for name in ("a b", "a-b", "9a", "_a", "ä", "abcdefghijklmnopqrstuvwxyz1234567")),
    *((f"--label-property is '{name}', a name that clouds use for other data",
       f"--output a.ply --label-property {name}")
      for name in ("x", "NX", "normal_x", "Red", "rgb", "scalar_Intensity", "classification", "tolerance", "gps_time")),
    ("--label-property needs --output or --output-directory", "--label-property a"),
    ("--shapes is 'a.txt', must end in .csv", "--shapes a.txt"))], 2, absent=["a.ply"])
