// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shapes, their groups and colors.
class Shapes {
  // points: positions and marks; inputColors: three bytes for each of them, or nothing
  constructor(scene, points, inputColors) {
    this.scene = scene;
    this.points = points;
    this.inputColors = inputColors;
    this.columns = scene.shapes;
    this.count = this.columns.points.length;
    this.largest = this.columns.points.reduce((a, b) => Math.max(a, b), 2);
    this.directions = this.groupsOf(this.columns.parallel_group, scene.directions);
    this.planes = this.groupsOf(this.columns.coplanar_group, scene.planes);
    this.orthogonal = this.directions.map(() => []);
    for (const [a, b] of scene.orthogonal) {
      this.orthogonal[a].push(b);
      this.orthogonal[b].push(a);
    }
    this.starts = [0];
    this.columns.shown.forEach((size, shape) => this.starts.push(this.starts[shape] + size));
    this.inputMeans = inputColors.length > 0 ? this.columns.shown.map((_, shape) => this.meanOfInput(shape)) : [];
  }

  // The first and behind the last of its points that are shown; behind the shapes: of those without one.
  range(shape) { return this.starts.slice(shape, shape + 2); }
  positions(shape) { return this.points.positions.subarray(...this.range(shape).map(i => 3 * i)); }

  meanOfInput(shape) {
    const [first, last] = this.range(shape), sum = [0, 0, 0];
    for (let i = 3 * first; i < 3 * last; ++i)
      sum[i % 3] += this.inputColors[i];
    return sum.map(x => x / (255 * Math.max(last - first, 1)));
  }

  // Largest first, by the number of points: `rank` is the place in that order.
  groupsOf(column, count) {
    const groups = Array.from({ length: count }, (_, index) => ({ index, members: [], points: 0 }));
    column.forEach((group, shape) => {
      groups[group].members.push(shape);
      groups[group].points += this.columns.points[shape];
    });
    const order = [...groups].sort((a, b) => b.points - a.points);
    order.forEach((group, rank) => group.rank = rank);
    return groups;
  }

  groups(kind) { return kind === "direction" ? this.directions : this.planes; }
  groupOf(kind, shape) {
    return this.groups(kind)[this.columns[kind === "direction" ? "parallel_group" : "coplanar_group"][shape]];
  }

  membersOf(selection) {
    if (!selection)
      return [];
    return selection.kind === "shape" ? [selection.index] : this.groups(selection.kind)[selection.index].members;
  }

  has(selection) {
    const count = selection.kind === "shape" ? this.count : this.groups(selection.kind).length;
    return Number.isInteger(selection.index) && selection.index >= 0 && selection.index < count;
  }

  normal(shape) { return this.columns.coefficients.slice(4 * shape, 4 * shape + 3); }
  centroid(shape) { return this.columns.centroid.slice(3 * shape, 3 * shape + 3); }

  // To the outward side; if it is not known, to the viewer, who is at the place.
  outward(shape, place) {
    const normal = vector(this.normal(shape)), side = this.columns.outward[shape];
    const isSeen = side !== 0 ? side > 0 : normal.dot(place.clone().sub(vector(this.centroid(shape)))) >= 0;
    return isSeen ? normal : normal.negate();
  }

  // Red, green, blue from 0 to 1. A shape that is alone in its group is grey.
  color(mode, shape) {
    if (mode === "direction" || mode === "plane")
      return groupColor(this.groupOf(mode, shape));
    if (mode === "curved")
      return curveColor(this.columns.curved[shape]);
    return mode === "input" ? this.inputMeans[shape] : wheelColor(shape);
  }

  // A little light, so that corners show.
  litColor(mode, shape) {
    if (mode === "input")
      return this.color(mode, shape);
    const [x, y, z] = this.normal(shape);
    const brightness = 0.7 + 0.3 * Math.abs(0.36 * x + 0.48 * y + 0.8 * z);
    return this.color(mode, shape).map(c => c * brightness);
  }
}

function groupColor(group) {
  if (group.members.length > 1)
    return wheelColor(group.rank);
  const grey = 0.5 + 0.04 * (group.rank % 5);
  return [grey, grey, grey * 1.08];
}

// From grey to orange; a shape without points has no curvature.
function curveColor(curved) { return [0.62, 0.62, 0.65].map((grey, k) => grey + curved * ([1, 0.5, 0.05][k] - grey)); }

// As color_of_shape() in the files of detect_planes: steps of the golden ratio around the color wheel.
function wheelColor(index) {
  const hue = 6 * ((0.13 + 0.61803398874989485 * index) % 1);
  const saturation = index % 3 === 1 ? 0.55 : 0.8;
  const value = index % 2 === 1 ? 0.8 : 1;
  return [5, 3, 1].map(shift => {
    const x = (shift + hue) % 6;
    return value * (1 - saturation * Math.max(0, Math.min(x, 4 - x, 1)));
  });
}

function cssColor(color) { return "rgb(" + color.map(c => Math.round(255 * c)).join(" ") + ")"; }
