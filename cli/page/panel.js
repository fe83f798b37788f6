// The panel beside the picture.
'use strict';

const element = id => document.getElementById(id);
const count = n => n.toLocaleString('en-GB');
const plural = (n, one, many = one + 's') => `${count(n)} ${n === 1 ? one : many}`;

function metres(v) {
  if (!(Math.abs(v) < 1e30)) return 'beyond float32';
  if (v === 0) return '0';
  const [, factor, name] = [[1e-6, 1e9, 'nm'], [1e-3, 1e6, 'µm'], [1, 1e3, 'mm'], [1e4, 1, 'm'], [Infinity, 1e-3, 'km']].find(([end]) => Math.abs(v) < end);
  return `${+(v * factor).toPrecision(3)} ${name}`;
}

function node(name, properties, ...children) {
  const result = Object.assign(document.createElement(name), properties);
  result.append(...children);
  return result;
}

const swatch = colour => { const i = document.createElement('i'); i.style.background = colour; return i; };
const bodyName = index => `${kindOf(rowOf.get(index))} ${index}`;

function surfaceText({on, across, left_out}) {
  if (!on.points) return '';
  return `Tried against every face, edge and corner: all points lie within ${metres(on.greatest)} of the surface that they are on, ` +
    `half within ${metres(on.median)}` + (across.points ? `; moved by their depth along the normal, those of manifolds lie within ${metres(across.greatest)} of B.` : '.') +
    (left_out ? ` ${count(left_out)} on large hulls were not tried.` : '');
}

function showScene() {
  element('scene').textContent = data.scene;
  element('counts').textContent = [`frame ${count(data.frame)}`, plural(bodies, 'body', 'bodies'),
    plural(contacts, 'contact'), ...(data.detail === 'manifold' ? [plural(marks.length, 'point')] : [])].join(' · ')
    + (data.left_out ? ` · ${count(data.left_out)} left out (not finite, or of negative size)` : '');
  element('surface').textContent = surfaceText(data.surface);
  const kinds = [...new Set(Array.from({length: bodies}, (_, row) => body.motion[row] === 0 ? 'static' : kindOf(row)))];
  element('kinds').append(...kinds.map(kind => node('span', {}, swatch(colours[kind] ?? fixedColour), kind)));
}

function showScale() {
  if (!contacts) return;
  const bar = swatch(`linear-gradient(to right, ${ramp.map(rgb => `rgb(${rgb.join(' ')})`).join(', ')})`);
  element('scale').append(bar, node('div', {}, node('span', {textContent: 'depth 0'}), node('span', {textContent: metres(greatestShown) + ' and more'})));
}

function showList() {
  const most = 100;
  element('heading').textContent = contacts ? (contacts > most ? `The ${most} deepest contacts` : 'Contacts, deepest first') : 'No contacts in this frame';
  element('list').append(...byDepth.slice(0, most).map(i => node('button', {onclick: () => choose(i), id: 'contact' + i},
    swatch(css(depthColour(depthOf(contact.separation[i])))), node('span', {textContent: `${bodyName(contact.a[i])} – ${bodyName(contact.b[i])}`}),
    metres(depthOf(contact.separation[i])))));
}

function showChosen() {
  for (const button of element('list').children) button.ariaPressed = button.id === 'contact' + state.chosen;
  if (state.chosen === null) { element('chosen').replaceChildren(); return; }
  element('contact' + state.chosen)?.scrollIntoView({block: 'nearest'});
  const i = state.chosen, vector = v => v.map(x => +x.toPrecision(4)).join(', ');
  element('chosen').replaceChildren(node('p', {},
    swatch(colourOfA), `A: ${bodyName(contact.a[i])}`, document.createElement('br'),
    swatch(colourOfB), `B: ${bodyName(contact.b[i])}`, document.createElement('br'),
    `depth ${metres(depthOf(contact.separation[i]))}, ${plural(contact.points[i], 'point')}`, document.createElement('br'),
    `normal (${vector(three(contact.normal, i))})`, document.createElement('br'),
    `point on A (${vector(add(positionOfA(i), three(contact.arm_a, i)))})`, document.createElement('br'),
    node('button', {onclick: () => choose(null), textContent: 'All bodies'})));
}

// Shows a contact with its two bodies, or everything.
function choose(i, instantly = false) {
  if (i !== null && !state.isLast) { stop(); showFrame(lastFrame); }
  state.chosen = i;
  colourBodies();
  colourMarks();
  showChosen();
  history.replaceState(null, '', i === null ? location.pathname + location.search : '#contact=' + i);
  if (i === null) redraw();
  else fly(poseTowards(i), instantly);
}
