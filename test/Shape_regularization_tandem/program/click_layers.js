// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points, outlines, surface, and the colors of the input.
const { run, square } = require("./view_browser.js");

run(async b => {
  await b.open("unassigned=0&elevation=60&size=-20");
  const ceiling = await b.shapeAt(2, 1.5), middle = await b.place([0, 0, 1.5]), region = square(middle, 60);
  const some = await b.shareOfShape(region, ceiling);
  b.expect(some > 0.005 && some < 0.5, "small points cover " + some);

  // The surface has no gaps.
  await b.click("#layer-surface");
  b.equal(await b.state("page.cloud.layers.shown()"), ["points", "surface"], "the layers");
  b.expect(await b.shareOfShape(region, ceiling) > 0.98, "the surface has gaps");
  await b.click("#layer-points");
  b.expect(await b.shareOfShape(region, ceiling) > 0.98, "the surface has gaps without points");
  await b.clickAt(middle);
  b.equal(await b.state("page.selection"), { kind: "shape", index: ceiling }, "a click on the surface");
  await b.press("Escape");

  // Outlines are at the edges of the ceiling, and not inside.
  await b.click("#layer-surface");
  b.expect(await b.shareOfBackground(region) > 0.99, "without layers something is drawn");
  await b.click("#layer-outlines");
  b.expect(await b.shareOfShape(region, ceiling) < 0.05, "the outline fills the ceiling");
  const edge = square(await b.place([3, 0, 1.5]), 24), clear = await b.shareOfBackground(edge);
  b.expect(clear > 0.5 && clear < 0.95, "at an edge there is no line: " + clear);
  b.expect((await b.address()).includes("layers=outlines"), "the address does not have the layers");
  await b.press("o");
  b.equal(await b.state("page.cloud.layers.shown()"), [], "the layers after O");
  await b.press("p");
  b.equal(await b.state("page.cloud.layers.shown()"), ["points"], "the layers after P");

  // Colors of the input, of points and as a mean of surfaces.
  await b.click("#color-input");
  const color = [200 / 255, 180 / 255, 80 / 255]; // of the ceiling, in test_browser.py
  b.expect(await b.share(region, color) > 0.005, "no point has the color of the input");
  await b.click("#layer-surface");
  await b.click("#layer-points");
  b.expect(await b.share(region, color) > 0.98, "the surface does not have the color of the input");
  b.expect((await b.address()).includes("color=input"), "the address does not have the colors");
  await b.click("#color-plane");
  b.expect(await b.share(region, color) < 0.01, "the colors stay");
});
