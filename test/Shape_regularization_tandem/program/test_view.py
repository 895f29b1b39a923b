# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of detect_planes --view: it is one file, and has all of the result."""

import base64
import json
import re
import subprocess

import numpy as np
import pytest
from support import CLOUD, HAS_VIEW, N, NOTHING, SOURCES, cases, cube, ply, properties, text_of

needs_page = pytest.mark.skipif(not HAS_VIEW, reason="the program was built without three.js")
HOSTS = "www.w3.org|graphics.stanford.edu|github.com|mrdoob.com|alteredqualia.com|erichaines.com"


def prepare(p):
    colored = CLOUD + properties(["red", "green", "blue"], "uchar")
    p.write({"<script>.ply": ply(colored, cube(4500000).replace("\n", " 10 20 30\n"))})
    if HAS_VIEW:
        p(0, NOTHING, "cube.ply E --quiet --view page.html")


def test_without_three_js(p):
    """The script that makes the page a part of the program; and the program itself"""
    script = SOURCES / "examples/detect_planes/view/embed_page.cmake"
    subprocess.run(["cmake", f"-DOUTPUT={p.path('page_parts.cpp')}", "-P", script], check=True)
    assert p.read("page_parts.cpp").count("_data[] = {\n  nullptr") == 2
    if not HAS_VIEW:
        p(2, "built without three.js; install libjs-three and build again", "no_such.ply --view page.html")
        assert not p.has("page.html")


@needs_page
def test_one_file(p):
    page = p.read("page.html")
    for pattern in (r"<(script|link|img|iframe)[^>]* (src|href) *=", "@import", r"url\(", r"@[a-z]+(\.js|\.css)?@"):
        assert not re.search(pattern, page)
    assert not [host for host in set(re.findall("https?://([A-Za-z0-9.-]+)", page)) if not re.fullmatch(HOSTS, host)]
    assert page.startswith("<!DOCTYPE html>") and page.endswith("</html>\n")
    # The licence of three.js, which asks for its text in all copies
    for text in ("Copyright (c) 2010-2019 three.js authors", "Permission is hereby granted, free of charge",
                 "The above copyright notice and this permission notice shall be included in"):
        assert text in page


def scene_of(page):
    scene, points = re.search(r'id="scene">({[^<]*)</script>\n<script type="text/plain" id="points">\n([^<]*)\n</script>',
                              page).groups()
    scene = json.loads(scene)
    assert len(points) == 4 * ((24 + 7 * N) // 3)  # a block without padding
    expected = {"points": N, "shown": N, "stride": 1, "directions": 3, "planes": 3, "ignored": 0}
    assert {name: scene[name] for name in expected} == expected
    assert sum(scene["shapes"]["shown"]) == N and len(scene["orthogonal"]) == 3
    return scene


def element(page, name, pattern="[A-Za-z0-9+/=]+\n"):
    return re.search(f'<script type="text/plain" id="{name}">\n({pattern})</script>\n', page).group(1)


@needs_page
def test_data(p):
    page = p.read("page.html")
    shapes = scene_of(page)["shapes"]
    for i in range(3):  # squares of 0.161, or a spacing wider where the planes of others bound them
        assert 0.025 <= shapes["area"][i] < 0.029
        assert all(abs(shapes[name][i]) < 1e-5 for name in ("turned_deg", "shifted", "mean_distance"))  # they are planar
        assert abs(shapes["outward"][i]) == 1  # the normals are given
        assert shapes["curved"][i] < .5 and shapes["class"][i] in ("wall", "ground", "floor", "ceiling", "roof")
    # The faces meet in seven corners of 12 bytes; for each face, an outline is of the number of its loops, that of its
    # corners and at least four of these, and triangles are their number and at least two; no colors.
    for name, least in (("corners", 7 * 12), ("loops", 3 * 4 * 6), ("triangles", 3 * 4 * 7)):
        assert (len(element(page, name)) - 1) // 4 * 3 >= least
    assert element(page, "input-colors", "") == "" and element(page, "model", "") == ""


def shown_points(page, center):
    """Blocks of at most 4096 points: a corner and steps of a box, 16 bits a coordinate, 8 for the distance"""
    for line in re.search('id="points">\n([^<]*)</script>', page).group(1).split():
        block = base64.b64decode(line)
        n = (len(block) - 24) // 7
        corner, step = np.frombuffer(block, "<f4", 6).astype(float).reshape(2, 3)
        places = np.frombuffer(block, "<u2", 3 * n, 24).reshape(n, 3)
        yield np.column_stack([center + corner + step * places, (np.frombuffer(block, "u1", n, 24 + 6 * n) - 128.) / 127])


@needs_page
def test_points(p):
    """Of a plane with noise and clutter, far away; one that is not finite is not shown"""
    rng = np.random.default_rng(4)
    near = rng.random((9000, 3)) * (3, 2, .02) + (4500000, 7, -.01)
    rows = np.concatenate([near, rng.random((500, 3)) + (4500000, 7, 3), [(np.nan, 7, 7)]])
    p.write({"noisy.xyz": text_of(rows)})
    p(0, NOTHING, "noisy.xyz --maximum-distance 0.02 --quiet --view noisy.html --planes noisy.planes --labels noisy.labels")
    page, (plane,), labels = p.read("noisy.html"), p.planes("noisy.planes"), p.labels("noisy.labels")
    center = json.loads(re.search('id="scene">({[^<]*)<', page).group(1))["center"]
    shown = np.concatenate(list(shown_points(page, center)))
    order = np.concatenate([np.flatnonzero(labels == 0), np.flatnonzero(labels[:-1] < 0)])
    assert len(shown) == 9500 and np.abs(shown[:, :3] - rows[order]).max() < 1e-4
    distances = np.where(labels[order] == 0, (rows[order] @ plane[:3] + plane[3]) / .02, 0)
    assert np.abs(shown[:, 3] - distances).max() < .01


@needs_page
def test_model(p):
    """Of a roof down to its base: the roof has points, walls and floor have no shape and none."""
    x, y = (a.ravel() for a in np.meshgrid(np.arange(.1, 10, .2), np.arange(.1, 8, .2)))
    p.write({"roof.xyz": text_of(np.column_stack([x, y, 9 - .75 * abs(y - 4) + .01 * np.sin(9 * x + 7 * y)]))})
    p(0, NOTHING, "roof.xyz --maximum-distance 0.05 --quiet --base 0 --view roof.html --mesh roof.obj")
    page = p.read("roof.html")
    assert page.endswith("</html>\n")
    triangles = np.frombuffer(base64.b64decode(element(page, "model")), [("corners", "<f4", (3, 3)), ("mark", "<u4")])
    center = json.loads(re.search('id="scene">({[^<]*)<', page).group(1))["center"]
    corners, shape, seen = triangles["corners"] + center, triangles["mark"] & 0xffffff, triangles["mark"] >> 24
    heights = np.abs(np.linalg.det(corners)).sum() / 6
    assert heights == pytest.approx(600, rel=.06)  # from the origin, a corner of the base
    assert set(shape) == {0, 1, 2} and seen[shape < 2].min() > 200 and seen[shape == 2].max() == 0
    # What the shell has opened is written once, before there is a mesh.
    p.shell(0, NOTHING, "$P roof.xyz --maximum-distance 0.05 --quiet --base 0 --view open.html --mesh roof.obj > open.html")
    assert p.read("open.html").count("<!DOCTYPE html>") == 1 and element(p.read("open.html"), "model", "") == ""


@needs_page
def test_colors_and_names(p):
    """Colors where the input has any; large coordinates, and a name that is markup"""
    p(0, NOTHING, "<script>.ply E --quiet --view far.html".split())
    assert len(element(p.read("far.html"), "input-colors", "(?:ChQe)+\n")) == 4 * N + 1  # 10 20 30
    assert scene_of(p.read("far.html"))["name"] == "<script>.ply"


test_bad_names = needs_page(cases([(code, pattern, f"cube.ply E {arguments}") for code, pattern, arguments in (
    (1, "no/page.html: cannot be written", "--view no/page.html"), (2, "must end in .html or .htm", "--view cube.ply"),
    (1, "labels: cannot be written", "--view never.html --labels no/labels"))], absent=["never.html"]))
