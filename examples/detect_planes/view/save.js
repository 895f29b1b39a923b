// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that the browser saves: the picture of the canvas, and a table of the shapes that are shown.
function saveFile(name, blob) {
  const link = element("a", { download: name, href: URL.createObjectURL(blob) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const stemOf = scene => nameOfCloud(scene).replace(/(\.[A-Za-z0-9]+)?(\.gz)?$/, "") || "cloud";

// A picture is gone when the task ends that has drawn it.
function savePicture(cloud, scene) {
  cloud.render();
  cloud.canvas.toBlob(blob => saveFile(stemOf(scene) + ".png", blob), "image/png");
}

// As --shapes writes it.
function tableOfShapes(shapes, isShown) {
  const names = shapes.scene.table, lines = [["shape", ...names].join()];
  for (let s = 0; s < shapes.count; ++s)
    if (isShown(s))
      lines.push([s, ...names.map(name => shapes.columns[name][s])].join());
  return lines.join("\n") + "\n";
}

function saveTable(shapes, isShown) {
  saveFile(stemOf(shapes.scene) + ".csv", new Blob([tableOfShapes(shapes, isShown)], { type: "text/csv" }));
}
