# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of the result and of the input of detect_planes: --largest, --minimum-area, --minimum-extent, --minimum-width, --flat-only,
--class, --near-direction and --crop."""

import re

import numpy as np
from support import HAS_VIEW, NOTHING, WARNS, cases, off, table

OPTIONS = "E --minimum-region-size 100"
PARTS = f"parts.xyz {OPTIONS}"
TOTAL = 1752


def parts():
    """A level face of 24 x 24 points, edge 0.161, a wall of 20 x 24 points, a wall of 16 x 24 points with a slope of 5
    degrees, and 13 x 24 points of a roof of 45 degrees: by falling number of points."""
    s, c, h = np.sin(np.pi / 36), np.cos(np.pi / 36), np.sqrt(.5)
    for i in range(1, 25):
        for j in range(1, 25):
            x, y = 7 * i / 1000, 7 * j / 1000
            yield x, y, 0, 0, 0, 1
            if i <= 20:
                yield x, 1, y, 0, 1, 0
            if i <= 16:
                yield 1 + x * s, y, x * c, c, 0, -s
            if i <= 13:
                yield 2 + x * h, y, x * h, -h, 0, h


def prepare(p):
    rows = ["{:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}\n".format(*row) for row in parts()]
    low = [row for row in rows if float(row.split()[0]) <= 0.1]
    names = "x y z nx ny nz\n"
    p.write({"parts.xyz": names + "".join(rows), "low.xyz": names + "".join(low),
             "nan.xyz": names + "".join(rows) + "nan 0 0 0 0 1\n",
             "square.off": off("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "4 1 0")})


@table("sizes, options", [
    ([576, 480, 384, 312], ""), ([576], "--largest 1"), ([576, 480, 384], "--largest 3"),
    ([576, 480, 384, 312], "--largest 9"), ([576], "--near-direction 0,0,-2"), ([576], "--near-direction horizontal"),
    ([480, 384], "--near-direction vertical"), ([480, 384, 312], "--near-direction vertical,46"),
    ([312], "--near-direction '-1,0,1, 1'"), ([576, 480], "--minimum-area 0.018"),
    ([480], "--largest 1 --minimum-area 0.0145 --near-direction vertical"),
    ([576, 480, 384, 312], "--minimum-extent 0.16"), ([576, 480], "--minimum-width 0.13"),
    ([576, 480, 384, 312], "--flat-only"), ([480, 384], "--class wall"), ([480], "--minimum-width 0.13 --class slanted,wall"),
    # The direction of symmetry is upward.
    ([480], "--near-direction horizontal --symmetry-direction 0,1,0"),
    ([576, 384, 312], "--near-direction vertical --symmetry-direction 0,1,0")])
def test_sizes(p, sizes, options):
    """The numbers of points of the shapes by --labels, in their order, and what the report says."""
    p(0, NOTHING, f"{PARTS} {options} --labels l.bin --planes p.txt --report r.json --output o.ply --polygons o.obj --quiet")
    assigned = sum(sizes)
    assert p.sizes("l.bin") == {**({-1: TOTAL - assigned} if assigned < TOTAL else {}), **dict(enumerate(sizes))}
    report = p.json("r.json")
    assert len(p.planes("p.txt")) == report["counts"]["shapes"] == len(sizes)
    assert report["counts"]["assigned"] == assigned
    assert report["free"]["total"] == report["free"]["unselected"] == TOTAL - assigned
    given = re.sub(" --symmetry.*|'", "", options)
    assert not given or report["selection"] == {
        "detected_shapes": 4, "detected_points": TOTAL, "shapes": len(sizes), "points": assigned, "options": given}


test_summary = cases([
    ("selection +1 of 4 shapes, with 576 of 1752 points .--largest 1.\n +shapes +1 in 1 planes.*67[0-9.]* % in shapes that "
     "were not selected", f"{PARTS} --largest 1"),
    ("selection +1 of 4 shapes.*--by-plane --largest 1", f"{PARTS} --by-plane --largest 1"),
    ("--minimum-area 0.0201234 --minimum-extent 0.16", f"{PARTS} --minimum-area 0.0201234 --minimum-extent 0.16")], 0)


def test_outputs_of_what_is_left(p):
    """They are those of any result: with one shape for each plane, sides, models and the page."""
    assert "selection" not in p(0, "shapes +4 in 4 planes", PARTS)
    p(0, "shapes +2", f"{PARTS} --near-direction vertical --output o.csv")
    assert set(p.csv("o.csv")["shape"]) == {-1, 0, 1}
    view = "--view v.html" if HAS_VIEW else ""
    p(0, "selection +2 of 4",
      f"{PARTS} --near-direction vertical --oriented --planes p.txt --shapes s.csv {view} --by-plane "
      "--vg o.vg --polygons o.geojson")
    assert len(p.lines("s.csv")) == 3 and len(p.lines("o.geojson", '"id": [01],')) == 2
    assert p.lines("o.vg", "num_groups") == ["num_groups: 2"]


def test_nothing_is_left(p):
    """A warning, and files without shapes"""
    p.warns(f"{PARTS} --minimum-extent 1 --labels l.bin --planes p.txt --polygons o.obj --vg o.vg --output o.ply",
            "none of the 4 shapes fits --minimum-extent 1: the outputs have no shapes")
    assert p.read("p.txt") == "" and p.sizes("l.bin") == {-1: TOTAL}


test_bad_usage = cases([(pattern, f"{PARTS} {arguments}") for pattern, arguments in (
    *((f"--largest is {value}, allowed is .1, 2147483648.", f"--largest {value}") for value in (0, -1, 99999999999)),
    *((f"--minimum-{name} is .*, must be positive", f"--minimum-{name} {value}") for name in ("area", "extent", "width")
      for value in (0, -2, "nan", 1e300)),
    ("--minimum-area", "--minimum-area wide"),
    *((f"--class is '{names}', must be names .*: any of floor, ceiling, wall, roof, ground, slanted", f"--class '{names}'")
      for names in ("door", "wall,", "wall;roof", "2")),
    *((f"--near-direction is '{value}', must be X,Y,Z, not all 0, vertical or horizontal", f"--near-direction='{value}'")
      for value in ("up", "0,0", "0,0,0", "0,0,1,91", "0,0,1,-1", "0,0,nan", "0,0,1,2,3", "vertical,up", "vertical,",
                    "vertical,1,2", "vertical,-1", "0,0,1,")),
    *((f"--crop is '{box}', must be XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX", f"--crop='{box}'")
      for box in ("0,0,0,1,1", "0,0,0,1,1,1,1", "0,0,0,-1,1,1", "0,0,0,1,1,nan", "0,0,0,1,1,", "a,b,c,d,e,f")))], 2)


def test_crop(p):
    """As if the other points were not there"""
    low_hash = p.hash(f"low.xyz {OPTIONS} --labels low.bin")
    for box in ("0,0,0,0.1,1,1", "-inf,-inf,-inf,0.1,inf,inf", "'0, 0, 0, 0.1, 2, 2'"):
        p(0, low_hash, f"nan.xyz --crop={box} {OPTIONS} --labels l.bin")
        assert p.is_same("low.bin", "l.bin")
    p(0, "points +1753", f"nan.xyz {OPTIONS}")
    p(1, "nan.xyz: has no points in the box of --crop: the box of its points is 0.007,0.007,0,2.06[0-9]*,1,0.168",
      f"nan.xyz {OPTIONS} --crop 5,5,5,6,6,6")
    p(WARNS, "warning: low.xyz: has no points in the box of --crop: the box of its points", "low.xyz nan.xyz --crop 1.5,0,0,3,1,1 E")


def test_crop_of_meshes(p):
    """Points on the faces, not the corners"""
    p(0, "points +[23][0-9][0-9], normals given.*shapes +1 in", "square.off --sample 1000 --crop 0.25,0.25,-1,0.75,0.75,1 "
      "--maximum-distance .01 --output o.csv")
    csv = p.csv("o.csv")
    assert all(((csv[name] >= .25) & (csv[name] <= .75)).all() for name in "xy")
