// Plays the frames of the run. Contacts are there in the last one alone.
'use strict';

const {track} = data;
const trackPoses = new Float32Array(Uint8Array.from(atob(track.pose), c => c.charCodeAt(0)).buffer);
const lastFrame = track.frame.length - 1;

// The poses of all bodies in the kept frame i.
function posesAt(i) {
  const position = [...body.position], orientation = [...body.orientation];
  track.body.forEach((index, k) => {
    const row = rowOf.get(index), from = 7 * (i * track.body.length + k);
    if (row === undefined) return;
    for (let axis = 0; axis < 3; ++axis) position[3 * row + axis] = trackPoses[from + axis] + track.origin[axis];
    for (let j = 0; j < 4; ++j) orientation[4 * row + j] = trackPoses[from + 3 + j];
  });
  return {...body, position, orientation};
}

function showFrame(i) {
  if (state.chosen !== null) choose(null);
  state.isLast = i === lastFrame;
  moveBodies(state.isLast ? body : posesAt(i));
  element('frame').value = i;
  element('frame_number').textContent = count(track.frame[i]);
  redraw();
}

// Plays in the time of the scene from the frame of the slider; from the first one after the last.
function play() {
  const slider = element('frame');
  const first = Number(slider.value) === lastFrame ? 0 : Number(slider.value), begin = performance.now();
  state.isPlaying = true;
  element('play').textContent = 'Stop';
  const step = now => {
    if (!state.isPlaying) return;
    const seconds = (now - begin) / 1000 + track.frame[first] * track.dt;
    let i = first;
    while (i < lastFrame && track.frame[i + 1] * track.dt <= seconds) ++i;
    showFrame(i);
    if (i === lastFrame) stop();
    else requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

function stop() {
  state.isPlaying = false;
  element('play').textContent = 'Play';
}

function loadTrack() {
  const slider = element('frame');
  element('track').hidden = lastFrame < 1;
  slider.max = lastFrame;
  slider.value = lastFrame;
  element('frame_number').textContent = count(track.frame[lastFrame] ?? 0);
  slider.addEventListener('input', () => { stop(); showFrame(Number(slider.value)); });
  element('play').addEventListener('click', () => { if (state.isPlaying) stop(); else play(); });
}
