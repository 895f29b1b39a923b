// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The list of shapes, hiding and isolating, and a page of 50,000 shapes.
const { run, square, file } = require("./view_browser.js");
const fs = require("fs");

const rows = b => b.tab.$$eval("#list .row", rows => rows.map(row => Number(row.dataset.shape)));

async function testRows(b, ceiling, floor, region) {
  b.equal((await rows(b)).length, 7, "rows");
  await b.click("#sort-area");
  await b.click("#sort-area");
  b.equal((await rows(b))[0], await b.shapeAt(1, 1.7), "the row of the smallest area");
  await b.tab.fill("#search", "D" + await b.state(`page.shapes.columns.parallel_group[${ceiling}]`));
  b.equal((await rows(b)).sort(), [ceiling, floor].sort(), "the rows of the direction up");

  // Keys belong to the field that has the focus.
  await b.tab.click("#search");
  await b.tab.keyboard.type("tlh2x");
  b.equal(await b.state("[page.cloud.controls.autoRotate, page.mode, document.body.className]"), [false, "shape", ""],
          "while text is typed: turning, colors, panel");
  b.equal(await rows(b), [], "rows of what is not there");
  await b.tab.fill("#search", String(ceiling));
  await b.click(`#list .row[data-shape='${ceiling}']`);
  b.equal(await b.state("page.selection"), { kind: "shape", index: ceiling }, "a click on a row");
  b.expect(await b.shareOfShape(region, ceiling) > 0.95, "the selected ceiling is not drawn in its color");
  await b.tab.fill("#search", "");
}

async function testHiding(b, ceiling, floor, region) {
  await b.click(b.button("hide"));
  b.equal(await b.state("[...page.visibility.hidden]"), [ceiling], "hidden");
  b.equal(await b.shareOfShape(region, ceiling), 0, "the share of the hidden ceiling");
  b.expect(await b.shareOfShape(region, floor) > 0.95, "the floor is not in the middle");
  b.expect((await b.address()).includes("hide=" + ceiling), "the address does not have what is hidden");
  await b.open((await b.address()).slice(1));
  b.expect(await b.shareOfShape(region, floor) > 0.95, "with the link the floor is not in the middle");
  await b.click("#show-all");
  b.expect(await b.shareOfShape(region, ceiling) > 0.95, "the ceiling does not return");

  await b.click(`#list .row[data-shape='${ceiling}'] button`);
  b.equal(await b.shareOfShape(region, ceiling), 0, "the share of the ceiling that the list hides");
  await b.click(`#list .row[data-shape='${ceiling}'] button`);
  b.expect(await b.shareOfShape(region, ceiling) > 0.95, "the list does not show the ceiling again");

  await b.click(`#list .row[data-shape='${floor}']`);
  await b.click(b.button("isolate"));
  b.equal(await b.state("page.visibility.hidden.size"), 6, "shapes hidden by isolate");
  b.expect(await b.shareOfShape(region, floor) > 0.95, "the isolated floor is not in the middle");
  b.expect((await b.address()).includes("only=" + floor), "the address does not have what is isolated");
  const wall = square(await b.place([0, -2, 1]), 20);
  b.expect(await b.shareOfBackground(wall) > 0.9 || await b.shareOfShape(wall, floor) > 0.9, "a wall is still there");
  await b.press("a");
  b.equal(await b.state("page.visibility.hidden.size"), 0, "shapes hidden after A");
}

// The room with copies of its first shape that have no points to be drawn.
function writeMany(name, total) {
  const page = fs.readFileSync(file, "latin1"), mark = "<script type=\"application/json\" id=\"scene\">";
  const first = page.indexOf(mark) + mark.length, last = page.indexOf("</script>", first);
  const scene = JSON.parse(page.slice(first, last)), s = scene.shapes, old = s.points.length;
  const free = s.shown.pop();
  for (let i = old; i < total; ++i) {
    for (const column of [...scene.table, "outward"])
      s[column].push(s[column][0]);
    s.coefficients.push(...s.coefficients.slice(0, 4));
    s.centroid.push(...s.centroid.slice(0, 3));
    s.points[i] = i % 97 + 1;
    s.shown.push(0);
  }
  s.shown.push(free);
  fs.writeFileSync(name, page.slice(0, first) + JSON.stringify(scene) + page.slice(last), "latin1");
}

async function testMany(b) {
  const name = file.replace(/\.html$/, "_many.html"), total = 50000;
  writeMany(name, total);
  await b.open("", name);
  b.expect((await rows(b)).length < 40, "there are " + (await rows(b)).length + " rows");
  await b.click("#sort-shape");
  await b.click("#sort-shape");
  b.equal((await rows(b))[0], total - 1, "the first row");
  await b.tab.$eval("#list", list => list.scrollTop = list.scrollHeight);
  await b.settle();
  b.equal((await rows(b)).pop(), 0, "the last row");
  const start = Date.now();
  await b.tab.fill("#search", "49999");
  b.equal(await rows(b), [total - 1], "the row that is found");
  b.expect(Date.now() - start < 8000, "to find a row takes " + (Date.now() - start) + " ms");
}

run(async b => {
  await b.open("unassigned=0&size=8&elevation=75");
  const ceiling = await b.shapeAt(2, 1.5), floor = await b.shapeAt(2, -1.5);
  const region = square(await b.place([0, 0, 0]), 40);
  await testRows(b, ceiling, floor, region);
  await testHiding(b, ceiling, floor, region);
  await testMany(b);
});
