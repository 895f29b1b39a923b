// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a PLY file of a closed room of 6 x 4 x 3 with a board on its long wall: normals point into the room, each face
// has a color of its own, and some points are in the air.
//   node make_room.js FILE.ply
const size = [6, 4, 3], step = 0.05, rows = [];
const add = (p, n, color) => rows.push([...p.map(x => x.toFixed(4)), ...n, ...color].join(" "));

// The rectangle at `height` along an axis, from low to high along the two others.
function face(axis, height, side, low, high, color) {
  const [a, b] = [0, 1, 2].filter(k => k !== axis), normal = [0, 1, 2].map(k => k === axis ? side : 0);
  for (let x = low[0] + step / 2; x < high[0]; x += step)
    for (let y = low[1] + step / 2; y < high[1]; y += step) {
      const p = [0, 0, 0];
      p[axis] = height;
      p[a] = x;
      p[b] = y;
      add(p, normal, color);
    }
}

for (let axis = 0; axis < 3; ++axis)
  for (const end of [0, 1]) {
    const others = [0, 1, 2].filter(k => k !== axis).map(k => size[k]);
    face(axis, end * size[axis], 1 - 2 * end, [0, 0], others, [40 + 80 * axis, 60 + 120 * end, 200 - 60 * axis]);
  }
face(1, 3.7, -1, [2, 1], [4, 2], [250, 240, 10]);
for (let i = 0; i < 40; ++i)
  add([0.5 + 0.13 * i, 0.5 + (i * 7 % 30) / 10, 0.6 + (i * 11 % 18) / 10], [0, 0, 1], [255, 255, 255]);
const names = ["double x", "double y", "double z", "double nx", "double ny", "double nz", "uchar red", "uchar green",
               "uchar blue"];
require("fs").writeFileSync(process.argv[2], "ply\nformat ascii 1.0\nelement vertex " + rows.length + "\n" +
  names.map(name => "property " + name + "\n").join("") + "end_header\n" + rows.join("\n") + "\n");
