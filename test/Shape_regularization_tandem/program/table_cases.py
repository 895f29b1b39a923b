# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A cloud of faces of known place and size, and the table of its shapes beside labels and planes.

table_cases.py make                                      x y z nx ny nz, on standard output
table_cases.py check CLOUD TABLE LABELS PLANES NUMBER    what is wrong with a table of NUMBER shapes
table_cases.py features TABLE GEOJSON                    the number of features, and those that are no rows of the table
"""

import csv
import json
import math
import struct
import sys

STEP, COLUMNS, ROWS = 0.1, 41, 21
LENGTH, WIDTH = STEP * (COLUMNS - 1), STEP * (ROWS - 1)
# The center of each face, the axes of its length and width, tilt and azimuth. Two are parts of one floor.
HALF, ROOT = 0.5, math.sqrt(0.75)
FACES = [((0, 0, 0), (1, 0, 0), (0, 1, 0), 0, 0), ((6, 0, 0), (1, 0, 0), (0, 1, 0), 0, 0),
         ((0, 5, 3), (1, 0, 0), (0, 0, 1), 90, 180), ((0, 10, 5), (0, 1, 0), (-ROOT, 0, HALF), 30, 90)]
NAMES = ("shape points a b c d x y z area length width lowest highest tilt_deg dip_deg azimuth_deg rms_distance "
         "mean_distance turned_deg shifted noise offset_deviation angle_deviation_deg parallel_group "
         "coplanar_group").split()


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def make():
    for center, u, v, _, _ in FACES:
        n = cross(u, v)
        for i in range(COLUMNS):
            for j in range(ROWS):
                noise = 0.001 * ((7 * i + 5 * j) % 11 - 5) / 5
                a, b = STEP * (i - (COLUMNS - 1) / 2), STEP * (j - (ROWS - 1) / 2)
                print(*(center[k] + a * u[k] + b * v[k] + noise * n[k] for k in range(3)), *n)


def expect(what, value, expected, tolerance=0.0):
    if not abs(value - expected) <= tolerance:
        print(f"{what} is {value} instead of {expected}")


def check_points(row, points, plane):
    name = "shape " + row["shape"] + ", "
    expect(name + "points", int(row["points"]), len(points))
    for k in range(3):
        expect(name + "xyz"[k], float(row["xyz"[k]]), sum(p[k] for p in points) / len(points), 1e-12)
    heights = [sum(plane[k] * p[k] for k in range(3)) + plane[3] for p in points]
    squares = sum(h * h for h in heights)
    expect(name + "rms_distance", float(row["rms_distance"]), math.sqrt(squares / len(points)), 1e-12)
    expect(name + "mean_distance", float(row["mean_distance"]), sum(map(abs, heights)) / len(points), 1e-12)
    expect(name + "noise", float(row["noise"]), math.sqrt(squares / (len(points) - 3)), 1e-5)
    expect(name + "lowest", float(row["lowest"]), min(p[2] for p in points))
    expect(name + "highest", float(row["highest"]), max(p[2] for p in points))


def check_face(row, faces):
    name = "shape " + row["shape"] + ", "
    center, _, _, tilt, azimuth = FACES[faces[0]]
    far = FACES[faces[-1]][0][0] - center[0]  # from one part of the floor to the other
    expect(name + "length", float(row["length"]), LENGTH + far, 1e-2)
    expect(name + "width", float(row["width"]), WIDTH, 1e-2)
    expect(name + "area", float(row["area"]), len(faces) * LENGTH * WIDTH, 0.05)
    expect(name + "tilt_deg", float(row["tilt_deg"]), tilt, 0.05)
    expect(name + "dip_deg", float(row["dip_deg"]), tilt, 0.05)
    if tilt > 0:
        expect(name + "azimuth_deg", float(row["azimuth_deg"]), azimuth, 0.05)
    expect(name + "turned_deg", float(row["turned_deg"]), 0, 0.1)
    expect(name + "shifted", float(row["shifted"]), 0, 1e-3)
    expect(name + "angle_deviation_deg", float(row["angle_deviation_deg"]), 0, 0.1)


def check(cloud, table, labels, planes, number):
    points = [[float(x) for x in line.split()[:3]] for line in open(cloud)]
    label = struct.unpack(f"<{len(points)}i", open(labels, "rb").read())
    plane = [[float(x) for x in line.split()] for line in open(planes)]
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    if list(rows[0]) != NAMES:
        print(f"the columns are {list(rows[0])}")
    expect("rows", len(rows), int(number))
    expect("planes", len(plane), int(number))
    expect("largest label", max(label), int(number) - 1)
    for s, row in enumerate(rows):
        expect("shape", int(row["shape"]), s)
        if [float(row[k]) for k in "abcd"] != plane[s]:
            print(f"the plane of shape {s} is not that of --planes")
        own = [i for i in range(len(points)) if label[i] == s]
        check_points(row, [points[i] for i in own], plane[s])
        check_face(row, sorted({i // (COLUMNS * ROWS) for i in own}))
    floors = [s for s, row in enumerate(rows) if float(row["dip_deg"]) < 1]
    expect("groups of the floor", len({rows[s]["coplanar_group"] for s in floors}), 1)
    expect("directions", len({row["parallel_group"] for row in rows}), 3)


def features(table, geojson):
    with open(table, encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    with open(geojson, encoding="ascii") as file:
        properties = [feature["properties"] for feature in json.load(file)["features"]]
    for row, found in zip(rows, properties):
        expected = {name: float(number) for name, number in row.items() if name not in "abcd"}
        expected["plane"] = [float(row[name]) for name in "abcd"]
        if found != expected:
            print(f"{found} instead of {expected}")
    print(len(properties), "rows")


if __name__ == "__main__":
    {"make": make, "check": check, "features": features}[sys.argv[1]](*sys.argv[2:])
