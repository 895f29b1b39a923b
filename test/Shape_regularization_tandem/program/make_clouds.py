# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# make_clouds.py TEXT: LAS files of all point formats (0.las to 10.las) and PCD files of all kinds, with the points of a
# text file. They are made from the specifications alone, to test the readers of detect_planes.

import struct
import sys

points = [tuple(map(float, line.split())) for line in open(sys.argv[1])]
count = len(points)
scale, offset = 0.001, 4000.0
record_sizes = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67]
color_positions = {2: 20, 3: 28, 5: 28, 7: 30, 8: 30, 10: 30}


def las(version, point_format, record_size, extra):
    header_size = 375 if version == 4 else 235 if version == 3 else 227
    record = struct.pack('<H16sHH32s', 0, b'LASF_Projection', 2112, 5, b'') + b'WKT\0\0'
    legacy_count = 0 if version == 4 else count
    header = b'LASF' + struct.pack('<HH16sBB64sHH', 0, 0, b'', 1, version, b'', 1, 2024)
    header += struct.pack('<HII', header_size, header_size + len(record) + 2, 1)
    header += struct.pack('<BHI20s', point_format, record_size + extra, legacy_count, b'')
    header += struct.pack('<12d', scale, scale, scale, offset, offset, offset, 0, 0, 0, 0, 0, 0)
    header += struct.pack('<Q', 0) if version >= 3 else b''
    header += struct.pack('<QIQ120s', 0, 0, count, b'') if version == 4 else b''
    assert len(header) == header_size
    data = bytearray(header + record + b'\xdd\xcc')
    for i, point in enumerate(points):
        row = bytearray(record_size + extra)
        integers = [round((c - offset) / scale) for c in point]
        struct.pack_into('<iiiH', row, 0, *integers, i)
        if point_format < 6:
            row[15] = 6 | 128  # withheld
        else:
            row[16] = 200
        if point_format in color_positions:
            struct.pack_into('<HHH', row, color_positions[point_format], i, 300, 65535)
        data += row
    return bytes(data)


def lzf(data):
    result = bytearray()
    i = 0
    while i < len(data):
        run = 1
        while run < 264 and i + run < len(data) and i > 0 and data[i + run - 1] == data[i - 1]:
            run += 1
        run -= 1
        if run >= 3:  # repeats the byte before
            result += bytes([(run - 2) << 5, 0] if run < 9 else [7 << 5, run - 9, 0])
            i += run
        else:
            piece = data[i:i + 7]
            result += bytes([len(piece) - 1]) + piece
            i += len(piece)
    return bytes(result)


def pcd(kind, body):
    return ('VERSION .7\nFIELDS _ x y z rgb intensity label\nSIZE 1 8 8 8 4 4 4\nTYPE U F F F F F U\nCOUNT 3 1 1 1 1 1 1\n'
            'WIDTH %d\nHEIGHT 2\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA %s\n' % (count // 2, count, kind)).encode() + body


for f, size in enumerate(record_sizes):
    version = 0 if f < 2 else 2 if f < 4 else 3 if f < 6 else 4
    with open('%d.las' % f, 'wb') as file:
        file.write(las(version, f, size, 5 if f in (3, 8) else 0))

color = struct.unpack('<f', struct.pack('<I', 0x0A14FA))[0]
rows = [(b'\1\2\3', *p, struct.pack('<f', color), 77., 9) for p in points]
binary = b''.join(struct.pack('<3s3d4sfI', *row) for row in rows)
columns = [b''.join(struct.pack('<' + t, row[i]) for row in rows) for i, t in enumerate(['3s', 'd', 'd', 'd', '4s', 'f', 'I'])]
compressed = lzf(b''.join(columns))
text = ''.join('1 2 3 %.3f %.3f %.3f %.9g 77 9\n' % (*p, color) for p in points)
files = {
    'text.pcd': pcd('ascii', text.encode()),
    'binary.pcd': pcd('binary', binary),
    'compressed.pcd': pcd('binary_compressed', struct.pack('<II', len(compressed), len(binary)) + compressed),
    'damaged.pcd': pcd('binary_compressed', struct.pack('<II', len(compressed), len(binary)) + compressed[:-9] + b'\xff' * 9),
    'huge.pcd': pcd('binary_compressed', struct.pack('<II', len(compressed), 0xFFFFFFFF) + compressed),
}
for name, data in files.items():
    with open(name, 'wb') as file:
        file.write(data)
