# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors the points of a cloud by their planes and writes them as a PLY file.

    python3 color_cloud.py OUTPUT.ply [CLOUD.npy]

CLOUD.npy has an array of shape (n, 3), or (n, 6) with normals. Without CLOUD.npy, the program generates a corner of a
room. From Open3D, use np.asarray(cloud.points) and np.asarray(cloud.normals).
"""

import sys

import numpy as np

import tandem


def make_corner(points_a_wall=4000, noise=0.005):
    """Makes three walls of 3 meters that meet at nearly right angles, and some clutter."""
    random = np.random.default_rng(2016)
    walls = []
    for axis in range(3):
        wall = 3 * random.random((points_a_wall, 3))
        wall[:, axis] = 0.01 * wall[:, axis - 1] + noise * random.standard_normal(points_a_wall)
        walls.append(wall)
    return np.concatenate([*walls, 3 * random.random((points_a_wall // 10, 3))])


def colors_of(labels):
    """Returns a color for each point: one color for each shape, gray for points without a shape."""
    hues = (np.arange(labels.max(initial=-1) + 1) * 0.618034) % 1  # the golden ratio keeps neighbors apart
    colors = 0.5 + 0.45 * np.cos(2 * np.pi * (hues[:, None] + [0, 1 / 3, 2 / 3]))
    table = np.vstack([255 * colors, [128, 128, 128]]).astype(np.uint8)
    return table[labels]  # -1 is the last row


def write_ply(path, points, normals, colors, labels):
    """Writes binary PLY, with an int property `shape`."""
    fields = [(name, "<f8") for name in ("x", "y", "z")] + [(name, "<f4") for name in ("nx", "ny", "nz")]
    fields += [(name, "u1") for name in ("red", "green", "blue")] + [("shape", "<i4")]
    vertices = np.empty(len(points), dtype=fields)
    for names, values in ((("x", "y", "z"), points), (("nx", "ny", "nz"), normals), (("red", "green", "blue"), colors)):
        for column, name in enumerate(names):
            vertices[name] = values[:, column]
    vertices["shape"] = labels
    words = {"<f8": "double", "<f4": "float", "u1": "uchar", "<i4": "int"}
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}"]
    header += [f"property {words[code]} {name}" for name, code in fields] + ["end_header"]
    with open(path, "wb") as file:
        file.write(("\n".join(header) + "\n").encode("ascii"))
        file.write(vertices.tobytes())


def main(output, cloud=None):
    values = make_corner() if cloud is None else np.load(cloud)
    points, normals = values[:, :3], values[:, 3:6] if values.shape[1] >= 6 else None
    shapes = tandem.detect_planes(points, normals)
    write_ply(output, points, shapes.normals, colors_of(shapes.labels), shapes.labels)

    for s, (a, b, c, d) in enumerate(shapes.planes):
        print(f"shape {s}: {len(shapes.points_of(s))} points, {a:.3f} x + {b:.3f} y + {c:.3f} z + {d:.3f} = 0")
    for first, second in shapes.orthogonal_pairs:
        print(f"directions {first} and {second} are orthogonal")
    print(f"{shapes.statistics['coverage']:.1%} of the points are within {shapes.maximum_distance:.3f} of a plane")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(*sys.argv[1:])
