# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors of shapes: distinct, and the same for the shapes of two results that have most points in common."""

import colorsys
import itertools

import numpy as np

COLUMNS = [(name, "<f4") for name in ("x", "y", "z", "nx", "ny", "nz")] + [
    (name, "u1") for name in ("red", "green", "blue")] + [("shape", "<i4")]
TYPES = {"<f4": "float", "u1": "uchar", "<i4": "int"}  # of PLY


def color_of(rank):
    """Hues in steps of the golden angle: any few in a row are far apart."""
    hue, saturation, value = .56 + .6180339887498949 * rank, (.6, .75, .4)[rank % 3], (.98, .84, .92)[rank // 3 % 3]
    return [int(255 * channel + .5) for channel in colorsys.hsv_to_rgb(hue % 1, saturation, value)]


def ranks(sizes):
    """0 for the largest."""
    return np.argsort(np.argsort(-sizes, kind="stable"))


def sizes(labels):
    return np.bincount(labels[labels >= 0])


def ranks_of_directions(labels, direction_of):
    return ranks(np.bincount(direction_of, sizes(labels)))[direction_of]


def ranks_like(reference, labels):
    """Of each shape the one of its counterpart, with which it has most points in common; others come behind."""
    both = (reference >= 0) & (labels >= 0)
    pairs, common = np.unique(np.stack([labels, reference], 1)[both], axis=0, return_counts=True)
    counterpart = {}
    for shape, other in pairs[np.argsort(-common, kind="stable")]:
        if shape not in counterpart and other not in counterpart.values():
            counterpart[shape] = other
    known = ranks(sizes(reference))
    new = itertools.count(len(known))
    return [known[counterpart[s]] if s in counterpart else next(new) for s in range(len(sizes(labels)))]


def write_colored(path, points, labels, normals, rank_of):
    """A cloud as render() draws it. The normals are those of the shapes, for even shading."""
    table = np.zeros((len(points), 10))
    table[:, :3] = points
    table[:, 9] = labels
    of_shapes = labels >= 0
    table[of_shapes, 3:9] = np.c_[normals, [color_of(rank) for rank in rank_of]][labels[of_shapes]]
    header = "".join(f"property {TYPES[kind]} {name}\n" for name, kind in COLUMNS)
    path.write_bytes(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n{header}end_header\n".encode() +
                     np.rec.fromarrays(table.T, dtype=COLUMNS).tobytes())
