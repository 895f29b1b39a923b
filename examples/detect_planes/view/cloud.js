// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cloud on the canvas: one draw call. A table, of one texel for each shape and one for the points without a shape,
// gives color and state, so that nothing is done for each point but on the graphics processor.
const State = { hidden: 0, dim: 85, normal: 170, selected: 255 };
const tableWidth = 256;

const vertexShader = `
  precision highp float;
  attribute vec3 position;
  attribute vec4 mark;
  uniform mat4 modelViewMatrix, projectionMatrix;
  uniform sampler2D table;
  uniform float tableHeight, noShape, worldSize, pixelsPerUnit, smallestSize;
  uniform vec3 background;
  uniform bool isByDistance, isPicking, hasSelection;
  varying vec3 color;

  vec3 ramp(float t) {
    vec3 end = t < 0.0 ? vec3(0.13, 0.40, 0.85) : vec3(0.86, 0.20, 0.15);
    return mix(vec3(0.86, 0.86, 0.84), end, sqrt(abs(t)));
  }

  void main() {
    float row = mark.y + 256.0 * mark.z;
    vec4 look = texture2D(table, vec2((mark.x + 0.5) / 256.0, (row + 0.5) / tableHeight));
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    color = vec3(0.0);
    if (look.a < 0.1)
      return;
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * seen;
    gl_PointSize = clamp(worldSize * pixelsPerUnit / max(-seen.z, 1e-30), smallestSize, 40.0);
    bool hasShape = mark.x + 256.0 * row < noShape;
    color = isByDistance && hasShape ? ramp((mark.w - 128.0) / 127.0) : look.rgb;
    if (look.a < 0.5)
      color = mix(background, color, 0.25);
    if (hasSelection) // what is selected is in front of the rest
      gl_Position.z = 0.5 * gl_Position.z + (look.a > 0.9 ? -0.5 : 0.5) * gl_Position.w;
    if (isPicking)
      color = mark.xyz / 255.0;
  }`;

const fragmentShader = `
  precision mediump float;
  varying vec3 color;
  void main() {
    vec2 d = gl_PointCoord - 0.5;
    if (dot(d, d) > 0.25)
      discard;
    gl_FragColor = vec4(color, 1.0);
  }`;

class Cloud {
  constructor(canvas, scene, points) {
    this.canvas = canvas;
    this.box = scene.extent;
    this.extent = Math.hypot(...scene.extent) || 1;
    this.noShape = scene.shapes.points.length;
    this.renderer = new THREE.WebGLRenderer({ canvas });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.camera = new THREE.PerspectiveCamera(40, 1, 1, 10);
    this.scene = new THREE.Scene();
    this.makeTable();
    this.makePoints(points, spacingOf(scene));
    this.pickTarget = new THREE.WebGLRenderTarget(1, 1, { minFilter: THREE.NearestFilter,
                                                          magFilter: THREE.NearestFilter });
    this.afterRender = () => {};
    this.afterLoss = this.afterReturn = () => {};
    canvas.addEventListener("webglcontextlost", event => {
      event.preventDefault(); // else it never returns
      this.afterLoss();
    });
    canvas.addEventListener("webglcontextrestored", () => this.restore());
    this.resize();
    this.setUp("z");
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
  }

  makeTable() {
    this.tableHeight = Math.ceil((this.noShape + 1) / tableWidth);
    this.look = new Uint8Array(4 * tableWidth * this.tableHeight);
    this.table = new THREE.DataTexture(this.look, tableWidth, this.tableHeight, THREE.RGBAFormat);
    this.table.minFilter = this.table.magFilter = THREE.NearestFilter;
    this.table.generateMipmaps = false;
  }

  makePoints(points, spacing) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(points.positions, 3));
    geometry.setAttribute("mark", new THREE.BufferAttribute(points.marks, 4));
    this.spacing = spacing;
    const value = x => ({ value: x });
    this.material = new THREE.RawShaderMaterial({ vertexShader, fragmentShader, uniforms: {
      table: value(this.table), tableHeight: value(this.tableHeight), noShape: value(this.noShape),
      worldSize: value(spacing), pixelsPerUnit: value(1), smallestSize: value(1),
      background: value(new THREE.Color()), isByDistance: value(false), isPicking: value(false),
      hasSelection: value(false) } });
    const object = new THREE.Points(geometry, this.material);
    object.frustumCulled = false;
    this.scene.add(object);
  }

  set(name, value) {
    this.material.uniforms[name].value = value;
    this.requestRender();
  }

  setPointSize(factor) { this.set("worldSize", this.spacing * factor); }

  setBackground(color) {
    this.renderer.setClearColor(color, 1);
    this.material.uniforms.background.value.set(color);
    this.requestRender();
  }

  isLost() { return this.renderer.getContext().isContextLost(); }

  // three.js has made its buffers anew, without the background.
  restore() {
    this.renderer.setClearColor(this.material.uniforms.background.value, 1);
    this.requestRender();
    this.afterReturn();
  }

  // appearance(shape): red, green, blue from 0 to 1, and the state
  setLook(appearance) {
    let hasSelection = false;
    for (let shape = 0; shape <= this.noShape; ++shape) {
      const [color, state] = appearance(shape);
      hasSelection = hasSelection || state === State.selected;
      this.look.set([...color.map(c => Math.round(255 * c)), state], 4 * shape);
    }
    this.table.needsUpdate = true;
    this.set("hasSelection", hasSelection);
  }

  // The controls keep the axis that points up: "z", "y" or "-y".
  setUp(axis) {
    this.up = axis;
    this.camera.up.set(0, axis === "z" ? 0 : axis === "y" ? 1 : -1, axis === "z" ? 1 : 0);
    if (this.controls)
      this.controls.dispose();
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.screenSpacePanning = true;
    this.controls.autoRotateSpeed = 4;
    this.controls.addEventListener("change", () => this.requestRender());
    this.controls.addEventListener("start", () => this.first = null);
    this.lookAtAll();
  }

  // All of the box of the shapes. Azimuth 0: the viewer stands in the direction of x, 90: of y (if z points up), as in
  // scripts/render.sh.
  lookAtAll(azimuth = 30, elevation = 30, zoom = 1) {
    this.first = [azimuth, elevation, zoom]; // until the viewer moves
    const a = azimuth * Math.PI / 180, e = elevation * Math.PI / 180;
    const across = Math.cos(e) * Math.cos(a), along = Math.cos(e) * Math.sin(a), above = Math.sin(e);
    const sign = this.up === "-y" ? -1 : 1;
    const toViewer = this.up === "z" ? [across, along, above] : [across, sign * above, -sign * along];
    this.controls.target.set(0, 0, 0);
    this.camera.position.set(...toViewer);
    this.camera.lookAt(this.controls.target);
    this.camera.position.setLength(this.distanceToBox() / zoom);
    this.controls.update();
    this.requestRender();
  }

  // From the center, in the direction of the camera: so that each corner is inside of its picture.
  distanceToBox() {
    const toCamera = this.camera.quaternion.clone().inverse();
    const slope = 0.92 * Math.tan(this.camera.fov * Math.PI / 360);
    let distance = this.extent / 100;
    for (let corner = 0; corner < 8; ++corner) {
      const signs = [corner & 1, corner & 2, corner & 4].map(bit => bit ? 0.5 : -0.5);
      const p = new THREE.Vector3(...this.box.map((x, k) => signs[k] * x)).applyQuaternion(toCamera);
      distance = Math.max(distance, p.z + Math.max(Math.abs(p.x) / this.camera.aspect, Math.abs(p.y)) / slope);
    }
    return distance;
  }

  // The viewer keeps the direction.
  goTo(center, size) {
    this.first = null;
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.setLength(0.9 * size / Math.tan(this.camera.fov * Math.PI / 360));
    this.controls.target.set(...center);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.requestRender();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    if (this.first)
      this.lookAtAll(...this.first);
    this.requestRender();
  }

  prepareCamera() {
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = distance / 200;
    this.camera.far = distance + 20 * this.extent;
    this.camera.updateProjectionMatrix();
    const height = this.renderer.getDrawingBufferSize(new THREE.Vector2()).y;
    const uniforms = this.material.uniforms;
    uniforms.pixelsPerUnit.value = height / 2 / Math.tan(this.camera.fov * Math.PI / 360);
    uniforms.smallestSize.value = 1.25 * this.renderer.getPixelRatio();
  }

  requestRender() {
    if (this.isRequested)
      return;
    this.isRequested = true;
    requestAnimationFrame(time => {
      this.isRequested = false;
      if (this.controls.autoRotate)
        this.controls.update();
      if (this.isLost())
        return;
      this.render();
      this.afterRender(time);
    });
  }

  render() {
    this.prepareCamera();
    this.renderer.render(this.scene, this.camera);
  }

  // The shape of the shown point closest to a pixel of the canvas: the surroundings of the pixel are drawn with the
  // indices of the shapes as colors. -1 if there is none or if it has no shape.
  pick(x, y) {
    const size = 2 * 6 + 1, ratio = this.renderer.getPixelRatio();
    const full = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    this.prepareCamera();
    this.camera.setViewOffset(full.x, full.y, Math.floor(x * ratio) - 6, Math.floor(y * ratio) - 6, size, size);
    this.pickTarget.setSize(size, size);
    const clear = this.renderer.getClearColor().clone();
    this.renderer.setClearColor(0xffffff, 1);
    this.material.uniforms.isPicking.value = true;
    this.renderer.setRenderTarget(this.pickTarget);
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    const pixels = new Uint8Array(4 * size * size);
    this.renderer.readRenderTargetPixels(this.pickTarget, 0, 0, size, size, pixels);
    this.renderer.setRenderTarget(null);
    this.material.uniforms.isPicking.value = false;
    this.renderer.setClearColor(clear, 1);
    this.camera.clearViewOffset();
    const shape = closestShape(pixels, size);
    return shape < this.noShape ? shape : -1;
  }
}

// White is no shape.
function closestShape(pixels, size) {
  let best = Infinity, shape = 0xffffff;
  for (let i = 0; i < size * size; ++i) {
    const index = pixels[4 * i] + 256 * pixels[4 * i + 1] + 65536 * pixels[4 * i + 2];
    const distance = Math.hypot(i % size - (size - 1) / 2, Math.floor(i / size) - (size - 1) / 2);
    if (index !== 0xffffff && distance < best) {
      best = distance;
      shape = index;
    }
  }
  return shape;
}

// The side of the square that a shown point has for itself.
function spacingOf(scene) {
  const sum = numbers => numbers.reduce((a, b) => a + b, 0);
  const shown = sum(scene.shapes.shown.slice(0, -1)), area = sum(scene.shapes.area);
  return 1.2 * (shown > 0 && area > 0 ? Math.sqrt(area / shown)
                                       : Math.hypot(...scene.extent) / Math.sqrt(Math.max(scene.shown, 1)));
}
