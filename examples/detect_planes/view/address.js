// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the address of the page after '#', which is a link to what is seen:
//   #camera=x,y,z,x,y,z  viewer and target, relative to the center     #up=z, y, -y or x,y,z
//   #azimuth=30  #elevation=35  #zoom=1.5                              all shapes, from a side
//   #color=shape, direction, plane, distance, curved or input         #layers=points,outlines,surface,model
//   #theme=dark  #panel=0  #size=4
//   #shape=3  #direction=2  #plane=4                                   what is selected
//   #unassigned=0  #smallest=100  #hide=1-4,9  #only=7                 what is shown
//   #clip=x,y,z,x,y,z  #slice=x,y,z,offset,reach                       see clip.js
//   #spin  #pick=0.5,0.5 (a click there)
//   #check  writes what was drawn to attributes of the page, for tests
// Several are joined by '&'.
class Address {
  constructor(page) {
    this.page = page;
    this.timer = null; // while something is to be written
    window.addEventListener("hashchange", () => this.read());
  }

  static words() { return new URLSearchParams(location.hash.slice(1)); }

  read() {
    const { page } = this, words = Address.words(), { viewer } = page.cloud;
    this.isReading = true;
    const number = (name, otherwise) => Number.isFinite(parseFloat(words.get(name))) ? parseFloat(words.get(name))
                                                                                      : otherwise;
    if (words.has("theme"))
      page.setTheme(page.chosenTheme = words.get("theme") === "dark" ? "dark" : "light");
    if (words.has("panel"))
      document.body.classList.toggle("alone", words.get("panel") === "0");
    page.cloud.resize();
    const up = directionOf(words.get("up"));
    if (up)
      viewer.setUp(up);
    if (["azimuth", "elevation", "zoom"].some(name => words.has(name)))
      viewer.lookAtAll(number("azimuth", 30), number("elevation", 30), number("zoom", 1));
    if (words.has("camera"))
      viewer.fromText(words.get("camera"));
    if (words.has("unassigned"))
      page.setUnassigned(words.get("unassigned") !== "0");
    page.setSmallest(number("smallest", page.smallest));
    page.setPointSize(number("size", 0));
    page.visibility.fromWords(words.get("hide"), words.get("only"));
    page.clip.fromTexts(words.get("clip") || "", words.get("slice") || "");
    if (words.has("layers"))
      page.setLayers(words.get("layers").split(","));
    const kind = ["shape", "direction", "plane"].find(name => words.has(name));
    page.selection = null;
    if (kind)
      page.select({ kind, index: number(kind, -1) });
    page.setMode(words.get("color") in page.modes ? words.get("color") : page.mode);
    this.isReading = false;
    this.act(words);
  }

  act(words) {
    const { page } = this;
    if (words.has("pick")) {
      const [x, y] = words.get("pick").split(",").map(Number), { clientWidth, clientHeight } = byId("canvas");
      page.pick(x * clientWidth, y * clientHeight);
    }
    page.cloud.render();
    if (words.has("spin"))
      page.spin();
    if (words.has("check"))
      describePicture(page);
  }

  // Soon: while the user moves something, there are many changes.
  write() {
    if (this.isReading)
      return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.timer = null;
      this.writeNow();
    }, 150);
  }

  // A browser may refuse to change the address of a file.
  writeNow() {
    const words = Address.words(), { page } = this, values = this.values();
    if (values.camera)
      ["azimuth", "elevation", "zoom"].forEach(name => words.delete(name));
    ["shape", "direction", "plane", "pick"].forEach(name => words.delete(name));
    for (const [name, value] of Object.entries(values))
      if (value === "")
        words.delete(name);
      else
        words.set(name, value);
    if (page.selection)
      words.set(page.selection.kind, page.selection.index);
    try {
      history.replaceState(null, "", "#" + words.toString().replace(/%2C/g, ","));
    } catch (error) {
      // the address is a convenience
    }
  }

  // Empty where that is what a page shows without the word.
  values() {
    const { page } = this, { viewer } = page.cloud, hidden = page.visibility.toWords();
    const layers = page.cloud.layers.shown().join();
    if (!hidden)
      tell("The address of this page does not list the hidden shapes: there are too many.");
    return { camera: viewer.toText(), up: viewer.up.join() === page.firstUp.join() ? "" : textOfDirection(viewer.up),
             color: page.mode === "shape" ? "" : page.mode, layers: layers === "points" ? "" : layers || "none",
             unassigned: page.hasUnassigned ? "" : "0", smallest: page.smallest > 1 ? String(page.smallest) : "",
             size: byId("size").value === "0" ? "" : byId("size").value, theme: page.chosenTheme,
             clip: page.clip.boxText(), slice: page.clip.sliceText(), hide: "", only: "", ...hidden };
  }
}

function directionOf(text) {
  if (text in axes)
    return axes[text];
  const numbers = (text || "").split(",").map(Number);
  return numbers.length === 3 && numbers.every(Number.isFinite) && Math.hypot(...numbers) > 0 ? numbers : null;
}

function textOfDirection(direction) {
  return Object.keys(axes).find(name => axes[name].join() === direction.join()) ||
    direction.map(x => Number(x.toPrecision(8))).join();
}

// Looks at the pixels that were just drawn. Colors of a few pixels are mixed ones, at edges.
function describePicture(page) {
  const { cloud, shapes } = page, gl = cloud.renderer.getContext();
  const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
  const bytes = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  const pixels = new Uint32Array(bytes.buffer);
  const back = new THREE.Color(cloud.uniforms.background.value);
  const isDrawn = i => Math.abs(bytes[4 * i] - 255 * back.r) + Math.abs(bytes[4 * i + 1] - 255 * back.g) > 4;
  const shown = shapes.columns.shown.reduce((sum, n, shape) => sum + (page.isShown(shape) ? n : 0), 0);
  const sizes = new Map();
  pixels.forEach(pixel => sizes.set(pixel, (sizes.get(pixel) || 0) + 1));
  const colors = [...sizes.values()].filter(size => size > pixels.length / 5000).length;
  Object.assign(document.body.dataset, { shown, colors,
                                         drawn: pixels.filter((_, i) => isDrawn(i)).length,
                                         selected: page.selection ? page.selection.kind + page.selection.index
                                                                  : "none" });
}
