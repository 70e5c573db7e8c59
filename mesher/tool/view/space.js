// The mesh in space: the faces between what is shown and what is not, behind a plane that cuts it.
//
// Which faces those are is found anew after every change: the cost is that of a visit of all
// tetrahedra.

import {COLOUR, LINE, make_program, put_judged, set_colours} from './gl.js';
import {FREE} from './mesh.js';

const NONE = 0xffffffff;
const kReach = 10;   // pixels
const kFade = 1200, kGone = 600;  // milliseconds that what came, and what went, is shown
const kMostGone = 4000;  // faces

const FACES = [`
in vec3 at, normal; in vec4 judged; in float born;
uniform mat4 matrix; uniform vec3 eye_direction; uniform float now; uniform vec3 fill;
flat out vec3 base; out vec3 side;
${COLOUR}
void main() {
  gl_Position = matrix * vec4(at, 1.);
  float light = .70 + .30 * abs(dot(normalize(normal), eye_direction));
  float fresh = born > 0. ? clamp(1. - (now - born) / ${kFade}., 0., 1.) : 0.;
  vec3 c = mix(colour(judged), vec3(1., .55, 0.), fresh * .8);
  base = (fill.x < 0. ? c : fill) * light;
  int corner = gl_VertexID % 3;
  side = vec3(corner == 0, corner == 1, corner == 2);
}`, `
uniform float opacity;
flat in vec3 base; in vec3 side; out vec4 pixel;
${LINE}
void main() {
  pixel = vec4(mix(base, vec3(.18, .22, .30), line_at(side, .3, 1., .08) * .7), 1.) * opacity;
}`];

// Faces that were seen and went; what is as far from the eye does not hide them.
const GONE = [`
in vec3 at; in float since;
uniform mat4 matrix; uniform float now;
out float strength;
void main() {
  gl_Position = matrix * vec4(at, 1.);
  gl_Position.z -= 1e-3 * gl_Position.w;
  strength = .3 * clamp(1. - (now - since) / ${kGone}., 0., 1.);
}`, `
in float strength; out vec4 pixel;
void main() { pixel = vec4(.16, .35, .86, 1.) * strength; }`];

const LINES = [`
in vec3 at; uniform mat4 matrix; uniform float nearer, size;
void main() {
  gl_Position = matrix * vec4(at, 1.);
  gl_Position.z -= nearer * gl_Position.w;
  gl_PointSize = size;
}`, `
uniform vec4 tint; uniform float size; out vec4 pixel;
void main() {
  if (size > 0. && length(gl_PointCoord - .5) > .5) discard;
  pixel = tint;
}`];

// --- Small vectors and matrices (by columns) ---------------------------------------------------

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const plus = (a, b, t = 1) => [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const l = Math.hypot(...a) || 1; return [a[0] / l, a[1] / l, a[2] / l]; };

export class Space {
  constructor(canvas, settings) {
    this.canvas = canvas;
    this.settings = settings;  // mode, judge, cut {axis, at} or null, only_marked, all
    const gl = this.gl = canvas.getContext('webgl2', {antialias: true, alpha: false, depth: true});
    if (!gl) throw new Error('this browser has no WebGL 2');
    this.programs = {faces: make_program(gl, ...FACES), lines: make_program(gl, ...LINES),
      gone: make_program(gl, ...GONE)};
    this.buffers = {};
    for (const name of ['faces', 'ghost', 'gone', 'edges', 'points']) {
      this.buffers[name] = {buffer: gl.createBuffer(), count: 0};
    }
    this.born = new Map();
    this.gone = [];   // faces: {places: nine numbers of the buffers, since}
    this.seen = null; // by slot: bits of the faces that are drawn
    this.camera = null;
  }

  load(mesh) {
    this.mesh = mesh;
    this.centre = [0, 1, 2].map((i) => (mesh.lo[i] + mesh.hi[i]) / 2);
    this.side = Math.max(...[0, 1, 2].map((i) => mesh.hi[i] - mesh.lo[i]));
    this.born.clear();
    this.gone = [];
    this.seen = null;
    if (!this.camera) this.show_all();
    this.stale = true;
  }
  simplex_goes(s, stays) {
    this.stale = true;
    if (stays) return;
    if (this.settings.changes && !this.born.has(s)) this.fade(s);
    this.born.delete(s);
    if (this.seen && s < this.seen.length) this.seen[s] = 0;  // another one may take the slot
  }
  simplex_came(s, stays) {
    if (!stays && this.settings.changes) this.born.set(s, performance.now());
    this.stale = true;
  }
  // Keeps the faces of a tetrahedron that are drawn.
  fade(s) {
    const faces = this.seen && s < this.seen.length ? this.seen[s] : 0;
    for (let k = 0; k < 4; ++k) {
      if (!(faces >> k & 1) || this.gone.length >= kMostGone) continue;
      const places = [];
      for (let j = 0; j < 4; ++j) {
        if (j !== k) places.push(...this.inside(this.mesh.place(this.mesh.simplices[4 * s + j])));
      }
      this.gone.push({places, since: performance.now()});
    }
  }
  edge_goes() { this.stale = true; }
  edge_came() { this.stale = true; }
  point_goes() { this.stale = true; }
  point_came() { this.stale = true; }
  recolour() { this.stale = true; }
  spoil() { this.stale = true; }
  shows_points() { return true; }

  // In the units of the buffers: the box has side 1.
  inside(p) {
    return [0, 1, 2].map((i) => (p[i] - this.centre[i]) / this.side);
  }
  outside(p) { return [0, 1, 2].map((i) => p[i] * this.side + this.centre[i]); }

  // --- What is shown ---------------------------------------------------------------------------

  cut_height() {
    const {axis, at} = this.settings.cut;
    return this.mesh.lo[axis] + (this.mesh.hi[axis] - this.mesh.lo[axis]) * at;
  }

  // By slot.
  shown() {
    const m = this.mesh, {all, only_marked, cut, judge} = this.settings;
    const {simplices: t, places: p, labels} = m, shown = new Uint8Array(m.slots);
    const axis = cut ? cut.axis : 0, four = cut ? 4 * this.cut_height() : -Infinity;
    for (let s = 0; s < m.slots; ++s) {
      if (labels[s] === FREE || (labels[s] === 0 && !all)) continue;
      if (only_marked && judge(m, s) === 0) continue;
      const i = 4 * s;  // its middle is behind the cut
      shown[s] = p[3 * t[i] + axis] + p[3 * t[i + 1] + axis] + p[3 * t[i + 2] + axis] +
        p[3 * t[i + 3] + axis] >= four ? 1 : 0;
    }
    return shown;
  }

  build() {
    const m = this.mesh;
    const shown = this.shown();
    const list = [], ghost = [];
    const ghosts = this.settings.only_marked, {neighbours} = m;
    for (let s = 0; s < m.slots; ++s) {
      if (shown[s]) {
        for (let k = 0; k < 4; ++k) {
          const t = neighbours[4 * s + k];
          if (t === NONE || !shown[t]) list.push(4 * s + k);
        }
      } else if (ghosts && m.is_kept(s)) {
        for (let k = 0; k < 4; ++k) {
          const t = m.neighbours[4 * s + k];
          if (t === NONE || !m.is_kept(t)) ghost.push(4 * s + k);
        }
      }
    }
    this.list = list;
    this.seen = new Uint8Array(m.slots);
    for (const face of list) this.seen[face >> 2] |= 1 << (face & 3);
    this.upload_faces('faces', list);
    this.upload_faces('ghost', ghost);
    const lines = [];
    for (let e = 0; e < m.edge_slots; ++e) {
      if (!Number.isNaN(m.edge_lines[e])) lines.push(m.edges[2 * e], m.edges[2 * e + 1]);
    }
    const ends = new Float32Array(lines.length * 3);
    lines.forEach((v, i) => ends.set(this.inside(m.places.subarray(3 * v, 3 * v + 3)), 3 * i));
    this.upload('edges', ends, lines.length);
    const points = new Float32Array(m.points.size * 3);
    let i = 0;
    for (const p of m.points.values()) points.set(this.inside(p), 3 * i++);
    this.upload('points', points, m.points.size);
  }

  upload(name, data, count) {
    const gl = this.gl, to = this.buffers[name];
    gl.bindBuffer(gl.ARRAY_BUFFER, to.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
    to.count = count;
  }

  // Each is 4 * simplex + the corner across from it.
  upload_faces(name, list) {
    const m = this.mesh, p = m.places, words = 8;  // place, normal, judged, born
    const data = new ArrayBuffer(list.length * 3 * words * 4);
    const floats = new Float32Array(data), octets = new Uint8Array(data);
    const c = this.centre, side = this.side;
    let at = 0;
    const x = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
    for (const face of list) {
      const s = face >> 2, far = face & 3;
      for (let k = 0, i = 0; k < 4; ++k) {
        if (k === far) continue;
        const v = 3 * m.simplices[4 * s + k];
        for (let d = 0; d < 3; ++d) x[i][d] = (p[v + d] - c[d]) / side;
        ++i;
      }
      const normal = cross(minus(x[1], x[0]), minus(x[2], x[0]));
      const length = Math.hypot(normal[0], normal[1], normal[2]) || 1;
      const marks = this.settings.judge(m, s), born = this.born.get(s) || 0;
      for (let k = 0; k < 3; ++k, at += words) {
        for (let d = 0; d < 3; ++d) {
          floats[at + d] = x[k][d];
          floats[at + 3 + d] = normal[d] / length;
        }
        put_judged(octets, 4 * (at + 6), m, s, marks, 70);
        floats[at + 7] = born;
      }
    }
    this.upload(name, data, list.length * 3);
  }

  // --- The camera ------------------------------------------------------------------------------

  show_all() {
    const box = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    for (const p of this.mesh.points.values()) {
      for (let i = 0; i < 3; ++i) {
        box[0][i] = Math.min(box[0][i], p[i]);
        box[1][i] = Math.max(box[1][i], p[i]);
      }
    }
    if (!(box[0][0] <= box[1][0])) box.splice(0, 2, this.mesh.lo, this.mesh.hi);
    const target = this.inside([0, 1, 2].map((i) => (box[0][i] + box[1][i]) / 2));
    const reach = Math.hypot(...minus(box[1], box[0])) / this.side;
    this.camera = {target, yaw: -.5, pitch: .45, distance: Math.max(reach, 1e-6) * 1.25};
  }
  show(place, size) {
    this.camera.target = this.inside(place);
    this.camera.distance = Math.max(1e-5, size / this.side * 6);
  }
  zoom(by) {
    this.camera.distance = Math.min(8, Math.max(1e-5, this.camera.distance / by));
  }
  orbit(dx, dy) {
    this.camera.yaw -= dx * .008;
    this.camera.pitch = Math.min(1.55, Math.max(-1.55, this.camera.pitch + dy * .008));
  }
  axes() {
    const {yaw, pitch} = this.camera;
    const back = [Math.cos(pitch) * Math.sin(yaw), -Math.cos(pitch) * Math.cos(yaw),
      Math.sin(pitch)];
    const right = [Math.cos(yaw), Math.sin(yaw), 0];
    return {back, right, up: cross(back, right)};
  }
  pan(dx, dy) {
    const {right, up} = this.axes(), by = this.camera.distance / (this.canvas.clientHeight * 1.2);
    this.camera.target = plus(plus(this.camera.target, right, -dx * by), up, dy * by);
  }

  matrix() {
    const {back, right, up} = this.axes(), {target, distance} = this.camera;
    const eye = plus(target, back, distance);
    const f = 2.4, aspect = this.width / this.height;
    const near = distance * .02, far = distance + 3;
    const a = (near + far) / (near - far), b = 2 * near * far / (near - far);
    const rows = [[...right, -dot(right, eye)].map((x) => x * f / aspect),
      [...up, -dot(up, eye)].map((x) => x * f),
      [...back, -dot(back, eye)].map((x) => x * a),
      [...back, -dot(back, eye)].map((x) => -x)];
    rows[2][3] += b;
    const out = new Float32Array(16);
    for (let r = 0; r < 4; ++r) for (let c = 0; c < 4; ++c) out[4 * c + r] = rows[r][c];
    this.eye = eye;
    return out;
  }

  // On the page, in CSS pixels; null behind the eye.
  on_page(place) {
    const p = this.inside(place), m = this.view;
    if (!m) return null;
    const row = (r) => m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
    const w = row(3);
    if (w <= 0) return null;
    return [(row(0) / w + 1) / 2 * this.width / this.ratio,
      (1 - row(1) / w) / 2 * this.height / this.ratio];
  }

  resize() {
    this.ratio = Math.min(2, window.devicePixelRatio || 1);
    this.width = Math.max(1, Math.round(this.canvas.clientWidth * this.ratio));
    this.height = Math.max(1, Math.round(this.canvas.clientHeight * this.ratio));
    if (this.canvas.width !== this.width) this.canvas.width = this.width;
    if (this.canvas.height !== this.height) this.canvas.height = this.height;
  }

  // --- Drawing ---------------------------------------------------------------------------------

  frame(now) {
    if (!this.mesh) return false;
    this.resize();
    for (const [s, at] of this.born) if (now - at > kFade) this.born.delete(s);
    if (this.stale) this.build();
    this.stale = false;
    const gl = this.gl;
    this.view = this.matrix();
    gl.viewport(0, 0, this.width, this.height);
    gl.clearColor(.97, .97, .955, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    this.draw_faces('faces', now, 1, [-1, 0, 0]);
    this.draw_lines('edges', gl.LINES, [.05, .10, .22, 1], 0, 5e-4);
    this.draw_lines('points', gl.POINTS, [.10, .25, .60, 1], this.point_size(), 8e-4);
    gl.depthMask(false);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.draw_faces('ghost', now, .10, [.5, .6, .75]);
    this.draw_gone(now);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    return this.born.size > 0 || this.gone.length > 0;
  }

  point_size() {
    const count = Math.max(1, this.mesh.points.size);
    return Math.min(7, Math.max(2, Math.sqrt(this.width * this.height / count) / 8)) * this.ratio;
  }

  draw_faces(name, now, opacity, fill) {
    const gl = this.gl, at = this.programs.faces, {buffer, count} = this.buffers[name];
    if (count === 0) return;
    gl.useProgram(at.program);
    gl.uniformMatrix4fv(at.matrix, false, this.view);
    gl.uniform3fv(at.eye_direction, unit(plus(this.axes().back, this.axes().up, .35)));
    gl.uniform1f(at.now, now);
    gl.uniform1f(at.opacity, opacity);
    gl.uniform3fv(at.fill, fill);
    set_colours(gl, at, this.mesh, this.settings.mode);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    const used = [];
    for (const [attribute, size, type, offset] of [['at', 3, gl.FLOAT, 0],
      ['normal', 3, gl.FLOAT, 12], ['judged', 4, gl.UNSIGNED_BYTE, 24], ['born', 1, gl.FLOAT, 28]]) {
      const i = gl.getAttribLocation(at.program, attribute);
      if (i < 0) continue;
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, size, type, false, 32, offset);
      used.push(i);
    }
    gl.drawArrays(gl.TRIANGLES, 0, count);
    for (const i of used) gl.disableVertexAttribArray(i);
  }

  draw_gone(now) {
    this.gone = this.gone.filter((face) => now - face.since < kGone);
    if (this.gone.length === 0) return;
    const data = new Float32Array(12 * this.gone.length);
    this.gone.forEach(({places, since}, i) => {
      for (let k = 0; k < 3; ++k) {
        data.set(places.slice(3 * k, 3 * k + 3), 12 * i + 4 * k);
        data[12 * i + 4 * k + 3] = since;
      }
    });
    this.upload('gone', data, 3 * this.gone.length);
    const gl = this.gl, at = this.programs.gone;
    gl.useProgram(at.program);
    gl.uniformMatrix4fv(at.matrix, false, this.view);
    gl.uniform1f(at.now, now);
    const used = [['at', 3, 0], ['since', 1, 12]].map(([name, size, offset]) => {
      const i = gl.getAttribLocation(at.program, name);
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, size, gl.FLOAT, false, 16, offset);
      return i;
    });
    gl.drawArrays(gl.TRIANGLES, 0, this.buffers.gone.count);
    for (const i of used) gl.disableVertexAttribArray(i);
  }

  draw_lines(name, kind, tint, size, nearer) {
    const gl = this.gl, at = this.programs.lines, {buffer, count} = this.buffers[name];
    if (count === 0) return;
    gl.useProgram(at.program);
    gl.uniformMatrix4fv(at.matrix, false, this.view);
    gl.uniform4fv(at.tint, tint);
    gl.uniform1f(at.size, size);
    gl.uniform1f(at.nearer, nearer);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    const i = gl.getAttribLocation(at.program, 'at');
    gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(i, 3, gl.FLOAT, false, 12, 0);
    gl.drawArrays(kind, 0, count);
    gl.disableVertexAttribArray(i);
  }

  // --- Picking ---------------------------------------------------------------------------------

  // The point that is seen there, the nearest to the eye of those within reach.
  pick_point(x, y, reach = kReach) {
    let best = Infinity, found = null;
    for (const [id, place] of this.mesh.points) {
      const at = this.on_page(place);
      if (!at || Math.hypot(at[0] - x, at[1] - y) > reach) continue;
      const away = Math.hypot(...minus(this.inside(place), this.eye));
      if (away < best) [best, found] = [away, id];
    }
    return found;
  }

  pick_line(x, y) {
    const m = this.mesh;
    let best = 6, found = null;
    for (let e = 0; e < m.edge_slots; ++e) {
      if (Number.isNaN(m.edge_lines[e])) continue;
      const [a, b] = [0, 1].map((k) => {
        const v = 3 * m.edges[2 * e + k];
        return this.on_page(m.places.subarray(v, v + 3));
      });
      if (!a || !b) continue;
      const u = [b[0] - a[0], b[1] - a[1]], v = [x - a[0], y - a[1]];
      const t = Math.min(1, Math.max(0, (u[0] * v[0] + u[1] * v[1]) / (u[0] ** 2 + u[1] ** 2 || 1)));
      const d = Math.hypot(v[0] - t * u[0], v[1] - t * u[1]);
      if (d < best) [best, found] = [d, m.edge_lines[e]];
    }
    return found;
  }

  // What is seen at a position on the page: {place, inside: the middle of its tetrahedron, polygon}.
  pick_face(x, y) {
    if (!this.list) return null;
    const {back, right, up} = this.axes(), f = 2.4;
    const u = (x * this.ratio / this.width * 2 - 1) * (this.width / this.height) / f;
    const v = (1 - y * this.ratio / this.height * 2) / f;
    const ray = unit(plus(plus(plus([0, 0, 0], back, -1), right, u), up, v));
    const m = this.mesh;
    let best = Infinity, found = null;
    for (const face of this.list) {
      const s = face >> 2, far = face & 3, p = [];
      for (let k = 0; k < 4; ++k) {
        if (k !== far) {
          const at = 3 * m.simplices[4 * s + k];
          p.push(this.inside(m.places.subarray(at, at + 3)));
        }
      }
      const e = minus(p[1], p[0]), g = minus(p[2], p[0]), h = cross(ray, g), det = dot(e, h);
      if (Math.abs(det) < 1e-18) continue;
      const w = minus(this.eye, p[0]), a = dot(w, h) / det;
      const q = cross(w, e), b = dot(ray, q) / det, t = dot(g, q) / det;
      if (a < 0 || b < 0 || a + b > 1 || t <= 0 || t >= best) continue;
      best = t;
      found = {s, far, place: this.outside(plus(this.eye, ray, t))};
    }
    if (!found) return null;
    const corners = [0, 1, 2, 3].map((k) => m.simplices[4 * found.s + k]);
    found.inside = [0, 1, 2].map((d) =>
      corners.reduce((sum, v) => sum + m.places[3 * v + d] / 4, 0));
    const seen = corners.filter((_, k) => k !== found.far);
    found.polygon = null;
    for (let i = 0; i < m.face_polygons.length; ++i) {
      if (Number.isNaN(m.face_polygons[i])) continue;
      if ([0, 1, 2].every((k) => seen.includes(m.faces[3 * i + k]))) {
        found.polygon = m.face_polygons[i];
        break;
      }
    }
    return found;
  }

  // A vector across a polygon, of length 1: exact if the polygon is across an axis.
  normal_of(polygon) {
    let best = [0, 0, 0];
    for (const face of this.mesh.polygon_faces(polygon)) {
      const [a, b, c] = face.map((v) => this.mesh.place(v));
      const normal = cross(minus(b, a), minus(c, a));
      if (dot(normal, normal) > dot(best, best)) best = normal;
    }
    return dot(best, best) > 0 ? unit(best) : null;
  }

  // How far along a direction of length 1 a motion on the page goes, for something at `place`.
  along(place, direction, dx, dy) {
    const from = this.on_page(place);
    const step = this.camera.distance * this.side * .02;
    const to = this.on_page(plus(place, direction, step));
    if (!from || !to) return 0;
    const u = [to[0] - from[0], to[1] - from[1]], squared = u[0] ** 2 + u[1] ** 2;
    if (squared < 1) return 0;  // it points to the eye
    return (dx * u[0] + dy * u[1]) / squared * step;
  }
}
