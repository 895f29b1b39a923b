# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tiles of an area: --output-directory of detect_planes, by one process."""

import gzip
import os
import shutil

import numpy as np
from clouds import OPTIONS, OUTPUTS, TILES, write_tiles
from support import HAS_GZIP, HELP, NOTHING, WARNS, cases, ply, properties, table

ALL = " ".join(TILES)
EMPTY = ply("element vertex 0\n" + properties(["x", "y", "z", "nx", "ny", "nz"], "float"))


def prepare(p):
    write_tiles(p)
    last = p.path("last.las").read_bytes()
    p.write({"classes.csv": "x,y,z,classification\n0,0,0,6\n1,0,0,6\n0,1,0,6\n1,1,0,2\n", "empty.ply": EMPTY,
             "none.ply": EMPTY, "folder/last.las": last, "folder/last.pts": last, "folder/last.ply": "old",
             "zipped/last.las": "old", "zipped/last.las.gz": gzip.compress(last),
             "folder/Middle.XYZ.gz": gzip.compress(p.path("folder/Middle.XYZ").read_bytes())})
    p.path("linked").mkdir()
    for name, target in (("link", "folder"), ("linked/a.las", "../folder/last.las"), ("deep", "folder/sub")):
        p.path(name).symlink_to(target)
    p(0, r"\Acorner.pts, .*points +9600.*hash",
      f"{ALL} {OPTIONS} --output-directory new/one --planes planes --output all.csv")


def test_each_input_has_its_points(p):
    """In a file of its own, with shapes of the whole area"""
    assert sorted(os.listdir(p.path("new/one"))) == sorted(OUTPUTS) and len(p.lines("planes")) == 4
    border, everything = (np.loadtxt(p.path(name), delimiter=",", skiprows=1) for name in ("new/one/border.csv", "all.csv"))
    assert set(map(tuple, border.tolist())) <= set(map(tuple, everything.tolist()))
    assert len(border) == len(p.lines("folder/sub/border.csv")) - 1 and set(border[:, -1]) >= {0, 1, 2, 3}


def test_what_is_written_is_read_again(p):
    p(0, "left out +normals", f"new/one/corner.ply new/one/last.las {OPTIONS} --colors shape --output-directory new/two")
    p(0, NOTHING, f"new/one/last.las {OPTIONS} --output-directory new/two --quiet")
    assert p.is_same("new/one/last.las", "new/two/last.las")
    if HAS_GZIP:
        p(0, NOTHING, f"folder/Middle.XYZ.gz {OPTIONS} --output-directory new/three --output middle.xyz --quiet")
        assert p.is_same("middle.xyz", "new/three/Middle.XYZ")


def test_a_tile_without_points(p):
    """It has an output without points, and changes nothing."""
    run = f"{OPTIONS} --output-directory with_empty"
    assert "normals estimated" in p(WARNS, "warning: empty.ply: has no points\n", f"empty.ply {ALL} {run}")
    for name in OUTPUTS:
        assert p.is_same(f"new/one/{name}", f"with_empty/{name}")
    p(1, "with_empty/empty.ply: has no points", "with_empty/empty.ply")
    p(WARNS, "warning: last.las: has no points of the --classes", f"last.las classes.csv --classes 6 {run}")
    p.shell(0, "warning: none.ply: has no points\n.*none of the inputs has points\n.*exit 1",
            "$P empty.ply none.ply --output-directory out 2>&1 || echo exit $?")
    assert not p.has("out")


IS_INPUT = "--output-directory is the folder of {}. name another folder"
INTO_INPUT = [
    *((f"{place}/last.{kind}", folder) for place, kind in (("folder", "las"), ("link", "pts"))
      for folder in ("folder/sub/..", "./folder/", "link/")),
    ("linked/a.las", "linked"), ("linked/a.las", "folder"), *HAS_GZIP * [("zipped/last.las.gz", "zipped")],
    # By names through folders that are not there yet, which the run would make; and through those that lead elsewhere
    *(("folder/last.pts", folder) for folder in (
        "folder/nn/..", "folder/nn/mm/../../", "./folder/nn/./..//", "nn/../folder", "link/n/..", "deep/n/../..",
        "link/n/../sub/m/../.."))]
test_refused_names = cases([
    *((IS_INPUT.format(name), f"corner.pts {name} --output-directory {folder}") for name, folder in INTO_INPUT),
    ("last.las and folder/last.las would both become out/last.las", "last.las folder/last.las --output-directory out"),
    ("corner.pts and corner.ply would both become out/corner.ply", "corner.pts corner.ply --output-directory out"),
    ("out/last.las is named twice", "last.las --output-directory out --labels out/last.las")], 2,
    absent=["out", "folder/nn", "folder/n", "folder/sub/n", "nn"])


def test_other_names(p):
    assert p.read("folder/last.ply") == p.read("zipped/last.las") == "old"
    p(0, NOTHING, f"last.las {OPTIONS} --quiet --output-directory folder/nn/../out")
    assert p.is_same("new/one/last.las", "folder/out/last.las")
    for name in ("folder/nn", "folder/out"):
        shutil.rmtree(p.path(name))


@table("pattern, arguments", [
    ("last.xyz: cannot be made", "last.las --output-directory last.xyz"),
    ("taken/last.las: is a directory", f"last.las corner.pts {OPTIONS} --output-directory taken"),
    ("nothere.las: no such file", "corner.pts nothere.las --output-directory out"),
    ("no/planes: cannot be written", f"last.las {OPTIONS} --output-directory made/one/two --planes no/planes"),
    *(("/dev/full: cannot be written completely", f"last.las {OPTIONS} --output-directory {folder} --report /dev/full")
      for folder in ("made/one/two", "taken/one"))])
def test_a_run_that_fails_leaves_no_folder(p, pattern, arguments):
    """One of before stays."""
    p.path("taken/last.las").mkdir(parents=True, exist_ok=True)
    p(1, pattern, arguments)
    assert p.has("taken") and not p.has("out", "taken/corner.ply", "taken/one", "made")


def test_other_processes(p):
    """What mpirun would tell a program that cannot work with others"""
    if "mpirun" not in HELP:
        p(1, "3 processes were started .OMPI_COMM_WORLD_SIZE., but this program was built without MPI", "last.las",
          OMPI_COMM_WORLD_SIZE="3")
        p(0, NOTHING, "last.las", OMPI_COMM_WORLD_SIZE="3", OMPI_COMM_WORLD_RANK="1")
