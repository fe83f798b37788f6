// The camera.
'use strict';

// The reach of the smaller body of a contact; infinite if neither has one.
const leastReach = i => Math.min(...[contact.a[i], contact.b[i]].map(index => reachOfBody(rowOf.get(index)) / radius).filter(reach => reach > 0));

// A view of all contacts and the smaller body of each.
function firstPose() {
  const around = contacts ? boxAround(marks.map(mark => toView(mark.onA))) : {middle: [0, 0, 0], radius: 1};
  const touching = contact.a.map((_, i) => leastReach(i)).filter(Number.isFinite);
  const size = Math.min(1, around.radius + touching.reduce((a, b) => Math.max(a, b), 0));
  return {target: around.middle, distance: 2.1 * size, yaw: 0.7, pitch: 0.5};
}

const camera = {...firstPose(), eye: null, toClip: null};

// The vector from the target to the eye.
const backwards = ({yaw, pitch}) => add(times(up, Math.sin(pitch)),
  times(add(times(east, Math.cos(yaw)), times(south, Math.sin(yaw))), Math.cos(pitch)));

function aim() {
  const back = backwards(camera), right = unit(cross(up, back)), top = cross(back, right);
  camera.eye = add(camera.target, times(back, camera.distance));
  const near = 0.02 * camera.distance, far = camera.distance + length(camera.target) + 4;
  const zoom = 1.9, flat = zoom * canvas.height / canvas.width;
  const row = (axis, s) => [...times(axis, s), -s * dot(axis, camera.eye)];
  const x = row(right, flat), y = row(top, zoom), w = row(back, -1);
  const z = row(back, -(far + near) / (far - near));
  z[3] -= 2 * far * near / (far - near);
  const aside = document.querySelector('aside').offsetWidth / canvas.clientWidth;
  for (let i = 0; i < 4; ++i) x[i] += (aside < 0.5 ? aside : 0) * w[i];  // in the middle of what the panel leaves free
  camera.toClip = [0, 1, 2, 3].flatMap(i => [x[i], y[i], z[i], w[i]]);
}

function onScreen(p) {
  const m = camera.toClip, clip = k => m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
  const w = clip(3);
  return w > 0 ? [(1 + clip(0) / w) / 2 * canvas.clientWidth, (1 - clip(1) / w) / 2 * canvas.clientHeight] : [Infinity, Infinity];
}

// Flies to a pose of the camera in half a second.
function fly(to, instantly = false) {
  const from = {...camera}, begin = performance.now();
  to.yaw = from.yaw + Math.atan2(Math.sin(to.yaw - from.yaw), Math.cos(to.yaw - from.yaw));
  const step = now => {
    const t = instantly ? 1 : Math.min(1, (now - begin) / 500), s = t * t * (3 - 2 * t);
    for (const name of ['yaw', 'pitch']) camera[name] = from[name] + (to[name] - from[name]) * s;
    camera.distance = from.distance * (to.distance / from.distance) ** s;
    camera.target = add(from.target, times(sub(to.target, from.target), s));
    redraw();
    if (t < 1) requestAnimationFrame(step);
  };
  step(begin);
}

// Looks from the side, so that the normal lies in the picture.
function poseTowards(i) {
  const normal = three(contact.normal, i), points = marks.filter(mark => mark.contact === i).map(mark => toView(mark.onA));
  let back = backwards(camera);
  back = sub(back, times(normal, dot(back, normal)));
  back = unit(length(back) > 0.05 ? back : sideOf(normal));
  if (dot(back, up) < -0.2) back = times(back, -1);
  return {target: boxAround(points).middle, distance: Number.isFinite(leastReach(i)) ? 3.6 * leastReach(i) : camera.distance,
    yaw: Math.atan2(dot(back, south), dot(back, east)), pitch: Math.max(-1.4, Math.min(1.4, Math.asin(dot(back, up))))};
}
