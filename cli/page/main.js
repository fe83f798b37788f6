// Handles mouse and keyboard, and starts the page.
'use strict';

function nearestMark(x, y) {
  let best = null, least = 12;
  for (const mark of marks) {
    const p = onScreen(toView(mark.onA)), distance = Math.hypot(p[0] - x, p[1] - y);
    if (distance < least) { least = distance; best = mark; }
  }
  return best;
}

function moveTarget(dx, dy) {
  const back = backwards(camera), right = unit(cross(up, back)), scale = camera.distance / (0.95 * canvas.clientHeight);
  camera.target = add(camera.target, add(times(right, -dx * scale), times(cross(back, right), dy * scale)));
}

function listen() {
  let way = 0;
  canvas.addEventListener('pointerdown', event => { way = 0; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener('pointermove', event => {
    if (!event.buttons) return;
    const {movementX: dx, movementY: dy} = event;
    way += Math.abs(dx) + Math.abs(dy);
    if (event.shiftKey || event.buttons !== 1) moveTarget(dx, dy);
    else {
      camera.yaw -= 0.006 * dx;
      camera.pitch = Math.max(-1.55, Math.min(1.55, camera.pitch + 0.006 * dy));
    }
    redraw();
  });
  canvas.addEventListener('click', event => {
    const mark = way < 4 ? nearestMark(event.clientX, event.clientY) : null;
    if (mark && state.isLast) choose(mark.contact);
  });
  canvas.addEventListener('contextmenu', event => event.preventDefault());
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    camera.distance = Math.max(1e-5, Math.min(20, camera.distance * Math.exp(0.0012 * event.deltaY)));
    redraw();
  }, {passive: false});
  addEventListener('keydown', event => { if (event.key === 'Escape') choose(null); });
  addEventListener('resize', redraw);
  element('opacity').addEventListener('input', event => { state.opacity = event.target.value / 100; redraw(); });
  for (const name of ['normals', 'hidden']) {
    element(name).addEventListener('change', event => { state[name] = event.target.checked; redraw(); });
  }
}

showScene();
showScale();
showList();
if (gl) {
  loadBodies();
  loadGrid();
  loadMarks();
  loadTrack();
  listen();
  const asked = Number(/^#contact=(\d+)$/.exec(location.hash)?.[1] ?? NaN);
  draw();
  choose(asked < contacts ? asked : null, true);
} else {
  element('heading').textContent = 'This browser has no WebGL 2: the view cannot be drawn. ' + element('heading').textContent;
}
