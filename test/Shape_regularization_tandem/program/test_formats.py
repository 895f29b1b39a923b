# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The formats of detect_planes: a cloud gives the same labels in each of them, read and written."""

import gzip
import re

import numpy as np
import pytest
from clouds import las, las_of_each_format, pcd_of_each_kind, ptx, read_las, rows_of, turned_room
from support import (BARE, CLOUD, CUBE, HAS_GZIP, HELP, N, NOTHING, ROWS, WARNS, cases, pcd, ply, refused_files, table,
                     text_of, with_columns)

POINTS = ROWS[:, :3]
FORMATS = ["ply", "las", "pcd", "xyz", "txt", "csv"]
LAS = las_of_each_format(POINTS)
PCD = pcd_of_each_kind(POINTS)
SHAPES = "shapes +3 in"
LABELED = re.sub("^(?=.)", "P1 ", BARE, flags=re.M)


def prepare(p):
    p.write({"source.txt": "x y z red green blue intensity classification\n" + with_columns(" 10 20 250 77 6"),
             "bare.xyz": BARE, "other.ply": ply(CLOUD, CUBE), "plain.ply.gz": ply(CLOUD, CUBE), **LAS, **PCD})
    for format in FORMATS:  # what the input has beside normals is kept
        p(0, NOTHING, f"source.txt E --output rich.{format} --colors input --quiet")
    p.write({f"rich.{kind}.gz": gzip.compress(p.path(f"rich.{kind}").read_bytes()) for kind in ("xyz", "las", "pcd")})
    packed = gzip.compress(ply(CLOUD, CUBE).encode())
    p.write({"Cube.PLY.GZ": packed, "cut.ply.gz": packed[:4000]})
    p(0, "normals estimated", "cube.ply E --estimate-normals --labels expected")


def check_labels(p, pattern, arguments):
    """The labels are those of the cube, of normals that are estimated."""
    p(0, pattern, f"{arguments} E --estimate-normals --labels labels")
    assert p.is_same("labels", "expected")


@table("format", FORMATS)
def test_written_and_read_back(p, format):
    check_labels(p, SHAPES, f"rich.{format} --classes 6 --output again.csv --colors input")
    names, row = (line.split(",") for line in p.lines("again.csv")[:2])
    expected = {"x", "y", "z", "nx", "ny", "nz", "intensity", "classification", "shape"}
    assert expected < set(names) and len(names) == 12 and ",10,20,250," in ",".join(row)
    assert dict(zip(names, row)).items() > {"intensity": "77", "classification": "6"}.items()
    p(1, f"rich.{format}: has no points of the --classes", f"rich.{format} --classes 0,7")
    low = np.count_nonzero(POINTS[:, 2] <= 0.1)
    p(0, f"points +{low}, ", f"rich.{format} E --crop=-inf,-inf,-inf,inf,inf,0.1 --output second.{format} --colors shape")
    assert format != "csv" or ",10,20,250,77,6" not in p.lines("second.csv")[1]


test_inputs_and_options = cases([
    (0, r"\Acube.ply, other.ply\n +points +3456, normals given.*hash", "cube.ply other.ply E"),
    (0, "points +3456, normals estimated\n +columns +x y z r.*source.txt.\n +left out +normals, colors, intensity, "
     "classification: ", "cube.ply source.txt E"),
    (1, "missing.las: no such file", "cube.ply missing.las"), (2, "named twice", "cube.ply rich.xyz --output rich.xyz"),
    *((2, f"columns {what}", f"rich.xyz --columns '{columns}'") for what, columns in (
        ("has 'q', must be one of x y z", "x y z q"), ("must have x, y and z", "x y"), ("has 'x' twice", "x y z x"),
        ("must have all three of", "x y z nx"))),
    (2, "columns is for text tables", "cube.ply --columns 'x y z'"),
    *((2, f"--classes is '{classes}', must be numbers from 0 to 255 .*as in 2,6", f"rich.las '--classes={classes}'")
      for classes in ("two", "256", "-1", "2.5", "0,,6", "2,", ",2", " ")),
    (1, "cube.ply: has no property 'classification'", "cube.ply --classes 2"),
    (1, "bare.xyz: has no classification, which --classes needs .its columns: x y z", "bare.xyz --classes 2"),
    (2, "output is 'never.obj', must end in .ply, .las,", "cube.ply --output never.obj"),
    (2, "colors is 'red', must be shape or input", "cube.ply --colors red"),
    # Formats that an option tells
    *((2, f"format is '{kind}', must be ply, las, (laz, )?pcd, off, ptx or that of a text table", f"bare.xyz --format {kind}")
      for kind in ("obj", ".xyz")), (1, "bare.xyz: is not a PLY file", "bare.xyz --format ply"),
    (2, "--columns is for text tables", "bare.xyz --format ply --columns 'x y z'")], absent=["never.obj"])


@pytest.mark.skipif(not HAS_GZIP, reason="built without zlib")
def test_compressed(p):
    for name in ("Cube.PLY.GZ", "rich.xyz.gz", "rich.las.gz", "rich.pcd.gz"):
        check_labels(p, SHAPES, name)
    p(1, "cut.ply.gz: is damaged or truncated", "cut.ply.gz")
    p(1, "plain.ply.gz: is not compressed", "plain.ply.gz")


@pytest.mark.skipif(".laz" not in HELP, reason="built without LASzip")
def test_laz(p):
    p(0, NOTHING, "rich.las E --output rich.laz --quiet")
    check_labels(p, SHAPES, "rich.laz --output of_laz.las")
    assert p.is_same("rich.las", "of_laz.las")


@table("columns, name, text, more", [
    ("x y z", "bare.xyz", "# comment\n\n" + BARE, ""), ("x y z nx ny nz", "normals.txt", CUBE, ""),
    *(("x y z r g b", "colors.txt", with_columns(colors), "") for colors in (" 200 100 1", " 0.5 0.25 1")),
    ("x y z intensity r g b", "scan.pts", f"{N}\n" + with_columns(" -900 200 100 50"), ""),
    ("x y z r g b nx ny nz", "everything.txt", with_columns(" 40000 100 50 0 0.6 0.8"), ""),
    ("x y z _ _", "unknown.txt", with_columns("\t7.5\t9.5"), ""),
    ("x y z nx ny nz", "commas.csv", '"X","Y","Z",normal_x,normal_y,normal_z\r\n'
     + CUBE.replace(" ", ",").replace("\n", ",\r\n"), ""),
    ("x y z nx ny nz", "header.txt", f"//X Y Z Nx Ny Nz\n{N}\n{CUBE}", ""),
    ("x y z _ r g b", "spaces.csv", "x,y,z,scan angle,R,G,B\n" + with_columns(" -900 200 100 50"), ""),
    ("_ x y z", "labeled.txt", LABELED, "--columns '- x y z'")])
def test_columns_of_text(p, columns, name, text, more):
    """Recognized, or named"""
    p.write({name: text})
    check_labels(p, f"columns +{columns}( [(][^\n]*)?\n", f"{name} {more}")


def test_other_columns(p):
    p.write({"wrong.csv": "x y z nx ny nz\n" + with_columns(" 200 100 1"),
             "nan.xyz": f"nan NaN -inf\n{BARE}1 ,, 2\n"})
    p(WARNS, "warning: wrong.csv: the normals .nx ny nz, columns 4 5 6. have lengths far from 1", "wrong.csv E")
    # Points that are not finite stay, and belong to no shape.
    p(WARNS, "points that are not finite, which LAS cannot have, are not in the output: 2\n",
      "nan.xyz E --output nan.las --labels nan.labels")
    assert len(p.labels("nan.labels")) == 1730 and read_las(p.path("nan.las").read_bytes()).returns[0] == 1728
    p(0, "points +1728", "nan.las E")


# --- Files that others make, as far as the specifications tell


def test_las_and_pcd_of_each_kind(p):
    for number in range(len(LAS)):
        kind = 6 if number < 6 else 200
        color = "[0-9]+,[0-9]+" if number in (0, 1, 4, 6, 9) else "1,255"
        check_labels(p, SHAPES, f"{number}.las --classes '1 {kind}' --output las.csv --colors input")
        assert re.search(f",{color},2,{kind},[0-2]$", p.lines("las.csv")[3])
    for kind in ("text", "binary", "compressed"):
        check_labels(p, SHAPES, f"{kind}.pcd --output pcd.csv --colors input")
        assert re.search(",10,20,250,77,[0-2]$", p.lines("pcd.csv")[1])


HEAD = "2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
SCAN = HEAD + "0 0 0 1\n1 2 3 0.5\n"
test_wrong_files = refused_files([
    *((f"{name}.pcd", None, "the compressed points are damaged") for name in ("damaged", "before")),
    ("huge.pcd", None, "is truncated"),
    ("cut.las", LAS["10.las"][:9000], f"is truncated: {N} points announced, but the file has room for [0-9]+"),
    ("head.las", LAS["10.las"][:100], "is truncated: the LAS header"),
    ("cut.pcd", PCD["binary.pcd"][:9000], f"is truncated: {N} points announced"),
    ("cut.pcd", PCD["compressed.pcd"][:9000], "is truncated: [0-9]+ compressed"),
    ("text.las", "LAST\n" + CUBE, "is not a LAS file"),
    ("flat.pcd", pcd("0 0\n", "x y", count=1, size=4), "the points of the PCD file have no field 'z'"),
    ("type.pcd", pcd("0 0 0\n", count=1).replace("8 8 8", "4 4 3"), "the PCD field 'z' has the type F of 3 bytes"),
    ("wide.pcd", pcd("", more="WIDTH 2\nHEIGHT 2\n", count=3, size=4),
     "the PCD header has 3 POINTS, but WIDTH times HEIGHT is 4"),
    ("cube.e57", "ASTM-E57", "this program does not read .e57; convert the file to LAS"),
    ("cube.stl", "solid cube", "this program does not read .stl; convert the mesh to PLY or OFF, and pass --sample N"),
    ("cube.doc", CUBE, "unknown format '.doc', expected .ply, .las,.*; --format NAME names the format"),
    ("table.ptx", CUBE, "row 1 is not the number of columns or rows of a scan"),
    ("head.ptx", HEAD, "is truncated: the header of a scan is not complete"),
    ("row.ptx", HEAD + "0 0 1\n1 2 3 0.5\n", "row 10 of the header of a scan has 3 numbers instead of 4"),
    ("cut.ptx", SCAN + "1 2 3 0.5\n", "is truncated: 2 of the 4 points of a scan"),
    ("more.ptx", SCAN + 4 * "1 2 3 0.5\n", "row 15 is not the number of columns"),
    ("word.ptx", SCAN + "1 2 three 0.5\n", "row 12 has 'three' where a number is expected"),
    ("mixed.ptx", SCAN + "1 2 3 0.5 1 2 3\n", "row 12 has 7 numbers, expected x y z intensity or"),
    ("none.ptx", HEAD + "0 0 0 1\n" + 4 * "0 0 0 0\n", "has no points"),
    ("huge.ptx", "1e9\n1000000001\n", "row 2 is not the number of columns")])


# --- Formats that an option tells in place of the name


@pytest.fixture(scope="module")
def room_hash(p):
    room = turned_room()
    p.write({"plain.xyz": rows_of(room), "one.ptx": ptx(room), "two.ptx": ptx(room, 2, " 10 20 250"),
             **{f"a folder/{name}": rows_of(room) for name in ("plain", "cloud.doc", "cloud.las", "cloud.ply")},
             "plain.data.gz": gzip.compress(rows_of(room).encode())})
    return p.hash("plain.xyz")


def test_format_option(p, room_hash):
    for name, format in (("plain", "xyz"), ("cloud.doc", "txt"), ("cloud.las", "csv"), ("cloud.ply", "asc"),
                         ("cloud.las", "xyz --columns 'x y z'")):
        p(0, f"columns +x y z\n.*{room_hash}", f"'a folder/{name}' --format {format}")
    for format in ("ply", "las", "pcd"):
        p.write({f"{format}.bin": p.path(f"rich.{format}").read_bytes()})
        p(1, f"{format}.bin: unknown format '.bin', .*; --format {format} reads the file as what its first bytes say",
          f"{format}.bin")
        p(0, f"points +{N}.*shapes +3 in", f"{format}.bin --format {format} E")
    if HAS_GZIP:
        p(0, room_hash, "plain.data.gz --format xyz")


def test_ptx(p, room_hash):
    """The frame of all scans, and their places"""
    assert room_hash
    one = p.hash("one.ptx --oriented --planes one.txt --output one.csv",
                 "scans +1, 50 pixels without a point left out\n.*shapes +3 in 3 planes of 3 directions, 3 orth")
    # The scanner is above the floor, whose outward normal is up therefore.
    assert np.count_nonzero(p.planes("one.txt")[:, 2] > 0.99) == 1
    p(0, f"normals estimated, towards the viewpoint\n.*{one}", "one.ptx")
    p(0, "tolerances", "one.ptx --noise 0.01")
    p(0, NOTHING, "one.ptx --crop=-inf,-inf,-inf,inf,inf,6 --output cut.csv --quiet")
    all_rows, low = ([line.split(",")[:3] for line in p.lines(name)[1:]] for name in ("one.csv", "cut.csv"))
    assert low == [row for row in all_rows if float(row[2]) <= 6]
    p(0, "normals estimated, towards the viewpoint\n +scans +2, 100 pixels without a point left out\n.*shapes +3 in 3 planes", "two.ptx --output two.csv --colors input")
    names, row = p.lines("two.csv")[:2]
    assert names == "x,y,z,nx,ny,nz,r,g,b,intensity,shape" and re.fullmatch("[0-9.,e+-]+,10,20,250,0.5,[0-9-]+", row)
    p(0, "tolerances", "two.ptx --noise 0.01")
    p(1, "one.ptx: is PTX, whose points have no 'classification', which --classes needs", "one.ptx --classes 2")


# --- The LAS files that are written: the grid of coordinates is fine for the distances, wherever the cloud is


def check_grid(p, name, epsilon, points):
    las_file = read_las(p.path(name).read_bytes())
    assert las_file.scale.max() <= 2e-4 * epsilon * (1 + 1e-9) and len(points) == len(las_file.points)
    # Half a step, and what the numbers themselves are rounded by.
    error = np.abs(points - las_file.points).max()
    assert error <= 1e-4 * epsilon * (1 + 1e-6) + 4e-16 * np.abs(points).max(), f"moved by {error}"
    assert (las_file.bounds == np.stack([las_file.points.max(axis=0), las_file.points.min(axis=0)], axis=1)).all()
    assert not (np.signbit(las_file.offset) & (las_file.offset == 0)).any(), "an offset is -0"


@table("size", [1e-6, 1, 4e6])
@table("place", [-0.5, -0.57, 0, -1, 1000.25])
def test_grid(p, size, place):
    """Clouds around the origin, beside it, on one side of it, and far away"""
    points = (POINTS + place) * size
    p.write({"placed.txt": text_of(points)})
    p(0, NOTHING, f"placed.txt --maximum-distance {0.004 * size} --output placed.las --quiet")
    check_grid(p, "placed.las", 0.004 * size, points)


def test_grids_of_inputs(p):
    wide = np.concatenate([[(-340000, 0, 0), (340000, 0, 0)], POINTS])  # as the integers allow for that step
    fine = np.array([(0.1234567, 0.2345678, 0.3456789)])
    p.write({"wide.txt": text_of(wide), "fine.txt": text_of(fine), "coarse.las": las(POINTS, 2, records=())})
    p(0, NOTHING, "wide.txt --maximum-distance 0.8 --output wide.las --quiet")
    check_grid(p, "wide.las", 0.8, wide)
    # The grid of an input is kept for its points, not for finer ones of other inputs.
    p(0, NOTHING, "coarse.las E --output kept.las --quiet")
    check_grid(p, "kept.las", 10, POINTS)
    assert p.path("kept.las").read_bytes()[131:179] == p.path("coarse.las").read_bytes()[131:179]
    p.warns("coarse.las fine.txt E --output both.las", "the points of the inputs do not have the same format and fields")
    check_grid(p, "both.las", 0.004, np.concatenate([POINTS, fine]))


BOTH = (34735, 2112)


@table("format, records, flag, kind, new_format, new_flag", [
    *((format, records, flag, 6, *new) for format in (2, 7) for flag in (0, 1) for records, new in (
        ((), (0, 0)), ((34735,), (0, 0)), ((2112,), (6, 1)), (BOTH, (6, 1) if flag else (0, 0)))),
    # Classes from 32 on need the format 6.
    *((7, records, flag, 200, 6, new_flag) for flag in (0, 1)
      for records, new_flag in (((), 1), ((34735,), 0), ((2112,), 1), (BOTH, flag)))])
def test_projection(p, format, records, flag, kind, new_format, new_flag):
    """The records of one of the inputs are those of the output, and the flag tells what they hold."""
    p.write({"in.las": las(POINTS, format, records=records, flag=flag, classification=kind),
             "in.txt": f"x y z classification\n0 0 0 {kind}\n"})
    p(WARNS, "", "in.las in.txt E --output out.las --quiet")
    out = read_las(p.path("out.las").read_bytes())
    assert (out.format, out.flag, tuple(out.ids)) == (new_format, new_flag, records)
