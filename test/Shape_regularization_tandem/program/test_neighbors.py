# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The ways from and to other programs that the manual has in its table "Other Programs". Where one is missing, its own test
is skipped; what it needs of a file is checked by the bytes, here and in test_round_trip.py."""

import os
import shutil
import subprocess

import numpy as np
import pytest
from clouds import las, read_las
from support import CLOUD, CUBE, N, NOTHING, ROWS, ply, properties, text_of

CXX = os.environ.get("TANDEM_CXX") or shutil.which("c++")
PROGRAM_OF_CGAL = """
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Point_set_3.h>
#include <CGAL/Point_set_3/IO.h>
#include <fstream>
#include <iostream>
int main(int, char* argv[])
{
  CGAL::Point_set_3<CGAL::Simple_cartesian<double>::Point_3> points;
  std::ifstream in(argv[1], std::ios::binary);
  if(!CGAL::IO::read_PLY(in, points) || !points.has_normal_map() || !points.has_property_map<int>("shape"))
    return 1;
  if(argv[2] != nullptr) {
    std::ofstream out(argv[2], std::ios::binary);
    CGAL::IO::set_binary_mode(out);
    return CGAL::IO::write_PLY(out, points) ? 0 : 1;
  }
  return 0;
}
"""


def prepare(p):
    p.write({"cloud.las": las(ROWS[:, :3], 6, extra=0),
             "compared.ply": ply(f"comment Created by CloudCompare v2.13\nelement vertex {N}\n" + properties("xyz", "float") +
                                 properties(["scalar_Intensity", "scalar_GpsTime"], "float"),
                                 text_of(np.column_stack([ROWS[:, :3], np.arange(2 * N).reshape(N, 2)])))})
    p(0, NOTHING, "cloud.las E --quiet --output shapes.las --labels labels")
    p(0, NOTHING, "cube.ply E --quiet --output shapes.ply")


def test_cloudcompare(p):
    """Its scalar fields stay, and the shape is one in addition, as a number of one type before no list."""
    p(0, NOTHING, "compared.ply E --quiet --output back.ply --labels compared")
    head, rows = p.read("back.ply").split("end_header\n")
    names = [line.split()[2] for line in head.splitlines() if line.startswith("property")]
    assert names[:5] == ["x", "y", "z", "scalar_Intensity", "scalar_GpsTime"] and names[-1] == "shape" and "list" not in head
    rows = np.array([row.split() for row in rows.splitlines()], float)
    assert (rows[:, 3:5] == np.arange(2 * N).reshape(N, 2)).all() and (rows[:, -1] == p.labels("compared")).all()


def test_qgis(p):
    """GeoJSON in a coordinate system, and the one of a LAS file, which layers of point clouds have"""
    p(0, NOTHING, "cloud.las E --quiet --polygons outlines.geojson --crs EPSG:25832 --output crs.las")
    outlines = p.json("outlines.geojson")
    assert outlines["crs"]["properties"]["name"] == "EPSG:25832" and len(outlines["features"]) == 3
    assert {"shape", "area", "dip_deg"} <= set(outlines["features"][0]["properties"])
    assert ("LASF_Projection", 2112) in read_las(p.path("crs.las").read_bytes()).records


@pytest.mark.skipif(not shutil.which("pdal"), reason="PDAL is missing")
def test_pdal(p):
    p.shell(0, "", "pdal translate cloud.las step.las --writers.las.forward=all --writers.las.extra_dims=all && "
            "$P step.las $E --quiet --output step_shapes.las && pdal translate step_shapes.las walls.csv "
            "-f filters.range --filters.range.limits='shape[0:]' 1> /dev/null")
    assert len(p.lines("walls.csv")) == 1 + np.count_nonzero(p.labels("labels") >= 0)


def test_laspy(p):
    laspy = pytest.importorskip("laspy")
    shapes = laspy.read(p.path("shapes.las"))
    assert (shapes["shape"] == p.labels("labels")).all()
    assert (shapes.intensity == laspy.read(p.path("cloud.las")).intensity).all()
    shapes.add_extra_dim(laspy.ExtraBytesParams("gain", "f8"))
    shapes["gain"] = np.arange(N)
    shapes.write(p.path("laspy.las"))
    p(0, "replaced", "laspy.las E --output of_laspy.las")
    assert (laspy.read(p.path("of_laspy.las"))["gain"] == np.arange(N)).all()


def test_open3d(p):
    open3d = pytest.importorskip("open3d")
    cloud = open3d.t.io.read_point_cloud(str(p.path("shapes.ply")))
    assert len(cloud.point["shape"]) == N
    open3d.t.io.write_point_cloud(str(p.path("open3d.ply")), cloud)
    p(0, "replaced", "open3d.ply E --output of_open3d.ply")


@pytest.mark.skipif(not CXX, reason="there is no compiler")
def test_cgal(p):
    """Point_set_3 reads the shape as a property of type int, and what it writes is read."""
    p.write({"reader.cpp": PROGRAM_OF_CGAL, "float.ply": ply(CLOUD.replace("double", "float"), CUBE)})
    run = subprocess.run([CXX, "-std=c++17", "-O0", "reader.cpp", "-o", "reader", "-lgmp", "-lmpfr"], cwd=p.folder,
                         stderr=subprocess.PIPE, text=True)
    if "No such file" in run.stderr:
        pytest.skip("CGAL is not where the compiler looks")
    assert run.returncode == 0, run.stderr
    for name in ("cube.ply", "float.ply"):
        p(0, NOTHING, f"{name} E --quiet --output to_cgal.ply --labels to_cgal")
        p.shell(0, NOTHING, "./reader to_cgal.ply of_cgal.ply")
        p(0, "replaced +the property 'shape' of the input", "of_cgal.ply E --output back.ply --labels of_cgal")
        assert p.is_same("to_cgal", "of_cgal")
