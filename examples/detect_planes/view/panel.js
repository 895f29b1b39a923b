// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The panel beside the canvas. Texts are set as text, never as markup: names of files may contain anything.
function element(tag, attributes = {}, ...children) {
  const result = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (name.startsWith("on"))
      result[name] = value;
    else
      result.setAttribute(name, value);
  result.append(...children);
  return result;
}

const byId = id => document.getElementById(id);
const count = n => n.toLocaleString("en");
const plural = (n, word) => count(n) + " " + word + (n === 1 ? "" : "s");
const rounded = (x, digits = 3) => x === null ? "?" : String(Number(x.toPrecision(digits)));
const degrees = x => x === null ? "?" : x.toFixed(2) + "\u00b0";
const letter = { shape: "", direction: "D", plane: "P" };

function swatch(color) {
  const result = element("span", { class: "swatch" });
  result.style.background = cssColor(color);
  return result;
}

// Rows of a name, what it is, and maybe attributes of that.
function factList(facts) {
  const list = element("dl");
  for (const [name, value, attributes] of facts)
    list.append(element("dt", {}, name), element("dd", attributes || {}, value));
  return list;
}

// The bytes of the name are UTF-8, as a rule.
function nameOfCloud(scene) {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(Uint8Array.from(scene.name, c => c.charCodeAt(0)));
  } catch (error) {
    return scene.name;
  }
}

class Panel {
  // select({ kind, index }) is what its chips and rows do; actions: name, title and function of the other buttons
  constructor(shapes, select, actions) {
    this.shapes = shapes;
    this.scene = shapes.scene;
    this.select = select;
    this.actions = actions;
    this.writeHeader();
    this.rows = { direction: new Map(), plane: new Map() };
    this.writeList("direction", "directions");
    this.writeList("plane", "planes");
  }

  // To a thousandth of the largest distance.
  length(x) {
    if (x === null)
      return "?";
    const digits = Math.ceil(3 - Math.log10(this.scene.maximum_distance));
    return x.toFixed(Math.max(0, Math.min(digits, 20)));
  }

  writeHeader() {
    const s = this.scene;
    document.title = "Planes of " + nameOfCloud(s);
    byId("name").textContent = nameOfCloud(s);
    byId("summary").textContent = plural(s.points, "point") + ", " + (100 * s.coverage).toFixed(1) + " % of them in " +
      plural(this.shapes.count, "shape") + ", on " + plural(s.planes, "plane") + " of " +
      plural(s.directions, "direction") + (s.ignored > 0 ? "; " + count(s.ignored) + " ignored" : "");
    if (s.stride > 1)
      byId("thinning").textContent = "1 of every " + s.stride + " points is shown: " + count(s.shown) +
        ". Counts are those of all points.";
  }

  // Groups of several shapes, the largest first.
  writeList(kind, id) {
    const all = [...this.shapes.groups(kind)].sort((a, b) => a.rank - b.rank);
    const groups = all.filter(group => group.members.length > 1);
    const details = byId(id), rows = details.querySelector(".rows");
    details.querySelector("summary").textContent = plural(all.length, kind) + ", " + groups.length + " of several shapes";
    const show = (first, last) => {
      for (const group of groups.slice(first, last))
        rows.append(this.row(kind, group));
      if (last >= groups.length)
        return;
      const more = element("button", { class: "more" }, "show all " + groups.length);
      more.onclick = () => (more.remove(), show(last, groups.length));
      rows.append(more);
    };
    show(0, 40);
  }

  row(kind, group) {
    const orthogonal = kind === "direction" ? this.shapes.orthogonal[group.index].length : 0;
    const row = element("button", { "aria-pressed": "false", title: "highlight" }, swatch(groupColor(group)),
                        letter[kind] + group.index,
                        element("span", { class: "weak" }, plural(group.members.length, "shape") +
                          (orthogonal ? ", \u27c2 " + orthogonal : "")),
                        element("span", { class: "number" }, count(group.points)));
    row.onclick = () => this.select({ kind, index: group.index });
    this.rows[kind].set(group.index, row);
    return row;
  }

  chips(kind, indices, mode) {
    const chips = element("div", { class: "chips" });
    const color = index => kind === "shape" ? this.shapes.color(mode, index) :
      groupColor(this.shapes.groups(kind)[index]);
    const show = (first, last) => {
      for (const index of indices.slice(first, last))
        chips.append(element("button", { onclick: () => this.select({ kind, index }) }, swatch(color(index)),
                             letter[kind] + index));
      if (last >= indices.length)
        return;
      const more = element("button", {}, "+ " + (indices.length - last));
      more.onclick = () => (more.remove(), show(last, indices.length));
      chips.append(more);
    };
    show(0, 24);
    return chips;
  }

  showSelection(selection, mode) {
    for (const rows of Object.values(this.rows))
      rows.forEach(row => row.setAttribute("aria-pressed", "false"));
    const target = byId("selection");
    target.textContent = "";
    if (!selection)
      return;
    const row = selection.kind !== "shape" && this.rows[selection.kind].get(selection.index);
    if (row)
      row.setAttribute("aria-pressed", "true");
    const facts = selection.kind === "shape" ? this.shapeFacts(selection.index, mode)
                                             : this.groupFacts(selection, mode);
    const title = { shape: "Shape ", direction: "Direction D", plane: "Plane P" }[selection.kind] + selection.index;
    const button = ([name, hint, act]) => element("button", { class: "small", title: hint, onclick: act }, name);
    target.append(element("h2", {}, element("span", {}, title),
                          button(["\u00d7", "select nothing (Esc)", () => this.select(null)])),
                  element("div", { class: "actions" }, ...this.actions.map(button)), factList(facts));
  }

  equation(shape) {
    const plane = this.shapes.columns.coefficients.slice(4 * shape, 4 * shape + 4);
    const digits = [6, 6, 6, 4];
    const text = plane.map((c, k) => (c < 0 ? "\u2212 " : k > 0 ? "+ " : "") + Math.abs(c).toFixed(digits[k]) +
      ["\u00a0x ", "\u00a0y ", "\u00a0z ", ""][k]).join("");
    return [text + " = 0", { class: "equation", title: plane.join(" ") }];
  }

  shapeFacts(shape, mode) {
    const c = this.shapes.columns, others = group => group.members.filter(s => s !== shape);
    const direction = this.shapes.groupOf("direction", shape), plane = this.shapes.groupOf("plane", shape);
    const facts = [
      ["Points", count(c.points[shape]) + (this.scene.stride > 1 ? ", shown " + count(c.shown[shape]) : "")],
      ["Plane", ...this.equation(shape)],
      ["Area", "about " + rounded(c.area[shape])],
      ["Class", (c.class[shape] || "?") + (c.curved[shape] > 0.5 ? ", a facet of a curved surface" : "")],
      ["Distance", "of its points: " + this.length(c.mean_distance[shape]) + " on average, at most " +
        this.length(this.scene.maximum_distance)],
      ["Moved", "by " + degrees(c.turned_deg[shape]) + " and " + this.length(c.shifted[shape]) +
        " from the least-squares plane of its points"],
      ["Direction", this.chips("direction", [direction.index])]];
    if (direction.members.length > 1)
      facts.push(["Parallel", this.chips("shape", others(direction), mode)]);
    if (this.shapes.orthogonal[direction.index].length > 0)
      facts.push(["Orthogonal", this.chips("direction", this.shapes.orthogonal[direction.index])]);
    if (plane.members.length > 1)
      facts.push(["Plane", this.chips("plane", [plane.index])],
                 ["Coplanar", this.chips("shape", others(plane), mode)]);
    return facts;
  }

  groupFacts({ kind, index }, mode) {
    const group = this.shapes.groups(kind)[index], shape = group.members[0];
    const facts = [["Points", count(group.points)]];
    if (kind === "plane")
      facts.push(["Plane", ...this.equation(shape)],
                 ["Direction", this.chips("direction", [this.shapes.columns.parallel_group[shape]])]);
    else
      facts.push(["Normal", this.shapes.normal(shape).map(x => x.toFixed(6)).join("  "), { class: "equation" }]);
    facts.push(["Shapes", this.chips("shape", group.members, mode)]);
    if (kind === "direction" && this.shapes.orthogonal[index].length > 0)
      facts.push(["Orthogonal", this.chips("direction", this.shapes.orthogonal[index])]);
    return facts;
  }
}
