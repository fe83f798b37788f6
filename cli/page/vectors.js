// Vectors of three numbers and quaternions x, y, z, w, as lists.
'use strict';

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = a => Math.hypot(...a);
const unit = a => times(a, 1 / (length(a) || 1));
const three = (column, i) => column.slice(3 * i, 3 * i + 3);
const identity = [0, 0, 0, 1];

function turned(q, v) {
  const t = times(cross(q, v), 2);
  return add(add(v, times(t, q[3])), cross(q, t));
}

const unitQuaternion = q => { const size = Math.hypot(...q) || 1; return q.map(x => x / size); };

const product = (q, p) => [
  ...add(add(times(p, q[3]), times(q, p[3])), cross(q, p)), q[3] * p[3] - dot(q, p)];

// The rotation that turns z to the unit vector v.
const turnFromZ = v => v[2] < -0.999999 ? [1, 0, 0, 0] : unitQuaternion([-v[1], v[0], 0, 1 + v[2]]);

// A vector perpendicular to the unit vector v.
const sideOf = v => unit(cross(v, Math.abs(v[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0]));
