// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the graphics processor does for points, outlines and triangles: the color and the state of a shape are a texel
// of a table, and what is outside of the clip box or of the slice is not drawn. While picking, colors are indices.
const lookShader = `
  precision highp float;
  uniform mat4 modelViewMatrix, projectionMatrix;
  uniform sampler2D table;
  uniform float tableHeight, noShape;
  uniform vec3 background;
  uniform bool isPicking, hasSelection;

  float row(vec4 mark) { return mark.y + 256.0 * mark.z; }
  bool hasShape(vec4 mark) { return mark.x + 256.0 * row(mark) < noShape; }
  vec4 lookOf(vec4 mark) { return texture2D(table, vec2((mark.x + 0.5) / 256.0, (row(mark) + 0.5) / tableHeight)); }

  vec3 shown(vec3 color, vec4 look, vec4 mark) {
    return isPicking ? mark.xyz / 255.0 : look.a < 0.5 ? mix(background, color, 0.25) : color;
  }

  // What is selected is in front of the rest.
  float depth(vec4 place, vec4 look) {
    return hasSelection ? 0.5 * place.z + (look.a > 0.9 ? -0.5 : 0.5) * place.w : place.z;
  }`;

const clipShader = `
  uniform vec3 clipLow, clipHigh, sliceNormal;
  uniform float sliceOffset, sliceReach;
  bool isClipped(vec3 p) {
    return any(lessThan(p, clipLow)) || any(greaterThan(p, clipHigh)) ||
           abs(dot(sliceNormal, p) - sliceOffset) > sliceReach;
  }`;

const pointShader = lookShader + clipShader + `
  attribute vec3 position;
  attribute vec4 mark;
  attribute vec3 inputColor;
  uniform float worldSize, pixelsPerUnit, smallestSize;
  uniform bool isByDistance, isByInput;
  varying vec3 color;

  vec3 ramp(float t) {
    vec3 end = t < 0.0 ? vec3(0.13, 0.40, 0.85) : vec3(0.86, 0.20, 0.15);
    return mix(vec3(0.86, 0.86, 0.84), end, sqrt(abs(t)));
  }

  void main() {
    vec4 look = lookOf(mark);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    color = vec3(0.0);
    if (look.a < 0.1 || isClipped(position))
      return;
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * seen;
    gl_PointSize = clamp(worldSize * pixelsPerUnit / max(-seen.z, 1e-30), smallestSize, 40.0);
    color = isByInput ? inputColor : isByDistance && hasShape(mark) ? ramp((mark.w - 128.0) / 127.0) : look.rgb;
    color = shown(color, look, mark);
    gl_Position.z = depth(gl_Position, look);
  }`;

const discShader = `
  precision mediump float;
  varying vec3 color;
  void main() {
    vec2 d = gl_PointCoord - 0.5;
    if (dot(d, d) > 0.25)
      discard;
    gl_FragColor = vec4(color, 1.0);
  }`;

const triangleShader = lookShader + `
  attribute vec3 position;
  attribute vec4 mark;
  varying vec3 color, place;
  varying float seen;
  void main() {
    vec4 look = lookOf(mark);
    seen = isPicking ? 1.0 : mark.w / 255.0;
    place = position;
    color = shown(look.rgb, look, mark);
    gl_Position = look.a < 0.1 ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    gl_Position.z = depth(gl_Position, look);
  }`;

// A segment is a rectangle of constant width on the canvas: `position` tells which end, and which side.
const segmentShader = lookShader + `
  attribute vec3 position;
  attribute vec3 first, last;
  attribute vec4 mark;
  uniform vec2 halfWidth;
  uniform float nearest, lineShade;
  uniform vec3 lineColor;
  varying vec3 color, place;
  varying float seen;

  // The end of a segment, or where it comes in front of the viewer.
  vec3 visible(vec3 a, vec3 b) {
    return a.z > -nearest ? mix(a, b, clamp((a.z + nearest) / (a.z - b.z), 0.0, 1.0)) : a;
  }

  void main() {
    vec4 look = lookOf(mark);
    seen = 1.0;
    color = shown(mix(look.rgb, lineColor, lineShade), look, mark);
    place = mix(first, last, position.x);
    vec3 a = (modelViewMatrix * vec4(first, 1.0)).xyz, b = (modelViewMatrix * vec4(last, 1.0)).xyz;
    vec4 from = projectionMatrix * vec4(visible(a, b), 1.0), to = projectionMatrix * vec4(visible(b, a), 1.0);
    vec2 along = (to.xy / to.w - from.xy / from.w) / halfWidth;
    along = length(along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
    gl_Position = position.x < 0.5 ? from : to;
    gl_Position.xy += position.y * vec2(-along.y, along.x) * halfWidth * gl_Position.w;
    gl_Position.z = depth(gl_Position, look) - 2e-4 * gl_Position.w;
    if (look.a < 0.1 || (a.z > -nearest && b.z > -nearest))
      gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }`;

// Grey stripes are as wide as the share without points.
const flatShader = "precision highp float;" + clipShader + `
  varying vec3 color, place;
  varying float seen;
  void main() {
    if (isClipped(place))
      discard;
    bool isStripe = fract((gl_FragCoord.x + gl_FragCoord.y) / 12.0) >= seen;
    gl_FragColor = vec4(isStripe ? vec3(0.5) : color, 1.0);
  }`;
