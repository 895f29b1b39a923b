// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the user does: the mouse, the keys, the controls of the panel, and the part of the address after '#':
//   #shape=3  #direction=2  #plane=4     what is selected
//   #color=shape, direction, plane or distance  #theme=dark  #up=y  #azimuth=30  #elevation=35  #zoom=1.5
//   #unassigned=0  #smallest=100  #panel=0  #spin  #pick=0.5,0.5 (a click there)
//   #check  writes what was drawn to attributes of the page, for tests
// Several are joined by '&'.
const modes = { shape: "Shapes", direction: "Directions", plane: "Planes", distance: "Distance" };

class Page {
  constructor(scene, points) {
    this.shapes = new Shapes(scene);
    this.scene = scene;
    this.cloud = new Cloud(byId("canvas"), scene, points);
    this.panel = new Panel(this.shapes, selection => this.select(selection), () => this.goToSelection());
    this.mode = "shape";
    this.smallest = 0;
    this.hasUnassigned = true;
    this.selection = null;
    this.times = [];
    this.cloud.afterRender = time => this.measure(time);
    this.cloud.afterLoss = () => tell("The browser took the graphics away. The page draws again when they return; " +
                                      "if they do not, load it again.", "error");
    this.cloud.afterReturn = () => tell("");
    this.makeModes();
    this.listen();
    this.setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    tell("");
    this.readAddress();
    window.onhashchange = () => this.readAddress();
  }

  makeModes() {
    for (const [mode, title] of Object.entries(modes))
      byId("colors").append(element("button", { role: "radio", id: "color-" + mode,
                                                onclick: () => this.setMode(mode) }, title));
  }

  setMode(mode) {
    this.mode = mode;
    for (const name of Object.keys(modes))
      byId("color-" + name).setAttribute("aria-checked", String(name === mode));
    this.cloud.set("isByDistance", mode === "distance");
    this.writeLegend();
    this.refresh();
  }

  writeLegend() {
    const legend = byId("legend");
    legend.textContent = { shape: "A color for each shape.",
                           direction: "A color for each direction of several shapes; the others are grey.",
                           plane: "A color for each plane of several shapes; the others are grey.",
                           distance: "Distance to the plane of the shape, along its normal:" }[this.mode];
    if (this.mode !== "distance")
      return;
    const bar = element("div", { class: "ramp" });
    bar.style.background = "linear-gradient(to right, #2166d9, #6690da 25%, #dbdbd6 50%, #db7b70 75%, #db3326)";
    const d = this.panel.length(this.scene.maximum_distance);
    legend.append(bar, element("div", { class: "ends" }, element("span", {}, "\u2212 " + d), element("span", {}, "0"),
                               element("span", {}, "+ " + d)));
  }

  setTheme(theme) {
    document.documentElement.dataset.theme = theme;
    this.cloud.setBackground(getComputedStyle(document.documentElement).getPropertyValue("--back").trim());
  }

  isShown(shape) {
    return shape === this.shapes.count ? this.hasUnassigned
                                       : this.shapes.columns.points[shape] >= this.smallest;
  }

  // Colors and states of all shapes.
  refresh() {
    const selected = new Set(this.shapes.membersOf(this.selection));
    const grey = document.documentElement.dataset.theme === "dark" ? 0.36 : 0.66;
    this.cloud.setLook(shape => {
      const isAssigned = shape < this.shapes.count;
      const color = isAssigned ? this.shapes.litColor(this.mode, shape) : [grey, grey, grey];
      if (!this.isShown(shape))
        return [color, State.hidden];
      return [color, selected.size === 0 ? State.normal : selected.has(shape) ? State.selected : State.dim];
    });
    this.panel.showSelection(this.selection, this.mode);
  }

  select(selection) {
    this.selection = selection && this.shapes.has(selection) ? selection : null;
    if (this.selection)
      this.showSelected();
    this.refresh();
    byId("panel").scrollTop = 0;
    this.writeAddress();
  }

  // What is selected must not be hidden for its size.
  showSelected() {
    const sizes = this.shapes.membersOf(this.selection).map(s => this.shapes.columns.points[s]);
    if (sizes.every(size => size < this.smallest))
      this.setSmallest(0);
  }

  goToSelection() {
    const members = this.shapes.membersOf(this.selection);
    if (members.length === 0)
      return this.cloud.lookAtAll();
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    let radius = 0;
    for (const shape of members) {
      this.shapes.centroid(shape).forEach((x, k) => (low[k] = Math.min(low[k], x), high[k] = Math.max(high[k], x)));
      radius = Math.max(radius, Math.sqrt(this.shapes.columns.area[shape]));
    }
    const size = Math.hypot(...high.map((h, k) => h - low[k])) + 1.5 * radius;
    this.cloud.goTo(low.map((l, k) => (l + high[k]) / 2), Math.max(size, this.cloud.extent / 1000));
  }

  setSmallest(points) {
    this.smallest = points;
    byId("smallest").value = points > 1 ? 100 * Math.log(points) / Math.log(this.shapes.largest) : 0;
    this.writeSmallest();
  }

  writeSmallest() {
    const shown = this.shapes.columns.points.filter(points => points >= this.smallest).length;
    byId("smallest-value").textContent = this.smallest <= 1 ? "all shapes"
      : "at least " + plural(this.smallest, "point") + ": " + plural(shown, "shape");
  }

  setPointSize(step) {
    byId("size").value = step;
    this.cloud.setPointSize(Math.pow(1.15, Number(byId("size").value)));
  }

  pick(x, y) {
    const shape = this.cloud.pick(x, y);
    if (this.cloud.isLost()) // nothing was drawn
      return;
    this.select(shape < 0 ? null : { kind: "shape", index: shape });
  }

  listen() {
    const canvas = byId("canvas");
    let start = null;
    canvas.addEventListener("pointerdown", event => start = event.button === 0 ? [event.offsetX, event.offsetY] : null);
    canvas.addEventListener("pointerup", event => {
      if (start && Math.hypot(event.offsetX - start[0], event.offsetY - start[1]) < 5)
        this.pick(event.offsetX, event.offsetY);
      start = null;
    });
    byId("smallest").oninput = event => {
      const value = Number(event.target.value);
      this.smallest = value === 0 ? 0 : Math.round(Math.pow(this.shapes.largest, value / 100));
      this.writeSmallest();
      this.refresh();
    };
    byId("size").oninput = event => this.setPointSize(event.target.value);
    byId("unassigned").onchange = event => this.setUnassigned(event.target.checked);
    document.addEventListener("keydown", event => {
      const action = !event.ctrlKey && !event.metaKey && !event.altKey && this.keys()[event.key.toLowerCase()];
      if (!action)
        return;
      action();
      event.preventDefault();
    });
    this.writeSmallest();
  }

  keys() {
    const step = n => () => this.setPointSize(Number(byId("size").value) + n);
    const result = { escape: () => this.select(null), f: () => this.goToSelection(),
                     r: () => this.cloud.lookAtAll(),
                     u: () => this.setUnassigned(!this.hasUnassigned), "+": step(2), "=": step(2), "-": step(-2),
                     y: () => this.cloud.setUp({ z: "y", y: "-y", "-y": "z" }[this.cloud.up]), t: () => this.spin(),
                     l: () => this.toggleTheme(), h: () => document.body.classList.toggle("alone") };
    Object.keys(modes).forEach((mode, i) => result[i + 1] = () => this.setMode(mode));
    return result;
  }

  toggleTheme() {
    this.setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
    this.refresh();
  }

  setUnassigned(isShown) {
    this.hasUnassigned = isShown;
    byId("unassigned").checked = isShown;
    this.refresh();
  }

  spin() {
    const controls = this.cloud.controls;
    controls.autoRotate = !controls.autoRotate;
    this.times = [];
    if (!this.cloud.isLost())
      tell("");
    this.cloud.requestRender();
  }

  // While it spins: the rate of the last frames.
  measure(time) {
    if (!this.cloud.controls.autoRotate)
      return;
    this.times.push(time);
    if (this.times.length > 30)
      this.times.shift();
    const seconds = (time - this.times[0]) / 1000;
    if (seconds > 0)
      tell(((this.times.length - 1) / seconds).toFixed(1) + " frames per second");
    this.cloud.requestRender();
  }

  readAddress() {
    const address = new URLSearchParams(location.hash.slice(1));
    const number = (name, otherwise) => Number.isFinite(parseFloat(address.get(name))) ? parseFloat(address.get(name))
                                                                                        : otherwise;
    if (address.has("theme"))
      this.setTheme(address.get("theme") === "dark" ? "dark" : "light");
    if (address.has("panel"))
      document.body.classList.toggle("alone", address.get("panel") === "0");
    this.cloud.resize();
    if (["z", "y", "-y"].includes(address.get("up")))
      this.cloud.setUp(address.get("up"));
    if (["azimuth", "elevation", "zoom"].some(name => address.has(name)))
      this.cloud.lookAtAll(number("azimuth", 30), number("elevation", 30), number("zoom", 1));
    if (address.has("unassigned"))
      this.setUnassigned(address.get("unassigned") !== "0");
    this.setSmallest(number("smallest", this.smallest));
    const kind = ["shape", "direction", "plane"].find(name => address.has(name));
    this.selection = null;
    if (kind)
      this.select({ kind, index: number(kind, -1) });
    this.setMode(address.get("color") in modes ? address.get("color") : this.mode);
    if (address.has("pick")) {
      const [x, y] = address.get("pick").split(",").map(Number), { clientWidth, clientHeight } = byId("canvas");
      this.pick(x * clientWidth, y * clientHeight);
    }
    this.cloud.render();
    if (address.has("spin"))
      this.spin();
    if (address.has("check"))
      this.check();
  }

  // A browser may refuse to change the address of a file.
  writeAddress() {
    const address = new URLSearchParams(location.hash.slice(1));
    for (const name of ["shape", "direction", "plane", "pick"])
      address.delete(name);
    if (this.selection)
      address.set(this.selection.kind, this.selection.index);
    try {
      history.replaceState(null, "", "#" + address);
    } catch (error) {
      // the address is a convenience
    }
  }

  // Looks at the pixels that were just drawn.
  check() {
    const gl = this.cloud.renderer.getContext();
    const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
    const bytes = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    const pixels = new Uint32Array(bytes.buffer);
    const back = new THREE.Color(this.cloud.material.uniforms.background.value);
    const isDrawn = i => Math.abs(bytes[4 * i] - 255 * back.r) + Math.abs(bytes[4 * i + 1] - 255 * back.g) > 4;
    const shown = this.shapes.columns.shown.reduce((sum, n, shape) => sum + (this.isShown(shape) ? n : 0), 0);
    Object.assign(document.body.dataset, { shown, colors: new Set(pixels).size,
                                           drawn: pixels.filter((_, i) => isDrawn(i)).length,
                                           selected: this.selection ? this.selection.kind + this.selection.index
                                                                    : "none" });
  }
}

function tell(text, kind = "") {
  byId("message").className = kind;
  byId("message").textContent = text;
}

function complain(text) {
  tell(text, "error");
  document.body.dataset.error = text;
}

window.onerror = text => complain(String(text));
setTimeout(() => { // the message comes first
  const scene = JSON.parse(byId("scene").textContent);
  const points = decodePoints(scene, byId("points").textContent);
  byId("points").remove();
  if (!document.createElement("canvas").getContext("webgl"))
    return complain("This browser does not offer WebGL, which the page needs.");
  window.page = new Page(scene, points);
}, 20);
