// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the viewer stands. Coordinates are relative to the center of the box of the shapes.
const axes = { z: [0, 0, 1], y: [0, 1, 0], "-y": [0, -1, 0] };
const vector = v => new THREE.Vector3(...v);

class Viewer {
  // afterMove() is called after each movement, afterEnd() when the viewer lets go.
  constructor(canvas, box, afterMove, afterEnd) {
    Object.assign(this, { canvas, box, afterMove, afterEnd });
    this.extent = Math.hypot(...box) || 1;
    this.camera = new THREE.PerspectiveCamera(40, 1, 1, 10);
    this.setUp(axes.z);
  }

  // The controls keep the direction that points up.
  setUp(direction) {
    this.up = direction;
    this.makeControls();
    this.lookAtAll();
  }

  makeControls() {
    const target = this.controls ? this.controls.target : new THREE.Vector3();
    this.camera.up.set(...this.up).normalize();
    if (this.controls)
      this.controls.dispose();
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.target.copy(target);
    this.controls.screenSpacePanning = true;
    this.controls.enableKeys = false;
    this.controls.autoRotateSpeed = 4;
    this.controls.addEventListener("change", () => {
      this.first = null;
      this.afterMove();
    });
    this.controls.addEventListener("end", () => this.afterEnd());
  }

  // The next of the axes of coordinates.
  turnUp() {
    const all = Object.values(axes);
    this.setUp(all[(all.findIndex(axis => axis.join() === this.up.join()) + 1) % all.length]);
  }

  // Shows the whole box. Azimuth 0: the viewer stands in the direction of x, 90: of y (if z points up).
  lookAtAll(azimuth = 30, elevation = 30, zoom = 1) {
    const a = azimuth * Math.PI / 180, e = elevation * Math.PI / 180;
    const up = vector(this.up).normalize();
    const x = vector(Math.abs(up.x) < 0.9 ? [1, 0, 0] : [0, 1, 0]);
    const across = x.addScaledVector(up, -up.dot(x)).normalize(), along = up.clone().cross(across);
    const toViewer = across.multiplyScalar(Math.cos(e) * Math.cos(a)).addScaledVector(along, Math.cos(e) * Math.sin(a))
        .addScaledVector(up, Math.sin(e));
    const corners = [];
    for (let corner = 0; corner < 8; ++corner)
      corners.push(...this.box.map((size, k) => (corner >> k & 1 ? 0.5 : -0.5) * size));
    this.standAt(new THREE.Vector3(), toViewer);
    this.camera.position.setLength(Math.max(this.distanceTo(corners), this.extent / 100) / zoom);
    this.finish();
    this.first = [azimuth, elevation, zoom]; // until the viewer moves
  }

  standAt(target, toViewer) {
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(toViewer);
    this.camera.lookAt(target);
  }

  finish() {
    this.controls.update();
    this.afterMove();
    this.afterEnd();
  }

  // From the target, in the direction of the camera: so that each of the points is inside of the picture.
  distanceTo(positions) {
    const slope = 0.92 * Math.tan(this.camera.fov * Math.PI / 360);
    let distance = 0;
    this.forEachSeen(positions, p => {
      distance = Math.max(distance, p.z + Math.max(Math.abs(p.x) / this.camera.aspect, Math.abs(p.y)) / slope);
    });
    return distance;
  }

  forEachSeen(positions, act) {
    const toCamera = this.camera.quaternion.clone().inverse(), p = new THREE.Vector3();
    for (let i = 0; i < positions.length; i += 3)
      act(p.fromArray(positions, i).sub(this.controls.target).applyQuaternion(toCamera));
  }

  // The points fill the view, seen from a direction. Exactly along the axis of the controls there is no azimuth: the
  // viewer stands a little aside.
  goTo(positions, toViewer) {
    this.first = null;
    const direction = toViewer.clone().normalize(), up = vector(this.up).normalize();
    const aside = this.camera.position.clone().sub(this.controls.target);
    aside.addScaledVector(up, -up.dot(aside));
    if (Math.abs(direction.dot(up)) > 0.9999 && aside.length() > 0)
      direction.addScaledVector(aside.normalize(), 0.02).normalize();
    const middle = new THREE.Vector3();
    for (let i = 0; i < positions.length; i += 3)
      middle.add(vector(positions.slice(i, i + 3)).multiplyScalar(3 / positions.length));
    this.standAt(middle, direction);
    const low = vector([Infinity, Infinity, Infinity]), high = vector([-Infinity, -Infinity, -Infinity]);
    this.forEachSeen(positions, p => (low.min(p), high.max(p)));
    middle.add(low.add(high).multiplyScalar(0.5).applyQuaternion(this.camera.quaternion));
    this.standAt(middle, direction);
    this.camera.position.copy(middle).addScaledVector(direction,
                                                      Math.max(this.distanceTo(positions), this.extent / 1000));
    this.finish();
  }

  resize(width, height) {
    this.camera.aspect = width / Math.max(height, 1);
    if (this.first)
      this.lookAtAll(...this.first);
  }

  // Before a picture is drawn.
  prepare() {
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = distance / 200;
    this.camera.far = distance + 20 * this.extent;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  // The line of sight through a place of the canvas.
  ray(x, y) {
    const { clientWidth, clientHeight } = this.canvas, caster = new THREE.Raycaster();
    this.prepare();
    caster.setFromCamera({ x: 2 * x / clientWidth - 1, y: 1 - 2 * y / clientHeight }, this.camera);
    return caster.ray;
  }

  // Viewer and target, as text, where the viewer has moved.
  toText() {
    return this.first ? "" : [...this.camera.position.toArray(), ...this.controls.target.toArray()]
        .map(x => Number(x.toPrecision(6))).join();
  }

  fromText(text) {
    const numbers = text.split(",").map(Number);
    if (numbers.length !== 6 || !numbers.every(Number.isFinite))
      return;
    this.first = null;
    const target = vector(numbers.slice(3));
    this.standAt(target, vector(numbers.slice(0, 3)).sub(target));
    this.finish();
  }
}
