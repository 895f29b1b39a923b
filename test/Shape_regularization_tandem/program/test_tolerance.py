# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tolerance of each point: --tolerance-column in all formats, --noise, and --maximum-distance auto-local. And points
at 0 0 0, and coordinates that are no longer what was measured."""

import re

import numpy as np
import pytest
from clouds import MAP, as_floats, corridor, sensor_room
from support import BARE, HELP, N, NOTHING, PROGRAM, ROWS, VERTICES, WARNS, cases, pcd, ply, table, text_of

# Of the 1728 points of the cube, 24 have no tolerance, those of an edge have a small one.
POINTS = ROWS[:, :3]
ROW = np.arange(1, N + 1)
SIGMA = np.where(ROW % 72 == 0, np.where(ROW % 144 == 0, -.25, 0), np.where(POINTS[:, 0] > .02, .00390625, .0078125))
SEVEN = np.full((N, 1), 7)
WITH_SIGMA = np.column_stack([POINTS, SIGMA])
WITH_OTHER = text_of(np.column_stack([POINTS, SEVEN, SIGMA]))
EXPECTED = {"minimum": 0.00390625, "maximum": 0.0078125}
BOUND = "--viewpoint 0,0,0"


def prepare(p):
    seen_from = "VIEWPOINT {} 1 0 0 0\n"
    near = [(3, 4 + i / 1e7, j / 1e7) for i in range(40) for j in range(40)]
    p.write({"bare.xyz": text_of(WITH_SIGMA), "plain.xyz": BARE, "near.xyz": text_of(near), "zero.xyz": "0 0 0\n" * 3,
             "named.txt": "x y z scalar_Sigma\n" + text_of(WITH_SIGMA),
             "second.txt": "x y z scalar_Sigma\n" + text_of(WITH_SIGMA + (7, 0, 0, 0)),
             "named.csv": "X,Y,Z,sigma\n" + text_of(WITH_SIGMA, ","),
             "both.txt": "x y z scalar_Sigma sigma\n" + text_of(np.column_stack([WITH_SIGMA, 2 * SIGMA])),
             "cloud.pcd": pcd(WITH_OTHER, "x y z other Sigma").replace("8 8 8 8 8", "8 8 8 4 8").replace(
                 "F F F F F", "F F F U F"),
             "cloud.ply": ply(VERTICES + "property uchar other\nproperty float sigma\n", WITH_OTHER),
             "far.pcd": pcd(more=seen_from.format("0.1 0 0")), "origin.pcd": pcd(more=seen_from.format("0 0 0"))})


def check_tolerances(p, source, expected, ignored, arguments):
    p(0, NOTHING, f"{arguments} --quiet --report t.json")
    report = p.json("t.json")
    found = {name: report["tolerance"][name] for name in ("source", *expected)}
    assert found == {"source": f"column {source}", **expected}
    assert report["counts"]["ignored_tolerances"] == ignored


def test_columns(p):
    for i, arguments in enumerate(["named.txt", "named.csv", "cloud.pcd", "cloud.ply", "bare.xyz --columns 'x y z sigma'"]):
        check_tolerances(p, "sigma", EXPECTED, 24, f"{arguments} --tolerance-column sigma --labels {i}.labels")
        assert p.is_same("0.labels", f"{i}.labels")
    # The same name, or else the first that differs in letters only
    for name, factor in (("sigma", 2), (" SIG_ma", 1)):
        check_tolerances(p, name, {limit: factor * x for limit, x in EXPECTED.items()}, 24,
                         f"both.txt --tolerance-column '{name}'")


def test_inputs_and_bounds(p):
    """More than one input; an upper bound that is less; and what is written of them, read again."""
    check_tolerances(p, "sigma", EXPECTED, 48, "named.csv second.txt --tolerance-column sigma")
    check_tolerances(p, "sigma", {**EXPECTED, "maximum": 0.0048828125}, 24,
                     "cloud.ply --maximum-distance 0.0048828125 --tolerance-column sigma")
    for format in ("ply", "pcd", "xyz", "csv"):
        p(0, NOTHING, f"cloud.ply --tolerance-column sigma --output out.{format} --quiet")
        name = "sigma" if format == "ply" else "tolerance"  # a file of the same format keeps the name
        check_tolerances(p, name, EXPECTED, 24, f"out.{format} --estimate-normals --tolerance-column {name}")


def test_extra_bytes_of_las(p):
    """The shape of each point, as a number, is one more number."""
    p(0, NOTHING, "cloud.ply E --output out.las --quiet")
    check_tolerances(p, "shape", {name: 0.00390625 for name in EXPECTED}, 576,
                     "out.las --tolerance-column shape --maximum-distance 0.00390625")
    p(1, "out.las: has no extra dimension 'sigma', which --tolerance-column names; it has shape",
      "out.las --tolerance-column sigma")


NO_NOISE = ("+", "r - r", "1 2", "r*r*r", "r^", "2*", "1e999", "(r)", "nan", "a + b*r", "r^-1", "2 r 3")
test_options = cases([
    (0, "; ignored: 24 without a tolerance\n.*tolerances  0.003906 to 0.007812, by column sigma\n.*shapes +3 in",
     "cloud.ply --tolerance-column sigma"),
    (1, "cloud.ply: has no property 'si', which --tolerance-column names; it has other, sigma\n",
     "cloud.ply --tolerance-column si"),
    (1, "cloud.pcd: has no field 'error', .* it has x, y, z, other, Sigma\n", "cloud.pcd --tolerance-column error"),
    (1, "named.csv: has no column 'error', .* it has X, Y, Z, sigma\n", "named.csv --tolerance-column error"),
    (1, "named.csv: the column 'z' of --tolerance-column is a coordinate", "named.csv --tolerance-column z"),
    (1, "bare.xyz: has no line of names with .*name the columns by --columns", "bare.xyz --tolerance-column sigma"),
    (2, ": --columns has no 'sigma', which --tolerance-column", "bare.xyz --columns 'x y z _' --tolerance-column sigma"),
    # Noise
    (0, "tolerances  0.00[0-9]* to 0.01[0-9]*, by noise 0.001 . 0.02[*]r\n.*shapes +3 in",
     f"plain.xyz --noise '0.001 + 0.02*r' --viewpoint=-0.02,-0.02,-0.02"),
    # Given normals are oriented, so the place is only that of the sensor.
    (0, "normals given\n.*by noise .001r.2\n", "cube.ply --noise .001r^2 --viewpoint 1,1,1"),
    # Negative noise is none: points beyond a range of .1 are in no shape.
    (0, "; ignored: [0-9]* without a tolerance\n", f"plain.xyz --noise '0.004 - 0.04*r' {BOUND}"),
    # The place of PCD files, if they have one
    (0, "by noise .02r\n", "far.pcd --noise .02r"), (0, "by noise .02r\n", f"origin.pcd --noise .02r {BOUND}"),
    (1, "origin.pcd: the VIEWPOINT is 0 0 0 1 0 0 0, .*; --noise needs that place: pass --viewpoint X,Y,Z", "origin.pcd --noise r"),
    (1, "plain.xyz: does not tell the place of the sensor; --noise needs that place: pass --viewpoint X,Y,Z", "far.pcd plain.xyz --noise r"),
    (2, ": --noise needs the place of the sensor: pass --viewpoint X,Y,Z .0,0,0 if it is the origin.", "plain.xyz --noise r"),
    *((2, f": --noise is '{re.escape(text)}', which .*; it must be a sum of numbers and powers of the range r, as in ",
       f"plain.xyz --noise='{text}' {BOUND}") for text in NO_NOISE),
    # One number, or one for each point
    *((0, "maximum distance [0-9.e-]* .estimated., angle", f"plain.xyz {auto}") for auto in ("", "--maximum-distance auto")),
    (0, "tolerances .* by auto-local\n.*shapes +3 in", "plain.xyz --maximum-distance auto-local"),
    (2, ": --maximum-distance is 'local', must be auto, auto-local or a number; write decimals", "plain.xyz --maximum-distance local"),
    (2, ": --tolerance-column and --noise both give ", f"cloud.ply --tolerance-column sigma --noise r {BOUND}"),
    (2, ": --maximum-distance auto-local and --noise both give ",
     f"cloud.ply --maximum-distance auto-local --noise r {BOUND}"),
    (1, "all points are at 0 0 0, or have coordinates that stand for no value", "zero.xyz --ignore-zeros")])


@table("text, noise", [("2.8e-3r^2+.001", .001 + .0028 * 25), (" r * r * 2.8e-3 - 1e-3 r + -0.05 ", .015), ("R**2", 25),
                       ("r\u00b2 + r^1 + r^0", 31), ("0.5*0.5 r", 1.25), ("1+1", 2)])
def test_noise(p, text, noise):
    """At a range of 5, of which the tolerance is a multiple, as the help tells"""
    multiple = float(re.search("tolerance of each point is ([0-9.]*) times that", re.sub(r"\s+", " ", HELP)).group(1))
    p(WARNS, "", ["near.xyz", "--noise", text, "--viewpoint", "0,0,0", "--report", "t.json", "--quiet"])
    assert multiple > 1 and p.json("t.json")["tolerance"]["minimum"] == pytest.approx(noise * multiple, rel=1e-4)


def test_corridor(p):
    """Noise grows with the square of the range; its shapes are its walls and its end."""
    p.write({"corridor.xyz": text_of(corridor(1))})
    p(0, "shapes +5 in 5 planes of 3 directions", "corridor.xyz --noise '0.0028*r^2' --viewpoint 1,2,3")
    p(0, "estimate +The noise varies from .*[.] Each point has its own tolerance;.*by auto-local.*shapes +5 in 5 planes",
      "corridor.xyz --report t.json")
    assert '"note": "The noise varies' in p.read("t.json")


# --- Coordinates that are none, or no longer what was measured

SENSOR = "--maximum-distance 0.012"
NEAR, FAR, AROUND = (-2, -1, .6), MAP, (-2, -1.5, -1)


@table("corner, zeros", [(FAR, 20), (NEAR, 3000)])
def test_zeros_are_left_out(p, corner, zeros):
    room = sensor_room(corner)
    points = np.insert(room, np.linspace(0, len(room), zeros, dtype=int), 0, axis=0)
    is_zero = (points == 0).all(axis=1)
    p.write({"z.xyz": text_of(points), "others.xyz": text_of(room)})
    p(0, f"; ignored: {zeros} at 0 0 0\n.*shapes +3 in 3 planes", f"z.xyz --ignore-zeros {SENSOR} --report z.json "
      "--labels z.labels --output z.txt --planes z.planes")
    counts = p.json("z.json")["counts"]
    assert (counts["ignored_zeros"], counts["ignored_coordinates"]) == (zeros, 0)
    # They are in no shape, and where they were.
    written = np.loadtxt(p.path("z.txt"))
    assert ((written[:, :3] == 0).all(axis=1) == is_zero).all() and (written[is_zero, -1] == -1).all()
    assert (p.labels("z.labels") == written[:, -1]).all()
    # The others are those of a cloud without them.
    p(0, NOTHING, f"others.xyz {SENSOR} --planes others.planes --quiet")
    assert p.is_same("z.planes", "others.planes")
    p.warns("z.xyz --ignore-zeros")


# Clouds, the tolerance, and the one warning of the coordinates, if there is any
CLOUDS = [
    # Coordinates that went through floats, or streams as they write by default
    (sensor_room(FAR), .02, ""), (as_floats(sensor_room(FAR)), 3, ""),
    (as_floats(sensor_room(FAR)), .02,
     "rounded, x in steps of 0.0625, y in steps of 0.5, while .* is 0.02: use doubles, or subtract an offset"),
    (np.vectorize(lambda x: float(f"{x:.6g}"))(10 * sensor_room((69438.62, 51554.875, 380), 20000)), .1,
     "rounded, x in steps of 1, y in steps of 1, while .*more digits"),
    # Millimeters and copies on a grid are no rounded coordinates.
    (np.round(1000 * sensor_room(NEAR)), 12, ""), (np.round(np.repeat(sensor_room(NEAR)[:900], 8, axis=0), 2), .015, ""),
    (sensor_room((0, 0, 38)) / (400, 300, .1) + (-71.06, 42.36, 0), .1,
     "look like degrees of longitude and latitude .*: first project .* to UTM"),
    # A few points at 0 0 0 far from the others, or many near them
    *((np.concatenate([sensor_room(corner), np.zeros((zeros, 3))]), .02,
       f"{zeros} points are exactly at 0 0 0, like invalid pixels: they are left out" if zeros > least else "")
      for corner, least in ((FAR, 3), (AROUND, 100)) for zeros in (2, 20, 500))]


@table("points, tolerance, pattern", CLOUDS)
def test_coordinates(p, points, tolerance, pattern):
    p.write({"sensor.xyz": text_of(points)})
    err = p.run([PROGRAM, "sensor.xyz", "--maximum-distance", str(tolerance), "--quiet"], {})[2]
    found = re.findall("[^\n]*(?:in steps of|degrees of|at 0 0 0)[^\n]*", err)
    assert len(found) == bool(pattern) and re.search(pattern, "".join(found)), err
