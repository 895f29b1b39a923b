// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The viewer of a detection. `model` has the shapes and groups; the element `points` has, for each point shown, three
// coordinates of 16 bits in the box and its distance to the plane in 127ths of the tolerance, shape after shape. The
// points without a shape come first. Colors and what is shown depend on a small texture with one texel a shape, so that
// no change touches the points.

'use strict';

(function () {
  const element = id => document.getElementById(id);
  const shapes = model.shapes; // [points, points shown, direction, plane, coefficients, turned, moved, area]
  const none = -1;
  const selection = { shape: none, direction: none, plane: none };
  const texels = shapes.length + 1; // the first one is for points without a shape
  const columns = Math.min(texels, 1024), rows = Math.ceil(texels / columns);

  // ---- colors ----

  function hslToRgb(h, s, l) {
    const f = n => {
      const k = (n + 12 * h) % 12;
      return Math.round(255 * (l - s * Math.min(l, 1 - l) * Math.max(-1, Math.min(k - 3, 9 - k, 1))));
    };
    return [f(0), f(8), f(4)];
  }

  // Steps of the golden ratio keep close numbers apart.
  const colorOf = i => hslToRgb((0.13 + 0.618033988749895 * i) % 1, i % 3 === 1 ? 0.55 : 0.8, i % 2 === 1 ? 0.42 : 0.58);

  // ---- points ----

  function decode() {
    const text = atob(element('points').textContent.trim());
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i)
      bytes[i] = text.charCodeAt(i);
    return bytes;
  }

  function makeGeometry() {
    const bytes = decode(), n = model.shown, place = new Uint16Array(3 * n), distance = new Int8Array(n);
    for (let i = 0; i < n; ++i) {
      const at = 7 * i;
      for (let c = 0; c < 3; ++c)
        place[3 * i + c] = bytes[at + 2 * c] | bytes[at + 2 * c + 1] << 8;
      distance[i] = bytes[at + 6];
    }
    const shape = new Float32Array(n);
    let next = model.unassignedShown;
    shapes.forEach((s, id) => shape.fill(id + 1, next, next += s.shown));
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(place, 3, true));
    geometry.setAttribute('distance', new THREE.BufferAttribute(distance, 1, true));
    geometry.setAttribute('shape', new THREE.BufferAttribute(shape, 1));
    geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(0.5, 0.5, 0.5), 1);
    return geometry;
  }

  // The texel of the shape: its color, and in alpha 0 (hidden), 0.5 (dimmed) or 1.
  const vertexShader = `
    attribute float shape, distance;
    uniform sampler2D look;
    uniform vec2 size;
    uniform float width, mode;
    varying vec3 tint;
    void main() {
      vec2 texel = vec2(mod(shape, size.x), floor(shape / size.x));
      vec4 own = texture2D(look, (texel + 0.5) / size);
      vec3 ramp = distance < 0.0 ? mix(vec3(0.9), vec3(0.1, 0.25, 0.85), -distance)
                                 : mix(vec3(0.9), vec3(0.85, 0.15, 0.1), distance);
      tint = mode == 1.0 && shape > 0.0 ? ramp : own.rgb;
      if (mode == 2.0)
        tint = vec3(mod(shape, 256.0), mod(floor(shape / 256.0), 256.0), floor(shape / 65536.0)) / 255.0;
      else if (own.a < 0.75)
        tint = mix(tint, vec3(0.55), 0.8);
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      gl_PointSize = own.a < 0.25 ? 0.0 : width;
      if (own.a < 0.25)
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    }`;
  const fragmentShader = `
    precision mediump float;
    varying vec3 tint;
    void main() { gl_FragColor = vec4(tint, 1.0); }`;

  const look = new THREE.DataTexture(new Uint8Array(4 * columns * rows), columns, rows, THREE.RGBAFormat);
  const uniforms = {
    look: { value: look }, size: { value: new THREE.Vector2(columns, rows) }, width: { value: 2 }, mode: { value: 0 }
  };

  // ---- what is shown ----

  let renderer, scene, camera, controls, points, pickTarget, isStale = true;

  function isMarked(s, id) {
    if (selection.direction !== none)
      return s.direction === selection.direction;
    if (selection.plane !== none)
      return s.plane === selection.plane;
    return selection.shape === none || id === selection.shape;
  }

  const smallestShown = () => {
    const largest = shapes.length > 0 ? shapes[0].points : 1, share = Number(element('size').value);
    return share === 0 ? 0 : Math.round(Math.exp(share * Math.log(largest)));
  };

  function update() {
    const mode = element('mode').value, minimum = smallestShown(), data = look.image.data;
    const set = (i, color, alpha) => data.set([...color, alpha], 4 * i);
    set(0, [120, 120, 120], element('unassigned').checked ? 255 : 0);
    shapes.forEach((s, id) => {
      const number = mode === 'direction' ? s.direction : mode === 'plane' ? s.plane : id;
      set(id + 1, colorOf(number), s.points < minimum ? 0 : isMarked(s, id) ? 255 : 128);
    });
    look.needsUpdate = true;
    uniforms.mode.value = mode === 'distance' ? 1 : 0;
    uniforms.width.value = Number(element('width').value) * (window.devicePixelRatio || 1);
    element('smallest').textContent = Math.max(minimum, shapes.length > 0 ? shapes[shapes.length - 1].points : 0);
    showLegend(mode);
    showSelected();
    for (const [list, marked] of [['directions', selection.direction], ['planes', selection.plane]])
      for (const item of element(list).children)
        item.classList.toggle('marked', Number(item.dataset.number) === marked);
    isStale = true;
  }

  function showLegend(mode) {
    const legend = element('legend');
    legend.style.display = mode === 'distance' ? 'block' : 'none';
    legend.style.background = 'linear-gradient(to right, #1940d9, #e6e6e6, #d9261a)';
    legend.innerHTML = '<span style="left:0"></span><span style="left:48%">0</span><span style="right:0"></span>';
    legend.children[0].textContent = '−' + model.maximumDistance;
    legend.children[2].textContent = model.maximumDistance;
  }

  // ---- the selected shape ----

  const names = ids => ids.length === 0 ? 'none' : ids.slice(0, 12).join(', ') + (ids.length > 12 ? ', …' : '');
  const others = (key, number, id) => shapes.map((s, i) => i).filter(i => i !== id && shapes[i][key] === number);
  const digits = x => Number(x.toPrecision(4)).toString();

  function showSelected() {
    const box = element('selected');
    box.textContent = '';
    document.documentElement.dataset.selected = selection.shape;
    if (selection.shape === none)
      return;
    const s = shapes[selection.shape], [a, b, c, d] = s.coefficients;
    const right = model.orthogonal.filter(p => p.includes(s.direction)).map(p => p[0] === s.direction ? p[1] : p[0]);
    const rows = [
      ['shape', selection.shape], ['points', s.points.toLocaleString('en')],
      ['plane', `${a} x + ${b} y + ${c} z + ${d} = 0`],
      ['area', digits(s.area)],
      ['turned by', digits(s.turned) + '°'], ['moved by', digits(s.moved)],
      ['direction', s.direction], ['parallel to', names(others('direction', s.direction, selection.shape))],
      ['plane group', s.plane], ['coplanar with', names(others('plane', s.plane, selection.shape))],
      ['orthogonal to', 'directions ' + names(right)]
    ];
    const table = box.appendChild(document.createElement('table'));
    for (const row of rows) {
      const line = table.insertRow();
      row.forEach(text => { line.insertCell().textContent = text; });
    }
  }

  // ---- lists ----

  // Groups of more than one shape come first, then by the number of points; a long list ends early.
  function fillList(id, key) {
    const groups = new Map(), longest = 300;
    for (const s of shapes) {
      const group = groups.get(s[key]) || { number: s[key], shapes: 0, points: 0 };
      ++group.shapes;
      group.points += s.points;
      groups.set(s[key], group);
    }
    const sorted = [...groups.values()].filter(g => key === 'direction' || g.shapes > 1)
      .sort((g, h) => h.points - g.points);
    for (const g of sorted.slice(0, longest)) {
      const item = element(id).appendChild(document.createElement('li'));
      item.dataset.number = g.number;
      item.innerHTML = '<span></span> <small></small>';
      item.firstChild.textContent = `${g.number}: ${g.shapes} shape${g.shapes > 1 ? 's' : ''}`;
      item.lastChild.textContent = `${g.points.toLocaleString('en')} points`;
      item.onclick = () => select(key === 'direction' ? 'direction' : 'plane', g.number);
    }
    if (sorted.length > longest || sorted.length === 0)
      element(id).appendChild(document.createElement('small')).textContent =
        sorted.length === 0 ? 'none of more than one shape' : `and ${sorted.length - longest} more`;
  }

  // Selects a shape, a direction or a plane; the same again selects nothing.
  function select(kind, number) {
    const value = selection[kind] === number ? none : number;
    selection.shape = selection.direction = selection.plane = none;
    selection[kind] = value;
    update();
  }

  // ---- picking ----

  // The shape at a place of the canvas: ids instead of colors are drawn around it, and the nearest counts.
  function shapeAt(x, y) {
    const reach = 4, width = 2 * reach + 1, pixels = new Uint8Array(4 * width * width);
    const canvas = renderer.domElement;
    camera.setViewOffset(canvas.clientWidth, canvas.clientHeight, x - reach, y - reach, width, width);
    const before = [uniforms.mode.value, uniforms.width.value];
    uniforms.mode.value = 2;
    renderer.setRenderTarget(pickTarget);
    renderer.setClearColor(0x000000, 1);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(pickTarget, 0, 0, width, width, pixels);
    renderer.setRenderTarget(null);
    [uniforms.mode.value, uniforms.width.value] = before;
    camera.clearViewOffset();
    let best = { shape: none, distance: Infinity };
    for (let i = 0; i < width * width; ++i) {
      const id = pixels[4 * i] + 256 * pixels[4 * i + 1] + 65536 * pixels[4 * i + 2];
      const dx = i % width - reach, dy = Math.floor(i / width) - reach, distance = dx * dx + dy * dy;
      if (id > 0 && distance < best.distance)
        best = { shape: id - 1, distance };
    }
    isStale = true;
    return best.shape;
  }

  // ---- drawing ----

  function resetView() {
    const size = new THREE.Vector3(...model.size), reach = 0.5 * size.length() || 1;
    camera.position.set(1.2 * reach, -2.1 * reach, 1.3 * reach);
    camera.near = reach / 1000;
    camera.far = reach * 20;
    camera.updateProjectionMatrix();
    controls.target.set(0, 0, 0);
    controls.update();
    isStale = true;
  }

  function resize() {
    const box = element('canvas').getBoundingClientRect();
    renderer.setPixelRatio(window.devicePixelRatio || 1);
    renderer.setSize(box.width, box.height, false);
    camera.aspect = box.width / Math.max(box.height, 1);
    camera.updateProjectionMatrix();
    isStale = true;
  }

  function draw() {
    const back = getComputedStyle(document.body).backgroundColor;
    renderer.setClearColor(new THREE.Color(back), 1);
    renderer.clear();
    renderer.render(scene, camera);
    isStale = false;
  }

  function setUp() {
    renderer = new THREE.WebGLRenderer({ canvas: element('canvas'), preserveDrawingBuffer: true });
    renderer.autoClear = false;
    scene = new THREE.Scene();
    camera = new THREE.PerspectiveCamera(45, 1, 0.1, 100);
    camera.up.set(0, 0, 1);
    controls = new THREE.OrbitControls(camera, renderer.domElement);
    controls.addEventListener('change', () => { isStale = true; });
    const material = new THREE.ShaderMaterial({ uniforms, vertexShader, fragmentShader });
    points = new THREE.Points(makeGeometry(), material);
    points.scale.set(...model.size);
    points.position.set(...model.size.map(x => -x / 2));
    points.frustumCulled = false;
    scene.add(points);
    pickTarget = new THREE.WebGLRenderTarget(9, 9);
  }

  function connect() {
    for (const id of ['mode', 'size', 'width', 'unassigned'])
      element(id).addEventListener('input', update);
    window.addEventListener('resize', resize);
    let start = null; // a click is no drag
    element('canvas').addEventListener('mousedown', e => { start = [e.clientX, e.clientY]; });
    element('canvas').addEventListener('mouseup', e => {
      if (e.button !== 0 || !start || Math.hypot(e.clientX - start[0], e.clientY - start[1]) > 3)
        return;
      const box = element('canvas').getBoundingClientRect(), shape = shapeAt(e.clientX - box.left, e.clientY - box.top);
      select('shape', shape === selection.shape ? none : shape);
    });
    window.addEventListener('keydown', e => {
      if (e.key === 'Escape')
        select('shape', none);
      else if (e.key === 'r' || e.key === 'R')
        resetView();
    });
    window.addEventListener('hashchange', selectByAddress);
  }

  // #shape=3, #direction=0, #plane=2, and #mode=distance
  function selectByAddress() {
    for (const part of location.hash.slice(1).split('&')) {
      const [key, value] = part.split('=');
      if (key === 'mode')
        element('mode').value = value;
      else if (key in selection && Number(value) >= 0 && Number(value) < shapes.length)
        selection[key] = Number(value);
    }
    update();
  }

  function describe() {
    document.title = model.title;
    element('title').textContent = model.title;
    const n = x => x.toLocaleString('en');
    element('counts').textContent = `${n(model.points)} points, ${n(model.assigned)} of them in ${n(shapes.length)} ` +
      `shapes of ${n(model.directions)} directions and ${n(model.planes)} planes.` +
      (model.stride > 1 ? ` One of ${model.stride} points is shown; counts are those of all points.` : '');
  }

  // For those who look at the page from outside: what was drawn.
  function report() {
    const canvas = renderer.domElement, gl = renderer.getContext();
    const pixels = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const colors = new Set();
    for (let i = 0; i < pixels.length; i += 4)
      colors.add(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]);
    const middle = canvas.getBoundingClientRect();
    Object.assign(document.documentElement.dataset,
      { drawn: model.shown, colors: colors.size, picked: shapeAt(middle.width / 2, middle.height / 2) });
  }

  let frames = 0, since = performance.now();
  function loop(now) {
    requestAnimationFrame(loop);
    if (isStale)
      draw();
    ++frames;
    if (now - since > 1000) {
      document.documentElement.dataset.frames = Math.round(1000 * frames / (now - since));
      frames = 0;
      since = now;
    }
  }

  try {
    setUp();
  } catch (error) {
    element('failure').hidden = false;
    element('failure').textContent = 'This page needs WebGL: ' + error.message;
    return;
  }
  describe();
  fillList('directions', 'direction');
  fillList('planes', 'plane');
  connect();
  resize();
  resetView();
  selectByAddress();
  draw();
  report();
  draw();
  requestAnimationFrame(loop);
})();
