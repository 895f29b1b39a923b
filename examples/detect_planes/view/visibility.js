// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes the user has hidden.
const longestText = 1000; // of an address

class Visibility {
  constructor(count) {
    this.count = count;
    this.hidden = new Set();
  }

  isHidden(shape) { return this.hidden.has(shape); }
  hide(shapes) { shapes.forEach(shape => this.hidden.add(shape)); }
  show(shapes) { shapes.forEach(shape => this.hidden.delete(shape)); }
  showAll() { this.hidden.clear(); }

  toggle(shape) {
    if (!this.hidden.delete(shape))
      this.hidden.add(shape);
  }

  isolate(shapes) {
    const kept = new Set(shapes);
    for (let shape = 0; shape < this.count; ++shape)
      if (!kept.has(shape))
        this.hidden.add(shape);
    this.show(shapes);
  }

  // The words of the address: what is hidden, or what is not, whichever is shorter; null if both are too long.
  toWords() {
    if (this.hidden.size === 0)
      return {};
    const all = Array.from({ length: this.count }, (_, shape) => shape);
    const hide = rangesOf(all.filter(shape => this.hidden.has(shape)));
    const only = rangesOf(all.filter(shape => !this.hidden.has(shape)));
    if (Math.min(hide.length, only.length) > longestText)
      return null;
    return only.length < hide.length ? { only } : { hide };
  }

  fromWords(hide, only) {
    this.hidden = new Set(hide === null ? [] : numbersOf(hide, this.count));
    if (only !== null)
      this.isolate(numbersOf(only, this.count));
  }
}

// Ascending numbers as 1-4,9.
function rangesOf(numbers) {
  const ranges = [];
  for (const n of numbers) {
    const last = ranges[ranges.length - 1];
    if (last && last[1] === n - 1)
      last[1] = n;
    else
      ranges.push([n, n]);
  }
  return ranges.map(([first, last]) => first === last ? first : first + "-" + last).join();
}

function numbersOf(text, count) {
  const numbers = [];
  for (const range of text.split(",").filter(range => /^\d+(-\d+)?$/.test(range))) {
    const [first, last = first] = range.split("-").map(Number);
    for (let n = first; n <= Math.min(last, count - 1); ++n)
      numbers.push(n);
  }
  return numbers;
}
