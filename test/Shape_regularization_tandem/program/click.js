// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clicks, keys and fingers on a page of detect_planes --view, the room of test_browser.py:
//   node click.js PAGE.html select|layers|clip|list|save|link|lost|touch
// with NODE_PATH for playwright-core and CHROMIUM for the browser. It ends with 1 after it has said what is wrong. A
// new function of the page gets a click here, which checks how the state and the pixels of a region change.
const { chromium } = require("playwright-core");
const fs = require("fs");
const file = require("path").resolve(process.argv[2]);

class Browser {
  constructor(tab) {
    this.tab = tab;
    this.wrong = [];
    tab.on("pageerror", error => this.wrong.push(String(error.stack)));
    tab.on("console", message => message.type() === "error" && this.wrong.push(message.text()));
  }

  async open(address = "") {
    await this.tab.goto("about:blank");
    await this.tab.goto("file://" + file + "#theme=light&" + address);
    await this.tab.waitForFunction(() => (window.page && page.address) || document.body.dataset.error);
    await this.settle();
  }

  expect(isRight, text) {
    if (!isRight)
      this.wrong.push(text);
  }

  equal(value, expected, text) {
    this.expect(JSON.stringify(value) === JSON.stringify(expected),
                text + " is " + JSON.stringify(value) + " instead of " + JSON.stringify(expected));
  }

  // An expression of the page, in which `page` is its state.
  state(expression) { return this.tab.evaluate(expression); }
  address() { return this.tab.evaluate(() => location.hash.slice(1)); }
  button(name) { return this.tab.getByRole("button", { name, exact: true }); }
  camera() { return this.state("page.cloud.camera.position.toArray().map(x => Math.round(1000 * x))"); }

  async expectState(expression, value) { this.equal(await this.state(expression), value, expression); }

  async expectAddress(part) {
    this.expect((await this.address()).includes(part), "the address has no " + part + ": " + await this.address());
  }

  // The page writes its address some time after a change, and draws in the next frame.
  async settle() {
    await this.tab.waitForTimeout(40);
    await this.tab.waitForFunction(() => page.address.timer === null && !page.cloud.isRequested);
  }

  async click(where) {
    await (typeof where === "string" ? this.tab.click(where) : where.click());
    await this.settle();
  }

  async clickAt([x, y]) {
    await this.tab.mouse.click(x, y);
    await this.settle();
  }

  async press(key) {
    await this.tab.keyboard.press(key);
    await this.settle();
  }

  async drag(...places) {
    await this.tab.mouse.move(...places[0]);
    await this.tab.mouse.down();
    await this.tab.mouse.move(...places[1], { steps: 5 });
    await this.tab.mouse.up();
    await this.settle();
  }

  // Where a point of the page's coordinates is on the canvas.
  place(point) {
    return this.tab.evaluate(p => {
      const q = new THREE.Vector3(...p).project(page.cloud.camera), { clientWidth, clientHeight } = page.cloud.canvas;
      return [(q.x + 1) / 2 * clientWidth, (1 - q.y) / 2 * clientHeight];
    }, point);
  }

  // The ratio of the pixels of a region, [left, top, width, height], that have a color: red, green, blue from 0 to 1.
  // The picture is drawn again, as its pixels are gone after the task.
  ratio(region, color) {
    return this.tab.evaluate(([[left, top, width, height], color]) => {
      page.cloud.render();
      const gl = page.cloud.renderer.getContext(), bytes = new Uint8Array(4 * width * height);
      gl.readPixels(left, gl.drawingBufferHeight - top - height, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
      let n = 0;
      for (let i = 0; i < bytes.length; i += 4)
        n += color.every((c, k) => Math.abs(255 * c - bytes[i + k]) <= 3) ? 1 : 0;
      return n / (width * height);
    }, [region, color]);
  }

  async ratioOf(region, shape) {
    return this.ratio(region, await (shape === nothing ? this.state("page.cloud.uniforms.background.value.toArray()") :
                                     this.tab.evaluate(s => page.shapes.litColor(page.mode, s), shape)));
  }

  // The ratio of a shape, or of nothing, in a region is from low to high.
  async expectRatio(region, shape, low, high, when) {
    const ratio = await this.ratioOf(region, shape);
    this.expect(ratio >= low && ratio <= high, `${when}: the ratio of ${shape} is ${ratio}`);
  }

  async shows(region, shape, when) { await this.expectRatio(region, shape, 0.95, 1, when); }
  async hides(region, shape, when) { await this.expectRatio(region, shape, 0, 0, when); }

  // The shape of a face of the room: its normal is along the axis, and it is at this height from the center.
  shapeAt(axis, height) {
    return this.tab.evaluate(([axis, height]) => Array.from({ length: page.shapes.count }, (_, s) => s)
      .find(s => Math.abs(page.shapes.normal(s)[axis]) > 0.99 && Math.abs(page.shapes.centroid(s)[axis] - height) < 0.05),
                             [axis, height]);
  }

  rows() { return this.tab.$$eval("#list .row", rows => rows.map(row => Number(row.dataset.shape))); }
}

const nothing = "nothing";
const square = ([x, y], size) => [Math.round(x - size / 2), Math.round(y - size / 2), size, size];
const row = shape => `#list .row[data-shape='${shape}']`;

// The room from above: its ceiling, its floor, and the middle of the picture, where they are.
async function above(b, address = "unassigned=0&size=8&elevation=75") {
  await b.open(address);
  const ceiling = await b.shapeAt(2, 1.5);
  return { ceiling, floor: await b.shapeAt(2, -1.5), selected: { kind: "shape", index: ceiling },
           region: square(await b.place([0, 0, 0]), 40), middle: await b.place([0, 0, 1.5]) };
}

const tests = {
  // Selecting by a click, going there, and the direction that points up.
  async select(b) {
    const { ceiling, selected, middle } = await above(b, "unassigned=0&size=8");
    const start = square(middle, 40), board = await b.shapeAt(1, 1.7), end = await b.shapeAt(0, -3);
    await b.shows(start, ceiling, "at first");
    await b.shows(square([60, 60], 20), nothing, "beside the room");
    await b.clickAt(middle);
    await b.expectState("page.selection", selected);
    await b.expectAddress("shape=" + ceiling);
    await b.expectState("byId('selection').querySelector('h2 span').textContent", "Shape " + ceiling);
    await b.clickAt([60, 60]);
    await b.expectState("page.selection", null);

    // The board is behind a wall and has its visible side in the room.
    await b.open("unassigned=0&size=8&shape=" + board);
    const region = square([330, 350], 60);
    await b.expectRatio(region, board, 0, 0.9, "before anyone goes there");
    await b.click(b.button("go there"));
    b.expect((await b.camera())[1] < 1700, "the viewer is behind the board: " + await b.camera());
    await b.shows(region, board, "after going there");
    const [left] = await b.place([-1, 1.7, -0.5]), [right] = await b.place([1, 1.7, -0.5]);
    b.expect(Math.abs(right - left) > 500 && Math.min(left, right) > 0 && Math.max(left, right) < 660,
             "the board does not fill the view: " + left + " " + right);
    await b.expectAddress("camera=");

    // A double click goes there, too: to the ceiling from below.
    await b.open("unassigned=0&size=8");
    await b.tab.mouse.dblclick(...middle);
    await b.settle();
    b.expect((await b.camera())[2] < 1500, "the viewer is above the ceiling");
    await b.shows(region, ceiling, "after a double click");

    // Up: along the normal of the end of the room, which was to the side.
    await b.open("unassigned=0&size=8&shape=" + end);
    await b.click(b.button("up"));
    await b.expectState("page.cloud.viewer.up.map(Math.round)", [1, 0, 0]);
    const [, low] = await b.place([-3, 0, 0]), [, high] = await b.place([3, 0, 0]);
    b.expect(low > high + 100, "the end of the room is not below: " + low + " " + high);
    await b.expectAddress("up=1,0,0");
    await b.press("y");
    await b.expectState("page.cloud.viewer.up", [0, 0, 1]);
    await b.press("2");
    await b.expectState("page.mode", "direction");
    await b.press("Escape");
    await b.expectState("page.selection", null);
    await b.press("r");
    await b.shows(start, ceiling, "after R");
  },

  // Points, outlines, surface, model, and the colors of the input.
  async layers(b) {
    const { ceiling, selected, middle } = await above(b, "unassigned=0&elevation=60&size=-20");
    const region = square(middle, 60), edge = square(await b.place([3, 0, 1.5]), 24);
    await b.expectRatio(region, ceiling, 0.005, 0.5, "of small points");
    await b.click("#layer-surface");
    await b.expectState("page.cloud.layers.shown()", ["points", "surface"]);
    await b.click("#layer-points");
    await b.expectRatio(region, ceiling, 0.98, 1, "of the surface, which has no gaps");
    await b.clickAt(middle);
    await b.expectState("page.selection", selected);
    await b.press("Escape");
    await b.click("#layer-surface");
    await b.shows(region, nothing, "without layers");
    await b.click("#layer-outlines");
    await b.expectRatio(region, ceiling, 0, 0.05, "inside of its outline");
    await b.expectRatio(edge, nothing, 0.5, 0.95, "beside the outline");
    await b.expectAddress("layers=outlines");
    await b.press("o");
    await b.press("c");
    await b.expectRatio(region, ceiling, 0.98, 1, "of the model");
    await b.clickAt(middle);
    await b.expectState("page.selection", selected);
    await b.press("Escape");
    await b.expectAddress("layers=model");
    await b.press("c");
    await b.press("p");
    await b.expectState("page.cloud.layers.shown()", ["points"]);

    // Colors of the input, of points and as a mean of surfaces.
    await b.click("#color-input");
    const color = [200 / 255, 180 / 255, 80 / 255]; // of the ceiling, in test_browser.py
    b.expect(await b.ratio(region, color) > 0.005, "no point has the color of the input");
    await b.click("#layer-surface");
    await b.click("#layer-points");
    b.expect(await b.ratio(region, color) > 0.98, "the surface does not have the color of the input");
    await b.expectAddress("color=input");
    await b.click("#color-plane");
    b.expect(await b.ratio(region, color) < 0.01, "the colors stay");
    await b.click("#color-curved"); // no wall is
    await b.expectAddress("color=curved");
    b.expect((await b.state("page.shapes.color('curved', 0)")).every(c => c < 0.7), "a wall has the color of a facet");
    await b.click("#color-plane");
  },

  // The box and the slice: the room is looked into, and what is clipped cannot be clicked on.
  async clip(b) {
    const { ceiling, floor, region } = await above(b);
    // The handle of a slider, to a fraction of its length
    const slide = async (id, ratio) => {
      const slider = b.tab.locator(id);
      await slider.scrollIntoViewIfNeeded();
      const box = await slider.boundingBox();
      const value = Number(await slider.inputValue()) / Number(await slider.getAttribute("max"));
      await b.drag(...[value, ratio].map(part => [box.x + 8 + part * (box.width - 16), box.y + box.height / 2]));
    };
    await b.click("#clip summary");
    await slide("#clip-z1", 0.7);
    await b.hides(region, ceiling, "above the box");
    await b.shows(region, floor, "in the box");
    await b.clickAt(await b.place([0, 0, -1.5]));
    await b.expectState("page.selection", { kind: "shape", index: floor });
    await b.press("Escape");
    await b.expectAddress("clip=,,,,,0");
    await slide("#clip-z0", 0.9); // one end stops at the other one
    await b.expectState("page.clip.low[2] < page.clip.high[2]", true);
    await b.shows(region, nothing, "in an empty box");
    await b.click("#clip-reset");
    await b.shows(region, ceiling, "without a box");
    b.expect(!(await b.address()).includes("clip="), "the address still has a box");

    // A slice in the middle has walls only; moved down it has the floor.
    await b.click("#slice-z");
    await b.shows(region, nothing, "in the slice in the middle");
    await slide("#slice-place", 0);
    await b.shows(region, floor, "in the lowest slice");
    await b.expectAddress("slice=0,0,1,-1.5");
    await slide("#slice-reach", 1);
    await b.shows(region, ceiling, "in the thickest slice");
    await b.click("#slice-none");
    await b.expectState("page.clip.slice", null);

    // A slice at a shape, of all layers, and by a link
    await b.click(row(floor));
    await b.click(b.button("slice"));
    await b.hides(region, ceiling, "beyond the slice of the floor");
    await b.press("Escape");
    await b.press("p");
    for (const key of ["s", "o"]) {
      await b.press(key);
      await b.hides(region, ceiling, "with the layer of " + key);
    }
    await b.shows(region, floor, "as a surface");
    await b.press("p");
    await b.open(await b.address());
    await b.hides(region, ceiling, "with the link");
    await b.shows(region, floor, "with the link");
  },

  // The list of shapes, hiding and isolating.
  async list(b) {
    const { ceiling, floor, selected, region } = await above(b);
    b.equal((await b.rows()).length, 7, "rows");
    await b.click("#sort-area");
    await b.click("#sort-area");
    b.equal((await b.rows())[0], await b.shapeAt(1, 1.7), "the row of the smallest area");
    await b.tab.fill("#search", "D" + await b.state(`page.shapes.columns.parallel_group[${ceiling}]`));
    b.equal((await b.rows()).sort(), [ceiling, floor].sort(), "the rows of the direction up");
    // Keys belong to the field that has the focus.
    await b.tab.click("#search");
    await b.tab.keyboard.type("tlh2x");
    await b.expectState("[page.cloud.controls.autoRotate, page.mode, document.body.className]", [false, "shape", ""]);
    b.equal(await b.rows(), [], "rows of what is not there");
    await b.tab.fill("#search", String(ceiling));
    await b.click(row(ceiling));
    await b.expectState("page.selection", selected);
    await b.shows(region, ceiling, "selected");
    await b.tab.fill("#search", "");

    await b.click(b.button("hide"));
    await b.expectState("[...page.visibility.hidden]", [ceiling]);
    await b.hides(region, ceiling, "hidden");
    await b.shows(region, floor, "without the ceiling");
    await b.expectAddress("hide=" + ceiling);
    await b.open(await b.address());
    await b.shows(region, floor, "with the link");
    await b.click("#show-all");
    await b.shows(region, ceiling, "with all");
    await b.click(row(ceiling) + " button");
    await b.hides(region, ceiling, "hidden by the list");
    await b.click(row(ceiling) + " button");
    await b.shows(region, ceiling, "shown by the list");

    await b.click(row(floor));
    await b.click(b.button("isolate"));
    await b.expectState("page.visibility.hidden.size", 6);
    await b.shows(region, floor, "isolated");
    await b.expectAddress("only=" + floor);
    await b.press("a");
    await b.expectState("page.visibility.hidden.size", 0);
  },

  // Measuring, and the files that are saved.
  async save(b) {
    await b.open();
    await b.open("unassigned=0&elevation=75&hide=" + await b.shapeAt(2, 1.5));
    await b.click("#measure");
    await b.expectState("page.measure.isOn", true);
    await b.clickAt(await b.place([1.5, -1, -1.5]));
    await b.expectState("page.measure.places.length", 1);
    await b.clickAt(await b.place([-2, 1, -1.5]));
    const length = await b.state("page.measure.places.map(p => p.point).reduce((p, q) => p.distanceTo(q))");
    const label = await b.tab.textContent("#label");
    b.expect(Math.abs(length - Math.hypot(3.5, 2)) < 0.02 && Math.abs(Number(label) - length) < 0.002,
             `the length of the line is ${length}, its label ${label}`);
    await b.expectState("page.selection", null);
    const line = square(await b.place([-0.25, 0, -1.5]), 30), red = [229 / 255, 67 / 255, 45 / 255];
    b.expect(await b.ratio(line, red) > 0.01, "no line is drawn");
    b.expect((await b.tab.textContent("#measurement")).includes("Distance" + label), "the panel has another distance");
    await b.press("Escape");
    await b.expectState("[page.measure.isOn, byId('label').hidden]", [false, true]);
    b.equal(await b.ratio(line, red), 0, "the ratio of the line after Escape");

    const save = async button => {
      const [download] = await Promise.all([b.tab.waitForEvent("download"), b.tab.click(button)]);
      return [download.suggestedFilename(), fs.readFileSync(await download.path())];
    };
    const [picture, bytes] = await save("#save-picture"), [name, text] = await save("#save-table");
    b.equal([picture, bytes.slice(1, 4).toString(), bytes.length > 4000], ["room.png", "PNG", true], "the picture");
    await b.expectState("[page.cloud.canvas.width, page.cloud.canvas.height]",
                        [bytes.readUInt32BE(16), bytes.readUInt32BE(20)]);
    const lines = text.toString().trim().split("\n").map(line => line.split(","));
    b.equal([name, lines.length], ["room.csv", 1 + 6], "the table, of which a shape is hidden");
    b.equal(new Set(lines.map(line => line.length)).size, 1, "the numbers of its columns");
    b.equal(lines[0].slice(-2), ["parallel_group", "coplanar_group"], "the last names of its columns");
    const floor = lines.find(line => line[1] === "9600");
    b.expect(Math.abs(Number(floor[8])) < 0.01 && Math.abs(Number(floor[9]) - 24) < 0.5, "the floor: " + floor);
  },

  // The link to all of a view.
  async link(b) {
    await b.open("elevation=60");
    await b.drag([300, 400], [380, 370]);
    await b.tab.mouse.wheel(0, -200);
    await b.press("3");
    await b.click("#theme");
    await b.clickAt([330, 300]);
    const region = square([330, 350], 200), selection = await b.state("page.selection"), camera = await b.camera();
    const ratio = await b.ratioOf(region, selection.index), address = await b.address();
    b.expect(!address.includes("elevation"), "the address has two cameras: " + address);
    await b.expectAddress("theme=dark");
    await b.open(address.replace(/theme=[a-z]+&?/, "") + "&theme=dark");
    b.equal([await b.state("page.selection"), await b.state("page.mode"), await b.camera()],
            [selection, "plane", camera], "selection, colors and camera of the link");
    await b.expectRatio(region, selection.index, Math.max(0.1, ratio - 0.02), ratio + 0.02, "with the link");
  },

  // The WebGL context is lost, and returns: what the user does meanwhile is seen then, as if it had never been away.
  async lost(b) {
    const { middle } = await above(b);
    const picture = async () => (await b.tab.locator("#canvas").screenshot()).toString("base64");
    const press = async keys => {
      for (const key of keys)
        await b.tab.keyboard.press(key);
      await b.tab.waitForTimeout(400);
    };
    const isTold = () => b.state("/took the graphics/.test(byId('message').textContent) && " +
                                 "getComputedStyle(byId('message')).display !== 'none'");
    const lose = async keys => {
      await b.state("extension = page.cloud.renderer.getContext().getExtension('WEBGL_lose_context'), " +
                    "extension.loseContext()");
      await press([]);
      b.expect(await isTold(), "the page does not tell that the context is lost");
      await b.tab.mouse.click(...middle);
      await b.expectState("page.selection", null); // there is no picture
      await press(keys);
      b.expect(await isTold(), "the message does not stay");
      await b.state("extension.restoreContext()");
      await press([]);
      b.expect(!await isTold(), "the message stays");
      return picture();
    };
    const before = await picture();
    b.expect(await lose([]) === before && await lose([]) === before, "other pixels than before the loss");
    const changed = await lose("l2+y");
    await above(b);
    await press("l2+y");
    b.expect(changed !== before && await picture() === changed, "other pixels than with the same changes and no loss");
    await lose([]);
    await b.clickAt(middle);
    await b.expectState("page.selection.kind", "shape");
    await b.press("Escape");
    await lose("t");
    b.wrong = b.wrong.filter(text => !text.includes("Framebuffer not complete")); // of the clicks meanwhile
    await b.expectState("/frames per second/.test(byId('message').textContent)", true); // it turns on
  },

  // Fingers on a small screen.
  async touch(b) {
    const { ceiling, selected, middle } = await above(b), client = await b.tab.context().newCDPSession(b.tab);
    const distance = () => b.state("page.cloud.camera.position.length()");
    const touch = async (...steps) => {
      for (const [i, points] of [...steps, []].entries())
        await client.send("Input.dispatchTouchEvent", {
          type: points.length === 0 ? "touchEnd" : i === 0 || points.length > steps[i - 1].length ? "touchStart" : "touchMove",
          touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
      await b.settle();
    };
    // Two fingers that move apart come closer, and select nothing; nor does a tap of two.
    const before = await distance();
    await touch([[150, 200]], ...[0, 1, 2, 3, 4, 5].map(i => [[150 - 8 * i, 200], [240 + 8 * i, 200]]));
    b.expect(await distance() < 0.8 * before, "two fingers do not zoom: " + before + ", " + await distance());
    await touch([[190, 200]], [[190, 200], [198, 200]]);
    await b.expectState("page.selection", null);

    // One that moves turns; one that does not selects.
    const [, y] = await b.camera();
    await touch([[150, 200]], [[180, 200]], [[210, 200]]);
    b.expect(Math.abs((await b.camera())[1] - y) > 100, "a finger does not turn");
    await b.expectState("page.selection", null);
    await b.tab.touchscreen.tap(...middle);
    await b.settle();
    await b.expectState("page.selection", selected);
    await b.shows(square(middle, 30), ceiling, "after a tap");

    // The panel is a drawer; the canvas takes its place.
    const height = await b.state("byId('canvas').clientHeight");
    await b.tab.tap("#drawer");
    await b.settle();
    b.expect(await b.state("byId('canvas').clientHeight") > 1.5 * height, "the drawer does not close");
    const size = await b.tab.locator("#drawer").boundingBox();
    b.expect(size.width >= 32 && size.height >= 32, "buttons are too small for fingers");
    await b.expectState("document.documentElement.scrollWidth", 390);
  },
};

(async name => {
  const engine = await chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
  const screen = name === "touch" ? { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true } :
    { viewport: { width: 1000, height: 700 } };
  const browser = new Browser(await (await engine.newContext({ colorScheme: "light", ...screen })).newPage());
  await tests[name](browser).catch(error => browser.wrong.push(String(error.stack)));
  await engine.close();
  for (const text of browser.wrong)
    console.log("wrong: " + text);
  process.exit(browser.wrong.length > 0 ? 1 : 0);
})(process.argv[3]);
