// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The box and the slice, outside of which nothing is drawn or picked. Coordinates are relative to the center of the box
// of the shapes; at the ends of its sliders the box has no bound, as points without a shape may be farther out.
const steps = 400, thinnest = 1 / 2000; // of sliders; of the extent
const sliceNames = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

class Clip {
  constructor(scene, cloud, afterChange) {
    Object.assign(this, { scene, cloud, afterChange });
    this.extent = Math.hypot(...scene.extent) || 1;
    this.makeBoxSliders();
    this.makeSliceControls();
    byId("clip-reset").onclick = () => this.reset();
    this.reset();
  }

  reset() {
    this.low = [-far, -far, -far];
    this.high = [far, far, far];
    this.slice = null;
    this.apply();
  }

  isUsed() { return this.slice !== null || [...this.low, ...this.high].some(x => Math.abs(x) < far); }

  has(p) {
    return p.every((x, k) => x >= this.low[k] && x <= this.high[k]) &&
      (!this.slice || Math.abs(dot(this.slice.normal, p) - this.slice.offset) <= this.slice.reach);
  }

  makeBoxSliders() {
    this.sliders = ["x", "y", "z"].map((name, k) => {
      const make = (end, value) => element("input", {
        type: "range", min: 0, max: steps, value, id: "clip-" + name + end,
        "aria-label": (end === "0" ? "smallest " : "largest ") + name,
        oninput: event => this.moveBox(k, end, event.target) });
      const low = make("0", 0), high = make("1", steps), text = element("output");
      byId("clip-box").append(element("div", { class: "pair" }, element("span", {}, name),
                                      element("div", {}, low, high), text));
      return { low, high, text };
    });
  }

  // One end does not pass the other one.
  moveBox(k, end, slider) {
    const { low, high } = this.sliders[k], isLow = end === "0";
    slider.value = isLow ? Math.min(slider.value, high.value - 1) : Math.max(slider.value, Number(low.value) + 1);
    const value = Number(slider.value), place = (value / steps - 0.5) * this.scene.extent[k];
    if (isLow)
      this.low[k] = value === 0 ? -far : place;
    else
      this.high[k] = value === steps ? far : place;
    this.apply();
  }

  makeSliceControls() {
    const buttons = byId("slice-kind");
    const add = (name, title, act) =>
      buttons.append(element("button", { id: "slice-" + name, role: "radio", onclick: act }, title));
    add("none", "none", () => this.setSlice(null));
    for (const [name, normal] of Object.entries(sliceNames))
      add(name, name, () => this.sliceThrough(normal, [0, 0, 0]));
    byId("slice-place").oninput = event => {
      this.slice.offset = (Number(event.target.value) / steps - 0.5) * this.width();
      this.apply();
    };
    byId("slice-reach").oninput = event => {
      this.slice.reach = this.extent / 2 * Math.pow(thinnest, 1 - Number(event.target.value) / steps);
      this.apply();
    };
  }

  // Of the box of the shapes, along the normal of the slice.
  width() { return this.slice.normal.reduce((sum, n, k) => sum + Math.abs(n) * this.scene.extent[k], 0) || 1; }

  sliceThrough(normal, place) {
    this.setSlice({ normal, offset: dot(normal, place), reach: this.slice ? this.slice.reach : this.extent / 60 });
  }

  setSlice(slice) {
    this.slice = slice;
    this.apply();
  }

  apply() {
    const u = this.cloud.uniforms, slice = this.slice;
    u.clipLow.value.set(...this.low);
    u.clipHigh.value.set(...this.high);
    u.sliceNormal.value.set(...(slice ? slice.normal : [0, 0, 0]));
    u.sliceOffset.value = slice ? slice.offset : 0;
    u.sliceReach.value = slice ? slice.reach : far;
    this.show();
    this.cloud.requestRender();
    this.afterChange();
  }

  show() {
    const position = (x, k) => Math.abs(x) >= far ? (x < 0 ? 0 : steps)
                                                   : steps * (x / (this.scene.extent[k] || 1) + 0.5);
    this.sliders.forEach(({ low, high, text }, k) => {
      low.value = position(this.low[k], k);
      high.value = position(this.high[k], k);
      low.parentElement.style.setProperty("--from", 100 * low.value / steps + "%");
      low.parentElement.style.setProperty("--to", 100 * high.value / steps + "%");
      const name = x => Math.abs(x) >= far ? "\u2026" : rounded(x + this.scene.center[k], 5);
      const isAll = this.low[k] <= -far && this.high[k] >= far;
      text.textContent = isAll ? "all" : name(this.low[k]) + " \u2013 " + name(this.high[k]);
    });
    const slice = this.slice;
    const kind = !slice ? "none"
                        : Object.keys(sliceNames).find(name => sliceNames[name].join() === slice.normal.join());
    for (const name of ["none", "x", "y", "z"])
      byId("slice-" + name).setAttribute("aria-checked", String(name === kind));
    byId("slice-values").hidden = !slice;
    byId("clip-state").textContent = this.isUsed() ? "on" : "";
    byId("clip-reset").hidden = !this.isUsed();
    if (!slice)
      return;
    byId("slice-place").value = steps * (slice.offset / this.width() + 0.5);
    byId("slice-reach").value = steps * (1 - Math.log(2 * slice.reach / this.extent) / Math.log(thinnest));
    byId("slice-place-value").textContent = rounded(slice.offset + dot(slice.normal, this.scene.center), 5);
    byId("slice-reach-value").textContent = rounded(2 * slice.reach);
  }

  // Six bounds of the box, empty where there is none; normal, offset and half of the thickness of the slice.
  boxText() {
    const text = [...this.low, ...this.high].map(x => Math.abs(x) >= far ? "" : Number(x.toPrecision(6))).join();
    return text === ",,,,," ? "" : text;
  }

  sliceText() {
    const s = this.slice;
    return s ? [...s.normal, s.offset, s.reach].map(x => Number(x.toPrecision(7))).join() : "";
  }

  fromTexts(box, slice) {
    const bounds = box.split(",");
    const bound = (i, otherwise) => bounds.length === 6 && bounds[i] !== "" && Number.isFinite(Number(bounds[i]))
      ? Number(bounds[i]) : otherwise;
    this.low = [0, 1, 2].map(k => bound(k, -far));
    this.high = [3, 4, 5].map(k => bound(k, far));
    const n = slice.split(",").map(Number);
    this.slice = slice !== "" && n.length === 5 && n.every(Number.isFinite) && n[4] > 0
      ? { normal: n.slice(0, 3), offset: n[3], reach: n[4] } : null;
    this.apply();
  }
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
