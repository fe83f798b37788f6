// Draws bodies (balls, capsules, boxes and polygons) as instances; each geometry is stored once.
'use strict';

// corner.w is the end of a capsule that the corner belongs to, size.w half the length between the ends.
const bodyVertex = `
in vec4 corner; in vec3 normal;
in vec3 centre; in vec4 turn; in vec4 size; in vec4 colour;
uniform mat4 toClip; uniform float shown;
out vec3 at, facing, tint;
vec3 turned(vec3 v) { return v + 2. * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v); }
void main() {
  at = centre + turned(corner.xyz * size.xyz + vec3(0, 0, corner.w * size.w));
  facing = turned(normal);
  tint = colour.rgb;
  gl_Position = colour.a == shown ? toClip * vec4(at, 1) : vec4(2, 2, 2, 1);
}`;
const bodyFragment = `
in vec3 at, facing, tint;
uniform vec3 eye, up; uniform float opacity;
out vec4 pixel;
void main() {
  vec3 way = normalize(eye - at);
  vec3 n = normalize(facing);
  if (dot(n, way) < 0.) n = -n;
  float light = 0.52 + 0.3 * dot(n, way) + 0.2 * dot(n, up);
  float rim = pow(1. - dot(n, way), 3.);
  pixel = vec4(tint * light, opacity < 1. ? min(1., opacity * (1. + 3. * rim)) : 1.);
}`;

// Rings about z, the equator once for each end.
function ball() {
  const rings = parts.length > 5000 ? 6 : 16, sectors = 2 * rings, ringList = [];
  for (let i = 0; i <= rings; ++i) {
    const height = Math.PI * (i / rings - 0.5), end = 2 * i < rings ? -1 : 1;
    if (2 * i === rings) ringList.push([height, -1]);
    ringList.push([height, end]);
  }
  const corner = (ring, sector) => {
    const [height, end] = ringList[ring], around = 2 * Math.PI * sector / sectors;
    const p = [Math.cos(height) * Math.cos(around), Math.cos(height) * Math.sin(around), Math.sin(height)];
    return {corner: [...p, end], normal: p};
  };
  const corners = [];
  for (let i = 0; i + 1 < ringList.length; ++i) {
    for (let j = 0; j < sectors; ++j) {
      const [a, b, c, d] = [corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)];
      corners.push(a, b, c, a, c, d);
    }
  }
  return corners;
}

// Fans of flat polygons; points are lists of three numbers.
function polygons(points, faces) {
  return faces.flatMap(face => {
    const p = face.map(i => points[i]);
    let normal = [0, 0, 0];
    for (let i = 2; i < p.length; ++i) normal = add(normal, cross(sub(p[i - 1], p[0]), sub(p[i], p[0])));
    normal = unit(normal);
    return p.slice(2).flatMap((last, i) => [p[0], p[i + 1], last].map(q => ({corner: [...q, 0], normal})));
  });
}

const cube = () => polygons(
  Array.from({length: 8}, (_, i) => [i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1]),
  [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]);

function facesOf(shape) {
  const points = Array.from({length: shape.points.length / 3}, (_, i) => times(three(shape.points, i), 1 / radius));
  return polygons(points, shape.faces);
}

// A part as an instance of a ball, a cube or its own faces.
function instanceOf({row, index, shape, position, orientation}) {
  const instance = (key, centre, turn, size) => ({row, key, centre: toView(centre), turn, size: size.map(s => s / radius)});
  if (shape.kind === 'sphere') return instance('ball', position, orientation, [shape.radius, shape.radius, shape.radius, 0]);
  if (shape.kind === 'capsule') {
    const way = sub(shape.b, shape.a), middle = times(add(shape.a, shape.b), 0.5);
    return instance('ball', add(position, turned(orientation, middle)), product(orientation, turnFromZ(unit(way))),
      [shape.radius, shape.radius, shape.radius, length(way) / 2]);
  }
  if (shape.lower) {
    const half = times(sub(shape.upper, shape.lower), 0.5);
    return instance('cube', add(position, turned(orientation, times(add(shape.lower, shape.upper), 0.5))), orientation, [...half, 0]);
  }
  return instance(index, position, orientation, [radius, radius, radius, 0]);
}

const instancesOf = parts => Map.groupBy(
  parts.filter(part => part.shape.kind !== 'halfspace').map(instanceOf), instance => instance.key);

let bodyProgram, groups = [];
function loadBodies() {
  bodyProgram = program(bodyVertex, bodyFragment);
  for (const [key, instances] of instancesOf(parts)) {
    const corners = key === 'ball' ? ball() : key === 'cube' ? cube() : facesOf(shapes[key]);
    const of = name => corners.flatMap(c => c[name]), each = name => instances.flatMap(instance => instance[name]);
    const {array, buffers} = vertexArray(bodyProgram, {
      corner: {size: 4, values: of('corner')}, normal: {size: 3, values: of('normal')},
      centre: {size: 3, values: each('centre'), perInstance: true}, turn: {size: 4, values: each('turn'), perInstance: true},
      size: {size: 4, values: each('size'), perInstance: true}, colour: {size: 4, values: [], perInstance: true}});
    groups.push({key, array, buffers, corners: corners.length, instances});
  }
}

// Half-spaces stay where they are.
function moveBodies(poses) {
  const instances = instancesOf(allParts(poses));
  for (const {key, buffers} of groups) {
    for (const name of ['centre', 'turn']) replaceValues(buffers[name], instances.get(key).flatMap(instance => instance[name]));
  }
}

// The last number gives the order of drawing: fixed bodies mostly surround the others.
const drawn = {free: 0, fixed: 1, chosen: 2};

function colourBodies() {
  const [a, b] = state.chosen === null ? [] : [contact.a[state.chosen], contact.b[state.chosen]].map(index => rowOf.get(index));
  const colour = ({row}) => {
    if (row === a) return [...rgbOf(colourOfA), drawn.chosen];
    if (row === b) return [...rgbOf(colourOfB), drawn.chosen];
    return body.motion[row] === 0 ? [...rgbOf(fixedColour), drawn.fixed] : [...rgbOf(colours[kindOf(row)]), drawn.free];
  };
  for (const {buffers, instances} of groups) replaceValues(buffers.colour, instances.flatMap(colour));
}

function drawBodies(shown, opacity) {
  gl.useProgram(bodyProgram);
  setUniforms(bodyProgram, {shown, opacity, eye: camera.eye, up, toClip: camera.toClip});
  for (const {array, corners, instances} of groups) {
    gl.bindVertexArray(array);
    gl.drawArraysInstanced(gl.TRIANGLES, 0, corners, instances.length);
  }
}

function setUniforms(of, values) {
  for (const [name, value] of Object.entries(values)) {
    const place = gl.getUniformLocation(of, name);
    if (value.length === 16) gl.uniformMatrix4fv(place, false, value);
    else if (value.length === 3) gl.uniform3fv(place, value);
    else if (value.length === 2) gl.uniform2fv(place, value);
    else gl.uniform1f(place, value);
  }
}
