// Tools, panels and commands. The server alone decides what the mesh is: the page sends what is
// wanted and shows what comes.

import {LEGENDS} from './gl.js';
import {Mesh} from './mesh.js';
import {Plane} from './plane.js';
import {Space} from './space.js';
import {Wire} from './wire.js';

const $ = (id) => document.getElementById(id);
const scene = $('scene'), marks = $('marks');

const settings = {mode: 'region', changes: true, all: false, poor: false, below: 21, forced: false,
  slivers: false, cut: null, only_marked: false,
  // Bits: 1 poor, 2 above the bound, or a sliver.
  judge(mesh, s) {
    if (!mesh.is_kept(s)) return 0;
    return (settings.poor && mesh.angle[s] < settings.below ? 1 : 0) |
      ((settings.forced && mesh.is_forced(s)) || (settings.slivers && mesh.angle[s] < 5) ? 2 : 0);
  }};

let mesh = null, view = null, state = null, seeds = [];
let limits = {everywhere: null, boxes: []};  // of size: the last box that has a place counts there
let tool = 'move', draft = [], hover = null, selected = null;
let problems = [];  // errors: {text, places, features, times}
let told = null;    // the one of them whose text and features are shown
// {what: is dragged, key: how it is told where, wanted, sent, tag, tags: all of them, problem: what
// was refused on the way}
let drag = null, last_drag = null;
let gesture = null; // what the pointer does
let frame_wanted = false, marks_stale = true, panel_stale = true;
const sent = new Map();  // tag -> when
const speed = {updates: 0, frames: 0, engine: [], trip: [], paint: [], decode: []};

const is_space = () => mesh && mesh.dimension === 3;
const shown = (x, digits = 3) => Number(x.toPrecision(digits)).toString();
const text_of = (p) => '(' + p.map((x) => Number(x.toPrecision(8))).join(', ') + ')';

// --- Tools ---------------------------------------------------------------------------------------

const TOOLS = {
  move: ['Move', 'Drag a point, or the line or polygon that a click has selected; elsewhere, the view'],
  point: ['Point', 'Click: a new point'],
  segment: ['Segment', 'Click its two ends; near a point it takes that'],
  polyline: ['Polyline', 'Click its points; Enter or a double click ends, Escape drops it'],
  polygon: ['Polygon', 'Click its corners; Enter or a double click closes it'],
  hole: ['Hole', 'Click where nothing is to be meshed'],
  region: ['Region', 'Click into a region: it gets the attribute at the right'],
  limit: ['Limit', 'Drag a box: the limit of size at the right holds there'],
  delete: ['Delete', 'Click a point, line, hole or region; lines go with their points'],
};
const ACTIONS = {
  undo: ['Undo', () => command({do: 'undo'})],
  redo: ['Redo', () => command({do: 'redo'})],
  whole: ['All', () => { view.show_all(); wake(); }],
};

function make_tools() {
  for (const [name, [label, hint]] of Object.entries(TOOLS)) {
    const button = document.createElement('button');
    button.textContent = label;
    button.title = hint;
    button.id = 'tool_' + name;
    button.onclick = () => choose(name);
    $('tools').append(button);
  }
  $('tools').append(document.createElement('hr'));
  for (const [name, [label, act]] of Object.entries(ACTIONS)) {
    const button = document.createElement('button');
    button.textContent = label;
    button.id = name;
    button.onclick = act;
    $('tools').append(button);
  }
}

function choose(name) {
  tool = name;
  draft = [];
  for (const key of Object.keys(TOOLS)) $('tool_' + key).classList.toggle('chosen', key === name);
  scene.style.cursor = name === 'move' ? 'default' : 'crosshair';
  $('hint').textContent = TOOLS[name][1];
  wake(true);
}

// --- The server ----------------------------------------------------------------------------------

const wire = new Wire(receive, show_lost);
let run = null;       // of the server: another one after it was started again
let lost_at = null;   // how many updates there were when the server was gone

function command(what) {
  const tag = wire.send(what);
  if (tag) sent.set(tag, performance.now());
  return tag;
}

function show_lost(lost) {
  $('lost').hidden = !lost;
  if (!lost) return;
  show_under_way(null);
  if (lost_at === null && state) lost_at = state.updates;
  $('back').hidden = true;
  const next = `looking for it again in ${shown(lost.wait / 1000)} s`;
  $('lost_text').textContent = lost.refused
    ? `The server has another address now, which it has printed; ${next}`
    : `The server does not answer; ${next}`;
}
$('try_now').onclick = () => wire.try_now();

// An update that takes long; null: none does.
function show_under_way(head) {
  $('under_way').hidden = !head;
  $('stop').disabled = Boolean(head && head.stops);
  if (!head) return;
  $('under_way_text').textContent = `An update has run for ${shown(head.seconds, 2)} s, ` +
    `${head.calls} calls` + (head.stops ? '; it is being taken back' : '');
}
// Of updates and fresh runs.
const stop = () => fetch('stop', {method: 'POST'}).catch(() => null);
$('stop').onclick = () => {
  $('stop').disabled = true;
  stop();
};
$('stop_fresh').onclick = stop;

// What is behind a server that was gone: the same, or one that was started again.
function show_back(head) {
  if (lost_at === null) return;
  const {updates} = head.state, more = updates - lost_at;
  const count = (n) => `${n} update${n === 1 ? '' : 's'}`;
  let text = 'The connection is back';
  if (head.run !== run) {
    text = updates === 0 ? 'The server was started again, without updates'
      : `The server was started again, and went on from its journal of ${count(updates)}`;
  }
  if (more !== 0) text += `: ${count(Math.abs(more))} ${more > 0 ? 'more' : 'fewer'} than before`;
  // An edit that had no answer was made, or is a draft again.
  if (pending && more === 0) {
    draft = pending.draft;
    text += '; the last edit was not made';
  }
  pending = null;
  lost_at = null;
  $('back').textContent = text + '.';
  $('back').hidden = false;
  setTimeout(() => { $('back').hidden = true; }, 10000);
}

function receive(head, arrays, bytes) {
  const began = performance.now();
  if (head.kind === 'busy') return show_under_way(head);
  if (head.kind === 'idle') return show_under_way(null);
  if (head.state) state = head.state;
  if (head.seeds) seeds = head.seeds;
  if (head.limits) show_limits(head.limits);
  if (head.kind === 'snapshot') load(head, arrays);
  if (head.kind === 'change') {
    mesh.apply(head, arrays, view);
    speed.updates += 1;
    speed.engine.push(head.seconds * 1000);
    speed.decode.push(performance.now() - began);
    show_update(head, bytes);
  }
  if (head.kind === 'error') report(head);
  if (head.kind === 'fresh') show_fresh(head);
  if (head.tag && sent.has(head.tag)) {
    speed.trip.push(began - sent.get(head.tag));
    sent.delete(head.tag);
    if (drag && drag.tag === head.tag && head.kind !== 'dropped') {
      drag.tag = 0;
      follow_drag();
    }
    if (head.kind === 'change' && pending && pending.tag === head.tag) pending = null;
    if (head.kind === 'error' && pending && pending.tag === head.tag) {
      draft = pending.draft;  // what was drawn is not lost
      pending = null;
    }
  }
  panel_stale = true;
  const follows = !drag || drag.key === 'by';  // the ring at a point that is dragged can wait
  wake(head.kind !== 'change' || is_space() ||
    follows && (selected !== null || draft.length > 0 || told !== null) ||
    head.seeds !== undefined || head.limits !== undefined);
}

function load(head, arrays) {
  const first = mesh === null;
  mesh = new Mesh(head, arrays, settings.judge);
  document.body.classList.toggle('in_space', is_space());
  if (first) {
    view = is_space() ? new Space(scene, settings) : new Plane(scene, settings);
    if (is_space()) take_cut();
    document.title = head.name + ' - mesher view';
    $('name').textContent = head.name;
    $('histogram_title').textContent = is_space() ? 'Smallest dihedral angles' : 'Smallest angles';
    $('limit_measure').textContent = is_space() ? 'volume' : 'area';
    $('limit_box').placeholder = is_space() ? 'x y z x y z' : 'x y x y';
    $('tool_limit').hidden = is_space();
    $('below').value = settings.below = is_space() ? 10 :
      Math.floor(Math.asin(1 / (2 * head.rho)) * 180 / Math.PI);
    const formats = ['vtu', 'vtk', 'msh', 'inp', 'su2', 'mesh', 'off', 'obj', 'node', 'svg'];
    if (is_space()) formats.push('stl');
    for (const f of formats) $('format').add(new Option('.' + f, f));
    take_format();
    choose('move');
  }
  show_back(head);
  run = head.run;
  show_limits(limits);  // in the words of the dimension
  selected = null;
  drag = null;
  sent.clear();
  end_fresh();
  view.load(mesh);
  last_update = last_fresh = null;
  rows('update', []);
}

// --- Panels --------------------------------------------------------------------------------------

function rows(id, list) {
  $(id).innerHTML = '';
  for (const cells of list) {
    const row = $(id).insertRow();
    for (const cell of cells) row.insertCell().textContent = cell;
  }
}

function show_update(head, bytes) {
  $('edit').textContent = head.edit;
  last_update = {...head, bytes};
  show_figures();
}

// What the last update did, and beside it what a fresh run has to do.
let last_update = null, last_fresh = null;
function show_figures() {
  const u = last_update, f = last_fresh, list = [];
  const row = (name, updated, run) => list.push(f ? [name, u ? updated(u) : '', run(f)]
    : [name, updated(u)]);
  const time = (head) => shown(head.seconds * 1000) + ' ms';
  if (f) list.push(['', u ? 'update' : '', f.revision === state.revision ? 'fresh run'
    : 'earlier run']);
  row('time', time, time);
  row((is_space() ? 'tetrahedra' : 'triangles') + ' that came, went', () => `${u.came}, ${u.went}`,
    () => `${f.simplices}, 0`);
  row('vertices', () => `${u.vertices_came}, ${u.vertices_went}`, () => `${f.vertices}, 0`);
  row('calls that ran, were reused', () => `${u.executed}, ${u.reused}`, () => `${f.calls}, 0`);
  if (u) row('message', () => u.bytes + ' bytes', () => '');
  rows('update', list);
}

let fresh_tag = 0;  // of a fresh run that is under way
function begin_fresh() {
  fresh_tag = command({do: 'fresh'});
  if (fresh_tag === 0) return;
  $('fresh').disabled = true;
  $('stop_fresh').hidden = false;
  $('fresh_result').textContent = 'running ...';
}
function end_fresh() {
  fresh_tag = 0;
  $('fresh').disabled = false;
  $('stop_fresh').hidden = true;
  $('fresh_result').textContent = '';
}

function show_fresh(head) {
  end_fresh();
  last_fresh = head;
  const ratio = last_update ? `${shown(head.seconds / last_update.seconds, 2)} times the last update; `
    : '';
  $('fresh_result').textContent = ratio +
    (head.same ? 'the same mesh' : 'another mesh: please report this');
  show_figures();
}

function report(head) {
  if (fresh_tag && head.tag === fresh_tag) end_fresh();
  const found = {text: head.text, places: head.places || [], features: head.features || [], times: 1};
  const of = [drag, last_drag].find((d) => d && d.tags.has(head.tag));
  if (of) {  // a drag is refused once, at the last place
    if (of.problem) found.times += of.problem.times;
    problems = problems.filter((p) => p !== of.problem);
    of.problem = found;
  }
  problems.unshift(found);
  problems.length = Math.min(problems.length, 20);
  told = found;
  show_problems();
}

function show_problems() {
  $('errors').innerHTML = '';
  for (const p of problems) {
    const item = document.createElement('li');
    item.textContent = p.text + (p.times > 1 ? ` (${p.times} times in a drag)` : '');
    item.onclick = () => {
      told = p;
      if (p.places.length > 0) go_to(p.places[0]);
      wake();
    };
    $('errors').append(item);
  }
  wake(true);
}

function go_to(place, size = 0) {
  if (is_space()) {
    view.show(place, size || view.side / 100);
  } else {
    const r = size || 60 * Math.min(view.pixel(), view.mesh.hi[0] - view.mesh.lo[0]);
    view.show([place[0] - r, place[1] - r, place[0] + r, place[1] + r]);
  }
  wake();
}

// --- Limits of size ------------------------------------------------------------------------------

function text_of_limit(largest) {
  if (largest === null) return 'any size';
  if (largest === 'background') return 'a background';
  return (is_space() ? 'volume ' : 'area ') + shown(largest, 4);
}

// The limit that is typed, as fields of a command: without a number, none.
function typed_limit() {
  const text = $('limit_value').value.trim();
  return text === '' ? {} : {[$('limit_kind').value]: Number(text)};
}

function show_limits(now) {
  limits = now;
  rows('limits', [['everywhere', text_of_limit(limits.everywhere)]]);
  for (const box of limits.boxes) {
    const row = $('limits').insertRow();
    row.insertCell().textContent = [...box.lo, ...box.hi].map((x) => shown(x)).join(' ');
    row.insertCell().textContent = text_of_limit(box.largest);
    const actions = row.insertCell();
    const action = (name, act) => {
      const button = document.createElement('button');
      button.textContent = name;
      button.onclick = act;
      actions.append(button);
    };
    action('Change', () => command({do: 'limit', box: [box.lo, box.hi], ...typed_limit()}));
    action('Delete', () => command({do: 'unlimit', box: [box.lo, box.hi]}));
  }
}

$('limit_all').onclick = () => command({do: 'limit', ...typed_limit()});
$('limit_in').onclick = () => {
  const numbers = $('limit_box').value.split(/[\s,;]+/).filter((s) => s !== '').map(Number);
  const d = mesh.dimension;
  if (numbers.length !== 2 * d || !numbers.every(Number.isFinite)) {
    return report({text: `A box is ${2 * d} numbers: ${$('limit_box').placeholder}`});
  }
  command({do: 'limit', box: [numbers.slice(0, d), numbers.slice(d)], ...typed_limit()});
};

// The box between two positions of the pointer.
function box_between(from, to) {
  const a = snapped(view.place(...from)), b = snapped(view.place(...to));
  return [a.map((x, i) => Math.min(x, b[i])), a.map((x, i) => Math.max(x, b[i]))];
}

function draw_box(g, lo, hi) {
  const d = mesh.dimension;
  const corner = (bits) => view.on_page(lo.map((x, i) => (bits >> i & 1 ? hi[i] : x)));
  g.beginPath();
  for (let from = 0; from < 1 << d; ++from) {
    for (let i = 0; i < d; ++i) {
      if (from >> i & 1) continue;
      const a = corner(from), b = corner(from | 1 << i);
      if (!a || !b) continue;
      g.moveTo(...a);
      g.lineTo(...b);
    }
  }
  g.stroke();
}

function draw_limits(g) {
  g.strokeStyle = '#2f7d4f';
  g.lineWidth = 1.5;
  g.setLineDash([3, 3]);
  for (const {lo, hi} of limits.boxes) draw_box(g, lo, hi);
  if (tool === 'limit' && gesture && gesture.moved) {
    draw_box(g, ...box_between(gesture.from, [gesture.x, gesture.y]));
  }
  g.setLineDash([]);
}

let marked_at = 0;
function go_to_marked() {
  for (let i = 0; i < mesh.slots; ++i) {
    const s = (marked_at + i) % mesh.slots;
    if (!mesh.is_kept(s) || settings.judge(mesh, s) === 0) continue;
    marked_at = s + 1;
    const d = mesh.dimension, o = mesh.outline(s), place = [];
    for (let k = 0; k < d; ++k) {
      let sum = 0;
      for (let c = 0; c <= d; ++c) sum += o[d * c + k];
      place.push(sum / (d + 1));
    }
    let size = 0;
    for (let c = 0; c <= d; ++c) {
      size = Math.max(size, Math.hypot(...place.map((x, k) => x - o[d * c + k])));
    }
    return go_to(place, 4 * size);
  }
}

function draw_histogram() {
  const canvas = $('histogram'), g = canvas.getContext('2d'), {width, height} = canvas;
  g.clearRect(0, 0, width, height);
  const most = Math.max(1, ...mesh.bins), w = width / mesh.bins.length;
  mesh.bins.forEach((count, i) => {
    if (count === 0) return;
    const h = Math.max(1, count / most * (height - 12));
    g.fillStyle = i < settings.below ? '#cc4a33' : '#5b83b8';
    g.fillRect(i * w, height - 10 - h, w - .5, h);
  });
  g.fillStyle = '#667';
  g.font = '9px sans-serif';
  for (let angle = 0; angle <= mesh.bins.length - 4; angle += 10) {
    g.fillText(angle, angle * w, height - 1);
  }
  const least = mesh.bins.findIndex((count) => count > 0);
  $('smallest').textContent = least < 0 ? 'nothing is kept' :
    `from ${least} degrees; ${mesh.bins.slice(0, settings.below).reduce((a, b) => a + b, 0)} below ` +
    settings.below;
}

// What the colours at the ends of the legend mean.
function text_of_scale() {
  if (settings.mode === 'quality') return `from 0 to ${is_space() ? 70 : 60} degrees`;
  if (settings.mode !== 'size') return '';
  const [low, high] = mesh.sizes().map((octave) => shown(2 ** octave, 2));
  return `${is_space() ? 'volume' : 'area'} from ${low} to ${high}`;
}

let panel_at = 0;
function draw_panel(now) {
  if (!panel_stale || now - panel_at < 120) return panel_stale;
  panel_stale = false;
  panel_at = now;
  rows('counts', [['vertices', state.vertices.toString()],
    [is_space() ? 'tetrahedra' : 'triangles', state.simplices.toString()],
    ['kept', state.kept.toString()], ['points', mesh.points.size.toString()]]);
  $('undo').disabled = state.undo === 0;
  $('redo').disabled = state.redo === 0;
  $('journal').textContent = `${state.updates} update${state.updates === 1 ? '' : 's'} in ` +
    state.journal;
  $('legend').style.background = LEGENDS[settings.mode];
  $('scale').textContent = text_of_scale();
  const marks = settings.poor || settings.forced || settings.slivers;
  $('marked').textContent = marks ? mesh.marked + ' marked' : '';
  if ($('snap').checked && !is_space()) $('grid').textContent = 'of ' + shown(grid());
  draw_histogram();
  show_calls();
  return false;
}

// The picture of the calls of the last update; its link has labels under the pointer.
let calls_of = 0;
function show_calls() {
  $('calls').checked = state.calls !== null;
  $('calls_link').hidden = !state.calls;
  if (!state.calls || calls_of === state.calls) return;
  calls_of = state.calls;
  $('calls_link').href = $('calls_picture').src = 'calls.svg?' + calls_of;
}

// --- Marks over the picture ----------------------------------------------------------------------

function draw_marks() {
  // A canvas that is empty costs as much as one that is not.
  const any = seeds.length > 0 || selected || draft.length > 0 || problems.length > 0 ||
    limits.boxes.length > 0 ||
    (tool !== 'move' && hover !== null);
  marks.style.visibility = any ? 'visible' : 'hidden';
  if (!any) return;
  const ratio = view.ratio, w = Math.round(marks.clientWidth * ratio);
  const h = Math.round(marks.clientHeight * ratio);
  if (marks.width !== w || marks.height !== h) [marks.width, marks.height] = [w, h];
  const g = marks.getContext('2d');
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, w, h);
  const ring = (place, radius, colour, width = 2) => {
    const at = view.on_page(place);
    if (!at) return;
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.beginPath();
    g.arc(at[0], at[1], radius, 0, 7);
    g.stroke();
  };
  for (const seed of seeds) {
    const at = view.on_page(seed.at);
    if (!at) continue;
    g.fillStyle = seed.fault ? '#a01c14' : '#223';
    g.font = 'bold 12px sans-serif';
    const label = seed.kind === 'hole' ? '\u25cb hole' : `\u25c6 ${shown(seed.attribute)}`;
    g.fillText(label, at[0] - 5, at[1] + 4);
  }
  draw_limits(g);
  if (told) for (const feature of told.features) draw_feature(g, ring, feature, [200, 16, 46]);
  if (selected) draw_feature(g, ring, selected, [224, 122, 0]);
  draw_draft(g, ring);
  problems.forEach((p) => {
    for (const place of p.places) {
      ring(place.slice(0, mesh.dimension), 11, '#c8102e', 2.5);
      if (p !== told) continue;
      const at = view.on_page(place.slice(0, mesh.dimension));
      if (!at) continue;
      g.font = '12px sans-serif';
      const text = p.text.length > 90 ? p.text.slice(0, 88) + ' ...' : p.text;
      const left = Math.max(4, Math.min(at[0] + 16, marks.clientWidth - g.measureText(text).width - 8));
      g.fillStyle = '#ffffffe8';
      g.fillRect(left - 3, at[1] - 26, g.measureText(text).width + 6, 17);
      g.fillStyle = '#a01c14';
      g.fillText(text, left, at[1] - 13);
    }
  });
}

function draw_feature(g, ring, [kind, id], colour) {
  const strong = `rgb(${colour})`;
  if (kind === 'point' && mesh.points.has(id)) ring(mesh.points.get(id), 8, strong, 2.5);
  const seed = seeds.find((s) => s.kind === kind && s.id === id);
  if (seed) ring(seed.at, 10, strong, 2.5);
  const add_path = (vertices) => {
    const places = vertices.map((v) => view.on_page(mesh.place(v)));
    if (!places.every((p) => p)) return;
    places.forEach((p, i) => i === 0 ? g.moveTo(...p) : g.lineTo(...p));
  };
  const faces = kind === 'polygon' ? mesh.polygon_faces(id) : [];
  g.fillStyle = `rgba(${colour}, .3)`;
  g.beginPath();
  faces.forEach(add_path);
  g.fill();
  g.strokeStyle = strong;
  g.lineWidth = 3;
  g.beginPath();
  (kind === 'line' ? mesh.line_edges(id) : Mesh.outline_of(faces)).forEach(add_path);
  g.stroke();
}

const place_of = (end) => typeof end === 'number' ? mesh.points.get(end) : end;

function draw_draft(g, ring) {
  const ends = draft.map(place_of).filter((p) => p);
  if (tool !== 'move' && hover !== null && hover !== undefined) {
    const p = place_of(hover);
    if (p && tool !== 'delete') ends.push(p);
    if (p) ring(p, 5, typeof hover === 'number' ? '#e07a00' : '#557');
  }
  if (draft.length === 0) return;
  g.strokeStyle = '#1f4e9c';
  g.lineWidth = 2;
  g.setLineDash([6, 4]);
  g.beginPath();
  ends.map((p) => view.on_page(p)).filter((p) => p)
    .forEach((p, i) => i === 0 ? g.moveTo(...p) : g.lineTo(...p));
  if (tool === 'polygon' && ends.length > 2) g.closePath();
  g.stroke();
  g.setLineDash([]);
}

// --- Frames --------------------------------------------------------------------------------------

function wake(with_marks = true) {
  marks_stale = marks_stale || with_marks;
  if (frame_wanted) return;
  frame_wanted = true;
  requestAnimationFrame(frame);
}

function frame(now) {
  frame_wanted = false;
  if (!mesh || !state) return;
  const began = performance.now();
  let more = view.frame(now);
  if (marks_stale) draw_marks();
  marks_stale = false;
  more = draw_panel(now) || more;
  speed.frames += 1;
  speed.paint.push(performance.now() - began);
  if (more || measuring) wake(false);
}

// --- The pointer ---------------------------------------------------------------------------------

const at_pointer = (event) => {
  const box = scene.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
};

function grid() {
  return 10 ** Math.floor(Math.log10(40 * view.pixel()));
}
function snapped(place) {
  if (!$('snap').checked || is_space()) return place;
  const step = grid();
  return place.map((x) => Math.round(x / step) * step);
}

// What a click there means for drawing: the id of a point, a position, or null.
function end_at(x, y) {
  const id = view.pick_point(x, y);
  if (id !== null) return id;
  if (!is_space()) return snapped(view.place(x, y));
  const face = view.pick_face(x, y);
  return face ? face.place : null;
}

let pending = null;  // {tag, draft}: a line that the server has not answered
function finish() {
  const marker = Math.round(Number($('marker').value) || 0);
  const closed = tool === 'polygon';
  if (draft.length < (closed ? 3 : 2)) return;
  const what = closed && is_space() ? {do: 'polygon'} : {do: 'line', closed};
  const tag = command({...what, through: draft, ...(marker ? {marker} : {})});
  if (tag === 0) return;
  pending = {tag, draft};
  draft = [];
  wake();
}

function click(x, y, event) {
  if (tool === 'move') return select(x, y);
  if (tool === 'delete') {
    select(x, y);
    return remove_selected();
  }
  if (tool === 'limit') return undefined;  // it is dragged
  if (tool === 'hole' || tool === 'region') {
    const face = is_space() ? view.pick_face(x, y) : null;
    const at = is_space() ? face && face.inside : view.place(x, y);
    if (!at) return;
    const attribute = Number($('attribute').value) || 0;
    return command(tool === 'hole' ? {do: 'hole', at} : {do: 'region', at, attribute});
  }
  const end = end_at(x, y);
  if (end === null) return;
  if (tool === 'point') {
    if (typeof end === 'number') return;  // there is one
    const marker = Math.round(Number($('marker').value) || 0);
    return command({do: 'point', at: end, ...(marker ? {marker} : {})});
  }
  const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
  if (draft.length > 0 && same(draft[draft.length - 1], end)) {
    if (event.detail > 1 && tool !== 'segment') finish();
    return;
  }
  if (tool === 'polygon' && draft.length > 2 && same(draft[0], end)) return finish();
  draft.push(end);
  if (tool === 'segment' && draft.length === 2) finish();
}

function select(x, y) {
  selected = null;
  const id = view.pick_point(x, y);
  const near = seeds.find((s) => {
    const at = view.on_page(s.at);
    return at && Math.hypot(at[0] - x, at[1] - y) < 12;
  });
  if (id !== null) {
    selected = ['point', id];
    $('hint').textContent = `point ${id} at ${text_of(mesh.points.get(id))}`;
  } else if (near) {
    selected = [near.kind, near.id];
    $('hint').textContent = `${near.kind} ${near.id}` + (near.fault ? ': ' + near.fault : '');
  } else {
    const line = view.pick_line(x, y);
    const face = line === null && is_space() ? view.pick_face(x, y) : null;
    // Edges of polygons alone have the number -1 - id.
    if (line !== null) selected = line < 0 && is_space() ? ['polygon', -1 - line] : ['line', line];
    else if (face && face.polygon !== null) selected = ['polygon', face.polygon];
    $('hint').textContent = selected ? selected.join(' ') : TOOLS[tool][1];
  }
  wake();
}

function remove_selected() {
  if (selected) command({do: 'delete', features: [selected]});
  selected = null;
  wake();
}

scene.addEventListener('pointerdown', (event) => {
  if (!mesh || measuring) return;
  scene.setPointerCapture(event.pointerId);
  scene.focus();
  const [x, y] = at_pointer(event);
  gesture = {x, y, from: [x, y], moved: false, button: event.button, shift: event.shiftKey};
  if (tool !== 'move' || event.button !== 0) return;
  const id = view.shows_points() || is_space() ? view.pick_point(x, y) : null;
  if (id !== null) return begin_drag(['point', id], mesh.points.get(id).slice());
  const start = place_on_selected(x, y);
  if (start) begin_drag(selected, start);
});

// Where on the line or polygon that is selected the pointer is; null if it is not.
function place_on_selected(x, y) {
  const [kind, id] = selected || [];
  if (kind !== 'line' && kind !== 'polygon') return null;
  const face = kind === 'polygon' ? view.pick_face(x, y) : null;
  if (face && face.polygon === id) return face.place;
  if (view.pick_line(x, y) !== (kind === 'line' ? id : -1 - id)) return null;
  const ends = kind === 'line' ? mesh.line_edges(id) : Mesh.outline_of(mesh.polygon_faces(id));
  let best = Infinity, found = null;
  for (const place of ends.flat().map((v) => mesh.place(v))) {
    const at = view.on_page(place), away = at ? Math.hypot(at[0] - x, at[1] - y) : Infinity;
    if (away < best) [best, found] = [away, place];
  }
  return found;
}

// The gesture drags a feature; in space along a direction.
function begin_drag(feature, start) {
  const [kind, id] = feature, select = $(kind === 'polygon' ? 'polygon_axis' : 'axis');
  const axis = 'xyz'.indexOf(select.value);
  const direction = !is_space() ? null : axis < 0 ? view.normal_of(id) : UNITS[axis];
  if (is_space() && !direction) return;
  Object.assign(gesture, {feature, start, direction});
}
const UNITS = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

scene.addEventListener('pointermove', (event) => {
  if (!mesh || measuring) return;
  const [x, y] = at_pointer(event);
  if (!gesture) {
    if (tool !== 'move') {
      const draws = !['hole', 'region', 'delete', 'limit'].includes(tool);
      // In space faces are many: where the pointer is on them only a click asks.
      hover = !draws ? null : is_space() ? view.pick_point(x, y) : end_at(x, y);
      wake();
    }
    return;
  }
  const dx = x - gesture.x, dy = y - gesture.y;
  if (Math.hypot(x - gesture.from[0], y - gesture.from[1]) > 3) gesture.moved = true;
  [gesture.x, gesture.y] = [x, y];
  if (!gesture.moved) return;
  if (tool === 'limit' && gesture.button === 0 && !is_space()) return wake();
  if (gesture.feature) {
    if (!drag) {
      drag = new_drag(gesture.feature);
      selected = gesture.feature;
    }
    drag.wanted = dragged_to(gesture, x, y);
    follow_drag();
  } else if (is_space() && gesture.button === 0 && !gesture.shift) {
    view.orbit(dx, dy);
  } else {
    view.pan(dx, dy);
  }
  wake(!drag || drag.key === 'by');
});

// A point is told where it is to be; lines and polygons, by how much they are to move.
function new_drag([kind, id]) {
  const what = kind === 'point' ? {point: id} : {feature: [kind, id]};
  return {what, key: kind === 'point' ? 'at' : 'by', wanted: null, sent: null, tag: 0,
    tags: new Set(), problem: null};
}

function dragged_to({feature, start, direction, from}, x, y) {
  let by;
  if (direction) {
    const length = view.along(start, direction, x - from[0], y - from[1]);
    by = direction.map((v) => v * length);
  } else {
    const a = view.place(...from), b = view.place(x, y);
    by = b.map((v, i) => v - a[i]);
  }
  return snapped(feature[0] === 'point' ? start.map((v, i) => v + by[i]) : by);
}

function send_drag(of, more) {
  const tag = command({do: 'drag', ...of.what, [of.key]: of.wanted, ...more});
  of.tags.add(tag);
  return tag;
}

// Sends where it is wanted, one position at a time.
function follow_drag() {
  if (!drag || drag.tag !== 0 || !drag.wanted) return;
  if (drag.sent && drag.sent.every((v, i) => v === drag.wanted[i])) return;
  drag.sent = drag.wanted;
  drag.tag = send_drag(drag, {});
}

function drop() {
  if (!drag) return;
  if (drag.wanted) send_drag(drag, {drop: true});
  last_drag = drag;
  drag = null;
  wake();
}

scene.addEventListener('pointerup', (event) => {
  if (!gesture) return;
  const [x, y] = at_pointer(event), was = gesture;
  gesture = null;
  if (drag) return drop();
  if (tool === 'limit' && was.moved && was.button === 0 && !is_space()) {
    command({do: 'limit', box: box_between(was.from, [x, y]), ...typed_limit()});
    return wake();
  }
  if (!was.moved && was.button === 0) click(x, y, event);
});
scene.addEventListener('pointercancel', () => {
  gesture = null;
  drop();
});
scene.addEventListener('dblclick', () => {
  if (tool === 'polyline' || tool === 'polygon') finish();
});
scene.addEventListener('contextmenu', (event) => event.preventDefault());
scene.addEventListener('wheel', (event) => {
  event.preventDefault();
  if (!mesh) return;
  const [x, y] = at_pointer(event);
  view.zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? .05 : .0015)), x, y);
  panel_stale = true;
  wake();
}, {passive: false});

window.addEventListener('keydown', (event) => {
  if (event.target instanceof HTMLInputElement || !mesh) return;
  const key = event.key;
  if (key === 'Escape') {
    draft = [];
    selected = null;
  } else if (key === 'Enter') {
    finish();
  } else if (key === 'Delete' || key === 'Backspace') {
    remove_selected();
  } else if ((event.ctrlKey || event.metaKey) && key.toLowerCase() === 'z') {
    command({do: event.shiftKey ? 'redo' : 'undo'});
    event.preventDefault();
  } else if ((event.ctrlKey || event.metaKey) && key.toLowerCase() === 'y') {
    command({do: 'redo'});
    event.preventDefault();
  } else if (is_space() && 'xyzn'.includes(key) && key.length === 1) {
    const polygon = key === 'n' || selected && selected[0] === 'polygon';
    $(polygon ? 'polygon_axis' : 'axis').value = key === 'n' ? 'normal' : key;
  } else {
    return;
  }
  wake();
});
window.addEventListener('resize', () => wake());

// --- Settings ------------------------------------------------------------------------------------

function recolour() {
  if (!view || !mesh) return;
  view.recolour();
  mesh.count_marked();
  panel_stale = true;
  wake();
}
for (const input of document.querySelectorAll('input[name=mode]')) {
  input.onchange = () => {
    settings.mode = input.value;
    panel_stale = true;
    view.spoil();
    wake();
  };
}
$('changes').onchange = () => { settings.changes = $('changes').checked; };
$('all').onchange = () => {
  settings.all = $('all').checked;
  view.spoil();
  wake();
};
for (const id of ['poor', 'forced', 'slivers']) {
  $(id).onchange = () => {
    settings[id] = $(id).checked;
    recolour();
  };
}
$('below').onchange = () => {
  settings.below = Math.round(Number($('below').value) || 0);
  recolour();
};
$('only_marked').onchange = () => {
  settings.only_marked = $('only_marked').checked;
  recolour();
};
function take_cut() {
  settings.cut = $('cut').checked
    ? {axis: $('cut_axis').selectedIndex, at: Number($('cut_at').value) / 1000} : null;
  if (view) view.spoil();
  wake();
}
for (const id of ['cut', 'cut_axis', 'cut_at']) $(id).oninput = take_cut;
$('snap').onchange = () => {
  panel_stale = true;
  if (!$('snap').checked) $('grid').textContent = '';
  wake();
};
$('next_marked').onclick = go_to_marked;
$('fresh').onclick = begin_fresh;
$('calls').onchange = () => command({do: 'calls', on: $('calls').checked});
$('clear_errors').onclick = () => {
  problems = [];
  told = null;
  show_problems();
};
function take_format() {
  $('save').href = 'save/mesh.' + $('format').value;
}
$('format').onchange = take_format;

// --- Measuring -----------------------------------------------------------------------------------

let measuring = false;
const median = (list) => list.length === 0 ? 0 :
  [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];

// Drags the point in the middle of the view around for some seconds, and back. Gives figures.
async function measure(seconds = 3) {
  const middle = [scene.clientWidth / 2, scene.clientHeight / 2];
  let id = null;
  for (let reach = 8; id === null && reach < 4000; reach *= 2) id = view.pick_point(...middle, reach);
  if (id === null) return null;
  const start = mesh.points.get(id).slice();
  let apart = Infinity;  // to the nearest other point
  for (const [other, place] of mesh.points) {
    if (other !== id) apart = Math.min(apart, Math.hypot(...place.map((x, i) => x - start[i])));
  }
  measuring = true;
  Object.assign(speed, {updates: 0, frames: 0, engine: [], trip: [], paint: [], decode: []});
  drag = new_drag(['point', id]);
  const began = performance.now();
  let angle = 0;
  wake();
  await new Promise((done) => {
    const step = () => {
      const now = performance.now();
      if (now - began > seconds * 1000) return done();
      if (drag.tag === 0) {
        angle += .35;
        const r = .35 * apart;
        drag.wanted = start.map((x, i) =>
          x + (i === 0 ? r * Math.cos(angle) - r : i === 1 ? r * Math.sin(angle) : 0));
        follow_drag();
      }
      setTimeout(step, 0);
    };
    step();
  });
  const took = (performance.now() - began) / 1000;
  const result = {point: id, triangles: state.simplices, kept: state.kept,
    frames: speed.frames / took, updates: speed.updates / took, engine_ms: median(speed.engine),
    trip_ms: median(speed.trip), paint_ms: median(speed.paint), apply_ms: median(speed.decode)};
  drag.wanted = start;
  measuring = false;
  drop();
  rows('speed', [['updates a second', shown(result.updates)],
    ['frames a second', shown(result.frames)], ['engine', shown(result.engine_ms) + ' ms'],
    ['round trip', shown(result.trip_ms) + ' ms'], ['page: change', shown(result.apply_ms) + ' ms'],
    ['page: paint', shown(result.paint_ms) + ' ms']]);
  return result;
}
$('measure').onclick = () => measure();

make_tools();
// For tests: what the page knows.
window.mesher = {
  get mesh() { return mesh; }, get view() { return view; }, get state() { return state; },
  get seeds() { return seeds; }, get limits() { return limits; }, get problems() { return problems; },
  get draft() { return draft; }, get selected() { return selected; },
  get busy() { return sent.size > 0 || frame_wanted; }, measure, command, settings, go_to,
};
