// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Added to a page of detect_planes --view: takes its WebGL context away and gives it back, and writes what is wrong to
// the console.
const wrong = [];
const check = (isRight, text) => isRight || wrong.push(text);
const message = () => getComputedStyle(byId("message")).display === "none" ? "" : byId("message").textContent;

// The pixels of the canvas after the next frame, if the page has drawn it by itself; else none.
async function drawn(action) {
  const { cloud } = page, afterRender = cloud.afterRender;
  let pixels = new Uint8Array();
  cloud.afterRender = time => {
    const gl = cloud.renderer.getContext();
    pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    afterRender(time);
  };
  await action();
  await frame();
  await frame();
  cloud.afterRender = afterRender;
  return pixels;
}

const frame = () => new Promise(resolve => requestAnimationFrame(() => setTimeout(resolve)));
const event = name => new Promise(resolve => byId("canvas").addEventListener(name, resolve, { once: true }));
const isEqual = (a, b) => a.length > 0 && a.length === b.length && a.every((x, i) => x === b[i]);
const key = name => document.dispatchEvent(new KeyboardEvent("keydown", { key: name }));

function click() {
  const canvas = byId("canvas");
  for (const type of ["pointerdown", "pointerup"])
    canvas.dispatchEvent(new PointerEvent(type, { button: 0, clientX: 0.5 * canvas.clientWidth,
                                                  clientY: 0.6 * canvas.clientHeight }));
}

// What the user does meanwhile is seen when the context has returned, as if it had never been away.
async function lose(name, meanwhile) {
  const extension = page.cloud.renderer.getContext().getExtension("WEBGL_lose_context"), selection = page.selection;
  const isTold = () => check(message().includes("took the graphics"), name + ": the message is '" + message() + "'");
  const lost = event("webglcontextlost");
  extension.loseContext();
  await lost;
  isTold();
  click();
  check(page.selection === selection, name + ": a click selects without a picture");
  meanwhile();
  await frame();
  await frame();
  isTold();
  const back = await drawn(() => (extension.restoreContext(), event("webglcontextrestored")));
  check(!message().includes("graphics"), name + ": the message stays: '" + message() + "'");
  check(new Set(new Uint32Array(back.buffer)).size > 1, name + ": nothing is drawn when the context returns");
  return back;
}

(async () => {
  while (!window.page)
    await frame();
  const before = await drawn(() => page.cloud.requestRender());
  check(isEqual(await lose("nothing done", () => {}), before), "other pixels than before the loss");
  check(isEqual(await lose("again", () => {}), before), "other pixels than before the second loss");

  const other = await lose("other colors", () => (key("l"), key("2"), key("+"), key("y")));
  await drawn(() => (key("l"), key("1"), key("-"), key("y"), key("y")));
  check(!isEqual(other, before), "the changes are not drawn");
  const same = await drawn(() => (key("l"), key("2"), key("+"), key("y")));
  check(isEqual(same, other), "other pixels than with the same changes and no loss");

  click();
  check(page.selection && page.selection.kind === "shape", "a click selects nothing when the context is back");
  await lose("turning", () => key("t"));
  check(message().includes("frames per second"), "it does not turn on");
})().catch(error => wrong.push(String(error.stack)))
    .then(() => console.log("wrong: " + (wrong.join("; ") || "nothing")));
