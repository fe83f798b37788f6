// Draws the picture in its order.
'use strict';

const state = {chosen: null, opacity: 1, normals: true, hidden: true, isLast: true, isPlaying: false};

function drawSolid(part) {
  gl.disable(gl.BLEND);
  gl.depthMask(true);
  drawBodies(part, 1);
}

// Does not write depth, so that the order matters little.
function drawGhosts(part, opacity) {
  gl.enable(gl.BLEND);
  gl.depthMask(false);
  drawBodies(part, opacity);
}

function clear() {
  const [width, height] = [innerWidth, innerHeight].map(x => Math.round(x * devicePixelRatio));
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
  gl.viewport(0, 0, width, height);
  gl.depthMask(true);
  gl.depthFunc(gl.LEQUAL);
  gl.clearColor(0.945, 0.953, 0.96, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
}

function drawEverything() {
  if (state.opacity === 1) drawSolid(drawn.free);
  else drawGhosts(drawn.free, state.opacity);
  drawGhosts(drawn.fixed, 0.13 * state.opacity);
  drawGrid();
  if (!state.isLast) return;
  if (state.hidden) {
    gl.depthFunc(gl.GREATER);
    drawPoints({fade: 0.25, size: 2});
    gl.depthFunc(gl.LEQUAL);
  }
  const size = marks.length > 1000 ? 3 : 5;
  if (state.normals) drawSpikes({fade: 1, size, reach: 0.02});
  drawPoints({fade: 1, size});
}

function drawChosen() {
  drawGhosts(drawn.free, 0.05 * state.opacity);
  drawGhosts(drawn.fixed, 0.05 * state.opacity);
  drawGhosts(drawn.chosen, 0.5);
  drawGrid();
  if (state.normals) drawSpikes({fade: 1, size: 6, reach: 0.06});
  drawPoints({fade: 1, size: 6});
}

function draw() {
  clear();
  aim();
  if (state.chosen === null) drawEverything();
  else drawChosen();
}

let isQueued = false;
function redraw() {
  if (isQueued) return;
  isQueued = true;
  requestAnimationFrame(() => { isQueued = false; draw(); });
}
