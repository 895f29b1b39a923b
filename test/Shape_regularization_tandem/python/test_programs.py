# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The example, and the program detect_planes beside the module."""

import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest

import tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room

ROOT = os.environ.get("TANDEM_SOURCES", os.path.join(os.path.dirname(__file__), "..", "..", ".."))
EXAMPLE = os.path.join(ROOT, "examples", "python", "color_cloud.py")
PROGRAM = os.environ.get("TANDEM_PROGRAM", "")


@pytest.fixture
def path(tmp_path):
    """Where a file of this name is, in a folder of the test"""
    return lambda name: str(tmp_path / name)


def test_example(path):
    cloud, colored = path("cloud.npy"), path("colored.ply")
    np.save(cloud, np.concatenate(room(), axis=1))
    text = run_python(EXAMPLE, colored, cloud)
    assert text.count("shape ") == 6
    assert text.count("are orthogonal") == 3
    with open(colored, "rb") as file:
        header, data = file.read().split(b"end_header\n", 1)
    assert re.findall(rb"property \w+ (\w+)", header) == b"x y z nx ny nz red green blue shape".split()
    vertices = np.frombuffer(data, np.dtype([("xyz", "3f8"), ("normal", "3f4"), ("rgb", "3u1"), ("shape", "<i4")]))
    np.testing.assert_array_equal(vertices["xyz"], room()[0])
    colors = {(v["shape"], *v["rgb"]) for v in vertices}  # one for each shape, and gray
    assert len(colors) == 7 and (-1, 128, 128, 128) in colors
    assert run_python(EXAMPLE, path("corner.ply")).count("shape ") == 3  # without a cloud
    wrong = subprocess.run([sys.executable, EXAMPLE], stderr=subprocess.PIPE, text=True)
    assert (wrong.returncode, "OUTPUT.ply" in wrong.stderr) == (1, True)


def test_example_of_the_readme(path, tmp_path):
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
        code = re.search("```python\n(.*?)```", file.read(), re.DOTALL).group(1)
    np.save(path("points.npy"), room()[0])
    text = run_python("-c", code, folder=tmp_path)
    assert text.count("= 0 has") == 6
    assert "orthogonal directions: [[0, 1], [0, 2], [1, 2]]" in text


def run_python(*arguments, folder=None):
    return subprocess.run([sys.executable, *arguments], stdout=subprocess.PIPE, check=True, text=True, cwd=folder).stdout


@pytest.mark.skipif(not PROGRAM, reason="the program detect_planes is not built")
def test_same_result_as_the_program(path):
    rows = np.concatenate(room(), axis=1)
    np.savetxt(path("room.xyz"), rows, "%.17g")
    subprocess.run([PROGRAM, path("room.xyz"), "--maximum-distance", str(MAXIMUM_DISTANCE), "--quiet",
                    "--labels", path("labels"), "--planes", path("planes"),
                    "--report", path("report"), "--shapes", path("shapes.csv"), "--mesh", path("mesh.ply")], check=True)
    shapes = shapes_of_room()
    np.testing.assert_array_equal(np.fromfile(path("labels"), "<i4"), shapes.labels)
    np.testing.assert_array_equal(np.loadtxt(path("planes")), shapes.planes)
    with open(path("report")) as file:
        assert json.load(file)["hash"] == f"{shapes.hash:016x}"
    written = np.genfromtxt(path("shapes.csv"), delimiter=",", names=True, dtype=None, encoding="utf-8")
    table = shapes.table()
    assert written.dtype.names == tuple(table)
    assert written["class"].tolist() == table.pop("class").tolist()
    for name, column in table.items():
        np.testing.assert_allclose(written[name], column, rtol=1e-12, atol=1e-12, err_msg=name)
    with open(path("mesh.ply")) as file:
        rows = [row.split() for row in file.read().split("end_header\n")[1].splitlines()]
    surface, vertices, faces = shapes.closed_surface(), rows[:8], rows[8:]
    np.testing.assert_array_equal(np.array(vertices, float), surface.vertices)
    assert [int(corner) for face in faces for corner in face[1:-1]] == surface.face_vertices.tolist()
    assert [float(face[-1]) for face in faces] == surface.face_supported.tolist()


@pytest.mark.skipif(not PROGRAM, reason="the program detect_planes is not built")
def test_same_warnings_as_the_program(path):
    points = np.concatenate([room()[0] + (5e5, 4.5e6, 100), np.zeros((20, 3))]).astype(np.float32).astype(float)
    np.savetxt(path("room.xyz"), points, "%.17g")
    subprocess.run([PROGRAM, path("room.xyz"), "--maximum-distance", "0.01", "--maximum-angle", "0.9", "--quiet",
                    "--report", path("report")], check=True)
    with open(path("report")) as file:
        expected = json.load(file)["warnings"]
    with pytest.warns(tandem.TandemWarning) as caught:
        tandem.detect_planes(points, maximum_distance=0.01, maximum_angle=0.9, ignore_zeros=True)
    options = {"maximum_distance": "--maximum-distance", "maximum_angle": "--maximum-angle",
               "minimum_region_size": "--minimum-region-size"}
    assert len(expected) >= 3 and "20 points are exactly at 0 0 0" in expected.pop(0)  # which the program leaves out itself
    assert [re.sub("|".join(options), lambda name: options[name[0]], str(w.message)) for w in caught] == expected

