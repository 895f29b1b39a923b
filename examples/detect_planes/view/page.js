// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The state of the page: what is selected, shown and colored, and what the buttons do.
class Page {
  constructor(scene, data) {
    this.scene = scene;
    this.shapes = new Shapes(scene, data.points, data.inputColors);
    this.modes = { shape: "Shapes", direction: "Directions", plane: "Planes", distance: "Distance",
                   curved: "Curved", ...data.inputColors.length > 0 ? { input: "Input" } : {} };
    this.visibility = new Visibility(this.shapes.count);
    this.mode = "shape";
    this.smallest = 0;
    this.hasUnassigned = true;
    this.selection = null;
    this.chosenTheme = "";
    this.cloud = new Cloud(byId("canvas"), scene, data);
    this.firstUp = directionOf(scene.up.join()) || axes.z;
    this.firstUp = Object.values(axes).find(axis => axis.join() === this.firstUp.join()) || this.firstUp;
    this.cloud.viewer.setUp(this.firstUp);
    this.panel = new Panel(this.shapes, selection => this.select(selection), this.actions());
    this.clip = new Clip(scene, this.cloud, () => this.changed());
    this.list = new ShapeList(this.shapes, {
      select: shape => this.select({ kind: "shape", index: shape }), goTo: () => this.goToSelection(),
      toggle: shape => this.changeVisibility(() => this.visibility.toggle(shape)),
      isHidden: shape => this.visibility.isHidden(shape), color: shape => this.shapes.color(this.mode, shape) });
    this.measure = new Measure(this.shapes, this.cloud, this.clip, this.panel);
    this.address = new Address(this);
    this.connect();
    new Controls(this);
    this.setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    tell("");
    this.address.read();
  }

  connect() {
    this.times = [];
    this.cloud.afterMove = () => this.changed();
    this.cloud.afterRender = time => {
      this.measure.moveLabel();
      this.showRate(time);
    };
    this.cloud.afterLoss = () => tell("The browser took the graphics away. The page draws again when they return; " +
                                      "if they do not, load it again.", "error");
    this.cloud.afterReturn = () => tell("");
  }

  // Of what is selected.
  actions() {
    return [["go there", "in front of it (F)", () => this.goToSelection()],
            ["hide", "(X)", () => this.hideSelection()],
            ["isolate", "hide all others (I)", () => this.isolateSelection()],
            ["slice", "a layer along its plane", () => this.sliceAtSelection()],
            ["up", "its normal points up", () => this.setUpBySelection()]];
  }

  // Something that the link holds.
  changed() {
    if (this.address)
      this.address.write();
  }

  setMode(mode) {
    this.mode = mode;
    for (const name of Object.keys(this.modes))
      byId("color-" + name).setAttribute("aria-checked", String(name === mode));
    this.cloud.set("isByDistance", mode === "distance");
    this.cloud.set("isByInput", mode === "input");
    this.writeLegend();
    this.refresh();
  }

  writeLegend() {
    const legend = byId("legend");
    legend.textContent = { shape: "A color for each shape.",
                           direction: "A color for each direction of several shapes; the others are grey.",
                           plane: "A color for each plane of several shapes; the others are grey.",
                           input: "The colors of the input; a surface has the mean of its points.",
                           curved: "Faces are grey, facets of curved surfaces orange:",
                           distance: "Distance to the plane of the shape, along its normal:" }[this.mode];
    if (this.cloud.layers.shown().includes("model"))
      legend.append(" Grey is what the model assumes: no points lie there.");
    const d = this.panel.length(this.scene.maximum_distance);
    if (this.mode === "distance")
      legend.append(...ramp("#2166d9, #6690da 25%, #dbdbd6 50%, #db7b70 75%, #db3326", ["\u2212 " + d, "0", "+ " + d]));
    if (this.mode === "curved")
      legend.append(...ramp(cssColor(curveColor(0)) + "," + cssColor(curveColor(1)), ["0", "0.5", "1"]));
  }

  setTheme(theme) {
    document.documentElement.dataset.theme = theme;
    const color = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    this.cloud.setBackground(color("--back"), color("--text"));
  }

  setLayers(names) {
    for (const name of Object.keys(this.cloud.layers.objects)) {
      this.cloud.showLayer(name, names.includes(name));
      byId("layer-" + name).setAttribute("aria-pressed", String(names.includes(name)));
    }
    this.writeLegend();
    this.changed();
  }

  toggleLayer(name) {
    if (!(name in this.cloud.layers.objects))
      return; // a model is not in each page
    const shown = this.cloud.layers.shown();
    this.setLayers(shown.includes(name) ? shown.filter(other => other !== name) : [...shown, name]);
  }

  isShown(shape) {
    return shape === this.shapes.count ? this.hasUnassigned
      : this.shapes.columns.points[shape] >= this.smallest && !this.visibility.isHidden(shape);
  }

  // Colors and states of all shapes.
  refresh() {
    const members = this.shapes.membersOf(this.selection), selected = new Set(members);
    const grey = document.documentElement.dataset.theme === "dark" ? 0.36 : 0.66;
    this.cloud.setLook(shape => {
      const isAssigned = shape < this.shapes.count;
      const color = isAssigned ? this.shapes.litColor(this.mode, shape) : [grey, grey, grey];
      if (!this.isShown(shape))
        return [color, State.hidden];
      return [color, selected.size === 0 ? State.normal : selected.has(shape) ? State.selected : State.dim];
    });
    this.panel.showSelection(this.selection, this.mode);
    this.list.mark(members);
    const { size } = this.visibility.hidden;
    byId("hidden").hidden = size === 0;
    byId("hidden-count").textContent = plural(size, "shape") + " hidden";
    this.changed();
  }

  select(selection) {
    this.selection = selection && this.shapes.has(selection) ? selection : null;
    if (this.selection)
      this.showSelected();
    this.refresh();
    byId("panel").scrollTop = 0;
  }

  // What is selected must not be hidden for its size.
  showSelected() {
    const sizes = this.shapes.membersOf(this.selection).map(s => this.shapes.columns.points[s]);
    if (sizes.every(size => size < this.smallest))
      this.setSmallest(0);
  }

  changeVisibility(change) {
    change();
    this.refresh();
  }

  hideSelection() {
    const members = this.shapes.membersOf(this.selection);
    this.selection = null;
    this.changeVisibility(() => this.visibility.hide(members));
  }

  isolateSelection() {
    const members = this.shapes.membersOf(this.selection);
    if (members.length === 0)
      return;
    this.selection = null;
    this.hadUnassigned = this.hadUnassigned || this.hasUnassigned;
    this.setUnassigned(false);
    this.changeVisibility(() => this.visibility.isolate(members));
  }

  showAll() {
    this.setUnassigned(this.hasUnassigned || Boolean(this.hadUnassigned));
    this.hadUnassigned = false;
    this.changeVisibility(() => this.visibility.showAll());
  }

  // In front of a shape or a plane. Shapes of a direction are at many places: the viewer keeps the side.
  goToSelection() {
    const members = this.shapes.membersOf(this.selection), { viewer } = this.cloud;
    if (members.length === 0)
      return viewer.lookAtAll();
    const place = viewer.camera.position;
    viewer.goTo(this.positionsOf(members), this.selection.kind === "direction"
      ? place.clone().sub(viewer.controls.target) : this.shapes.outward(members[0], place));
  }

  // Of some of the points that are drawn.
  positionsOf(members) {
    const positions = [];
    for (const shape of members) {
      const all = this.shapes.positions(shape);
      const step = 3 * Math.max(1, Math.floor(all.length / 3 * members.length / 20000));
      for (let i = 0; i < all.length; i += step) {
        const p = [all[i], all[i + 1], all[i + 2]];
        if (this.clip.has(p))
          positions.push(...p);
      }
    }
    return positions.length > 0 ? positions : this.shapes.centroid(members[0]);
  }

  sliceAtSelection() {
    const [shape] = this.shapes.membersOf(this.selection);
    byId("clip").open = true;
    this.clip.sliceThrough(this.shapes.normal(shape), this.shapes.centroid(shape));
  }

  setUpBySelection() {
    const [shape] = this.shapes.membersOf(this.selection), { viewer } = this.cloud;
    const direction = this.shapes.outward(shape, viewer.camera.position);
    viewer.setUp(direction.toArray().map(x => Math.abs(x) < 1e-12 ? 0 : x));
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
    this.changed();
  }

  pick(x, y) {
    const shape = this.cloud.pick(x, y);
    if (this.cloud.isLost()) // nothing was drawn
      return;
    this.select(shape < 0 ? null : { kind: "shape", index: shape }); // points without a shape are none
  }

  toggleTheme() {
    this.chosenTheme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    this.setTheme(this.chosenTheme);
    this.refresh();
  }

  setUnassigned(isShown) {
    this.hasUnassigned = isShown;
    byId("unassigned").checked = isShown;
    this.refresh();
  }

  spin() {
    const { controls } = this.cloud;
    controls.autoRotate = !controls.autoRotate;
    this.times = [];
    if (!this.cloud.isLost())
      tell("");
    this.cloud.requestRender();
  }

  // While it spins: the rate of the last frames.
  showRate(time) {
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
}

// A bar of colors, with texts below it.
function ramp(colors, texts) {
  const bar = element("div", { class: "ramp" });
  bar.style.background = "linear-gradient(to right, " + colors + ")";
  return [bar, element("div", { class: "ends" }, ...texts.map(text => element("span", {}, text)))];
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
  window.page = new Page(scene, { points, layers: decodeLayers(scene), inputColors: readBytes("input-colors") });
}, 20);
