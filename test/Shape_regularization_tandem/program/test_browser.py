# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of detect_planes --view in a Chromium without a window: what it draws, and the clicks, keys and fingers of
click.js, for which TANDEM_PLAYWRIGHT is the folder of scripts/install_playwright.sh."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from support import HAS_VIEW, N, NOTHING, table

HERE = Path(__file__).parent
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
NODE = shutil.which("node") or shutil.which("nodejs")
PLAYWRIGHT = Path(os.environ.get("TANDEM_PLAYWRIGHT") or HERE.parents[2] / "build/playwright") / "node_modules"
pytestmark = pytest.mark.skipif(not CHROMIUM or not HAS_VIEW, reason="no Chromium, or a program without three.js")
FLAGS = ["--headless=new", "--no-sandbox", "--no-first-run", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--window-size=800,500", "--enable-logging=stderr", "--virtual-time-budget=10000", "--dump-dom"]
VIEW = "elevation=35&azimuth=45"


def prepare(p):
    p(0, NOTHING, "cube.ply E --quiet --view page.html")


def show(p, address):
    """What the page tells after '#check'."""
    run = subprocess.run([CHROMIUM, *FLAGS, f"--user-data-dir={p.path('profile')}",
                          f"file://{p.path('page.html')}#check&{address}"],
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace", timeout=60,
                         check=True)
    body = re.search("<body[^>]*>", run.stdout).group()
    assert "CONSOLE" not in run.stderr and "data-error" not in body, body + run.stderr
    told = {name: re.search(f'data-{name}="([a-z0-9]+)"', body).group(1)
            for name in ("shown", "colors", "drawn", "selected")}
    return {name: int(value) if value.isdigit() else value for name, value in told.items()}


def test_drawn(p):
    # A click on one of the three faces. All points are drawn, on a good part of the canvas: in the color of the face and
    # the weak ones of the others, which are mixed with that of the background.
    clicked = show(p, f"{VIEW}&theme=dark&pick=0.5,0.6")
    assert clicked["shown"] == N and 4 <= clicked["colors"] <= 12 and clicked["drawn"] >= 5000
    assert re.fullmatch("shape[0-2]", clicked["selected"])
    # A shape, with other colors: as many pixels as before
    other = show(p, f"{VIEW}&theme=dark&shape=2&color=distance")
    assert (other["selected"], other["drawn"]) == ("shape2", clicked["drawn"])
    # A group that does not exist, and a size that no shape has
    nothing = show(p, "plane=7&smallest=1000&unassigned=0")
    assert (nothing["selected"], nothing["shown"], nothing["drawn"]) == ("none", 0, 0)


def face(axis, height, side, low, high, color, step=0.05):
    """The rectangle at `height` along an axis, from low to high along the two others: points, normals and colors"""
    places = np.stack([a.ravel() for a in np.mgrid[low[0] + step / 2:high[0]:step, low[1] + step / 2:high[1]:step]], axis=1)
    normal = side * np.eye(3)[axis]
    return np.column_stack([np.insert(places, axis, height, axis=1), np.tile([*normal, *color], (len(places), 1))])


@pytest.fixture(scope="module")
def room(p):
    """A closed room of 6 x 4 x 3 with a board on its long wall: normals point into the room, each face has a color of its
    own, and some points are in the air."""
    size, i = np.array([6, 4, 3]), np.arange(40)
    faces = [face(axis, end * size[axis], 1 - 2 * end, [0, 0], np.delete(size, axis),
                  [40 + 80 * axis, 60 + 120 * end, 200 - 60 * axis]) for axis in range(3) for end in (0, 1)]
    air = np.column_stack([.5 + .13 * i, .5 + i * 7 % 30 / 10, .6 + i * 11 % 18 / 10,
                           np.tile([0, 0, 1, 255, 255, 255], (40, 1))])
    rows = np.concatenate([*faces, face(1, 3.7, -1, [2, 1], [4, 2], [250, 240, 10]), air])
    text = "".join("{:.4f} {:.4f} {:.4f} {:g} {:g} {:g} {:g} {:g} {:g}\n".format(*row) for row in rows)
    p.write({"room.xyz": "x y z nx ny nz red green blue\n" + text})
    p(0, NOTHING, "room.xyz --maximum-distance 0.02 --quiet --view room.html --mesh room.off")
    return p.path("room.html")


@pytest.mark.skipif(not NODE or not (PLAYWRIGHT / "playwright-core/package.json").exists(),
                    reason="no node, or no playwright-core (scripts/install_playwright.sh)")
@table("name", ["select", "layers", "clip", "list", "save", "link", "lost", "touch"])
def test_clicks(room, name):
    run = subprocess.run([NODE, HERE / "click.js", room, name], timeout=300, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True,
                         env={**os.environ, "NODE_PATH": str(PLAYWRIGHT), "CHROMIUM": CHROMIUM})
    assert run.returncode == 0, run.stdout
