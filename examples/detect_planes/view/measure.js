// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances between two places that the user clicks. A click on a shape is a place on its plane.
class Measure {
  constructor(shapes, cloud, clip, panel) {
    Object.assign(this, { shapes, cloud, clip, panel, isOn: false, places: [] });
    const geometry = new THREE.BufferGeometry();
    this.positions = new THREE.BufferAttribute(new Float32Array(6), 3);
    geometry.setAttribute("position", this.positions);
    const options = { color: 0xe5432d, depthTest: false, transparent: true };
    const dots = new THREE.PointsMaterial({ ...options, size: 9, sizeAttenuation: false });
    this.objects = [new THREE.LineSegments(geometry, new THREE.LineBasicMaterial(options)),
                    new THREE.Points(geometry, dots)];
    for (const object of this.objects) {
      object.frustumCulled = false;
      object.renderOrder = 1;
      cloud.overlay.add(object);
    }
    byId("measure").onclick = () => this.turn(!this.isOn);
    this.show();
  }

  turn(isOn) {
    this.isOn = isOn;
    this.places = [];
    byId("measure").setAttribute("aria-pressed", String(isOn));
    byId("canvas").classList.toggle("measuring", isOn);
    this.show();
  }

  click(x, y) {
    const shape = this.cloud.pick(x, y);
    const point = shape < 0 ? null : this.pointAt(shape, this.cloud.viewer.ray(x, y));
    if (!point)
      return;
    if (this.places.length === 2)
      this.places = [];
    this.places.push({ point, shape: shape < this.shapes.count ? shape : null });
    this.show();
  }

  // Where the line of sight meets the plane, or the point closest to it.
  pointAt(shape, ray) {
    if (shape < this.shapes.count) {
      const normal = vector(this.shapes.normal(shape)), slope = normal.dot(ray.direction);
      const height = normal.dot(ray.origin.clone().sub(vector(this.shapes.centroid(shape))));
      if (Math.abs(slope) > 0.02)
        return ray.at(-height / slope, new THREE.Vector3());
    }
    const { positions } = this.cloud.points, point = new THREE.Vector3();
    let best = Infinity, found = null;
    const [first, last] = this.shapes.range(shape);
    for (let i = first; i < last; ++i) {
      point.fromArray(positions, 3 * i);
      const depth = point.clone().sub(ray.origin).dot(ray.direction);
      const distance = ray.distanceToPoint(point) / depth;
      if (depth > 0 && distance < best && this.clip.has(point.toArray())) {
        best = distance;
        found = point.clone();
      }
    }
    return found;
  }

  facts() {
    const [a, b] = this.places, d = b.point.clone().sub(a.point);
    const up = vector(this.cloud.viewer.up).normalize(), height = d.dot(up), text = x => this.panel.length(x);
    const facts = [["Distance", text(d.length())],
                   ["Along x, y, z", d.toArray().map(text).join("  ")],
                   ["Up, level", text(height) + ", " + text(Math.sqrt(Math.max(0, d.lengthSq() - height * height)))]];
    const normal = place => vector(this.shapes.normal(place.shape)), { direction } = this.shapes.columns;
    if (a.shape !== null)
      facts.push(["From shape " + a.shape, text(Math.abs(normal(a).dot(d))) + " along its normal"]);
    if (a.shape !== null && b.shape !== null && a.shape !== b.shape) {
      const angle = Math.acos(Math.min(1, Math.abs(normal(a).dot(normal(b))))) * 180 / Math.PI;
      facts.push(["Planes", direction[a.shape] === direction[b.shape] ? "parallel" : "angle " + degrees(angle)]);
    }
    return facts;
  }

  show() {
    const target = byId("measurement"), n = this.places.length;
    this.objects.forEach((object, i) => object.visible = n > 1 - i);
    for (let i = 0; i < 2 && n > 0; ++i)
      this.positions.set(this.places[Math.min(i, n - 1)].point.toArray(), 3 * i);
    this.positions.needsUpdate = true;
    target.textContent = "";
    const end = element("button", { class: "small", title: "end", onclick: () => this.turn(false) }, "\u00d7");
    const next = n === 0 ? "Click on two places." : "Click on the second place.";
    if (this.isOn)
      target.append(element("h2", {}, element("span", {}, "Measure"), end),
                    n < 2 ? element("p", {}, next) : factList(this.facts()));
    this.cloud.requestRender();
    this.moveLabel();
  }

  // After each picture: the length, in the middle of its line.
  moveLabel() {
    const label = byId("label");
    label.hidden = this.places.length < 2;
    if (label.hidden)
      return;
    const [a, b] = this.places, { clientWidth, clientHeight } = this.cloud.canvas;
    const p = a.point.clone().add(b.point).multiplyScalar(0.5).project(this.cloud.camera);
    label.hidden = p.z > 1;
    label.textContent = this.panel.length(a.point.distanceTo(b.point));
    label.style.left = (p.x + 1) / 2 * clientWidth + "px";
    label.style.top = (1 - p.y) / 2 * clientHeight + "px";
  }
}
