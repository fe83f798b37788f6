// The scene as parts and marks, and its view space.
'use strict';

// ------------------------------------------------------------ bodies as parts
const {body, shapes, contact} = data;
const bodies = body.index.length, contacts = contact.a.length;
const rowOf = new Map(body.index.map((index, row) => [index, row]));
const kindOf = row => shapes[body.shape[row]].kind;
const colours = {
  sphere: '#9db8d2', capsule: '#a9c8b4', aabb: '#c9bfa5', box: '#cdb79b', dop: '#b9b3d3', hull: '#c2a9bd',
  mesh: '#b4b9a9', compound: '#a8c3c6', halfspace: '#b3b7bb', triangle: '#c6a9a0',
  cylinder: '#a3bfb9', cone: '#d0b8ae', ellipsoid: '#a7b1d0', rounded_box: '#cdb79b', rounded_hull: '#c2a9bd'};
const fixedColour = '#b3b7bb', colourOfA = '#f0901e', colourOfB = '#2f7fd0';

// The reach of a shape from its own origin.
function reachOf(shape) {
  if (shape.radius !== undefined) return shape.radius + Math.max(length(shape.a ?? [0, 0, 0]), length(shape.b ?? [0, 0, 0]));
  if (shape.lower) return Math.max(length(shape.lower), length(shape.upper));
  if (shape.children) return Math.max(...shape.children.map(c => length(c.position) + reachOf(shapes[c.shape])));
  let reach = 0;
  for (let i = 0; i < (shape.points?.length ?? 0); i += 3) reach = Math.max(reach, length(shape.points.slice(i, i + 3)));
  return reach;
}
const reaches = shapes.map(reachOf);
const reachOfBody = row => reaches[body.shape[row]];

// Every part with its pose: a body, or a child of one. `body` has the poses.
function partsOf(row, body) {
  const place = (index, position, orientation) => {
    const shape = shapes[index];
    if (!shape.children) return [{row, index, shape, position, orientation}];
    return shape.children.flatMap(child => {
      const turn = shapes[child.shape].kind === 'aabb' ? identity : unitQuaternion(child.orientation);
      return place(child.shape, add(position, turned(orientation, child.position)), product(orientation, turn));
    });
  };
  return place(body.shape[row], three(body.position, row), unitQuaternion(body.orientation.slice(4 * row, 4 * row + 4)));
}
const allParts = poses => Array.from({length: bodies}, (_, row) => partsOf(row, poses)).flat();
const parts = allParts(body);

// ------------------------------------------------------------ contacts as marks
const firstPoint = [0];
for (const count of contact.points) firstPoint.push(firstPoint.at(-1) + count);
const depthOf = separation => -(separation ?? -Number.MAX_VALUE);
const positionOfA = i => three(body.position, rowOf.get(contact.a[i]));

// The points of a contact, on A and on B.
function marksOf(i) {
  const normal = three(contact.normal, i);
  return Array.from({length: contact.points[i]}, (_, k) => {
    const at = firstPoint[i] + k, separation = contact.point_separation[at] ?? 0;
    const onA = add(positionOfA(i), three(contact.point, at));
    return {contact: i, normal, depth: depthOf(separation), onA, onB: add(onA, times(normal, separation))};
  });
}
const marks = Array.from({length: contacts}, (_, i) => marksOf(i)).flat();
const byDepth = contact.separation.map((_, i) => i).sort((i, j) => depthOf(contact.separation[j]) - depthOf(contact.separation[i]));
const sortedDepths = marks.map(mark => mark.depth).sort((a, b) => a - b);
const greatestShown = Math.max(sortedDepths[Math.ceil(0.98 * (sortedDepths.length - 1))] ?? 0, 0) || 1;

const ramp = [[255, 224, 60], [247, 140, 32], [214, 32, 40], [92, 10, 120]];
function depthColour(depth) {
  const place = Math.min(1, Math.max(0, depth / greatestShown)) * (ramp.length - 1);
  const i = Math.min(Math.floor(place), ramp.length - 2);
  return ramp[i].map((low, k) => (low + (ramp[i + 1][k] - low) * (place - i)) / 255);
}
const css = rgb => `rgb(${rgb.map(x => Math.round(255 * x)).join(' ')})`;
const rgbOf = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255);

// ------------------------------------------------------------ the space of the view: the scene about 0, of radius 1
function boxAround(points) {
  const lower = [Infinity, Infinity, Infinity], upper = [-Infinity, -Infinity, -Infinity];
  for (const p of points) {
    for (let k = 0; k < 3; ++k) { lower[k] = Math.min(lower[k], p[k]); upper[k] = Math.max(upper[k], p[k]); }
  }
  return lower[0] <= upper[0] ? {middle: times(add(lower, upper), 0.5), radius: length(sub(upper, lower)) / 2} : {middle: [0, 0, 0], radius: 1};
}
const middleOf = part => part.shape.lower
  ? add(part.position, turned(part.orientation, times(add(part.shape.lower, part.shape.upper), 0.5))) : part.position;
const finite = parts.filter(part => part.shape.kind !== 'halfspace');
const origin = boxAround(finite.map(middleOf)).middle;
const radius = finite.reduce((most, part) => Math.max(most, length(sub(part.position, origin)) + reaches[part.index]), 0) || 1;
const toView = p => times(sub(p, origin), 1 / radius);

// The axis direction away from fixed bodies; z if no fixed body is touched.
function upward() {
  let sum = [0, 0, 0];
  for (let i = 0; i < contacts; ++i) {
    const [a, b] = [contact.a[i], contact.b[i]].map(index => body.motion[rowOf.get(index)] === 0);
    if (a !== b) sum = add(sum, times(three(contact.normal, i), a ? 1 : -1));
  }
  const k = [0, 1, 2].reduce((best, axis) => Math.abs(sum[axis]) > Math.abs(sum[best]) ? axis : best, 2);
  return [0, 1, 2].map(axis => axis === k ? (sum[k] < 0 ? -1 : 1) : 0);
}
const up = upward(), east = sideOf(up), south = cross(east, up);
