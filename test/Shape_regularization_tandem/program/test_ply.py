# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What detect_planes reads of PLY and OFF: names and types as people have them, meshes, and numbers of items that a file
does not have, which is an error found at once and without much memory."""

import os
import re

import numpy as np
from support import (BARE, CLOUD, CUBE, N, ROWS, VERTICES, WARNS, XYZ, binary_ply, cases, off, ply, properties,
                     refused_files, table, text_of)

TWO = "element vertex 2\n" + XYZ
LIST = "property list uint float extra\n"
FACES = "element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\n"
EMPTY_ITEMS = "element foo 1000000000000\n"
ONE_FLOAT = "element vertex 1\n" + properties("xyz", "float")
POINT = bytes(12)
COUNTED = ONE_FLOAT + "property list int float extra\n"
OFF_FACES = "3 0 1 2 255 0\n3 0 2 1 255 0\n"
# A box of 4 x 3 x 2 with faces of three to four corners
CORNERS = "0 0 0\n4 0 0\n4 3 0\n0 3 0\n0 0 2\n4 0 2\n4 3 2\n0 3 2\n"
BOX_FACES = "4 0 3 2 1\n3 4 5 6\n3 4 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
BOX = "element vertex 8\n" + XYZ


def prepare(p):
    p.write({"box.ply": ply(BOX + "element face 7\nproperty list uchar int vertex_indices\n", CORNERS + BOX_FACES),
             "box.off": off(CORNERS + BOX_FACES, "8 7 0"), "plain.xyz": BARE,
             "both.ply": ply("element vertex 2\nproperty float X\n" + properties("xyz", "float"), "1 2 3 4\n5 6 7 8\n")})


@table("content, more", [
    (ply(CLOUD + FACES, f"\n{CUBE}\r\n \t3 0 1\n2 255\n\n4 0 1 2 3 255  \r\n\n"), " --sample 0"),
    (ply("element camera 1\nproperty list uchar float view\nproperty int id\n" + CLOUD, "2 .5 .5 7\n" + CUBE), ""),
    (ply(CLOUD + LIST + "property int id\n", CUBE.replace("\n", " 2 .5 .5 7\n")), ""),
    # Elements without bytes take no time.
    (ply(EMPTY_ITEMS + CLOUD, CUBE), ""), (ply(CLOUD + EMPTY_ITEMS, CUBE), "")])
def test_other_elements_do_not_change_the_result(p, content, more):
    p.write({"more.ply": content})
    p.shell(0, p.hash("cube.ply E"), f"exec timeout -k 1 5 $P more.ply $E{more}")


test_wrong_files = refused_files([
    # Numbers of items that the file cannot hold
    ("list.ply", ply(TWO + LIST, "0 0 0 1000000000\n0 0 0 0\n"),
     "row 1 of 'vertex' has 1000000000 items in the list 'extra', but there is room for 5 at most"),
    ("negative.ply", ply(TWO + LIST, "0 0 0 -1\n0 0 0 0\n"), "row 1 of 'vertex' has '-1' where the number"),
    ("small.ply", ply(TWO + "property list uchar float extra\n", "0 0 0 300\n0 0 0 0\n"),
     "row 1 of 'vertex' has 300 items"),
    ("face.ply", ply(TWO + FACES, "0 0 0\n0 0 0\n3 0 1 2 255\n9999 0 1 2 255\n"), "row 2 of 'face' has 9999 items"),
    ("real.ply", ply(TWO + "property list float float extra\n", "0 0 0 0\n0 0 0 0\n"),
     "the number of items of the PLY list 'extra' must be an integer"),
    *((name, binary_ply(COUNTED, POINT + count, order), pattern) for order in ("little", "big")
      for name, count, pattern in (("huge.ply", b"\100\0\0\100", "row 1 of 'vertex' has 1073741888 items"),
                                   ("below.ply", b"\377" * 4, "row 1 of 'vertex' has 4294967295 items"),
                                   ("short.ply", b"\0\0", "is truncated"))),
    ("cut.ply", binary_ply(ONE_FLOAT, POINT[:9]), "is truncated"),
    # More in the file than announced
    ("row.ply", ply(VERTICES, CUBE), "row 1 of 'vertex' has more values than the header says .add the missing property"),
    ("more.ply", ply(TWO, "0 0 0\n0 0 0\n0 0 1\n"),
     "is longer than its header says: 6 bytes follow .*correct the numbers of items"),
    ("part.ply", ply(TWO + "property int id\n", "0 0 0 1.5\n0 0 0 1\n"), ".*a value is not of the type"),
    ("twice.ply", ply("element vertex 1\n" + XYZ + "property int x\n", "0 0 0 0\n"), ".*two properties 'x'"),
    ("again.ply", ply(TWO + TWO, "0 0 0\n" * 4), ".*two elements of points"),
    ("long.ply", binary_ply(ONE_FLOAT, POINT + bytes(4)), "is longer than its header says: 4 bytes"),
    # Numbers of points
    ("negative.off", off(CUBE, "-1 0 0"), "announces -1 points"),
    ("negative.xyz", "-1\n" + CUBE, "announces -1 points"),
    ("fewer.xyz", "2\n" + CUBE, f"has {N} rows of points, but announces 2"),
    # Rows that are no points
    ("short.xyz", "1 0\n" + CUBE, "row 1 is neither a point, the number of points nor a line of names"),
    ("face.off", off("0 0 0\n1 0 0\n0 1 0\n" + OFF_FACES, "4 2 0"), "is truncated: less rows of faces"),
    ("color.off", f"COFF\n{N} 0 0\n{CUBE}", "the first word is not OFF or NOFF"),
    ("many.off", off(CUBE, "99999999999999 0 0"), f"is truncated: 99999999999999 points announced, {N} rows found"),
    # Values
    *(("wrong.ply", ply("element vertex 2\nproperty uchar x\n" + properties("yz", "float"), f"1 2 3\n{value} 2 3\n"),
       "unreadable after point 1 of 2 .a value is not of the type that the header says: "
       f"'{value}' of the property 'x'.") for value in ("256", "-1", "1.5", "1e2", "x", "9" * 20)),
    *(("wrong.ply", ply("element vertex 2\n" + properties("xyz", "float"), f"1 2 3\n{value} 2 3\n"),
       "(unreadable after point 1 of 2|row 2 of 'vertex' has a comma)")
      for value in ("1e39", "1,5", "1.5x", "0x10", "--1")),
    ("missing.ply", ply("element vertex 2\n" + properties("XYW", "float"), "1 2 3\n1 2 3\n"),
     "the points of the PLY file have no property 'z'"),
    # Meshes
    ("row.off", off("0 0 0\n0 1b\n" + OFF_FACES, "2 2 0"), "unreadable after point 1 of 2", "--sample 0"),
    *((f"corner.{kind}", content, "face 1 has a corner that is not one of the 8 points", "--sample 9")
      for face in ("3 0 1 8\n", "3 0 1 -1\n") for kind, content in (
          ("ply", ply(BOX + "element face 1\nproperty list int int vertex_index\n", CORNERS + face)),
          ("off", off(CORNERS + face, "8 1 0")))),
    ("flat.off", off(CORNERS + "3 0 0 1\n2 0 1\n", "8 2 0"), "has faces, but none of them has an area", "--sample 9"),
    ("short.off", off(CORNERS + "4 0 1 2\n", "8 1 0"), "face 1 does not have the number of its corners", "--sample 9"),
    ("infinite.off", off("0 0 0\n1e200 0 0\n0 1e200 0\n3 0 1 2\n", "3 1 0"), "face 1 has no finite area", "--sample 9"),
    ("strips.ply", ply(BOX + "element tristrips 1\nproperty list int int vertex_indices\n", CORNERS + "3 0 1 2\n"),
     "has 'tristrips' without the corners of single faces; --sample 0 uses", "--sample 9"),
    ("box.ply", None, "has faces: the points .* have no 'classification', which --classes needs", "--sample 9 --classes 1"),
    ("both.ply", None, "has no property 'error', which --tolerance-column names; it has X", "--tolerance-column error")])
test_wrong_options = cases([("sample is -1, allowed is .0, 1000000000.", "box.ply --sample -1"),
                            ("sample is for meshes", "plain.xyz --sample 9")], 2)


def test_right_files(p):
    p.write({"line.ply": binary_ply(ONE_FLOAT, POINT + b"\n"), "beside.off": f"OFF {N} 2 0\n{CUBE}{OFF_FACES}"})
    p(WARNS, "points +1,.*no shape was found", "line.ply")
    p(0, f"points +{N},", "beside.off E --sample 0")
    p.warns("cube.ply E --sample 9", "cube.ply: has no faces for --sample; the program uses its points")


def test_interrupted_reading(p):
    """Signals end the reading. The file takes no place on the disk."""
    p.write({"long.ply": ply("element foo 4000000000\nproperty list uchar uchar a\nelement vertex 1\n" + XYZ,
                             kind="binary_little_endian")})
    os.truncate(p.path("long.ply"), 4 << 30)
    p.shell(1, "interrupted", "exec timeout --foreground --preserve-status -s INT -k 2 0.3 $P long.ply")
    p.path("long.ply").unlink()


@table("order, sign", [("little", "<"), ("big", ">")])
def test_binary_types(p, order, sign):
    """They are the points of a text file."""
    columns = np.rint(1000 * ROWS[:, :3]).T
    rows = np.rec.fromarrays(columns.astype(int), dtype=[("x", sign + "f4"), ("y", sign + "u4"), ("z", sign + "i2")])
    types = properties("X", "float") + properties("Y", "uint") + properties("Z", "short")
    binary = binary_ply(f"element vertex {N}\n" + types, rows.tobytes(), order)
    p.write({"typed.ply": binary, "typed.xyz": text_of(columns.T)})
    found = p.hash("typed.ply --maximum-distance 4", f"points +{N}, .*shapes +3 in 3 planes ")
    p(0, found, "typed.xyz --maximum-distance 4")


@table("header, rows, pattern", [
    ("float X;float x;float y;float z", "1 2 3 4;5 6 7 8;2 9 1 0", "\n2,3,4,"),  # x, not X
    ("float x;float y;float z;list uchar int ids", "1 2 3 2 8 9;5 6 7 0;2 9 1 1 7", "\n5,6,7,.*\n2,9,1,"),
    ("double X;int Y;short Z;float NX;float NY;float NZ;ushort R;ushort g;ushort b",
     "0.1 -20 30 0 0 1 300 0 65535;1 2 3 0 0 1 0 1 2;4 5 1 0 0 1 7 7 7",
     "x,y,z,nx,ny,nz,r,g,b,shape\n0.1,-20,30,0,0,1,[0-9]+,0,255,"),
    ("float x;float y;float z", "0.1 1e-60 16777217;1 2 3;4 5 1", "\n0.10000000149[0-9]*,0,16777216,"),
    ("float x;float y;float z", "nan 1 2;+1 2. .3e1;5 6 7;2 9 1", "\nnan,1,2,.*\n1,2,3,")])
def test_points(p, header, rows, pattern):
    """The coordinates and all else, as a table of the output."""
    rows = rows.split(";")
    header = f"element vertex {len(rows)}\n" + "".join(f"property {line}\n" for line in header.split(";"))
    p.write({"points.ply": ply(header, "\n".join(rows) + "\n")})
    p(WARNS, "", "points.ply --maximum-distance 1 --output points.csv --colors input --quiet")
    assert re.search(pattern, p.read("points.csv"), re.DOTALL)


def test_meshes(p):
    hashes = set()
    for name in ("box.ply", "box.off"):
        p(1, f"{name}: has 7 faces: --sample N puts N points on the faces of a mesh, --sample 0 uses only their corners\n",
          name)
        p(WARNS, "points +8,.*sample +the corners of 7 faces", f"{name} --sample 0 --maximum-distance .1")
        hashes.add(p.hash(
            f"{name} --sample 5200 --maximum-distance 0.01 --planes box.planes --output box.csv --oriented",
            "points +5200, normals given\n +sample +5200 points on 7 faces\n.*shapes +6 in 6 planes of 3 directions.*"
            "coverage 100 %"))
        assert len(p.planes("box.planes")) == 6
    assert len(hashes) == 1
    # In proportion to the areas, 12, 8 and 6 of twice 26
    box = p.csv("box.csv")
    for is_on, expected in (((box["z"] == 2) & (box["nz"] == 1), 1200), ((box["y"] == 0) & (box["ny"] == -1), 800),
                            ((box["x"] == 4) & (box["nx"] == 1), 600)):
        assert abs(np.count_nonzero(is_on) - expected) <= 1
