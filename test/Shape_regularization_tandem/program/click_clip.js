// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The box and the slice: the room is looked into, and what is clipped cannot be clicked on.
const { run, square } = require("./view_browser.js");

// Drags the handle of a slider to a share of its length.
async function drag(b, id, share) {
  const slider = b.tab.locator(id);
  await slider.scrollIntoViewIfNeeded();
  const box = await slider.boundingBox();
  const value = Number(await slider.inputValue()) / Number(await slider.getAttribute("max"));
  const at = part => [box.x + 8 + part * (box.width - 16), box.y + box.height / 2];
  await b.tab.mouse.move(...at(value));
  await b.tab.mouse.down();
  await b.tab.mouse.move(...at(share), { steps: 5 });
  await b.tab.mouse.up();
  await b.settle();
}

run(async b => {
  await b.open("unassigned=0&size=8&elevation=75");
  const ceiling = await b.shapeAt(2, 1.5), floor = await b.shapeAt(2, -1.5);
  const region = square(await b.place([0, 0, 0]), 40);
  b.expect(await b.shareOfShape(region, ceiling) > 0.95, "the ceiling is not in the middle");
  await b.click("#clip summary");

  // The box without the ceiling.
  await drag(b, "#clip-z1", 0.7);
  const high = await b.state("page.clip.high[2]");
  b.expect(high > 0.3 && high < 0.9, "the upper bound is " + high);
  b.equal(await b.shareOfShape(region, ceiling), 0, "with the box the share of the ceiling");
  b.expect(await b.shareOfShape(region, floor) > 0.95, "with the box the floor is not in the middle");
  await b.clickAt(await b.place([0, 0, -1.5]));
  b.equal(await b.state("page.selection"), { kind: "shape", index: floor }, "a click into the room");
  await b.press("Escape");
  b.expect(/clip=,,,,,0/.test(await b.address()), "the address does not have the box: " + await b.address());

  // One end stops at the other one.
  await drag(b, "#clip-z0", 0.9);
  b.expect(await b.state("page.clip.low[2] < page.clip.high[2]"), "the ends of the box have passed each other");
  b.expect(await b.shareOfBackground(region) > 0.95, "something is drawn in an empty box");
  await b.click("#clip-reset");
  b.expect(await b.shareOfShape(region, ceiling) > 0.95, "without a box the ceiling is not in the middle");
  b.expect(!(await b.address()).includes("clip="), "the address still has a box");

  // A slice in the middle has walls only; moved down it has the floor.
  await b.click("#slice-z");
  b.expect(await b.shareOfBackground(region) > 0.95, "the slice is not empty in the middle");
  await drag(b, "#slice-place", 0);
  b.expect(await b.shareOfShape(region, floor) > 0.95, "the lowest slice has no floor");
  b.expect((await b.address()).includes("slice=0,0,1,-1.5"), "the address does not have the slice");
  await drag(b, "#slice-reach", 1);
  b.expect(await b.shareOfShape(region, ceiling) > 0.95, "the thickest slice has no ceiling");
  await b.click("#slice-none");
  b.equal(await b.state("page.clip.slice"), null, "without a slice");

  // A slice at a shape.
  await b.click("#list .row[data-shape='" + floor + "']");
  await b.click(b.button("slice"));
  b.equal(await b.shareOfShape(region, ceiling), 0, "with the slice of the floor the share of the ceiling");
  b.expect(await b.shareOfShape(region, floor) > 0.95, "the slice of the floor has no floor");

  // All layers are clipped.
  await b.press("Escape");
  await b.press("p");
  for (const key of ["s", "o"]) {
    await b.press(key);
    b.equal(await b.shareOfShape(region, ceiling), 0, "with the layer of " + key + " the share of the ceiling");
  }
  b.expect(await b.shareOfShape(region, floor) > 0.95, "the floor has no surface");
  await b.press("p");

  // The link.
  const address = (await b.address()).slice(1);
  await b.open(address);
  b.equal(await b.shareOfShape(region, ceiling), 0, "with the link the share of the ceiling");
  b.expect(await b.shareOfShape(region, floor) > 0.95, "with the link there is no floor");
});
