// Draws contact points and normals.
'use strict';

// A mark is one quad: a disc about the point, or a spike from it along the normal, in pixels.
const markVertex = `
in vec2 corner; in vec3 point, normal; in vec4 colour; in float onB;
uniform mat4 toClip; uniform vec3 eye; uniform vec2 pixels; uniform float spike, size, reach;
out vec2 place; out vec4 tint; out float hollow;
void main() {
  vec3 shown = mix(point, eye, 0.0015);  // in front of the surfaces that it lies on
  vec4 start = toClip * vec4(shown, 1);
  vec4 end = toClip * vec4(shown + normal * (reach * distance(eye, point)), 1);
  vec2 way = (end.xy / end.w - start.xy / start.w) * pixels;
  way = length(way) > 0. ? normalize(way) : vec2(1, 0);
  vec2 across = vec2(-way.y, way.x);
  vec4 base = spike > 0. && corner.x > 0. ? end : start;
  float width = spike > 0. ? (corner.x > 0. ? 0.2 : 0.42) * size : size;
  vec2 shift = across * corner.y * width + (spike > 0. ? vec2(0) : way * corner.x * width);
  gl_Position = base + vec4(shift / pixels * base.w, 0, 0);
  if (colour.a == 0. || (spike > 0. && onB > 0.)) gl_Position = vec4(2, 2, 2, 1);
  place = corner; tint = colour; hollow = onB;
}`;
const markFragment = `
in vec2 place; in vec4 tint; in float hollow;
uniform float spike, fade;
out vec4 pixel;
void main() {
  float r = length(place);
  if (spike > 0.) { pixel = vec4(tint.rgb * 0.8, tint.a * fade); return; }
  if (r > 1. || (hollow > 0. && r < 0.5)) discard;
  pixel = vec4(tint.rgb * (r > 0.74 ? 0.35 : 1.), tint.a * fade);
}`;

let markProgram, markArray;
function loadMarks() {
  markProgram = program(markVertex, markFragment);
  const sides = marks.flatMap(mark => [{mark, point: mark.onA, onB: 0}, {mark, point: mark.onB, onB: 1}]);
  markArray = vertexArray(markProgram, {
    corner: {size: 2, values: [-1, -1, 1, -1, -1, 1, 1, 1]},
    point: {size: 3, values: sides.flatMap(side => toView(side.point)), perInstance: true},
    normal: {size: 3, values: sides.flatMap(side => side.mark.normal), perInstance: true},
    onB: {size: 1, values: sides.map(side => side.onB), perInstance: true},
    colour: {size: 4, values: [], perInstance: true}});
}

// For the chosen contact the points on B are shown too; the other contacts fade.
function colourMarks() {
  const values = marks.flatMap(mark => {
    const chosen = mark.contact === state.chosen, colour = depthColour(mark.depth);
    return [...colour, state.chosen === null || chosen ? 1 : 0.08, ...colour, chosen ? 1 : 0];
  });
  replaceValues(markArray.buffers.colour, values);
}

function drawMarks(uniforms) {
  gl.useProgram(markProgram);
  gl.bindVertexArray(markArray.array);
  setUniforms(markProgram, {...uniforms, size: uniforms.size * devicePixelRatio, eye: camera.eye, toClip: camera.toClip,
    pixels: [canvas.width / 2, canvas.height / 2]});
  gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, 2 * marks.length);
}

const drawPoints = ({fade, size}) => drawMarks({fade, size, spike: 0, reach: 0.01});
const drawSpikes = ({fade, size, reach}) => drawMarks({fade, size, spike: 1, reach});
