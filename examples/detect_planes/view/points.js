// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points: a line of Base64 for each block of them, as write_points.h describes it. Gives the coordinates, relative
// to the center, and four bytes for each point: the index of its shape, least significant byte first, and the distance.
function decodePoints(scene, text) {
  const count = scene.shown;
  const positions = new Float32Array(3 * count);
  const marks = new Uint8Array(4 * count);
  let first = 0;
  for (const line of text.trim().split("\n")) {
    if (line === "")
      continue;
    const bytes = bytesOf(line), size = Math.min((bytes.length - headerSize) / 7, count - first);
    decodeBlock(bytes, size, positions.subarray(3 * first, 3 * (first + size)),
                marks.subarray(4 * first, 4 * (first + size)));
    first += size;
  }
  if (first !== count)
    throw new Error("the page is incomplete: it has " + first + " points of " + count);
  markShapes(scene.shapes.shown, marks);
  return { positions, marks };
}

const headerSize = 24; // six floats

function bytesOf(line) {
  const binary = atob(line);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i)
    bytes[i] = binary.charCodeAt(i);
  return bytes;
}

function decodeBlock(bytes, size, positions, marks) {
  const view = new DataView(bytes.buffer);
  const number = i => view.getFloat32(4 * i, true);
  const corner = [number(0), number(1), number(2)], step = [number(3), number(4), number(5)];
  for (let i = 0; i < 3 * size; ++i)
    positions[i] = corner[i % 3] + step[i % 3] * view.getUint16(headerSize + 2 * i, true);
  for (let i = 0; i < size; ++i)
    marks[4 * i + 3] = bytes[headerSize + 6 * size + i];
}

// The points are sorted by shape.
function markShapes(shown, marks) {
  let i = 0;
  shown.forEach((size, shape) => {
    for (const end = i + 4 * size; i < end; i += 4) {
      marks[i] = shape & 255;
      marks[i + 1] = (shape >> 8) & 255;
      marks[i + 2] = shape >> 16;
    }
  });
}
