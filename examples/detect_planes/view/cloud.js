// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is on the canvas: one draw call for each layer. A table, of one texel for each shape and one for the points
// without a shape, gives color and state, so that nothing is done for each point but on the graphics processor.
const State = { hidden: 0, dim: 85, normal: 170, selected: 255 };
const tableWidth = 256, far = 1e30;

class Cloud {
  constructor(canvas, scene, data) {
    this.canvas = canvas;
    this.noShape = scene.shapes.points.length;
    this.points = data.points;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.scene = new THREE.Scene();
    this.overlay = new THREE.Group(); // what cannot be picked
    this.scene.add(this.overlay);
    this.makeTable();
    this.makeLayers(data, spacingOf(scene));
    this.pickTarget = new THREE.WebGLRenderTarget(1, 1, { minFilter: THREE.NearestFilter,
                                                          magFilter: THREE.NearestFilter });
    this.afterRender = this.afterMove = () => {};
    this.afterLoss = this.afterReturn = () => {};
    canvas.addEventListener("webglcontextlost", event => {
      event.preventDefault(); // else it never returns
      this.afterLoss();
    });
    canvas.addEventListener("webglcontextrestored", () => this.restore());
    this.viewer = new Viewer(canvas, scene.extent, () => this.requestRender(), () => this.afterMove());
    this.resize();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
  }

  get camera() { return this.viewer.camera; }
  get controls() { return this.viewer.controls; }

  makeTable() {
    this.tableHeight = Math.ceil((this.noShape + 1) / tableWidth);
    this.look = new Uint8Array(4 * tableWidth * this.tableHeight);
    this.table = new THREE.DataTexture(this.look, tableWidth, this.tableHeight, THREE.RGBAFormat);
    this.table.minFilter = this.table.magFilter = THREE.NearestFilter;
    this.table.generateMipmaps = false;
  }

  makeLayers({ points, layers, inputColors }, spacing) {
    const value = x => ({ value: x });
    this.spacing = spacing;
    this.uniforms = {
      table: value(this.table), tableHeight: value(this.tableHeight), noShape: value(this.noShape),
      worldSize: value(spacing), pixelsPerUnit: value(1), smallestSize: value(1), nearest: value(1),
      background: value(new THREE.Color()), isByDistance: value(false), isByInput: value(false),
      isPicking: value(false),
      hasSelection: value(false), halfWidth: value(new THREE.Vector2()), lineColor: value(new THREE.Color()),
      lineShade: value(0), clipLow: value(vector([-far, -far, -far])), clipHigh: value(vector([far, far, far])),
      sliceNormal: value(vector([0, 0, 0])), sliceOffset: value(0), sliceReach: value(far) };
    this.layers = new Layers(this.scene, this.uniforms);
    this.layers.addPoints(points, inputColors);
    this.layers.addTriangles("surface", layers.triangles);
    this.layers.addTriangles("model", layers.model);
    this.layers.addSegments(layers.segments);
  }

  set(name, value) {
    this.uniforms[name].value = value;
    this.requestRender();
  }

  setPointSize(factor) { this.set("worldSize", this.spacing * factor); }

  showLayer(name, isShown) {
    this.layers.show(name, isShown);
    this.uniforms.lineShade.value = this.layers.shown().some(layer => layer !== "outlines") ? 0.75 : 0;
    this.requestRender();
  }

  setBackground(color, text) {
    this.renderer.setClearColor(color, 1);
    this.uniforms.background.value.set(color);
    this.uniforms.lineColor.value.set(text);
    this.requestRender();
  }

  isLost() { return this.renderer.getContext().isContextLost(); }

  // three.js has made its buffers anew, without the background.
  restore() {
    this.renderer.setClearColor(this.uniforms.background.value, 1);
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

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    this.renderer.setSize(width, height, false);
    this.viewer.resize(width, height);
    this.requestRender();
  }

  prepareCamera() {
    this.viewer.prepare();
    const size = this.renderer.getDrawingBufferSize(new THREE.Vector2()), ratio = this.renderer.getPixelRatio();
    const uniforms = this.uniforms;
    uniforms.pixelsPerUnit.value = size.y / 2 / Math.tan(this.camera.fov * Math.PI / 360);
    uniforms.smallestSize.value = 1.25 * ratio;
    uniforms.nearest.value = 1.01 * this.camera.near;
    uniforms.halfWidth.value.set(1.6 * ratio / size.x, 1.6 * ratio / size.y);
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

  // The shape of what is drawn closest to a pixel of the canvas, or the number of shapes for a point without one: the
  // surroundings of the pixel are drawn with the indices of the shapes as colors. -1 if there is nothing.
  pick(x, y) {
    const size = 2 * 6 + 1, ratio = this.renderer.getPixelRatio();
    const full = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    this.prepareCamera();
    this.camera.setViewOffset(full.x, full.y, Math.floor(x * ratio) - 6, Math.floor(y * ratio) - 6, size, size);
    this.pickTarget.setSize(size, size);
    const clear = this.renderer.getClearColor().clone();
    this.renderer.setClearColor(0xffffff, 1);
    this.uniforms.isPicking.value = true;
    this.overlay.visible = false;
    this.renderer.setRenderTarget(this.pickTarget);
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    const pixels = new Uint8Array(4 * size * size);
    this.renderer.readRenderTargetPixels(this.pickTarget, 0, 0, size, size, pixels);
    this.renderer.setRenderTarget(null);
    this.uniforms.isPicking.value = false;
    this.overlay.visible = true;
    this.renderer.setClearColor(clear, 1);
    this.camera.clearViewOffset();
    const shape = closestShape(pixels, size);
    return shape <= this.noShape ? shape : -1;
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
