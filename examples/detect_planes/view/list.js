// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The list of all shapes. Only the rows that can be seen are elements, as there may be many shapes.
const rowHeight = matchMedia("(pointer: coarse)").matches ? 38 : 26; // pixels

class ShapeList {
  // actions: select, goTo, toggle, isHidden, color
  constructor(shapes, actions) {
    Object.assign(this, { shapes, actions, sorting: "points", isDescending: true, selected: new Set() });
    this.window = byId("list");
    this.space = this.window.firstElementChild;
    this.window.style.setProperty("--row", rowHeight + "px");
    this.makeHead();
    this.window.onscroll = () => this.draw();
    new ResizeObserver(() => this.draw()).observe(this.window);
    byId("search").oninput = () => this.find();
    this.window.onkeydown = event => this.step(event);
    this.find();
  }

  value(name, shape) { return name === "shape" ? shape : this.shapes.columns[name][shape]; }

  makeHead() {
    const titles = { shape: "shape", points: "points", area: "area", parallel_group: "dir.",
                     coplanar_group: "plane" };
    this.head = Object.entries(titles).map(([name, title]) =>
      element("button", { id: "sort-" + name, onclick: () => this.sortBy(name) }, title));
    byId("list-head").append(element("span"), ...this.head, element("span"));
  }

  // Again: the other way round. Sizes begin with the largest.
  sortBy(name) {
    this.isDescending = name === this.sorting ? !this.isDescending : name === "points" || name === "area";
    this.sorting = name;
    this.find();
  }

  // What is searched: numbers of shapes that begin so, a direction, a plane, or a least number of points.
  matcher(text) {
    const columns = this.shapes.columns, word = text.trim().toUpperCase();
    const group = /^([DP])(\d+)$/.exec(word), least = /^>\s*(\d+)$/.exec(word);
    if (group)
      return shape => columns[group[1] === "D" ? "parallel_group" : "coplanar_group"][shape] === Number(group[2]);
    if (least)
      return shape => columns.points[shape] > Number(least[1]);
    return shape => String(shape).startsWith(word);
  }

  find() {
    const matches = this.matcher(byId("search").value), sign = this.isDescending ? -1 : 1, name = this.sorting;
    this.order = [];
    for (let shape = 0; shape < this.shapes.count; ++shape)
      if (matches(shape))
        this.order.push(shape);
    this.order.sort((a, b) => sign * (this.value(name, a) - this.value(name, b)) || a - b);
    for (const button of this.head)
      button.dataset.sorted = button.id !== "sort-" + name ? "" : this.isDescending ? "\u2193" : "\u2191";
    this.space.style.height = rowHeight * this.order.length + "px";
    this.window.scrollTop = 0;
    byId("shapes").querySelector("summary").textContent = this.order.length === this.shapes.count
      ? plural(this.shapes.count, "shape") : count(this.order.length) + " of " + plural(this.shapes.count, "shape");
    this.draw();
  }

  draw() {
    const first = Math.floor(this.window.scrollTop / rowHeight);
    const last = first + Math.ceil(this.window.clientHeight / rowHeight) + 1;
    this.space.replaceChildren(...this.order.slice(first, last).map((shape, i) => this.row(shape, first + i)));
  }

  row(shape, place) {
    const { columns } = this.shapes, isHidden = this.actions.isHidden(shape);
    const cell = text => element("span", { class: "number" }, text);
    const row = element("div", { class: "row" + (isHidden ? " hidden" : ""), "data-shape": shape,
                                 "aria-selected": String(this.selected.has(shape)) },
      swatch(this.actions.color(shape)), cell(String(shape)), cell(count(columns.points[shape])),
      cell(rounded(columns.area[shape])), cell("D" + columns.parallel_group[shape]), cell("P" + columns.coplanar_group[shape]),
      element("button", { title: isHidden ? "show" : "hide", onclick: event => {
        event.stopPropagation();
        this.actions.toggle(shape);
      } }, isHidden ? "\u25cb" : "\u25cf"));
    row.style.top = rowHeight * place + "px";
    row.onclick = () => this.actions.select(shape);
    row.ondblclick = () => this.actions.goTo();
    return row;
  }

  // The rows of these shapes are marked, and the first one comes into sight.
  mark(shapes) {
    this.selected = new Set(shapes);
    if (shapes.length === 1)
      this.bringToSight(this.order.indexOf(shapes[0]));
    this.draw();
  }

  bringToSight(place) {
    const top = rowHeight * place, { scrollTop, clientHeight } = this.window;
    if (place >= 0 && (top < scrollTop || top + rowHeight > scrollTop + clientHeight))
      this.window.scrollTop = top - (clientHeight - rowHeight) / 2;
  }

  step(event) {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!by || this.order.length === 0)
      return;
    event.preventDefault();
    const place = this.selected.size === 1 ? this.order.indexOf([...this.selected][0]) + by : 0;
    this.actions.select(this.order[Math.max(0, Math.min(place, this.order.length - 1))]);
  }
}
