# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""detect_planes --planes-from labels points by known planes."""

import os

import numpy as np
from support import HAS_VIEW, N, ROWS, cases, table, text_of

PART = ROWS[np.arange(N) % 3 < 2]  # without the third face
TWO = "shapes +2 in 2 planes of 2 directions, 1 orthogonal.*coverage 66.67 %"
VIEW = "--view v.html" if HAS_VIEW else ""


def prepare(p):
    p.write({"part.xyz": "x y z nx ny nz\n" + text_of(PART), "bare.xyz": text_of(PART[:, :3]),
             "two.txt": "0 0 1 0\n1 0 0 -0.05\n", "far.txt": "0 0 1 -7\n",
             "more.txt": "0 0 1 -7\n0 0 1 0\n0 0 1 0\n0 0 -1 0\n0 1 0 0\n",
             # The same planes in other forms: with normals of any length, as a table, and turned
             "long.txt": "# a comment\n\n  0 0 4   0\r\n\t0 -0.5 0 0\n",
             "table.csv": "shape,d,points,c,b,a\n0,0,576,1,0,0\n1,-0,576,0,1,-0.0\n",
             "excel.csv": "\ufeffa,b,c,d\r\n0,0,1,0\r\n0,1,0,0\r\n", "pandas.csv": ",a,b,c,d\n0,0,0,1,0\n1,0,1,0,0\n",
             "quoted.csv": '"Name","A","B","C","D"\n"floor, level","0","0",1,0\n"wall",0,1,0,0\n',
             "upper.csv": "D;C;B;A\n0;1;0;0\n0;0;1;0\n"})
    p(0, "shapes +2 in", "part.xyz E --planes part.txt --shapes shapes.csv")
    p(0, f"points +1728, normals given.*{TWO}", "cube.ply E --planes-from part.txt --labels l.bin --planes p.txt --report "
      "r.json --output o.ply --polygons o.geojson --vg o.vg --output-directory tiles")


def test_planes_of_a_part(p):
    assert p.is_same("part.txt", "p.txt") and p.is_same("o.ply", "tiles/cube.ply")
    assert p.sizes("l.bin") == {-1: 576, 0: 576, 1: 576}
    assert len(p.lines("o.geojson", ".id.: [01],")) == 2


# A normal decides where there is one; without, only the distance.
test_runs = cases([
    ("normals none.*shapes +2 in 2 planes", "bare.xyz E --planes-from two.txt --labels bare.bin"),
    ("normals by PCA of 9", "bare.xyz E --planes-from two.txt --estimate-normals 9"),
    ("shapes +3 in 3 planes", "cube.ply E --planes-from more.txt --by-plane --planes p.txt"),
    ("selection +1 of 5 shapes", "cube.ply E --planes-from more.txt --largest 1")], 0)


def test_points_without_normals(p):
    p(0, "normals none\n", "bare.xyz E --planes-from two.txt --viewpoint 1,2,3 --oriented --planes p.txt --output o.csv "
      "--vg o.vg")
    csv = p.csv("o.csv")
    assert len(csv) == 1152 and not any(csv[name].any() for name in ("nx", "ny", "nz"))


@table("name", ["long.txt", "table.csv", "excel.csv", "pandas.csv", "quoted.csv", "upper.csv"])
def test_forms(p, name):
    p(0, TWO, f"cube.ply E --planes-from {name} --planes p.txt --labels forms.bin")
    assert p.labels("forms.bin").tolist() == [0, 1, -1] * (N // 3)
    assert np.abs(p.planes("p.txt")).tolist() == [[0, 0, 1, 0], [0, 1, 0, 0]]
    assert name != "pandas.csv" or p.read("p.txt") == "0 0 1 0\n0 1 0 0\n"


def test_a_table_of_shapes_and_standard_input(p):
    p(0, "coverage 66.67 %", "cube.ply E --planes-from shapes.csv --planes p.txt")
    assert p.is_same("part.txt", "p.txt")
    p.shell(0, "shapes +2 in 2 planes", "cat long.txt | $P cube.ply $E --planes-from /dev/stdin")


def test_planes_without_points(p):
    """They are in the files, with their numbers."""
    p(0, "known +planes of more.txt, not detected.*shapes +5 in 3 planes of 2 directions", "cube.ply E --planes-from "
      "more.txt --labels l5.bin --shapes s.csv --planes p.txt --report r.json --vg o.vg --output o.ply")
    assert p.sizes("l5.bin") == {-1: 576, 1: 576, 4: 576}
    assert p.read("p.txt") == "0 0 1 -7\n0 0 1 0\n0 0 1 0\n0 0 1 0\n0 1 0 0\n"
    # Blank is what they do not have, also for a reader.
    rows = [row.split(",") for row in p.lines("s.csv")]
    assert len(rows) == 6 and len({len(row) for row in rows}) == 1 and "null" not in p.read("s.csv")
    assert [name for name, value in zip(rows[0], rows[1]) if value == ""] == (
        "x y z area length width lowest highest rms_distance mean_distance turned_deg shifted curved class noise "
        "offset_deviation angle_deviation_deg").split()
    p(0, "of s.csv, not detected.*shapes +5 in", "cube.ply E --planes-from s.csv")
    report = p.json("r.json")
    assert report["relations"]["coplanar_groups"] == [[0], [1, 2, 3], [4]] and report["planes_from"] == "more.txt"
    p.warns("cube.ply E --planes-from more.txt --polygons o.obj", "3 of 5 shapes have too few points")
    p.warns(f"cube.ply E --planes-from far.txt {VIEW} --output far.ply",
            "only 0 % of the points are within the tolerances of a plane of far.txt: a larger --maximum-distance")
    p.write({"few.txt": "0 0 1 -0.007\n"})
    p.warns("cube.ply E --planes-from few.txt", "only [0-9.]+ % of the points are within .*, or the planes belong to another")


@table("name, text, pattern", [
    ("none.txt", None, "cannot be opened .No such file"), ("tiles", None, "is a directory"),
    ("header.csv", "a,b,c,d\n", "has no planes"),
    *(("bad.txt", f"0 0 1 0\n# x\n{row}\n", "row 3 has [35] values instead of 4") for row in ("0 0 1", "0 0 1 0 0")),
    *(("bad.txt", f"0 0 1 0\n0 0 1 {word}\n", f"row 2 has '{word}' where a finite number is expected")
      for word in ("x", "nan", "1e999")),
    ("bad.txt", "1,,0,0\n", "row 1 has '' where a finite number is expected"),
    ("bad.txt", "0 0 1 0\n0 0 1e-310 5\n", "row 2 has a plane whose distance from the origin is not finite"),
    ("bad.txt", "0 0 0 1\n", "row 1 has a null vector as normal"),
    ("bad.txt", "x y z\n0 0 1\n", "row 1 has neither four numbers 'a b c d' nor names of columns with a, b, c and d"),
    *(os.path.exists("/proc/self/mem") * [("/proc/self/mem", None, "cannot be read .Input/output error")])])  # it opens
def test_wrong_files(p, name, text, pattern):
    p.write({} if text is None else {name: text})
    p(1, f"--planes-from {name}: {pattern}", f"cube.ply --planes-from {name}")


test_wrong_options = cases([
    ("--planes-from with --estimate-normals needs a number K",
     "bare.xyz --planes-from two.txt --estimate-normals"),
    ("the file two.txt is named twice", "cube.ply --planes-from two.txt --planes two.txt")], 2)
