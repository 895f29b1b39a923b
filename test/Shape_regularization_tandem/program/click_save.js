// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measuring, the files that are saved, and the link to all of a view.
const { run, square } = require("./view_browser.js");
const fs = require("fs");

async function testMeasure(b) {
  await b.open("unassigned=0&elevation=75&hide=" + await b.shapeAt(2, 1.5));
  await b.click("#measure");
  b.equal(await b.state("page.measure.isOn"), true, "measuring");
  await b.clickAt(await b.place([1.5, -1, -1.5]));
  b.equal(await b.state("page.measure.places.length"), 1, "places after a click");
  await b.clickAt(await b.place([-2, 1, -1.5]));
  const length = await b.state("page.measure.places.map(p => p.point).reduce((p, q) => p.distanceTo(q))");
  b.expect(Math.abs(length - Math.hypot(3.5, 2)) < 0.02, "the length of the line is " + length);
  b.equal(await b.state("page.selection"), null, "a click that measures selects");
  const label = await b.tab.textContent("#label");
  b.expect(Math.abs(Number(label) - length) < 0.002, "the label is " + label);
  const middle = await b.place([-0.25, 0, -1.5]), red = [229 / 255, 67 / 255, 45 / 255];
  b.expect(await b.share(square(middle, 30), red) > 0.01, "no line is drawn");
  b.expect((await b.tab.textContent("#measurement")).includes("Distance" + label), "the panel has another distance");
  await b.press("Escape");
  b.equal(await b.state("[page.measure.isOn, byId('label').hidden]"), [false, true], "after Escape: measuring, no label");
  b.equal(await b.share(square(middle, 30), red), 0, "the share of the line after Escape");
}

async function save(b, button) {
  const [download] = await Promise.all([b.tab.waitForEvent("download"), b.tab.click(button)]);
  return { name: download.suggestedFilename(), bytes: fs.readFileSync(await download.path()) };
}

async function testFiles(b) {
  const picture = await save(b, "#save-picture");
  b.equal(picture.name, "room.png", "the name of the picture");
  b.equal(picture.bytes.slice(1, 4).toString(), "PNG", "its first bytes");
  b.equal([picture.bytes.readUInt32BE(16), picture.bytes.readUInt32BE(20)],
          await b.state("[page.cloud.canvas.width, page.cloud.canvas.height]"), "its size");
  b.expect(picture.bytes.length > 4000, "the picture is empty");
  const table = await save(b, "#save-table"), lines = table.bytes.toString().trim().split("\n");
  b.equal(table.name, "room.csv", "the name of the table");
  b.equal(lines.length, 1 + 6, "its lines: a shape is hidden");
  b.equal(new Set(lines.map(line => line.split(",").length)).size, 1, "the numbers of its columns");
  b.equal(lines[0].split(",").slice(-2), ["parallel_group", "coplanar_group"], "the last names of its columns");
  const row = lines.find(line => line.split(",")[1] === "9600"); // the floor
  b.expect(Math.abs(Number(row.split(",")[8])) < 0.01 && Math.abs(Number(row.split(",")[9]) - 24) < 0.5,
           "the row of the floor: " + row);
}

async function testLink(b) {
  await b.open("elevation=60");
  await b.tab.mouse.move(300, 400);
  await b.tab.mouse.down();
  await b.tab.mouse.move(380, 370, { steps: 4 });
  await b.tab.mouse.up();
  await b.tab.mouse.wheel(0, -200);
  await b.press("3");
  await b.click("#theme");
  await b.clickAt([330, 300]);
  const region = square([330, 350], 200), selection = await b.state("page.selection");
  b.expect(selection !== null, "nothing is selected");
  const camera = await b.state("page.cloud.camera.position.toArray().map(x => x.toFixed(3))");
  const share = await b.shareOfShape(region, selection.index), address = (await b.address()).slice(1);
  b.expect(!address.includes("elevation"), "the address has two cameras: " + address);
  await b.open(address.replace(/theme=[a-z]+&?/, "") + "&theme=dark");
  b.equal(await b.state("page.selection"), selection, "the selection of the link");
  b.equal(await b.state("page.mode"), "plane", "the colors of the link");
  b.equal(await b.state("page.cloud.camera.position.toArray().map(x => x.toFixed(3))"), camera, "the camera");
  const again = await b.shareOfShape(region, selection.index);
  b.expect(share > 0.1 && Math.abs(again - share) < 0.02, "the picture of the link: " + share + ", " + again);
  b.expect(address.includes("theme=dark"), "the address does not have the theme");
}

run(async b => {
  await b.open();
  await testMeasure(b);
  await testFiles(b);
  await testLink(b);
});
