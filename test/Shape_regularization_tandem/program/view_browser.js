// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of clicks on a page of detect_planes --view share. A test is run as
//   node click_....js PAGE.html
// with NODE_PATH for playwright-core and CHROMIUM for the browser. It ends with 1 after it has said what is wrong.
const { chromium } = require("playwright-core");
const path = require("path");
const file = path.resolve(process.argv[2]);

class Browser {
  constructor(tab) {
    this.tab = tab;
    this.wrong = [];
    tab.on("pageerror", error => this.wrong.push(String(error.stack)));
    tab.on("console", message => message.type() === "error" && this.wrong.push(message.text()));
  }

  async open(address = "", name = file) {
    await this.tab.goto("about:blank");
    await this.tab.goto("file://" + name + "#theme=light&" + address);
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

  // Of the page: an expression, in which `page` is its state.
  state(expression) { return this.tab.evaluate(expression); }
  address() { return this.tab.evaluate(() => location.hash); }
  button(name) { return this.tab.getByRole("button", { name, exact: true }); }

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

  // Where a point of the page's coordinates is on the canvas.
  place(point) {
    return this.tab.evaluate(p => {
      const q = new THREE.Vector3(...p).project(page.cloud.camera), { clientWidth, clientHeight } = page.cloud.canvas;
      return [(q.x + 1) / 2 * clientWidth, (1 - q.y) / 2 * clientHeight];
    }, point);
  }

  // The share of the pixels of a region, [left, top, width, height], that have a color: red, green and blue from 0 to 1.
  // The picture is drawn again, as its pixels are gone after the task.
  share(region, color) {
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

  async shareOfShape(region, shape) {
    return this.share(region, await this.tab.evaluate(s => page.shapes.litColor(page.mode, s), shape));
  }

  async shareOfBackground(region) {
    return this.share(region, await this.tab.evaluate(() => page.cloud.uniforms.background.value.toArray()));
  }

  // The shape of a face of the room: its normal is along the axis, and it is at this height from the center.
  shapeAt(axis, height) {
    return this.tab.evaluate(([axis, height]) => Array.from({ length: page.shapes.count }, (_, s) => s)
      .find(s => Math.abs(page.shapes.normal(s)[axis]) > 0.99 && Math.abs(page.shapes.centroid(s)[axis] - height) < 0.05),
                             [axis, height]);
  }
}

const square = ([x, y], size) => [Math.round(x - size / 2), Math.round(y - size / 2), size, size];

// test(browser) says what is wrong by expect().
async function run(test, options = { viewport: { width: 1000, height: 700 } }) {
  const engine = await chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
  const context = await engine.newContext({ colorScheme: "light", ...options });
  const browser = new Browser(await context.newPage());
  await test(browser).catch(error => browser.wrong.push(String(error.stack)));
  await engine.close();
  for (const text of browser.wrong)
    console.log("wrong: " + text);
  process.exit(browser.wrong.length > 0 ? 1 : 0);
}

module.exports = { run, square, file };
