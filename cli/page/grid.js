// Draws half-spaces as grids.
'use strict';

const gridVertex = 'in vec3 point; uniform mat4 toClip; void main() { gl_Position = toClip * vec4(point, 1); }';
const gridFragment = 'out vec4 pixel; void main() { pixel = vec4(0.5, 0.53, 0.56, 0.35); }';

function gridOf({shape, position, orientation}) {
  const size = length(shape.normal), normal = turned(orientation, times(shape.normal, 1 / size));
  const height = dot(normal, sub(origin, position)) - shape.offset / size;
  const middle = times(normal, -height / radius), u = sideOf(normal), v = cross(normal, u), points = [];
  for (let i = -10; i <= 10; ++i) {
    for (const [along, across] of [[u, v], [v, u]]) {
      for (const end of [-1.5, 1.5]) points.push(...add(middle, add(times(along, 0.15 * i), times(across, end))));
    }
  }
  return points;
}

let gridProgram, grid;
function loadGrid() {
  const points = parts.filter(part => part.shape.kind === 'halfspace').flatMap(gridOf);
  gridProgram = program(gridVertex, gridFragment);
  grid = {...vertexArray(gridProgram, {point: {size: 3, values: points}}), count: points.length / 3};
}

function drawGrid() {
  gl.useProgram(gridProgram);
  setUniforms(gridProgram, {toClip: camera.toClip});
  gl.bindVertexArray(grid.array);
  gl.drawArrays(gl.LINES, 0, grid.count);
}
