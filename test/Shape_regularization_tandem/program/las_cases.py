# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# LAS files to be read, and the properties of those that detect_planes writes.
#   las_cases.py make FILE FORMAT RECORDS FLAG CLASS SCALE < TEXT  a file of version 1.4 with these points
#   las_cases.py grid FILE EPSILON TEXT...                        its steps, and its points against those of the texts
#   las_cases.py projection FILE FORMAT FLAG RECORDS              what it says of its coordinate system
# RECORDS: none, or the numbers of records of LASF_Projection, separated by commas. FLAG: whether that is WKT.

import struct
import sys

header_size, wkt_bit = 375, 16
sizes = {2: 26, 7: 36}


def text_points(paths):
    lines = [line for path in paths for line in open(path)]
    return [tuple(map(float, line.split()[:3])) for line in lines if line[0] not in '#x']


def make(path, point_format, records, flag, *, classification, scale):
    points = [tuple(map(float, line.split()[:3])) for line in sys.stdin]
    ids = [] if records == 'none' else [int(r) for r in records.split(',')]
    content = {2112: b'WKT\0', 34735: struct.pack('<4H', 1, 1, 0, 0)}
    blocks = [struct.pack('<H16sHH32s', 0, b'LASF_Projection', i, len(content[i]), b'') + content[i] for i in ids]
    size = sizes[point_format]
    header = b'LASF' + struct.pack('<HH16sBB64sHH', 0, wkt_bit * flag, b'', 1, 4, b'', 1, 2024)
    header += struct.pack('<HII', header_size, header_size + sum(map(len, blocks)), len(blocks))
    header += struct.pack('<BHI20s', point_format, size, 0, b'')
    header += struct.pack('<12d', scale, scale, scale, 0, 0, 0, 0, 0, 0, 0, 0, 0)
    header += struct.pack('<QQIQ120s', 0, 0, 0, len(points), b'')
    with open(path, 'wb') as file:
        file.write(header + b''.join(blocks))
        for point in points:
            row = bytearray(size)
            struct.pack_into('<iii', row, 0, *(round(c / scale) for c in point))
            row[15 if point_format < 6 else 16] = classification
            file.write(row)


class Las:
    def __init__(self, path):
        data = open(path, 'rb').read()
        self.flag = struct.unpack_from('<H', data, 6)[0] // wkt_bit % 2
        size, first, records, self.format, length = struct.unpack_from('<HIIBH', data, 94)
        count, = struct.unpack_from('<Q', data, 247)
        frame = struct.unpack_from('<6d', data, 131)
        self.scale, self.offset = frame[:3], frame[3:]
        self.bounds = struct.unpack_from('<6d', data, 179)
        self.ids, place = [], size
        for _ in range(records):
            user, record, bytes_after = struct.unpack_from('<16sHH', data, place + 2)
            if user.startswith(b'LASF_Projection'):
                self.ids.append(record)
            place += 54 + bytes_after
        assert place == first, 'the records do not end where the points begin'
        integers = (struct.unpack_from('<iii', data, first + i * length) for i in range(count))
        self.points = [tuple(n * s + o for n, s, o in zip(p, self.scale, self.offset)) for p in integers]


def check_grid(las, epsilon, points):
    assert max(las.scale) <= 2e-4 * epsilon * (1 + 1e-9), 'steps of %g for a distance of %g' % (max(las.scale), epsilon)
    assert len(points) == len(las.points), '%d points instead of %d' % (len(las.points), len(points))
    # Half a step, and what the numbers themselves are rounded by.
    error = max(abs(a - b) for p, q in zip(points, las.points) for a, b in zip(p, q))
    largest = max(abs(c) for p in points for c in p)
    assert error <= 1e-4 * epsilon * (1 + 1e-6) + 4e-16 * largest, 'moved by %g' % error
    for c in range(3):
        axis = [p[c] for p in las.points]
        assert (las.bounds[2 * c], las.bounds[2 * c + 1]) == (max(axis), min(axis)), 'other bounds than the points have'


def check_projection(las, point_format, flag, records):
    found = (las.format, las.flag, ','.join(map(str, las.ids)) or 'none')
    assert found == (point_format, flag, records), 'format %d, flag %d, records %s' % found
    # What the specification says of the flag
    assert las.flag == 0 or las.format >= 6 and (2112 in las.ids or not las.ids), 'declared WKT without one'
    assert las.flag == 1 or las.format < 6 or 34735 in las.ids, 'not declared WKT without keys of GeoTIFF'


command, path, *rest = sys.argv[1:]
if command == 'make':
    make(path, int(rest[0]), rest[1], int(rest[2]), classification=int(rest[3]), scale=float(rest[4]))
elif command == 'grid':
    check_grid(Las(path), float(rest[0]), text_points(rest[1:]))
else:
    check_projection(Las(path), int(rest[0]), int(rest[1]), rest[2])
