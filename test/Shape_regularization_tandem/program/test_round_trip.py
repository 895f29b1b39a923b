# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the input has of each point and around the points is in an output of the same format, byte for byte; the shape is
added."""

import csv
import re
import struct

import numpy as np
import pytest
from clouds import COLOR_PLACES, RECORD_SIZES, las, lzf, read_las
from support import HELP, N, NOTHING, ROWS, WARNS, binary_ply, pcd, ply, properties, table, text_of

POINTS = ROWS[:, :3]
NORMALS = ROWS[:, 3:]
RNG = np.random.default_rng(5)
HAS_LAZ = ".laz" in HELP
LAYOUT = "number, version, extra"
LAYOUTS = [*((f, v, 0) for f in range(11) for v in range(5) if v >= (0, 0, 2, 2, 3, 3, 4, 4, 4, 4, 4)[f]), (3, 2, 9),
           (6, 4, 9), (10, 4, 300)]


def described(kind, name, options=0):
    """A description of extra bytes; kind 0: as many as the options say."""
    return struct.pack("<HBB32s156s", 0, kind, options, name, b"")


def record(user, number, content, extended=False):
    return struct.pack("<H16sHQ32s" if extended else "<H16sHH32s", 0, user, number, len(content), b"a name") + content


WAVEFORMS = record(b"somebody", 65535, bytes(range(99)), True)


def any_las(number, version, extra, tail=b""):
    """All bytes but those of the coordinates are random; a double `gain` is described if there are 8 bytes for it."""
    data = las(POINTS, number, version, records=(), extra=extra)
    size, = struct.unpack_from("<H", data, 94)
    header, rows = bytearray(data[:size]), np.frombuffer(data[size:], np.uint8).reshape(N, -1).copy()
    rows[:, 12:] = RNG.integers(0, 256, (N, rows.shape[1] - 12))
    blocks = [record(b"LASF_Projection", 2112, b"WKT\0\0"), record(b"somebody", 7, b"anything")]
    blocks += [record(b"LASF_Spec", 4, described(10, b"gain"))] if extra >= 8 else []
    header[6:58] = struct.pack("<H16s2B32s", 16 + 1, b"0123456789abcdef", 1, version, b"a scanner")
    header[90:94] = struct.pack("<HH", 77, 2020)
    struct.pack_into("<II", header, 96, size + len(b"".join(blocks)), len(blocks))
    if tail:
        place = size + len(b"".join(blocks)) + rows.size
        struct.pack_into("<Q", header, 227, place + len(tail) - len(WAVEFORMS))
        header[235:247] = struct.pack("<QI", place, 2) if version == 4 else header[235:247]
    return bytes(header) + b"".join(blocks) + rows.tobytes() + tail


def check_las(p, name, before, labels=True):
    """The points, the records and the header of a file with the shape."""
    old, new = read_las(before), read_las(p.path(name).read_bytes())
    assert new.format == old.format and (new.rows[:, :-4] == old.rows).all()
    assert (new.rows[:, -4:].copy().view("<i4").ravel() == p.labels("labels")).all()
    descriptions = new.records.pop(("LASF_Spec", 4))
    old_descriptions = old.records.pop(("LASF_Spec", 4), b"")
    assert descriptions.startswith(old_descriptions) and len(descriptions) % 192 == 0
    sizes = [description[3] if description[2] == 0 else {6: 4, 10: 8}[description[2]]
             for description in (descriptions[i:i + 192] for i in range(0, len(descriptions), 192))]
    assert sum(sizes) == old.rows.shape[1] - RECORD_SIZES[old.format] + 4 and descriptions[-188:-183] == b"shape"
    assert new.records == old.records
    changed = [*range(58, 90), *range(96, 104), *range(105, 131), *range(179, 375)]  # software, counts, places, bounds
    assert [a for i, a in enumerate(new.header) if i not in changed] == [
        a for i, a in enumerate(old.header) if i not in changed]
    assert (new.bounds == np.stack([old.points.max(axis=0), old.points.min(axis=0)], axis=1)).all()
    numbers = old.rows[:, 14] & (7 if old.format < 6 else 15)
    assert new.returns == [np.count_nonzero(numbers == r + 1) for r in range(len(new.returns))]
    return new


@table(LAYOUT, LAYOUTS)
def test_las(p, number, version, extra):
    before = any_las(number, version, extra)
    p.write({"in.las": before})
    p(0, NOTHING, "in.las E --quiet --output out.las --labels labels")
    check_las(p, "out.las", before)
    # The shape of another run is replaced.
    p(0, "replaced +the property 'shape' of the input", "out.las E --output again.las")
    assert p.is_same("out.las", "again.las")
    p(0, NOTHING, "out.las E --quiet --output two.las --label-property second")
    two = read_las(p.path("two.las").read_bytes())
    assert (two.rows[:, -4:] == two.rows[:, -8:-4]).all() and two.rows.shape[1] == RECORD_SIZES[number] + extra + 8


@table("number, version", [(1, 4), (7, 4), (10, 4), (4, 3)])
def test_records_behind_the_points(p, number, version):
    """Of LAS 1.4, or the waveforms of LAS 1.3"""
    tail = (record(b"LASF_Projection", 2112, b"WKT\0", True) if version == 4 else b"") + WAVEFORMS
    before = any_las(number, version, 0, tail)
    p.write({"tail.las": before})
    for kind in ["las"] + ["laz"] * HAS_LAZ:
        p(0, NOTHING, f"tail.las E --quiet --output tailed.{kind} --labels labels")
        data = p.path(f"tailed.{kind}").read_bytes()
        waveforms, first, count = struct.unpack_from("<QQI", data, 227)
        assert data[waveforms:] == WAVEFORMS and (version == 3 or (data[first:], count) == (tail, 2))
    assert check_las(p, "tailed.las", before).tail == tail
    if HAS_LAZ:
        p(0, NOTHING, "tailed.laz E --quiet --output back.las")
        assert p.path("back.las").read_bytes()[90:] == p.path("tailed.las").read_bytes()[90:]


def test_damaged_records(p):
    """They are told: one before the points that is not there, and one behind them of which the head is cut."""
    tail = record(b"LASF_Projection", 2112, b"WKT\0", True) + WAVEFORMS
    data = bytearray(any_las(6, 4, 0, tail))
    data[100] += 1
    p.write({"damaged.las": bytes(data[:-len(WAVEFORMS) + 20])})
    p.warns("damaged.las E --output out.las", "LAS records that are damaged, or not there, are not in the output: 2")


@pytest.mark.skipif(not HAS_LAZ, reason="built without LASzip")
@table(LAYOUT, LAYOUTS)
def test_laz(p, number, version, extra):
    p.write({"plain.las": any_las(number, version, extra)})
    p(0, NOTHING, "plain.las E --quiet --output packed.laz --labels labels")
    p(0, NOTHING, "packed.laz E --quiet --output unpacked.las")
    check_las(p, "unpacked.las", p.path("plain.las").read_bytes())


@table("number", range(11))
def test_las_in_colors_of_the_shapes(p, number):
    """A format without colors becomes the one that has them in addition."""
    before = any_las(number, 4, 9)
    p.write({"gray.las": before})
    p(0, NOTHING, "gray.las E --quiet --output colored.las --labels labels --colors shape")
    old, new, labels = read_las(before), read_las(p.path("colored.las").read_bytes()), p.labels("labels")
    assert new.format == {0: 2, 1: 3, 4: 5, 6: 7, 9: 10}.get(number, number)
    place, added = COLOR_PLACES[new.format], RECORD_SIZES[new.format] - RECORD_SIZES[number]
    assert (new.rows[:, :place] == old.rows[:, :place]).all()
    assert (new.rows[:, place + (added or 6) :-4] == old.rows[:, place + (0 if added else 6):]).all()
    colors = {tuple(row) for row in np.column_stack([labels, new.rows[:, place:place + 6].copy().view("<u2")]).tolist()}
    assert len(colors) == len(set(labels.tolist()))


def test_las_of_other_formats(p):
    """There are colors only if the input has them."""
    p.write({"gray.txt": text_of(POINTS), "red.txt": text_of(np.column_stack([POINTS, np.full((N, 3), (200, 10, 0))]))})
    for name, number in (("gray", 0), ("red", 2)):
        p(0, NOTHING, f"{name}.txt E --quiet --output {name}.las")
        assert read_las(p.path(f"{name}.las").read_bytes()).format == number


# --- PLY


COMMENTS = "comment by hand\nobj_info scan 7\n"
TYPES = [("gps", "f8"), ("x", "f4"), ("y", "f4"), ("z", "f4"), ("scalar_Intensity", "f4"), ("flags", "u2"), ("row", "i4"),
         ("red", "u1"), ("green", "u1"), ("blue", "u1"), ("alpha", "u1")]
NAMES = {"f8": "double", "f4": "float", "u2": "ushort", "i4": "int", "u1": "uchar"}


def cloud(names=None):
    rows = np.zeros(N, [(name, "<" + kind) for name, kind in TYPES if names is None or name in names])
    for name, kind in TYPES:
        if name in rows.dtype.names:
            rows[name] = RNG.random(N) * 1e9 if kind == "f8" else RNG.integers(0, 200, N)
    for c, name in enumerate("xyz"):
        rows[name] = POINTS[:, c]
    return rows


def property_lines(rows):
    return "".join(f"property {NAMES[rows.dtype[name].str[1:]]} {name}\n" for name in rows.dtype.names)


BEFORE = "element camera 1\nproperty float focal\nproperty list uchar short view\n"
BEHIND = "element note 2\ncomment of notes\nproperty list int uchar text\n"


def header(kind, points, first=BEFORE, last=BEHIND):
    return (f"ply\nformat {kind} 1.0\n{COMMENTS}{first}element vertex {N}\n{points}{last}end_header\n")


def ply_of_kind(kind, rows):
    """The header with a list among the properties, the other elements, and each row."""
    points = property_lines(rows).replace("property int row",
                                          "comment of rows\nproperty list uchar ushort more\nproperty int row")
    lists = [list(range(i % 3)) for i in range(N)]
    place = rows.dtype.names.index("row")
    if kind == "ascii":
        text = [" ".join([*map(str, row[:place]), str(len(more)), *map(str, more), *map(str, row[place:])])
                for row, more in zip(rows.tolist(), lists)]
        return points, b"35 2 4 5\n", [(line + " ").encode() for line in text], b"2 7 8\n0\n"
    order = ">" if "big" in kind else "<"
    types = rows.dtype.newbyteorder(order)
    split = types.fields[rows.dtype.names[place]][1]
    packed = rows.astype(types).tobytes()
    lines = [packed[i * types.itemsize:i * types.itemsize + split] + struct.pack(f"{order}B{len(more)}H", len(more), *more) +
             packed[i * types.itemsize + split:(i + 1) * types.itemsize] for i, more in enumerate(lists)]
    return (points, struct.pack(order + "fBhh", 35, 2, 4, 5), lines, struct.pack(order + "iBBi", 2, 7, 8, 0))


@table("kind", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_ply(p, kind):
    rows = cloud()
    points, camera, lines, notes = ply_of_kind(kind, rows)
    end = b"\n" if kind == "ascii" else b""
    p.write({"in.ply": header(kind, points).encode() + camera + b"".join(line + end for line in lines) + notes})
    p(0, NOTHING, "in.ply E --estimate-normals --quiet --output out.ply --labels labels")
    head, body = p.path("out.ply").read_bytes().split(b"end_header\n", 1)
    added = "property float nx\nproperty float ny\nproperty float nz\nproperty int shape\n"
    assert head.decode() + "end_header\n" == header(kind, points + added)
    assert body.startswith(camera) and body.endswith(notes)
    place = len(camera)
    for line, label in zip(lines, p.labels("labels").tolist()):
        assert body[place:place + len(line)] == line
        place += len(line)
        if kind == "ascii":
            *normal, shape = body[place:body.index(b"\n", place)].split()
            place = body.index(b"\n", place) + 1
        else:
            *normal, shape = struct.unpack_from((">" if "big" in kind else "<") + "fffi", body, place)
            place += 16
        assert int(shape) == label and abs(np.linalg.norm(np.array(normal, float)) - 1) < 1e-5
    assert body[place:] == notes
    p(0, "replaced +the property 'shape' of the input", "out.ply E --output again.ply")
    assert p.is_same("out.ply", "again.ply")
    # Other elements may name points by their places.
    p.warns("in.ply E --crop=-1,-1,-1,2,2,.1 --output cut.ply",
            "in.ply: has more than points, which the output does not have, because points are left out")
    cut = p.read("cut.ply")
    assert "element note" not in cut and "element camera" not in cut and COMMENTS in cut


def test_colors_and_normals_of_ply(p):
    """Those of the input are kept, unless others are asked for."""
    rows = np.column_stack([POINTS, 2 * NORMALS, np.full((N, 3), (1, 2, 3))])
    p.write({"rich.ply": ply(f"element vertex {N}\n" + properties(["x", "y", "z", "nx", "ny", "nz"]) +
                             properties(["red", "green", "blue"], "ushort"), text_of(rows)),
             "poor.ply": ply(f"element vertex {N}\n" + properties("xyz"), text_of(POINTS))})
    for name, more, added in (("rich", "", []), ("rich", "--colors shape", ["red"]), ("poor", "", ["nx", "red"]),
                              ("rich", "--estimate-normals", ["nx"])):
        p(0, NOTHING, f"{name}.ply E --quiet --output out.ply {more}")
        lines = p.read("out.ply").split("end_header\n")
        types = dict(line.split()[:0:-1] for line in lines[0].splitlines() if line.startswith("property"))
        assert list(types)[-1] == "shape" and {"x", "nx", "red"} <= set(types)
        assert types["red"] == ("uchar" if "red" in added else "ushort")
        table_of = np.array([line.split() for line in lines[1].splitlines()], float)
        for group, columns in (("nx", slice(3, 6)), ("red", slice(6, 9))):
            names = list(types)
            values = table_of[:, names.index(group):names.index(group) + 3]
            assert (values == rows[:, columns]).all() == (group not in added)


# --- PCD


@table("kind", ["ascii", "binary", "binary_compressed"])
def test_pcd(p, kind):
    rows = cloud(["gps", "x", "y", "z", "flags", "row"])
    names = rows.dtype.names
    sizes = [rows.dtype[name].itemsize for name in names]
    types = [{"f": "F", "u": "U", "i": "I"}[rows.dtype[name].kind] for name in names]

    def head(added, kind):
        lists = {"FIELDS": names, "SIZE": sizes, "TYPE": types, "COUNT": [1] * len(names)}
        return "# by hand\nVERSION .7\n" + "".join(" ".join([key, *map(str, values), *added.get(key, [])]) + "\n" for key, values in
                                    lists.items()) + f"WIDTH {N // 2}\nHEIGHT 2\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS {N}\nDATA {kind}\n"

    packed = lzf(b"".join(rows[name].tobytes() for name in names))
    text = "".join(" ".join(map(str, row)) + "\n" for row in rows.tolist())
    body = {"ascii": text.encode(), "binary": rows.tobytes(),
            "binary_compressed": struct.pack("<II", len(packed), rows.nbytes) + packed}[kind]
    p.write({"in.pcd": head({}, kind).encode() + body})
    p(0, NOTHING, "in.pcd E --quiet --output out.pcd --labels labels")
    added = {"FIELDS": ["normal_x", "normal_y", "normal_z", "rgb", "shape"], "SIZE": ["4"] * 5, "TYPE": [*"FFFFI"],
             "COUNT": ["1"] * 5}
    expected = head(added, "ascii" if kind == "ascii" else "binary").encode()
    out = p.path("out.pcd").read_bytes()
    assert out.startswith(expected)
    if kind == "ascii":
        lines = [line.rsplit(" ", 5) for line in out[len(expected):].decode().splitlines()]
        assert [line[0] for line in lines] == text.splitlines()
        assert [int(line[-1]) for line in lines] == p.labels("labels").tolist()
    else:
        new = np.frombuffer(out[len(expected):], [("row", rows.dtype), ("added", "4<f4"), ("shape", "<i4")])
        assert new["row"].tobytes() == rows.tobytes() and (new["shape"] == p.labels("labels")).all()
    p(0, "replaced +the property 'shape' of the input", "out.pcd E --output again.pcd")
    assert p.is_same("out.pcd", "again.pcd")


# --- Tables


def test_tables(p):
    rows = [f"{i};{x:.3f};007;{y:.3f};{z:.3f};;pole {i % 3};1e-3" for i, (x, y, z) in enumerate(POINTS.tolist())]
    p.write({"in.csv": "Point id;Easting;Code;Northing;Height;Empty;Kind;Error\n" + "\n".join(rows) + "\n",
             "bare.txt": "".join(f"{x:.3f} {y:.3f} {z:.3f} 0.50 7.10\n" for x, y, z in POINTS)})
    p(0, NOTHING, "in.csv E --quiet --output out.csv --labels labels")
    names, *lines = p.lines("out.csv")
    assert names == "Point id,Easting,Code,Northing,Height,Empty,Kind,Error,nx,ny,nz,r,g,b,shape"
    assert [line.split(",")[:8] for line in lines] == [row.split(";") for row in rows]
    assert [int(line.split(",")[-1]) for line in lines] == p.labels("labels").tolist()
    p(0, NOTHING, "in.csv E --quiet --output out.txt")
    assert p.lines("out.txt")[0].startswith("# Point_id Easting Code") and " 007 " in p.lines("out.txt")[1]
    assert " nan pole_0 1e-3 " in p.lines("out.txt")[1]
    p(0, NOTHING, "bare.txt E --quiet --output bare.xyz")
    names, *lines = p.lines("bare.xyz")
    assert names == "# x y z _ _ nx ny nz r g b shape" and all(line.split()[3:5] == ["0.50", "7.10"] for line in lines)
    p(0, "replaced", "bare.xyz E --output again.xyz")
    assert p.is_same("bare.xyz", "again.xyz")


@table("head, row, out", [
    ("x,y,z,r", "5.5", "x,y,z,r,nx,ny,nz,r2,g2,b2,shape"), ("x,y,z,nx", "7", "x,y,z,nx,nx2,ny2,nz2,r,g,b,shape"),
    ('x;y;z;"a;b";v', '"c;d, e";1,5', "x,y,z,a;b,v,nx,ny,nz,r,g,b,shape"), ("x,y,z,v", "", "x,y,z,v,nx,ny,nz,r,g,b,shape"),
    ("x,y,z,note", '"say ""hi"", you"', "x,y,z,note,nx,ny,nz,r,g,b,shape")])
def test_names_of_something_else(p, head, row, out):
    """Fields that are added have other names as a whole; separators in quotes are none."""
    separator = head[1]
    rows = [separator.join([f"{x:.3f}", f"{y:.3f}", f"{z:.3f}", row]) for x, y, z in POINTS]
    p.write({"odd.csv": "\n".join([head, *rows]) + "\n"})
    p(0, NOTHING, "odd.csv E --quiet --output out.csv")
    names, *lines = csv.reader(p.lines("out.csv"))
    values, = csv.reader([row], delimiter=separator) if row else [[""]]
    assert ",".join(names) == out and {len(line) for line in lines} == {len(names)}
    assert all(line[3:3 + len(values)] == values for line in lines)


def test_names_beside_columns(p):
    p.write({"named.xyz": "E N H quality\n" + "".join(f"{x:.3f} {y:.3f} {z:.3f} 7\n" for x, y, z in POINTS)})
    p(0, NOTHING, ["named.xyz", "E", "--quiet", "--columns", "x y z", "--output", "out.csv"])
    assert p.lines("out.csv")[0] == "E,N,H,quality,nx,ny,nz,r,g,b,shape"


# --- Several inputs


def test_descriptions_of_several_inputs(p):
    """The smallest and largest values are those of one file; a name may be there twice."""
    first, second = (any_las(6, 4, 16).replace(described(10, b"gain"),
                                               described(10, b"gain", 6)[:64] + bytes([i + 1]) * 48 + bytes(80))
                     for i in range(2))
    p.write({"first.las": first, "second.las": second,
             "twice.las": any_las(6, 4, 24).replace(described(10, b"gain"), described(10, b"shape"))})
    p(0, NOTHING, "first.las second.las E --quiet --output both.las")
    both = read_las(p.path("both.las").read_bytes())
    assert (both.rows[:, :-4] == np.concatenate([read_las(data).rows for data in (first, second)])).all()
    assert both.records["LASF_Spec", 4].startswith(described(10, b"gain"))
    p(0, "replaced", "twice.las E --output out.las")
    assert (read_las(p.path("out.las").read_bytes()).rows[:, :-4]
            == np.delete(read_las(p.path("twice.las").read_bytes()).rows, np.s_[30:38], axis=1)).all()


def test_several_inputs(p):
    """One file has all fields if those of the inputs are the same; its grid is that of the first input if it is fine."""
    first, second = any_las(6, 4, 9), any_las(6, 4, 9)
    p.write({"a.las": first, "b.las": second, "other.las": any_las(3, 2, 0),
             "c.las": las(POINTS, 6, 4, ()), "moved.las": las(POINTS + (3, 0, 0), 6, 4, (), offset=1000),
             **{f"{name}.ply": ply(f"comment {name}\nelement vertex {N}\n" + properties([*"xyz", "gain"]),
                                   text_of(np.column_stack([POINTS + (shift, 0, 0), POINTS[:, 0]])))
                for name, shift in (("a", 0), ("b", 3))}})
    p(0, NOTHING, "a.las b.las E --quiet --output both.las --labels labels")
    both = read_las(p.path("both.las").read_bytes())
    assert (both.rows[:, :-4] == np.concatenate([read_las(first).rows, read_las(second).rows])).all()
    p(0, NOTHING, "c.las moved.las E --quiet --output grid.las")
    grid, *parts = (read_las(p.path(f"{name}.las").read_bytes()) for name in ("grid", "c", "moved"))
    assert (grid.rows[:, 12:-4] == np.concatenate([part.rows[:, 12:] for part in parts])).all()
    assert (grid.offset == 0).all() and np.allclose(grid.points, np.concatenate([part.points for part in parts]), 0, 1e-9)
    p(0, NOTHING, "a.ply b.ply E --quiet --output both.ply")
    assert "comment b" not in p.read("both.ply") and len(p.lines("both.ply", r"^\d\S* \S+ \S+ \S+ ")) == 2 * N
    for arguments in ("a.las other.las E --output mixed.las", "a.ply a.las E --output mixed.ply"):
        p.warns(arguments, "mixed.(las|ply): the points of the inputs do not have the same format and fields; the output has")
    p(0, NOTHING, "a.las other.las E --quiet --output-directory each --labels labels")
    for name, before in (("a.las", first), ("other.las", p.path("other.las").read_bytes())):
        assert (read_las(p.path(f"each/{name}").read_bytes()).rows[:, :-4] == read_las(before).rows).all()
