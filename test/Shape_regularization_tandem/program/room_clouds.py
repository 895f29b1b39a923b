# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# room_clouds.py: the floor and two walls of a room, turned about the vertical, with noise, as the files that people
# have: tables with other names or a column that counts the rows, and PLY of all types of coordinates.

import math
import random
import struct

random.seed(49)
n = 1100  # points of each plane
noise = 0.004


def room():
    points = []
    c, s = math.cos(0.37), math.sin(0.37)
    for plane in range(3):
        for _ in range(n):
            a, b, e = random.uniform(0.05, 4), random.uniform(0.05, 3), random.gauss(0, noise)
            x, y, z = [(a, b, e), (a, e, b), (e, a * 0.75, b)][plane]
            points.append((c * x - s * y + 20, s * x + c * y + 30, z + 5))
    random.shuffle(points)
    return points


points = room()


def table(name, header, row):
    with open(name, 'w') as file:
        file.write(header + ''.join(row(i, p) + '\n' for i, p in enumerate(points)))


def plain(separator):
    return lambda i, p: separator.join('%.4f' % x for x in p)


def numbered(i, p):
    return '%d ' % (i + 7) + plain(' ')(i, p)


table('plain.xyz', '', plain(' '))
table('numbered.xyz', '', numbered)
table('numbered.pts', '%d\n' % len(points), lambda i, p: numbered(i, p) + ' %d' % (i % 50))
table('numbered.txt', 'x y z\n', numbered)
table('broken.xyz', '', lambda i, p: numbered(i if i < 2000 else i + 1, p))
table('named.csv', 'Easting,Northing,Elevation\n', plain(','))
table('units.csv', 'Point,East [m],North [m],Height (m)\n', lambda i, p: 'P%d,' % i + plain(',')(i, p))
table('short.txt', 'E N Z\n', plain(' '))
table('degrees.csv', 'lon,lat,height\n', plain(','))
table('strange.csv', 'rechts,hoch,auf\n', plain(','))
table('normals.xyzn', '', lambda i, p: plain(' ')(i, p) + ' 0 0 0')
table('colors.xyzrgb', '', lambda i, p: plain(' ')(i, p) + ' 0.25 0.5 1')
table('points.asc', '', plain(' '))
table('commas.csv', '', lambda i, p: plain(';')(i, p).replace('.', ','))
table('commas.txt', 'x y z\n', lambda i, p: plain('\t')(i, p).replace('.', ','))
# Each row of the raster has one y, and an x that counts.
with open('raster.xyz', 'w') as file:
    for y in range(4):
        file.write(''.join('%d %d %.3f 9\n' % (x, y, random.gauss(0, noise)) for x in range(1200)))



def ptx(name, scans, colors='', decimal='.'):
    """Scans of a level scanner turned about the vertical, whose last column of pixels is empty."""
    with open(name, 'w') as file:
        for scan in range(scans):
            part = points[scan::scans]
            c, s = math.cos(scan + 0.5), math.sin(scan + 0.5)
            place = (20 + scan, 31, 6)
            file.write('%d\n%d\n%g %g %g\n1 0 0\n0 1 0\n0 0 1\n' % (len(part) // 50 + 1, 50, *place))
            text = '%.9f %.9f 0 0\n%.9f %.9f 0 0\n0 0 1 0\n%g %g %g 1\n' % (c, s, -s, c, *place)
            for p in part[:len(part) // 50 * 50]:
                x, y, z = [a - b for a, b in zip(p, place)]
                text += '%.6f %.6f %.6f 0.5%s\n' % (c * x + s * y, -s * x + c * y, z, colors)
            text += ('0 0 0 0.5' + colors + '\n') * 50
            file.write(text.replace('.', decimal))


ptx('one.ptx', 1)
ptx('two.ptx', 2, ' 10 20 250')
ptx('commas.ptx', 1, '', ',')

letters = {'char': 'b', 'short': 'h', 'ushort': 'H', 'int': 'i', 'uint': 'I', 'float': 'f', 'double': 'd'}


def ply(name, types, scale=1, names='xyz', order='<'):
    rows = [[x * scale for x in p] for p in points]
    if scale != 1:
        rows = [[round(x) for x in row] for row in rows]
    header = 'element vertex %d\n' % len(rows) + ''.join('property %s %s\n' % tn for tn in zip(types, names))
    form = order + ''.join(letters[t] for t in types)
    kind = 'binary_little_endian' if order == '<' else 'binary_big_endian'
    with open(name + '.ply', 'wb') as file:
        file.write(('ply\nformat %s 1.0\n%send_header\n' % (kind, header)).encode())
        file.write(b''.join(struct.pack(form, *row) for row in rows))
    text = ''.join(' '.join('%d' % x if t[0] not in 'fd' else '%.9g' % struct.unpack('f', struct.pack('f', x))
                            if t == 'float' else '%.17g' % x for t, x in zip(types, row)) + '\n' for row in rows)
    with open(name + '_text.ply', 'w') as file:
        file.write('ply\nformat ascii 1.0\n%send_header\n%s' % (header, text))


ply('upper', ['float'] * 3, names='XYZ')
ply('int', ['int'] * 3, 1000)
ply('uint', ['uint'] * 3, 10000, order='>')
ply('short', ['short'] * 3, 100)
ply('mixed', ['double', 'double', 'float'])
ply('big', ['float', 'double', 'float'], order='>')
