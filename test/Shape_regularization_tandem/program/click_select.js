// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Selecting by a click, going there, and the direction that points up.
const { run, square } = require("./view_browser.js");

run(async b => {
  await b.open("unassigned=0&size=8");
  const ceiling = await b.shapeAt(2, 1.5), board = await b.shapeAt(1, 1.7);
  const middle = await b.place([0, 0, 1.5]), away = square([60, 60], 20);
  b.expect(await b.shareOfShape(square(middle, 40), ceiling) > 0.95, "the ceiling is not in the middle");
  b.expect(await b.shareOfBackground(away) > 0.99, "something is drawn beside the room");

  await b.clickAt(middle);
  b.equal(await b.state("page.selection"), { kind: "shape", index: ceiling }, "after a click the selection");
  b.expect((await b.address()).includes("shape=" + ceiling), "the address does not have the selection");
  b.equal(await b.state("byId('selection').querySelector('h2 span').textContent"), "Shape " + ceiling, "the title");
  await b.clickAt([60, 60]);
  b.equal(await b.state("page.selection"), null, "after a click on nothing the selection");

  // The board is behind a wall and has its visible side in the room.
  await b.open("unassigned=0&size=8&shape=" + board);
  const region = square([330, 350], 60);
  b.expect(await b.shareOfShape(region, board) < 0.9, "the board fills the view before anyone goes there");
  await b.click(b.button("go there"));
  const side = await b.state("page.cloud.camera.position.toArray()");
  b.expect(side[1] < 1.7, "the viewer is behind the board: " + side);
  b.expect(await b.shareOfShape(region, board) > 0.95, "the board is not in the middle of the view");
  const [left] = await b.place([-1, 1.7, -0.5]), [right] = await b.place([1, 1.7, -0.5]);
  b.expect(Math.abs(right - left) > 500 && Math.min(left, right) > 0 && Math.max(left, right) < 660,
           "the board does not fill the view: " + left + " " + right);
  b.expect((await b.address()).includes("camera="), "the address does not have the camera");

  // A double click goes there, too: to the ceiling from below.
  await b.open("unassigned=0&size=8");
  await b.tab.mouse.dblclick(...middle);
  await b.settle();
  b.expect((await b.state("page.cloud.camera.position.z")) < 1.5, "the viewer is above the ceiling");
  b.expect(await b.shareOfShape(region, ceiling) > 0.95, "the ceiling is not in front of the viewer");

  // Up: along the normal of the end of the room, which was to the side.
  const end = await b.shapeAt(0, -3);
  await b.open("unassigned=0&size=8&shape=" + end);
  await b.click(b.button("up"));
  b.equal(await b.state("page.cloud.viewer.up.map(Math.round)"), [1, 0, 0], "the direction up");
  const [, low] = await b.place([-3, 0, 0]), [, high] = await b.place([3, 0, 0]);
  b.expect(low > high + 100, "the end of the room is not below: " + low + " " + high);
  b.expect((await b.address()).includes("up=1,0,0"), "the address does not have the direction up");
  await b.press("y");
  b.equal(await b.state("page.cloud.viewer.up"), [0, 0, 1], "after Y the direction up");

  // Keys.
  await b.press("2");
  b.equal(await b.state("page.mode"), "direction", "after 2 the colors");
  await b.press("Escape");
  b.equal(await b.state("page.selection"), null, "after Escape the selection");
  await b.press("r");
  b.expect(await b.shareOfShape(square(middle, 40), ceiling) > 0.95, "after R the ceiling is not in the middle");
});
