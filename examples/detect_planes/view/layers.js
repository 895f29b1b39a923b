// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outlines and triangles of the shapes, and the model. write_view.cpp describes their elements of the page. A mark has
// the shape, 24 bits, and the share of a face that has points, 8 bits.
function readBytes(id) {
  const lines = byId(id).textContent.trim().split("\n").filter(line => line !== "").map(bytesOf);
  byId(id).remove();
  const result = new Uint8Array(lines.reduce((sum, line) => sum + line.length, 0));
  let size = 0;
  for (const line of lines) {
    result.set(line, size);
    size += line.length;
  }
  return result;
}

function decodeLayers(scene) {
  const corners = new Float32Array(readBytes("corners").buffer);
  return { corners, segments: segmentsOf(scene, new Uint32Array(readBytes("loops").buffer), corners),
           triangles: trianglesOf(scene, new Uint32Array(readBytes("triangles").buffer), corners),
           model: modelOf(readBytes("model")) };
}

function setMark(marks, place, shape) {
  marks[4 * place] = shape & 255;
  marks[4 * place + 1] = (shape >> 8) & 255;
  marks[4 * place + 2] = shape >> 16;
  marks[4 * place + 3] = 255;
}

// Ends and shape of each segment: there are fewer than numbers.
function segmentsOf(scene, numbers, corners) {
  const ends = new Float32Array(6 * numbers.length), marks = new Uint8Array(4 * numbers.length);
  let next = 0, segments = 0;
  for (let shape = 0; shape < scene.shapes.points.length && next < numbers.length; ++shape)
    for (let loops = numbers[next++]; loops > 0; --loops) {
      const size = numbers[next++];
      for (let k = 0; k < size; ++k, ++segments) {
        const first = 3 * numbers[next + k], last = 3 * numbers[next + (k + 1) % size];
        ends.set(corners.subarray(first, first + 3), 6 * segments);
        ends.set(corners.subarray(last, last + 3), 6 * segments + 3);
        setMark(marks, segments, shape);
      }
      next += size;
    }
  return { ends: ends.slice(0, 6 * segments), marks: marks.slice(0, 4 * segments) };
}

// Each triangle has corners of its own, as these tell its shape.
function trianglesOf(scene, numbers, corners) {
  const positions = new Float32Array(3 * numbers.length), marks = new Uint8Array(4 * numbers.length);
  let next = 0, size = 0;
  for (let shape = 0; shape < scene.shapes.points.length && next < numbers.length; ++shape)
    for (let n = 3 * numbers[next++]; n > 0; --n, ++size) {
      const corner = 3 * numbers[next++];
      positions.set(corners.subarray(corner, corner + 3), 3 * size);
      setMark(marks, size, shape);
    }
  return { positions: positions.slice(0, 3 * size), marks: marks.slice(0, 4 * size) };
}

function modelOf(bytes) {
  const view = new DataView(bytes.buffer), size = 3 * bytes.length / 40;
  const positions = new Float32Array(3 * size), marks = new Uint8Array(4 * size);
  for (let corner = 0; corner < size; ++corner) {
    const first = 40 * Math.floor(corner / 3);
    for (let k = 0; k < 3; ++k)
      positions[3 * corner + k] = view.getFloat32(first + 12 * (corner % 3) + 4 * k, true);
    marks.set(bytes.subarray(first + 36, first + 40), 4 * corner);
  }
  return { positions, marks };
}

class Layers {
  // All share the uniforms.
  constructor(scene, uniforms) {
    this.scene = scene;
    this.uniforms = uniforms;
    this.objects = {};
  }

  addPoints(points, inputColors) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(points.positions, 3));
    geometry.setAttribute("mark", new THREE.BufferAttribute(points.marks, 4));
    if (inputColors.length > 0)
      geometry.setAttribute("inputColor", new THREE.BufferAttribute(inputColors, 3, true));
    this.add("points", new THREE.Points(geometry, this.material(pointShader, discShader)));
  }

  // Without triangles there is no layer.
  addTriangles(name, { positions, marks }) {
    if (marks.length === 0)
      return;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("mark", new THREE.BufferAttribute(marks, 4));
    this.add(name, new THREE.Mesh(geometry, this.material(triangleShader, flatShader, {
      side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 })));
  }

  addSegments({ ends, marks }) {
    const geometry = new THREE.InstancedBufferGeometry(), pairs = new THREE.InstancedInterleavedBuffer(ends, 6, 1);
    const rectangle = new Float32Array([0, -1, 0, 0, 1, 0, 1, -1, 0, 1, 1, 0]);
    geometry.setAttribute("position", new THREE.BufferAttribute(rectangle, 3));
    geometry.setIndex([0, 2, 1, 1, 2, 3]);
    geometry.setAttribute("first", new THREE.InterleavedBufferAttribute(pairs, 3, 0));
    geometry.setAttribute("last", new THREE.InterleavedBufferAttribute(pairs, 3, 3));
    geometry.setAttribute("mark", new THREE.InstancedBufferAttribute(marks, 4));
    geometry.maxInstancedCount = marks.length / 4;
    const material = this.material(segmentShader, flatShader, { side: THREE.DoubleSide });
    this.add("outlines", new THREE.Mesh(geometry, material));
  }

  material(vertexShader, fragmentShader, options = {}) {
    return new THREE.RawShaderMaterial({ vertexShader, fragmentShader, uniforms: this.uniforms, ...options });
  }

  add(name, object) {
    object.frustumCulled = false;
    object.visible = name === "points";
    this.objects[name] = object;
    this.scene.add(object);
  }

  isShown(name) { return this.objects[name].visible; }
  show(name, isShown) { this.objects[name].visible = isShown; }
  shown() { return Object.keys(this.objects).filter(name => this.isShown(name)); }
}
