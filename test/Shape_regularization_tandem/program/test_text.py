# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Text tables as people have them, and texts that are refused since they would be read as others: commas within numbers,
lines that end in a carriage return alone, and lines without an end."""

import gzip
import os
import random
import re

import numpy as np
from clouds import ptx, read_las, rows_of, turned_room
from support import (BARE, CLOUD, CUBE, HAS_GZIP, N, NOTHING, PROGRAM, VERTICES, WARNS, XYZ, cases, off, pcd, ply,
                     refused_files, table, text_of)

TABLES = ["xyz", "csv"]
TWO = "element vertex 2\n" + XYZ
PCD_ROWS = pcd("", count=2, size=4)
STRIP = VERTICES + "element strip 1\nproperty list int int vertex_indices\n"
PLAIN = {"off": off(CUBE), "ply": ply(CLOUD, CUBE), "pcd": pcd(CUBE, "x y z normal_x normal_y normal_z"),
         **{kind: CUBE for kind in TABLES}}


def prepare(p):
    room = turned_room()
    rng = random.Random(1)

    numbered = rows_of(room, before=lambda i: f"{i + 7} ")
    pts = rows_of(room, before=lambda i: f"{i + 7} ", after=lambda i: f" {i % 50}")
    p.write({"plain.xyz": rows_of(room), "numbered.xyz": numbered,
             "broken.xyz": rows_of(room, before=lambda i: f"{(i + (i >= 2000)) * .02:.4f} "),
             "numbered.pts": f"{len(room)}\n{pts}", "numbered.txt": "x y z\n" + numbered,
             "named.csv": "Easting,Northing,Elevation\n" + rows_of(room, ","),
             "units.csv": "Point,East [m],North [m],Height (m)\n" + rows_of(room, ",", lambda i: f"P{i},"),
             "short.txt": "E N Z\n" + rows_of(room), "degrees.csv": "lon,lat,height\n" + rows_of(room, ","),
             "strange.csv": "rechts,hoch,auf\n" + rows_of(room, ","), "points.asc": rows_of(room),
             "normals.xyzn": rows_of(room, after=lambda i: " 0 0 0"),
             "colors.xyzrgb": rows_of(room, after=lambda i: " 0.25 0.5 1"),
             "commas.csv": rows_of(room, ";").replace(".", ","),
             "commas.txt": "x y z\n" + rows_of(room, "\t").replace(".", ","),
             "commas.ptx": ptx(room).replace(".", ","), "one.ptx": ptx(room),
             # Each row of the raster has one y, and an x that counts.
             "raster.xyz": "".join(f"{x} {y} {rng.gauss(0, .004):.3f} 9\n" for y in range(4) for x in range(1200))})


# --- Commas


@table("row", ["1,5 2,5 3,5", " -1,5\t2\t3 ", "1 2 3,5", "1,5;2,5;3,5", "1,5, 2,5, 3,5", "1,5 ,2,5 ,3,5", "1,05,2,5,3,5",
               "1.234,5;2;3", "1,234.5 2,345.6 3,456.7", "1,034.5,2,345.6,3,456.7", "1 234,5;2 345,6;3 456,7"])
def test_commas_within_numbers(p, row):
    """The first row, a later one, one below names, and one whose columns are named."""
    for text, number, more in ((f"{row}\n{row}\n", 1, ""), (f"0.5 1 2\n\n# comment\n{row}\n", 4, ""),
                               (f"x y z\n0.5 1 2\n{row}\n", 3, ""), (f"{row}\n{row}\n", 1, "--columns 'x y z'")):
        p.write({"comma.csv": text})
        p(1, f"comma.csv: row {number} .*with a decimal point", f"comma.csv {more}")


@table("row", ["1,5 2,5 3,5", "1,234.5 2 3", "1 2 3,5", "1,2,3"])
def test_commas_where_blanks_separate(p, row):
    p.write({"comma.off": off(f"0 0 0\n{row}\n", "2 0 0"), "comma.ply": ply(TWO, f"0 0 0\n{row}\n"),
             "comma.pcd": f"{PCD_ROWS}0 0 0\n{row}\n"})
    p(1, "comma.off: row 4 has a comma .write numbers with a decimal point", "comma.off")
    p(1, "comma.ply: row 2 of 'vertex' has a comma .write numbers with a decimal point", "comma.ply")
    p(1, "comma.pcd: row 7 has '[0-9,.]+' where a number is expected.*with a decimal point", "comma.pcd")


PAIRS = "pairs.csv: each row has integers with commas between them, read as x y z r g b"


@table("code, row, pattern", [
    *((WARNS, row, f'warnings": .*"{PAIRS}[_ ]*: .*warning: {PAIRS}[_ ]*: if the commas are decimal commas, ')
      for row in ("4,4,17,4,1,1", "1,5,2,5,3,5", "-4,4,-17,4,+1,1", "4,4,17,4,1,1,0,5", "4,4,17,4,1,1,0,0,0,0,1,0")),
    *((1, row, "pairs.csv: each row has integers .*, read as x y z r g b with values above 255 for r g b: if")
      for row in ("5,426,18,369,2,112", "4,4,17,400,1,1"))])  # colors above 255 are none
def test_integers_with_commas_only(p, code, row, pattern):
    """They may be numbers with decimal commas, or with separators of thousands."""
    p.write({"pairs.csv": re.sub("[^,]+", "1", row) + f"\n{row}\n"})
    p(code, pattern, "pairs.csv --maximum-distance 1 --report /dev/stdout")


NAMED = "--columns 'x y z'"
RAGGED = "1,5,2,5,3,5\n1,5,2,3,5\n"
RASTER = "NCOLS 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n"
test_refused = refused_files([
    ("zero.csv", "1,05,2,5,3,5\n",
     "row 1 has a number with a leading 0 after a comma, .*write numbers with a decimal point"),
    # More values than names, or another number of them in each row
    ("names.csv", "x,y,z\n1,5,2,5,3,5\n",
     "row 2 has more than 3 values .name all its columns by --columns, those to skip by _.", NAMED),
    ("ragged.csv", RAGGED, "row 1 has more than 3 values", NAMED),
    ("ragged.csv", RAGGED, "row 1 has more than 5 values", "--columns 'x _ y z _'"),
    ("ragged.csv", RAGGED, "row 2 has 5 values instead of 6\n"),
    ("cut.csv", "1.5,2.5,3.5\n2.5,1.5,4.5\n1.5,2", "row 3 has 2 values instead of 3\n"),
    ("less.pcd", PCD_ROWS + "0 0 0\n0.25 0.25\n", "row 7 has 2 values instead of 3"),
    ("less.xyz", BARE + "1 2\n", "row 1729 has 2 values instead of 3"),
    ("word.xyz", BARE + "1 2 three\n", "row 1729 has 'three' where the number z is expected"),
    # With --decimal-comma
    *(("points.txt", f"1;2;3\n{row}\n",
       "row 2 has '[0-9.,]+': with --decimal-comma, numbers have a comma, but no point and", "--decimal-comma")
      for row in ("1.234,5;2;3", "1.5;2,5;3", "1 2.25 3", "1.5,2.5,3.5")),
    ("commas.csv", None, "row 1 .*numbers have no commas.* .or give --decimal-comma."),
    ("commas.txt", None, "row 2 .*or give --decimal-comma.", NAMED),
    # Names and extensions
    ("strange.csv", None, "row 1 is a line of names without x, y and z .name the columns by --columns.\n"),
    ("raster.asc", RASTER, "is a raster of ESRI .its first word is ncols., not a table"),
    *((f"cloud.{kind}", "1 2 3\n", f"this program does not read .{kind}; {advice}") for kind, advice in (
        ("npy", "write the array as text by numpy.savetxt"), ("vtk", "convert the file to PLY, .* ParaView"),
        ("splat", "convert the file to PLY, .* SuperSplat"))),
    ("cloud.doc", "1 2 3\n", r"unknown format '.doc', expected .*\.pwn, .xyzn, .xyzrgb, .asc")])


@table("columns, rows, more", [
    # Commas and semicolons between values are read, also those of integers.
    *(("x y z", rows, "") for rows in ("1,2,3\n4,5,6\n", "1.5, 2.5, 3.5\n4, 5,6 ,\n", "1.5 2.5 3.5\n4 ,, 5\n",
                                       "1;2.5; 3\r\n4; 5;6;\r\n")),
    *(("x y z r g b", rows, "") for rows in (
        "1,-5,2,5,3,5\n0,10,20,0,0,0\n", "x,y,z,r,g,b\n1,5,2,5,3,5\n", "1;5;2;500;3;5\n0;10;20;0;0;0\n",
        "1,5,2.5,500,3,5\n0,10,20,0,0,0\n", "100, 20,300,  5, 10, 15\n  1,  2,  3,  5, 10,100\n")),
    ("x y z r g b", "1,5,2,5,3,500\n", "--columns 'x y z r g b'"), ("x y z", "1;2;3;4\n", NAMED),
    ("_ x y z", "scan 05,1,2,3\nscan 06,1,2,3\n", "--columns '_ x y z'"), ("x _ y z", "x,,y,z\n1,a b,2,3\n", ""),
    # x, y and z are never others where a file has them.
    ("_ x y z", "height,x,y,z\n9,1,2,3\n9,2,2,3\n9,3,4,3\n", ""),
    # Decimal commas
    ("x y z", "1,5, 2,5, 3,5\n1,5, 2,5, 4,5\n", "--decimal-comma"),
    ("x y z _", "X;Y;Z;code 1.2\n1,5;2;3;a.1\n1,5;2;4;b\n", "--decimal-comma")])
def test_columns(p, columns, rows, more):
    """Few points have no shape, which is the only warning."""
    p.write({"right.csv": rows})
    text = p(WARNS, f"columns +{columns}( [(][^\n]*)?\n", f"right.csv --maximum-distance 1 {more}")
    assert "warning: right.csv" not in text


def test_decimal_commas(p):
    """With a digit before them, a sign, a blank, or nothing"""
    p.write({"commas.xyz": "1,5 -2,5 3,5e1\n,5 ,25 -,5\n1 2 +,75\n"})
    p(WARNS, "", "commas.xyz --decimal-comma --maximum-distance 1 --output values.csv --quiet")
    values = p.csv("values.csv")
    assert np.stack([values[name] for name in "xyz"], axis=1).tolist() == [[1.5, -2.5, 35], [.5, .25, -.5], [1, 2, .75]]
    p(0, p.hash("one.ptx"), "commas.ptx --decimal-comma")


# --- Names, extensions and a column that counts the rows


def test_tables_with_the_same_result(p):
    room_hash = p.hash("plain.xyz", "columns +x y z\n.*shapes +3 in 3 planes ")
    for columns, names in (
            ("x y z", ["named.csv", "short.txt", "named.csv --columns 'x y z'", "strange.csv --columns x,y,z", "points.asc",
                       "commas.csv --decimal-comma", "commas.txt --decimal-comma"]), ("_ x y z .column 1: Point.", ["units.csv"]),
            ("_ x y z .column 1: integers before other numbers.", ["numbered.xyz", "numbered.txt"]),
            ("_ x y z intensity .column 1: integers before other numbers.", ["numbered.pts"]), ("x y z r g b", ["colors.xyzrgb"])):
        for arguments in names:
            p(0, f"columns +{columns}\n.*{room_hash}", arguments)


test_other_tables = cases([
    (0, "columns +x y z intensity\n", "raster.xyz --maximum-distance .02"),
    (0, "normals estimated\n +columns +x y z nx ny nz\n", "normals.xyzn"),  # all of them are zero
    (2, "--decimal-comma is for text tables .* and .ptx", "cube.ply --decimal-comma")])


def test_warnings(p):
    p.warns("degrees.csv", "degrees.csv: x and y are columns of longitude and latitude: planes need lengths, so first project")
    p.warns("broken.xyz", "broken.xyz: column 1 has equal steps until row 2001, so the program skips it")


# --- Columns without names


def column_of(kind, rng, count):
    """What is before or behind coordinates, or is one: the texts of a column."""
    ids = sorted(rng.sample(range(10 ** 6), count))
    start = rng.uniform(1e5, 6e5)
    values = {
        "id": ids, "shuffled": rng.sample(ids, count), "ring": [rng.randrange(32) for _ in ids],
        "rings": sorted(rng.randrange(32) for _ in ids), "gray": [rng.randrange(256) for _ in ids],
        "name": [f"P{i}" for i in ids], "code": [rng.choice(["KERB", "TREE"]) for _ in ids],
        "ratio": [f"{rng.random():.4f}" for _ in ids], "place": [f"{i * .0005:.4f}" for i in range(count)],
        "unix": [f"{1.7e9 + i * .001:.4f}" for i in range(count)], "week": [f"{start + i / 3e4:.6f}" for i in range(count)],
        "times": sorted(f"{rng.random():.6f}" for _ in ids),
        "rounded": [f"{start + i / 3e4:.4f}" for i in range(count)], "clock": [f"{i / 30:.6f}" for i in range(count)]}[kind]
    return [str(value) for value in values]


INTEGERS = "integers before other numbers"


@table("kinds, seed, columns, digits, scale", [
    # Ordinary tables: x y z are first, also where they are integers, sorted, or far from 0.
    *(("", 2, "x y z", digits, scale) for digits, scale in ((4, 1), (0, 1000))),
    *(("xyz gray", 3, "x y z intensity", digits, scale) for digits, scale in ((4, 1), (0, 1000), (None, 1))),
    *((f"{order} {behind}", 4, "x y z intensity", 4, 1) for order in ("xyz", "sorted", "far", "level", "wall")
      for behind in ("ratio", "gray")),
    ("sorted gray", 5, "x y z intensity", 0, 1000), ("far ratio", 5, "x y z intensity", None, 1),
    ("xyz gray gray gray", 6, "x y z r g b", 0, 1000),
    ("xyz gray ring week", 7, "x y z _ _ _ .column 4: integers; column 5: integers; column 6: numbers.", 3, 1),
    ("xyz code", 8, "x y z _ .column 4: words.", 3, 1),
    # Something else is before them.
    *((f"{kind} xyz", 9, f"_ x y z .column 1: {INTEGERS}.", 3, 1) for kind in ("id", "shuffled", "ring")),
    *((f"{kind} xyz gray", 10, f"_ x y z intensity .column 1: {INTEGERS}.", None, 1)
      for kind in ("id", "shuffled", "ring")),
    ("shuffled xyz", 11, "_ x y z .column 1: a different integer in each row.", 0, 1000),
    ("unix xyz", 12, "_ x y z .column 1: too large for a length.", 4, 1),
    ("week far", 13, "_ x y z .column 1: other digits than the next columns.", 3, 1),
    ("clock xyz", 14, "_ x y z .column 1: equal steps from row to row.", 6, 1),
    ("id far code", 15, f"_ x y z _ .column 1: {INTEGERS}; column 5: words.", 2, 1),
    ("name xyz gray", 16, "_ x y z intensity .column 1: words.", 3, 1),
    ("code id xyz", 17, f"_ _ x y z .column 1: words; column 2: {INTEGERS}.", 3, 1),
    ("times ring xyz", 18, f"_ _ x y z .column 1: before integers; column 2: {INTEGERS}.", 3, 1),
    ("id ring xyz", 19, f"_ _ x y z .column 1: {INTEGERS}; column 2: {INTEGERS}.", 3, 1),
    # Either may be.
    *((kinds, 20, "", digits, scale) for kinds, digits, scale in (
        ("rings xyz", 3, 1), ("id xyz", 0, 1000), ("rounded xyz", 4, 1), ("ring ring xyz", 3, 1)))])
def test_columns_without_names(p, kinds, seed, columns, digits, scale):
    rng = random.Random(seed)
    room = turned_room()
    of_kind = {"far": room + (512345, 4512345, 200), "sorted": room[np.lexsort(room.T[::-1])], "level": room * (1, 1, 0),
               "wall": room * (0, 1, 1)}
    cells = []
    for kind in kinds.split() or ["xyz"]:
        coordinates = of_kind.get(kind, room if kind == "xyz" else None)
        cells += ([column_of(kind, rng, len(room))] if coordinates is None else
                  [[f"{x:.6g}" if digits is None else f"{x:.{digits}f}" for x in column] for column in scale * coordinates.T])
    p.write({"nameless.xyz": "".join(" ".join(row) + "\n" for row in zip(*cells))})
    arguments = f"nameless.xyz --maximum-distance {.02 * scale} --report n.json"
    if columns:
        p(WARNS if digits is None and "far" in kinds else 0, f"columns +{columns}\n", arguments)  # rounded
        assert re.fullmatch(f"columns {columns}", p.json("n.json")["notes"][0])
        return
    text = p(1, "nameless.xyz: x may be column 1 or 2 .column 1: .*: pass --columns '", arguments)
    first, second = re.findall("--columns '([^']*)'", text)
    assert first.startswith("x y z") and second.startswith("_ x y z")
    p(WARNS if kinds == "ring ring xyz" else 0, f"columns +{second}\n", f"{arguments} --columns '{second}'")


@table("value, axes, kind", [
    ("-9999", [2], "xyz"), ("-99999.00", [0, 1, 2], "far"), ("1e10", [0], "xyz"), ("-32768", [2], "far"),
    ("0", [0, 1, 2], "far"), ("-999", [1], "xyz"), ("3.4028235e38", [2], "xyz")])
def test_no_values(p, value, axes, kind):
    """They are counted, told, and free; the others are as without them, and no point is lost."""
    room = turned_room() + (0 if kind == "xyz" else (512345, 4512345, 200))
    rows = [[f"{x:.4f}" for x in point] for point in room]
    for row in rows[::9]:
        for axis in axes:
            row[axis] = value
    p.write({"values.xyz": "".join(" ".join(row) + "\n" for row in rows),
             "others.xyz": "".join(" ".join(row) + "\n" for i, row in enumerate(rows) if i % 9)})
    count = len(rows[::9])
    what = f"points with {'xyz'[axes[0]]} {float(value):.10g}, far from all others.* left out: {count}".replace("+", "[+]")
    what = f"{count} points are exactly at 0 0 0, like" if value == "0" else what
    outputs = "--labels v.labels --planes v.planes --output v.csv"
    p.warns(f"values.xyz --maximum-distance .02 {outputs}", what)
    p(0, NOTHING, "others.xyz --maximum-distance .02 --quiet --planes o.planes --labels o.labels")
    labels = p.labels("v.labels")
    assert (labels[::9] == -1).all() and p.is_same("v.planes", "o.planes")
    assert (np.delete(labels, np.s_[::9]) == p.labels("o.labels")).all()
    counts = p.json("w.json")["counts"]
    assert counts["ignored_zeros"] + counts["ignored_no_values"] == counts["ignored"] == count
    # The grid of LAS is as fine as without them.
    p(WARNS, what, "values.xyz --maximum-distance .02 --quiet --output v.las")
    points = read_las(p.path("v.las").read_bytes()).points
    assert len(points) == len(room) and abs(np.delete(points, np.s_[::9], 0) - np.delete(room, np.s_[::9], 0)).max() < 6e-5
    written = p.csv("v.csv")
    assert len(written) == len(room) and (written["xyz"[axes[0]]][::9] == float(value)).all()


def test_no_value_is_missing(p):
    """Exact planes above each other, one at a height of nines"""
    points = np.rint(1000 * np.random.default_rng(5).random((4000, 3)))
    points[:, 2] = np.where(points[:, 2] < 500, 0, 999)
    p.write({"exact.xyz": text_of(points)})
    p(0, "points +4000, normals estimated\n.*shapes +2 in 2 planes", "exact.xyz --maximum-distance 5")


# --- Ends of lines, and none


@table("kind", PLAIN)
def test_carriage_returns(p, kind):
    text = PLAIN[kind]
    lines = text.split("\n")
    lines[999] = re.sub(r"^(\S+ \S+) ", r"\1" + "\r", lines[999])  # of a row of the points
    files = {"crlf": text.replace("\n", "\r\n"), "cr": text.replace("\n", "\r"), "row": "\n".join(lines),
             "zero": "\n".join(lines[:20]) + "\n\0" + "\n".join(lines[20:])}
    p.write({f"{name}.{kind}": content for name, content in files.items()})
    p(0, f"points +{N}", f"crlf.{kind} E")
    for name, row in (("cr", "1"), ("row", "[0-9]+ (of 'vertex' )?")):
        p(1, f"{name}.{kind}: row {row} ?ends in a carriage return alone", f"{name}.{kind}")
    if kind != "ply":  # a byte 0, as of UTF-16: the message is whole
        p(1, f"zero.{kind}: row 21 has a byte 0, as texts in UTF-16 have", f"zero.{kind}")


LIMIT = "more than 65536 bytes, the limit of a"


@table("row, name, text", [
    ("row 3", "endless.csv", "0 0 0\n1 0 0\n0 1 0"), ("row 2", "endless.xyz", "0 0 0\n# comment"),
    ("row 2", "count.off", "OFF\n1"), ("row 4", "rows.off", "OFF\n2 0 0\n0 0 0\n1 0 0"),
    ("row 4", "face.off", "OFF\n1 1 0\n0 0 0\n1 0"), ("row 3", "note.ply", "ply\nformat ascii 1.0\ncomment"),
    ("row 2 of 'vertex'", "rows.ply", ply(TWO, "0 0 0\n1 0 0")), ("row 1 of 'strip'", "strip.ply", ply(STRIP, BARE + "1 ")),
    ("row 3", "size.pcd", "# comment\nFIELDS x y z\nSIZE 4"), ("row 7", "rows.pcd", PCD_ROWS + "0 0 0\n1 0 0")])
def test_lines_without_an_end(p, row, name, text):
    """What has no bytes on the disk is 4 GB of zeros."""
    p.write({name: text})
    os.truncate(p.path(name), 4 << 30)
    p.shell(1, f"{name}: {row} has {LIMIT}", f"exec timeout -k 1 10 $P {name}")
    p.path(name).unlink()


def test_long_lines(p):
    p.write({"wide.xyz": f"0 0{' ' * 65000}0\n1 0 0\r", "strip.ply": ply(STRIP, f"{BARE}100000{' 1' * 100000}\n"),
             "line.xyz.gz": gzip.compress(bytes(100000000), 1)})
    p(WARNS, "points +2,", "wide.xyz --maximum-distance 1")
    p(0, f"points +{N},", "strip.ply E")  # no line of points
    p(1, f"line.xyz.gz: row 1 has {LIMIT}" if HAS_GZIP else "without zlib", "line.xyz.gz")
