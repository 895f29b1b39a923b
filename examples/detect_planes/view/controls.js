// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mouse, fingers, keys, and the buttons and sliders of the page.
const layerNames = { points: "Points", outlines: "Outlines", surface: "Surface", model: "Model" };

class Controls {
  constructor(page) {
    this.page = page;
    this.makeButtons();
    this.listenToPointer();
    this.listenToPanel();
    document.addEventListener("keydown", event => this.press(event));
    page.writeSmallest();
  }

  makeButtons() {
    const { page } = this;
    for (const [mode, title] of Object.entries(page.modes))
      byId("colors").append(element("button", { role: "radio", id: "color-" + mode,
                                                onclick: () => page.setMode(mode) }, title));
    for (const [name, title] of Object.entries(layerNames).filter(([name]) => name in page.cloud.layers.objects))
      byId("layers").append(element("button", { "aria-pressed": String(name === "points"), id: "layer-" + name,
                                                onclick: () => page.toggleLayer(name) }, title));
  }

  // A click, or the touch of one finger that does not move, selects.
  listenToPointer() {
    const canvas = byId("canvas"), { page } = this;
    const fingers = new Set();
    let start = null;
    canvas.addEventListener("pointerdown", event => {
      fingers.add(event.pointerId);
      start = event.button === 0 && fingers.size === 1 ? [event.offsetX, event.offsetY] : null;
    });
    canvas.addEventListener("pointerup", event => {
      const reach = event.pointerType === "touch" ? 12 : 5;
      if (start && Math.hypot(event.offsetX - start[0], event.offsetY - start[1]) < reach)
        this.click(event.offsetX, event.offsetY);
      start = null;
    });
    for (const type of ["pointerup", "pointercancel", "pointerleave"])
      canvas.addEventListener(type, event => fingers.delete(event.pointerId));
    canvas.addEventListener("dblclick", () => page.selection && !page.measure.isOn && page.goToSelection());
  }

  click(x, y) {
    const { page } = this;
    if (document.activeElement)
      document.activeElement.blur(); // keys are for the picture again
    if (page.measure.isOn)
      return page.measure.click(x, y);
    page.pick(x, y);
  }

  listenToPanel() {
    const { page } = this;
    byId("smallest").oninput = event => {
      const value = Number(event.target.value);
      page.smallest = value === 0 ? 0 : Math.round(Math.pow(page.shapes.largest, value / 100));
      page.writeSmallest();
      page.refresh();
    };
    byId("size").oninput = event => page.setPointSize(event.target.value);
    byId("unassigned").onchange = event => page.setUnassigned(event.target.checked);
    byId("show-all").onclick = () => page.showAll();
    byId("fit").onclick = () => page.cloud.viewer.lookAtAll();
    byId("save-picture").onclick = () => savePicture(page.cloud, page.scene);
    byId("save-table").onclick = () => saveTable(page.shapes, shape => page.isShown(shape));
    byId("theme").onclick = () => page.toggleTheme();
    byId("keys").onclick = () => this.toggleHelp();
    byId("drawer").onclick = () => document.body.classList.toggle("alone");
  }

  toggleHelp() { byId("help").hidden = !byId("help").hidden; }

  // Text is typed into a field without being taken for keys of the page. Sliders keep their arrows, which are none.
  press(event) {
    const isText = event.target.matches && event.target.matches("input[type=search], input[type=text], textarea");
    if (isText && event.key === "Escape")
      event.target.blur();
    const action = !isText && !event.ctrlKey && !event.metaKey && !event.altKey && this.keys()[event.key.toLowerCase()];
    if (!action)
      return;
    action();
    event.preventDefault();
  }

  keys() {
    const { page } = this, { viewer } = page.cloud;
    const step = n => () => page.setPointSize(Number(byId("size").value) + n);
    const result = { escape: () => page.measure.isOn ? page.measure.turn(false) : page.select(null),
                     f: () => page.goToSelection(), r: () => viewer.lookAtAll(),
                     u: () => page.setUnassigned(!page.hasUnassigned), "+": step(2), "=": step(2), "-": step(-2),
                     y: () => viewer.turnUp(), t: () => page.spin(), l: () => page.toggleTheme(),
                     h: () => document.body.classList.toggle("alone"), x: () => page.hideSelection(),
                     i: () => page.isolateSelection(), a: () => page.showAll(),
                     p: () => page.toggleLayer("points"), o: () => page.toggleLayer("outlines"),
                     s: () => page.toggleLayer("surface"), c: () => page.toggleLayer("model"), m: () => page.measure.turn(!page.measure.isOn),
                     "/": () => byId("search").focus(), "?": () => this.toggleHelp() };
    Object.keys(page.modes).forEach((mode, i) => result[i + 1] = () => page.setMode(mode));
    return result;
  }
}
