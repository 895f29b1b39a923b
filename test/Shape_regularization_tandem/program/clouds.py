# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds as sensors, conversions and people make them, and files of LAS and PCD from the specifications alone."""

import random
import struct
from types import SimpleNamespace

import numpy as np

from support import NOTHING

# --- The floor and two walls of a room, turned about the vertical, with noise


def turned_room(points_a_plane=1100, noise=0.004):
    rng = random.Random(49)
    points = []
    for plane in range(3):
        for _ in range(points_a_plane):
            a, b, e = rng.uniform(0.05, 4), rng.uniform(0.05, 3), rng.gauss(0, noise)
            points.append([(a, b, e), (a, e, b), (e, a * 0.75, b)][plane])
    rng.shuffle(points)
    c, s = np.cos(0.37), np.sin(0.37)
    return np.array(points) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + (20, 30, 5)


def rows_of(points, separator=" ", before=lambda i: "", after=lambda i: ""):
    return "".join(before(i) + separator.join(f"{x:.4f}" for x in p) + after(i) + "\n" for i, p in enumerate(points))


def ptx(points, scans=1, colors=""):
    """Scans of a level scanner turned about the vertical, whose last column of pixels is empty."""
    text = ""
    for scan in range(scans):
        part = points[scan::scans]
        part = part[:len(part) // 50 * 50]
        c, s = np.cos(scan + 0.5), np.sin(scan + 0.5)
        place = np.array([20 + scan, 31, 6])
        where = "{} {} {}".format(*place)
        text += f"{len(part) // 50 + 1}\n50\n{where}\n1 0 0\n0 1 0\n0 0 1\n"
        text += f"{c:.9f} {s:.9f} 0 0\n{-s:.9f} {c:.9f} 0 0\n0 0 1 0\n{where} 1\n"
        for x, y, z in (part - place) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]):
            text += f"{x:.6f} {y:.6f} {z:.6f} 0.5{colors}\n"
        text += f"0 0 0 0.5{colors}\n" * 50
    return text


# --- What sensors and conversions make of a room

MAP = (694386.2, 5155487.5, 380)


def sensor_room(corner, count=3000):
    """Floor and two walls, pairwise orthogonal, of noise 4 mm: 3 planes."""
    rng = np.random.default_rng(1)
    points = rng.random((count, 3)) * (4, 3, 2.5)
    for axis, place in enumerate((4, 3, 0)):
        points[axis::3, axis] = place + rng.normal(0, .004, len(points[axis::3]))
    return points + corner


def as_floats(points):
    return points.astype(np.float32).astype(float)


def corridor(seed):
    """What a depth camera at (1, 2, 3) sees of a corridor; noise .0028 r^2 along the ray: 4 walls and an end, 5 planes."""
    width, height = 160, 120
    i, j = np.meshgrid(np.arange(width), np.arange(height))
    rays = np.stack([(i - width / 2) / (.9 * width), (j - height / 2) / (.9 * width), np.ones(i.shape)], axis=-1)
    rays = (rays / np.linalg.norm(rays, axis=-1, keepdims=True)).reshape(-1, 3)
    cosines = rays @ np.array([(0, 1, 0), (-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 0, 1)]).T
    r = np.where(cosines > 1e-6, (1.2, 1.2, 1.2, 1.3, 5) / np.maximum(cosines, 1e-6), np.inf).min(axis=1)
    r += .0028 * r * r * np.random.default_rng(seed).standard_normal(len(r))
    return rays * r[:, None] + (1, 2, 3)


# --- LAS of all point formats

RECORD_SIZES = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67]
COLOR_PLACES = {2: 20, 3: 28, 5: 28, 7: 30, 8: 30, 10: 30}
PROJECTIONS = {2112: b"WKT\0\0", 34735: struct.pack("<4H", 1, 1, 0, 0)}
WKT_BIT = 16


def las(points, point_format, version=4, records=(2112,), flag=0, classification=6, offset=0, extra=0, gap=b""):
    """With steps of 0.001; `extra` bytes are behind each point, and `gap` is before the first one."""
    points, count, size = np.asarray(points), len(points), RECORD_SIZES[point_format] + extra
    blocks = b"".join(struct.pack("<H16sHH32s", 0, b"LASF_Projection", i, len(PROJECTIONS[i]), b"") + PROJECTIONS[i]
                      for i in records) + gap
    header_size = 375 if version == 4 else 235 if version == 3 else 227
    header = b"LASF" + struct.pack("<HH16sBB64sHH", 0, WKT_BIT * flag, b"", 1, version, b"", 1, 2024)
    header += struct.pack("<HII", header_size, header_size + len(blocks), len(records))
    header += struct.pack("<BHI20s", point_format, size, 0 if version == 4 else count, b"")
    header += struct.pack("<12d", *[.001] * 3, *[offset] * 3, *[0] * 6)
    header += struct.pack("<Q", 0) if version >= 3 else b""
    header += struct.pack("<QIQ120s", 0, 0, count, b"") if version == 4 else b""
    assert len(header) == header_size
    rows = np.zeros((count, size), np.uint8)
    rows[:, :12] = np.rint((points - offset) / .001).astype("<i4").view(np.uint8)
    rows[:, 12:14] = np.arange(count, dtype="<u2")[:, None].view(np.uint8)
    rows[:, 15 if point_format < 6 else 16] = classification
    if point_format in COLOR_PLACES:
        place = COLOR_PLACES[point_format]
        colors = np.stack([np.arange(count), np.full(count, 300), np.full(count, 65535)], axis=1)
        rows[:, place:place + 6] = colors.astype("<u2").view(np.uint8)
    return header + blocks + rows.tobytes()


def las_of_each_format(points):
    return {f"{f}.las": las(points, f, 0 if f < 2 else 2 if f < 4 else 3 if f < 6 else 4, offset=4000, gap=b"\xdd\xcc",
                            classification=6 | 128 if f < 6 else 200, extra=5 if f in (3, 8) else 0)  # 128: withheld
            for f in range(len(RECORD_SIZES))}


def read_las(data):
    size, first, number, point_format, length = struct.unpack_from("<HIIBH", data, 94)
    is_1_4 = data[25] == 4
    old_count, *old_returns = struct.unpack_from("<6I", data, 107)
    count, *returns = struct.unpack_from("<16Q", data, 247) if is_1_4 else (old_count, *old_returns)
    records, place = {}, size
    for _ in range(number):
        user, record, content = struct.unpack_from("<16sHH", data, place + 2)
        records[user.split(b"\0")[0].decode("latin1"), record] = data[place + 54:place + 54 + content]
        place += 54 + content
    assert place == first, "the records do not end where the points begin"
    assert is_1_4 or old_count == count
    frame = np.frombuffer(data, "<f8", 6, 131)
    rows = np.frombuffer(data, np.uint8, count * length, first).reshape(count, length)
    return SimpleNamespace(format=point_format, flag=struct.unpack_from("<H", data, 6)[0] // WKT_BIT % 2, records=records,
                           ids=[record for user, record in records if user == "LASF_Projection"], returns=returns,
                           scale=frame[:3], offset=frame[3:], bounds=np.frombuffer(data, "<f8", 6, 179).reshape(3, 2),
                           header=data[:size], rows=rows, tail=data[first + count * length:],
                           points=rows[:, :12].copy().view("<i4") * frame[:3] + frame[3:])


# --- PCD of all kinds


def lzf(data):
    """In place of 16 or 8 bytes that repeat the 4 before them, their number and distance; else 7 bytes as they are."""
    result, i = bytearray(), 0
    while i < len(data):
        same = next((n for n in (16, 8) if i >= 4 and data[i:i + n] == (data[i - 4:i] * 4)[:n]), 0)
        result += (bytes([7 << 5, 16 - 9, 3] if same == 16 else [6 << 5, 3]) if same else
                   bytes([len(data[i:i + 7]) - 1]) + data[i:i + 7])
        i += same or 7
    return bytes(result)


def pcd_of_each_kind(points):
    count = len(points)
    color = struct.unpack("<f", struct.pack("<I", 0x0A14FA))[0]

    def file(kind, body):
        return (f"VERSION .7\nFIELDS _ x y z rgb intensity label\nSIZE 1 8 8 8 4 4 4\nTYPE U F F F F F U\n"
                f"COUNT 3 1 1 1 1 1 1\nWIDTH {count // 2}\nHEIGHT 2\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\n"
                f"DATA {kind}\n").encode() + body

    row = np.dtype([("_", "3u1"), ("x", "<f8"), ("y", "<f8"), ("z", "<f8"), ("c", "<f4"), ("i", "<f4"), ("l", "<u4")])
    rows = np.empty(count, row)
    rows[:] = [((1, 2, 3), *p, color, 77, 9) for p in points]
    text = "".join(f"1 2 3 {x:.3f} {y:.3f} {z:.3f} {color:.9g} 77 9\n" for x, y, z in points).encode()
    packed = lzf(b"".join(rows[name].tobytes() for name in row.names))

    def compressed(packed, size=rows.nbytes):
        return file("binary_compressed", struct.pack("<II", len(packed), size) + packed)

    # The last one begins with a repetition of what is before it, in place of its first 7 bytes.
    return {"text.pcd": file("ascii", text), "binary.pcd": file("binary", rows.tobytes()),
            "compressed.pcd": compressed(packed), "damaged.pcd": compressed(packed[:-9] + b"\xff" * 9),
            "huge.pcd": compressed(packed, 0xFFFFFFFF), "before.pcd": compressed(b"\xa0\0" + packed[8:])}


# --- A hall of floor, walls and roof in several files and formats

OPTIONS = "--maximum-distance 0.01 --minimum-region-size 100"
TILES = ["corner.pts", "folder/Middle.XYZ", "folder/sub/border.csv", "last.las"]
OUTPUTS = ["corner.ply", "Middle.XYZ", "border.csv", "last.las"]
MEMBERS = r'"(input|hash|source|minimum|maximum|ignored_zeros|maximum_distance|points|assigned|shapes|planes|mean_distance|.*groups|.*pairs)":'


def hall():
    """By tiles, which borders at x = 1, 4 and 5 cut"""
    i, j = (a.ravel() for a in np.mgrid[:80, :30])
    x, zero = i / 10 + .02, np.zeros(len(i))
    points = np.stack([np.stack(face, axis=1) for face in (
        (x, j / 10, (i * j) % 7 / 2000), (x, (i * j) % 5 / 2000, j / 10), (x, 3 + zero, j / 10 + .05),
        (x, j / 10 + .03, 4 + j / 20))], axis=1).reshape(-1, 3)
    tile = np.digitize(points[:, 0], (1, 4, 5))
    return [points[tile == k] for k in range(4)]


def write_tiles(p):
    corner, middle, border, last = ("".join("{:.6g} {:.6g} {:.6g}\n".format(*row) for row in tile) for tile in hall())
    p.write({"corner.pts": corner, "folder/Middle.XYZ": middle, "last.xyz": last,
             "folder/sub/border.csv": "x,y,z\n" + border.replace(" ", ",")})
    p(0, NOTHING, f"last.xyz {OPTIONS} --output last.las --quiet")


def check_same_results(p, first, second, outputs=OUTPUTS):
    """The files of --output-directory and --planes are the same, byte for byte, and what reports tell of the result."""
    for file in [*outputs, "planes"]:
        assert p.is_same(f"{first}/{file}", f"{second}/{file}"), file
    assert p.lines(f"{first}/report", MEMBERS) == p.lines(f"{second}/report", MEMBERS)
