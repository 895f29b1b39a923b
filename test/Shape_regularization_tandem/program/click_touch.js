// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fingers on a small screen.
const { run, square } = require("./view_browser.js");

run(async b => {
  await b.open("unassigned=0&size=8&elevation=75");
  const ceiling = await b.shapeAt(2, 1.5), middle = await b.place([0, 0, 1.5]);
  const touch = (type, points) => b.client.send("Input.dispatchTouchEvent", {
    type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  b.client = await b.tab.context().newCDPSession(b.tab);
  const distance = () => b.state("page.cloud.camera.position.length()");

  // Two fingers that move apart come closer, and select nothing.
  const before = await distance(), share = await b.shareOfShape([0, 60, 390, 340], ceiling);
  await touch("touchStart", [[150, 200]]);
  await touch("touchStart", [[150, 200], [240, 200]]);
  for (let i = 1; i <= 5; ++i)
    await touch("touchMove", [[150 - 8 * i, 200], [240 + 8 * i, 200]]);
  await touch("touchEnd", []);
  await b.settle();
  b.expect(await distance() < 0.8 * before, "two fingers do not zoom: " + before + ", " + await distance());
  b.expect(await b.shareOfShape([0, 60, 390, 340], ceiling) > 1.1 * share, "the room is not larger");
  b.equal(await b.state("page.selection"), null, "after two fingers the selection");

  // Nor does a tap of two.
  await touch("touchStart", [[190, 200]]);
  await touch("touchStart", [[190, 200], [198, 200]]);
  await touch("touchEnd", []);
  await b.settle();
  b.equal(await b.state("page.selection"), null, "after a tap of two fingers the selection");

  // One that moves turns; one that does not selects.
  const y = await b.state("page.cloud.camera.position.y");
  await touch("touchStart", [[150, 200]]);
  await touch("touchMove", [[180, 200]]);
  await touch("touchMove", [[210, 200]]);
  await touch("touchEnd", []);
  await b.settle();
  b.expect(Math.abs(await b.state("page.cloud.camera.position.y") - y) > 0.1, "a finger does not turn");
  b.equal(await b.state("page.selection"), null, "after turning the selection");
  await b.tab.touchscreen.tap(...middle);
  await b.settle();
  b.equal(await b.state("page.selection"), { kind: "shape", index: ceiling }, "after a tap the selection");
  b.expect(await b.shareOfShape(square(middle, 30), ceiling) > 0.95, "the ceiling is not highlighted");

  // The panel is a drawer; the canvas takes its place.
  const height = await b.state("byId('canvas').clientHeight");
  await b.tab.tap("#drawer");
  await b.settle();
  b.expect(await b.state("byId('canvas').clientHeight") > 1.5 * height, "the drawer does not close");
  const size = await b.tab.locator("#drawer").boundingBox();
  b.expect(size.width >= 32 && size.height >= 32, "buttons are too small for fingers");
  b.equal(await b.state("document.documentElement.scrollWidth"), 390, "the width of the page");
}, { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true });
