# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The outward sides of planes and of estimated normals: those of given normals, of --viewpoint, and of the VIEWPOINT of
PCD files."""

import re

import numpy as np
import pytest
from support import HAS_VIEW, ROWS, WARNS, cases, pcd, table

PLACES = {"inside": "5 6 7 1 0 0 0", "behind": "-1 0 -1e0 .7 0 .7 0", "default": "0 0 0 1 0 0 0",
          "turned": "0 0 0 0 1 0 0", "short": "5 6 7", "nan": "5 6 nan 1 0 0 0"}


def rows(shift=0, with_normals=False):
    """The cube, its corner at (1, 1, 1) or further along x, without normals or with such as point to the outside."""
    normals = " {:g} {:g} {:g}" if with_normals else ""
    return "".join(("{:.3f} {:.3f} {:.3f}" + normals + "\n").format(*row[:3] + (1 + shift, 1, 1), *-row[3:])
                   for row in ROWS)


def prepare(p):
    p.write({"bare.xyz": rows(), "outside.xyz": rows(with_normals=True), "far.xyz": rows(4500000),
             "second.xyz": rows(9), "none.pcd": pcd(rows()),
             "outside.pcd": pcd(rows(with_normals=True), "x y z normal_x normal_y normal_z",
                                "VIEWPOINT 5 6 7 1 0 0 0\n"),
             **{f"{name}.pcd": pcd(rows(), more=f"VIEWPOINT {place}\n") for name, place in PLACES.items()}})


@pytest.fixture(scope="module")
def plain(p):
    """Runs without --oriented: their hashes, and their planes, which others may turn only."""
    hashes = {"bare": p.hash("bare.xyz E --planes bare.planes --output bare.ply --vg bare.vg",
                             "normals estimated\n.*shapes +3 in"),
              "far": p.hash("far.xyz E --planes far.planes", "shapes +3 in"),
              "outside": p.hash("outside.xyz E --planes outside.planes", "normals given\n")}
    return {name: (found, p.planes(f"{name}.planes")) for name, found in hashes.items()}


def check_sides(place, side, planes=(), points=()):
    """Planes a b c d are on the side 1 of a place or the other one, -1; and so are points with their normals."""
    heights = [plane[:3] @ place + plane[3] for plane in planes] + [row[3:6] @ (place - row[:3]) for row in points]
    assert len(heights) >= 3 and (np.array(heights) * side > 0).all()


def groups(p, name):
    return [np.array(line.split()[1:5], float) for line in p.lines(name, "^group_parameters")]


@table("cloud, side, place, arguments", [
    *(("bare", 1, place, "bare.xyz --viewpoint='{}, {}, {}'".format(*place)) for place in ((5, 6, 7), (-2, -3, .5))),
    # Far away a step of float is half a unit.
    *(("far", 1, (x, 2, 2), f"far.xyz --viewpoint {x},2,2") for x in (4500001.25, 4500000.75)),
    # Given normals are oriented.
    *(("outside", -1, (5, 6, 7), cloud) for cloud in ("outside.xyz", "outside.xyz --viewpoint 5,6,7", "outside.pcd")),
    ("bare", 1, (5, 6, 7), "outside.xyz --estimate-normals --viewpoint 5,6,7"),
    # VIEWPOINT of PCD files
    ("bare", 1, (5, 6, 7), "inside.pcd"), ("bare", -1, (5, 6, 7), "inside.pcd --viewpoint 0,0,0"),
    ("bare", 1, (-1, 0, -1), "behind.pcd"), ("bare", 1, (0, 0, 0), "default.pcd"), ("bare", 1, (0, 0, 0), "turned.pcd")])
def test_oriented(p, plain, cloud, side, place, arguments):
    found, planes = plain[cloud]
    found = f"towards the viewpoint\n.*{found}" if cloud != "outside" else found
    p(0, found, f"{arguments} E --oriented --planes sided.planes --output sided.xyz --vg sided.vg")
    check_sides(place, side, [*p.planes("sided.planes"), *groups(p, "sided.vg")], np.loadtxt(p.path("sided.xyz")))
    assert all((a == b).all() or (a == -b).all() for a, b in zip(p.planes("sided.planes"), planes))


@table("arguments", ["bare.xyz --viewpoint 5,6,7", "inside.pcd", "default.pcd", "none.pcd"])
def test_the_same_without_oriented(p, plain, arguments):
    """Planes, and, where there is no viewpoint, normals"""
    p(0, plain["bare"][0], f"{arguments} E --planes again.planes --output again.ply --vg again.vg")
    for file in ["planes"] + ["ply", "vg"] * (arguments in ("default.pcd", "none.pcd")):
        assert p.is_same(f"bare.{file}", f"again.{file}")


def test_no_viewpoint(p, plain):
    assert plain
    p(WARNS, r"\Adetect_planes: warning: --oriented: planes have no outward side, because the input has neither normals nor a viewpoint[^\n]*\n\Z",
      "bare.xyz E --quiet --oriented --planes again.planes")
    assert p.is_same("bare.planes", "again.planes")
    for name in ("short", "nan"):
        p(WARNS, rf"\Adetect_planes: warning: {name}.pcd: the VIEWPOINT of the PCD header is not seven finite numbers[^\n]*"
          r"\n\Z", f"{name}.pcd E --quiet --output again.ply")
        assert p.is_same("again.ply", "bare.ply")


def test_several_inputs(p):
    """Each has its own, or none."""
    p(0, "shapes +6 in", "behind.pcd second.xyz E --output-directory two --planes two.planes")
    p(0, "shapes +6 in", "none.pcd second.xyz E --output-directory none")
    p(0, "shapes +6 in", "behind.pcd second.xyz E --oriented --planes two_sided.planes")
    assert p.is_same("two/second.xyz", "none/second.xyz")
    assert not p.is_same("two/behind.pcd", "none/none.pcd"), "the viewpoint is not used"
    assert not p.is_same("two.planes", "two_sided.planes"), "no plane was turned"


def test_areas_and_page(p):
    """Corners are in the order seen from the outward side, with or without --oriented; planes are turned with it."""
    view = "--view {0}.html" if HAS_VIEW else ""
    for more, name in (("", "plain"), ("--oriented", "sided")):
        run = f"bare.xyz E --viewpoint 0,0,0 --polygons {{}} --triangulate --planes {name}.planes {more} {view.format(name)}"
        for kind in ("obj", "json"):
            p(0, "shapes +3 in", run.format(f"{name}.{kind}"))
    assert p.is_same("plain.obj", "sided.obj")
    corners = np.array([line.split()[1:] for line in p.lines("sided.obj", "^v ")], float)
    faces = np.array([line.split()[1:] for line in p.lines("sided.obj", "^f ")], int) - 1
    a, b, c = (corners[faces[:, k]] for k in range(3))
    assert len(faces) >= 6 and ((np.cross(b - a, c - a) * a).sum(axis=1) <= 0).all(), "inside out"
    check_sides((0, 0, 0), 1, p.planes("sided.planes"))
    for file, name in (("json", "plane"), ("html", "coefficients"))[:1 + HAS_VIEW]:
        planes = ",".join(re.findall(rf'"{name}":\s*\[([^\]]*)\]', p.read(f"sided.{file}")))
        assert [float(x) for x in planes.split(",")] == p.planes("sided.planes").ravel().tolist()
    assert not p.is_same("plain.json", "sided.json"), "no plane was turned"


test_bad_usage = cases([
    *((r": --viewpoint is '[^']*', must be three numbers .*, as in 2.5,-1,1.6 ", f"bare.xyz --viewpoint '{value}'")
      for value in ("0,0", "0 0 1", "0,0,1,0", "nan,0,1", "1/2/3")),
    ("viewpoint' cannot be specified more than once", "bare.xyz --viewpoint 0,0,0 --viewpoint 0,0,1")], 2)
