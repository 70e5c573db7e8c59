// The mesh in the plane.
//
// What is seen is kept as a picture. A change draws anew what is behind its rectangle, so its cost
// does not grow with the mesh; another place or scale shows the old picture, moved, and draws it anew
// in cells, within a budget for each frame. The budget follows from how long frames take.

import {COLOUR, LINE, make_program, put_judged, set_colours} from './gl.js';
import {Tiles} from './tiles.js';

const kCell = 64;        // pixels
const kFade = 1200, kGone = 350;  // milliseconds that what came, and what went, is shown
const kMostFading = 4000;
const kMostPoints = 20000;  // more in the picture are not drawn
const kReach = 9;        // pixels, to pick something

const TRIANGLES = [`
in vec2 at; in vec4 judged;
uniform vec2 origin, half_size; uniform float scale; uniform bool all;
flat out vec3 base; out vec3 side;
${COLOUR}
void main() {
  vec2 px = origin + at * scale;
  gl_Position = vec4(px / half_size, 0., 1.);
  if (judged.z < .5 && !all) gl_Position = vec4(2., 2., 2., 1.);
  base = colour(judged);
  int corner = gl_VertexID % 3;
  side = vec3(corner == 0, corner == 1, corner == 2);
}`, `
flat in vec3 base; in vec3 side; out vec4 pixel;
${LINE}
void main() {
  pixel = vec4(mix(base, vec3(.22, .27, .36), line_at(side, .35, 1.05, .10) * .65), 1.);
}`];

const EDGES = [`
in vec2 from, to;
uniform vec2 origin, half_size; uniform float scale, width;
out float across;
void main() {
  vec2 a = origin + from * scale, b = origin + to * scale, along = b - a;
  float length = max(length(along), 1e-6);
  vec2 normal = vec2(-along.y, along.x) / length;
  float end = float(gl_VertexID >> 1), side = float(gl_VertexID & 1) * 2. - 1.;
  across = side * (width / 2. + .7);
  vec2 px = mix(a, b, end) + normal * across + along / length * (end * 2. - 1.) * .3;
  gl_Position = vec4(px / half_size, 0., 1.);
}`, `
in float across; uniform float width; out vec4 pixel;
void main() {
  pixel = vec4(.08, .12, .22, 1.) * clamp(width / 2. + .7 - abs(across), 0., 1.);
}`];

const POINTS = [`
in vec2 at;
uniform vec2 origin, half_size; uniform float scale, size;
void main() {
  gl_Position = vec4((origin + at * scale) / half_size, 0., 1.);
  gl_PointSize = size;
}`, `
uniform float size; out vec4 pixel;
void main() {
  float r = length(gl_PointCoord - .5) * size;
  float inside = clamp(size / 2. - r, 0., 1.), core = clamp(size / 2. - 1. - r, 0., 1.);
  pixel = vec4(mix(vec3(.08, .12, .22), vec3(1.), core), 1.) * inside;
}`];

const FADING = [`
in vec2 at; in vec4 tint;
uniform vec2 half_size;
out vec4 shade;
void main() {
  gl_Position = vec4(at / half_size, 0., 1.);
  shade = vec4(tint.rgb * tint.a, tint.a);
}`, `
in vec4 shade; out vec4 pixel;
void main() { pixel = shade; }`];

const PICTURE = [`
uniform vec2 move; uniform float zoom;
out vec2 at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2. - 1.;
  gl_Position = vec4(corner * zoom + move, 0., 1.);
  at = corner * .5 + .5;
}`, `
uniform sampler2D picture; in vec2 at; out vec4 pixel;
void main() { pixel = texture(picture, at); }`];

export class Plane {
  constructor(canvas, settings) {
    this.canvas = canvas;
    this.settings = settings;  // mode, all, changes, judge(mesh, slot) -> marks
    const gl = this.gl = canvas.getContext('webgl2', {antialias: false, alpha: false, depth: false,
      preserveDrawingBuffer: false});
    if (!gl) throw new Error('this browser has no WebGL 2');
    this.programs = {triangles: make_program(gl, ...TRIANGLES), edges: make_program(gl, ...EDGES),
      points: make_program(gl, ...POINTS), fading: make_program(gl, ...FADING),
      picture: make_program(gl, ...PICTURE)};
    this.fade_buffer = gl.createBuffer();
    this.empty = gl.createVertexArray();
    this.fades = gl.createVertexArray();
    this.pictures = [gl.createTexture(), gl.createTexture()];
    this.frames = [gl.createFramebuffer(), gl.createFramebuffer()];
    this.shown = 0;
    this.fading = [];         // what went: {outline, at}
    this.fresh = new Map();   // what came, by slot
    this.budget = 60000;  // triangles
    this.camera = null;
    this.last = 0;
  }

  // --- The mesh --------------------------------------------------------------------------------

  load(mesh) {
    const gl = this.gl;
    this.mesh = mesh;
    for (const tiles of [this.triangles, this.edges, this.points]) {
      if (tiles) gl.deleteBuffer(tiles.buffer);
    }
    const lo = mesh.lo.slice(), hi = mesh.hi.slice();
    const triangle_box = (s, out) => {
      const p = mesh.places, t = mesh.simplices;
      const a = 2 * t[3 * s], b = 2 * t[3 * s + 1], c = 2 * t[3 * s + 2];
      const ax = p[a], ay = p[a + 1], bx = p[b], by = p[b + 1], cx = p[c], cy = p[c + 1];
      out[0] = ax < bx ? (ax < cx ? ax : cx) : bx < cx ? bx : cx;
      out[1] = ay < by ? (ay < cy ? ay : cy) : by < cy ? by : cy;
      out[2] = ax > bx ? (ax > cx ? ax : cx) : bx > cx ? bx : cx;
      out[3] = ay > by ? (ay > cy ? ay : cy) : by > cy ? by : cy;
    };
    const edge_box = (e, out) => {
      const p = mesh.places, a = 2 * mesh.edges[2 * e], b = 2 * mesh.edges[2 * e + 1];
      out[0] = Math.min(p[a], p[b]);
      out[1] = Math.min(p[a + 1], p[b + 1]);
      out[2] = Math.max(p[a], p[b]);
      out[3] = Math.max(p[a + 1], p[b + 1]);
    };
    this.triangles = new Tiles(gl, {bytes: 36, lo, hi, bounds: triangle_box,
      write: (s, origin, floats, octets, at) => {
        const marks = this.settings.judge(mesh, s);
        for (let k = 0; k < 3; ++k, at += 3) {
          const v = 2 * mesh.simplices[3 * s + k];
          floats[at] = mesh.places[v] - origin[0];
          floats[at + 1] = mesh.places[v + 1] - origin[1];
          put_judged(octets, 4 * (at + 2), mesh, s, marks, 60);
        }
      }});
    this.edges = new Tiles(gl, {bytes: 16, lo, hi, bounds: edge_box,
      write: (e, origin, floats, octets, at) => {
        for (let k = 0; k < 2; ++k) {
          const v = 2 * mesh.edges[2 * e + k];
          floats[at + 2 * k] = mesh.places[v] - origin[0];
          floats[at + 2 * k + 1] = mesh.places[v + 1] - origin[1];
        }
      }});
    // Points of the input by a number of their own: ids may be any.
    this.point_numbers = new Map();
    this.point_ids = [];
    this.free_points = [];
    this.points = new Tiles(gl, {bytes: 8, lo, hi,
      bounds: (n, out) => {
        const at = mesh.points.get(this.point_ids[n]);
        out[0] = out[2] = at[0];
        out[1] = out[3] = at[1];
      },
      write: (n, origin, floats, octets, at) => {
        const place = mesh.points.get(this.point_ids[n]);
        floats[at] = place[0] - origin[0];
        floats[at + 1] = place[1] - origin[1];
      }});
    const triangles = [], edges = [], points = [];
    for (let s = 0; s < mesh.slots; ++s) if (mesh.is_live(s)) triangles.push(s);
    for (let e = 0; e < mesh.edge_slots; ++e) if (!Number.isNaN(mesh.edge_lines[e])) edges.push(e);
    for (const id of mesh.points.keys()) points.push(this.number_of(id));
    this.triangles.build(triangles);
    this.edges.build(edges);
    this.points.build(points);
    this.damage = null;
    this.fading = [];
    this.fresh.clear();
    if (!this.camera) this.show_all();
    this.spoil();
  }

  number_of(id) {
    let n = this.point_numbers.get(id);
    if (n === undefined) {
      n = this.free_points.length > 0 ? this.free_points.pop() : this.point_ids.length;
      this.point_numbers.set(id, n);
      this.point_ids[n] = id;
    }
    return n;
  }

  simplex_goes(s, stays) {
    this.hurt(this.mesh.outline(s));
    if (stays) return;
    if (this.mesh.is_kept(s)) this.fade(s, false);
    this.triangles.remove(s);
  }
  simplex_came(s, stays) {
    this.hurt(this.mesh.outline(s));
    if (stays) return this.triangles.rewrite(s);
    if (this.mesh.is_kept(s)) this.fade(s, true);
    this.triangles.add(s);
  }
  edge_goes(e) { this.edges.remove(e); }
  edge_came(e) { this.edges.add(e); }
  point_goes(id) {
    const n = this.point_numbers.get(id);
    if (n === undefined) return;
    this.hurt(this.mesh.points.get(id));
    this.points.remove(n);
    this.point_numbers.delete(id);
    this.free_points.push(n);
  }
  point_came(id) {
    this.points.add(this.number_of(id));
    this.hurt(this.mesh.points.get(id));
  }

  fade(s, came) {
    const had = this.fresh.delete(s);
    if (!this.settings.changes) return;
    const item = {outline: this.mesh.outline(s), at: performance.now()};
    if (came && this.fresh.size < kMostFading) this.fresh.set(s, item);
    // What had just come was not there for long.
    if (!came && !had && this.fading.length < kMostFading) this.fading.push(item);
  }

  hurt(outline) {
    const d = this.damage || (this.damage = [Infinity, Infinity, -Infinity, -Infinity]);
    for (let i = 0; i < outline.length; i += 2) {
      d[0] = Math.min(d[0], outline[i]);
      d[1] = Math.min(d[1], outline[i + 1]);
      d[2] = Math.max(d[2], outline[i]);
      d[3] = Math.max(d[3], outline[i + 1]);
    }
  }

  recolour() {
    this.triangles.rewrite_all();
    this.spoil();
  }
  // Everything is to be drawn anew.
  spoil() {
    if (this.cells) this.cells.fill(1);
    this.spoiled = true;
  }

  // --- The camera ------------------------------------------------------------------------------

  show_all() {
    const m = this.mesh;
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const [x, y] of m.points.values()) {
      box[0] = Math.min(box[0], x);
      box[1] = Math.min(box[1], y);
      box[2] = Math.max(box[2], x);
      box[3] = Math.max(box[3], y);
    }
    if (!(box[0] < box[2] || box[1] < box[3])) box.splice(0, 4, ...m.lo, ...m.hi);
    this.show(box, 1.12);
  }
  show([x0, y0, x1, y1], border = 3) {
    this.resize();
    const w = Math.max(x1 - x0, 1e-300), h = Math.max(y1 - y0, 1e-300);
    this.camera = {x: (x0 + x1) / 2, y: (y0 + y1) / 2,
      scale: Math.min(this.width / w, this.height / h) / border};
  }
  zoom(by, x, y) {
    const [wx, wy] = this.place(x, y), c = this.camera;
    const side = Math.max(this.mesh.hi[0] - this.mesh.lo[0], this.mesh.hi[1] - this.mesh.lo[1]);
    c.scale = Math.min(2 ** 44 / side, Math.max(50 / side, c.scale * by));
    const [nx, ny] = this.place(x, y);
    c.x += wx - nx;
    c.y += wy - ny;
  }
  pan(dx, dy) {
    this.camera.x -= dx * this.ratio / this.camera.scale;
    this.camera.y += dy * this.ratio / this.camera.scale;
  }
  // Of a position on the page, and back; x and y in CSS pixels from the canvas' corner.
  place(x, y) {
    const c = this.camera;
    return [c.x + (x * this.ratio - this.width / 2) / c.scale,
      c.y + (this.height / 2 - y * this.ratio) / c.scale];
  }
  on_page([x, y]) {
    const c = this.camera;
    return [((x - c.x) * c.scale + this.width / 2) / this.ratio,
      (this.height / 2 - (y - c.y) * c.scale) / this.ratio];
  }
  pixel() { return this.ratio / this.camera.scale; }  // its side in the mesh

  resize() {
    const ratio = this.ratio = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    if (this.width === width && this.height === height) return;
    const gl = this.gl;
    this.canvas.width = this.width = width;
    this.canvas.height = this.height = height;
    for (const i of [0, 1]) {
      gl.bindTexture(gl.TEXTURE_2D, this.pictures[i]);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
      for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR],
        [gl.TEXTURE_MAG_FILTER, gl.LINEAR], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
        [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) {
        gl.texParameteri(gl.TEXTURE_2D, name, value);
      }
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.frames[i]);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D,
        this.pictures[i], 0);
    }
    this.columns = Math.ceil(width / kCell);
    this.rows = Math.ceil(height / kCell);
    this.cells = new Uint8Array(this.columns * this.rows).fill(1);
    this.drawn = null;
  }

  // --- Drawing ---------------------------------------------------------------------------------

  // Draws a frame. Whether another one is needed.
  frame(now) {
    if (!this.mesh) return false;
    this.resize();
    const gl = this.gl;
    const took = now - this.last;
    this.last = now;
    this.follow_sizes();
    this.triangles.flush();
    this.edges.flush();
    this.points.flush();
    gl.viewport(0, 0, this.width, this.height);
    this.follow_camera();
    let left = this.budget;
    if (this.damage) {
      left -= this.mend();
      this.damage = null;
    }
    const busy = this.refresh(left);
    if (busy && took > 0 && took < 400) {
      this.budget = Math.min(400000, Math.max(12000, this.budget * (took > 28 ? .7 : 1.15)));
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    this.put_picture(0, 0, 1);
    this.draw_fading(now);
    return busy || this.fading.length > 0 || this.fresh.size > 0;
  }

  // Where sizes are coloured, another scale changes all colours.
  follow_sizes() {
    const scale = this.settings.mode === 'size' ? this.mesh.sizes().join() : null;
    if (scale !== null && scale !== this.scale) this.spoil();
    this.scale = scale;
  }

  // After the camera has moved, the picture shows what it had, in its new place.
  follow_camera() {
    const gl = this.gl, c = this.camera, was = this.drawn;
    if (was && was.x === c.x && was.y === c.y && was.scale === c.scale) return;
    const other = 1 - this.shown;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frames[other]);
    gl.disable(gl.SCISSOR_TEST);
    gl.disable(gl.BLEND);
    gl.clearColor(.97, .97, .955, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (was) {
      this.put_picture((was.x - c.x) * c.scale * 2 / this.width,
        (was.y - c.y) * c.scale * 2 / this.height, c.scale / was.scale);
    }
    this.shown = other;
    this.drawn = {...c};
    this.cells.fill(1);
  }

  // The picture, moved and scaled, into what is bound.
  put_picture(x, y, zoom) {
    const gl = this.gl, at = this.programs.picture;
    gl.useProgram(at.program);
    gl.bindVertexArray(this.empty);
    gl.bindTexture(gl.TEXTURE_2D, this.pictures[this.shown]);
    gl.uniform2f(at.move, x, y);
    gl.uniform1f(at.zoom, zoom);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }

  // Draws what has changed, at once if it is little, else with the cells.
  mend() {
    const [x0, y0, x1, y1] = this.damage, c = this.camera;
    const clamp = (x, most) => Math.min(most, Math.max(0, x));
    const l = clamp(Math.floor((x0 - c.x) * c.scale + this.width / 2) - 6, this.width);
    const r = clamp(Math.ceil((x1 - c.x) * c.scale + this.width / 2) + 6, this.width);
    const b = clamp(Math.floor((y0 - c.y) * c.scale + this.height / 2) - 6, this.height);
    const t = clamp(Math.ceil((y1 - c.y) * c.scale + this.height / 2) + 6, this.height);
    if (l >= r || b >= t) return 0;
    const cost = this.cost(l, b, r, t);
    if (cost <= Math.max(this.budget, 60000)) return this.draw(l, b, r, t);
    for (let row = Math.floor(b / kCell); row * kCell < t; ++row) {
      for (let column = Math.floor(l / kCell); column * kCell < r; ++column) {
        this.cells[row * this.columns + column] = 1;
      }
    }
    return 0;
  }

  // Draws cells that are out of date, row by row. Whether some are left.
  refresh(left) {
    for (let row = 0; row < this.rows; ++row) {
      for (let column = 0; column < this.columns; ++column) {
        if (!this.cells[row * this.columns + column]) continue;
        if (left <= 0) return true;
        let end = column + 1;
        const b = row * kCell, t = Math.min(this.height, b + kCell);
        while (end < this.columns && this.cells[row * this.columns + end] &&
               this.cost(column * kCell, b, (end + 1) * kCell, t) < left) {
          ++end;
        }
        left -= this.draw(column * kCell, b, Math.min(this.width, end * kCell), t);
        this.cells.fill(0, row * this.columns + column, row * this.columns + end);
        column = end - 1;
      }
    }
    return false;
  }

  box(l, b, r, t) {
    const c = this.camera, m = 4;
    return [c.x + (l - m - this.width / 2) / c.scale, c.y + (b - m - this.height / 2) / c.scale,
      c.x + (r + m - this.width / 2) / c.scale, c.y + (t + m - this.height / 2) / c.scale];
  }
  cost(l, b, r, t) {
    let count = 1000;
    for (const tile of this.triangles.within(this.box(l, b, r, t))) count += tile.count;
    return count;
  }

  // A rectangle of the picture, in pixels from below and left. How many triangles that took.
  draw(l, b, r, t) {
    const gl = this.gl, box = this.box(l, b, r, t);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frames[this.shown]);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(l, b, r - l, t - b);
    gl.disable(gl.BLEND);
    gl.clearColor(.97, .97, .955, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const count = this.draw_triangles(box);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.draw_edges(box);
    this.draw_points(box);
    gl.disable(gl.BLEND);
    gl.disable(gl.SCISSOR_TEST);
    return count + 1000;
  }

  begin(at) {
    const gl = this.gl;
    gl.useProgram(at.program);
    gl.bindVertexArray(null);
    gl.uniform2f(at.half_size, this.width / 2, this.height / 2);
    gl.uniform1f(at.scale, this.camera.scale);
  }
  move_to(at, tile) {
    const c = this.camera;
    this.gl.uniform2f(at.origin, (tile.origin[0] - c.x) * c.scale, (tile.origin[1] - c.y) * c.scale);
  }
  attribute(at, name, size, type, stride, offset, divisor = 0) {
    const gl = this.gl, i = gl.getAttribLocation(at.program, name);
    gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(i, size, type, false, stride, offset);
    gl.vertexAttribDivisor(i, divisor);
    return i;
  }
  end(used) {
    for (const i of used) {
      this.gl.disableVertexAttribArray(i);
      this.gl.vertexAttribDivisor(i, 0);
    }
  }

  draw_triangles(box) {
    const gl = this.gl, at = this.programs.triangles;
    this.begin(at);
    set_colours(gl, at, this.mesh, this.settings.mode);
    gl.uniform1i(at.all, this.settings.all ? 1 : 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.triangles.buffer);
    const used = [this.attribute(at, 'at', 2, gl.FLOAT, 12, 0),
      this.attribute(at, 'judged', 4, gl.UNSIGNED_BYTE, 12, 8)];
    let count = 0;
    for (const tile of this.triangles.within(box)) {
      this.move_to(at, tile);
      gl.drawArrays(gl.TRIANGLES, 3 * this.triangles.first(tile), 3 * tile.count);
      count += tile.count;
    }
    this.end(used);
    return count;
  }

  draw_edges(box) {
    const gl = this.gl, at = this.programs.edges;
    this.begin(at);
    gl.uniform1f(at.width, 1.5 * this.ratio);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.edges.buffer);
    let used = [];
    for (const tile of this.edges.within(box)) {
      const start = 16 * this.edges.first(tile);
      used = [this.attribute(at, 'from', 2, gl.FLOAT, 16, start, 1),
        this.attribute(at, 'to', 2, gl.FLOAT, 16, start + 8, 1)];
      this.move_to(at, tile);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, tile.count);
    }
    this.end(used);
  }

  // Whether points are few enough on the canvas to be drawn, and to be dragged.
  shows_points() {
    let count = 0;
    for (const tile of this.points.within(this.box(0, 0, this.width, this.height))) {
      count += tile.count;
    }
    return count <= kMostPoints;
  }

  draw_points(box) {
    if (!this.shows_points()) return;
    const gl = this.gl, at = this.programs.points;
    this.begin(at);
    gl.uniform1f(at.size, this.point_size());
    gl.bindBuffer(gl.ARRAY_BUFFER, this.points.buffer);
    const used = [this.attribute(at, 'at', 2, gl.FLOAT, 8, 0)];
    for (const tile of this.points.within(box)) {
      this.move_to(at, tile);
      gl.drawArrays(gl.POINTS, this.points.first(tile), tile.count);
    }
    this.end(used);
  }
  // Smaller where there are many: not above a fifth of their distance.
  point_size() {
    let count = 1;
    for (const tile of this.points.within(this.box(0, 0, this.width, this.height))) {
      const [x0, y0, x1, y1] = tile.box, [l, b, r, t] = this.box(0, 0, this.width, this.height);
      const part = (low, high, from, to) =>
        high > low ? Math.max(0, Math.min(high, to) - Math.max(low, from)) / (high - low) : 1;
      count += tile.count * part(x0, x1, l, r) * part(y0, y1, b, t);
    }
    const apart = Math.sqrt(this.width * this.height / count);
    return Math.min(8 * this.ratio, Math.max(2, apart / 5));
  }

  draw_fading(now) {
    this.fading = this.fading.filter((f) => now - f.at < kGone);
    for (const [s, {at}] of this.fresh) if (now - at >= kFade) this.fresh.delete(s);
    const count = this.fading.length + this.fresh.size;
    if (count === 0) return;
    const gl = this.gl, at = this.programs.fading, c = this.camera;
    const data = new ArrayBuffer(36 * count);
    const floats = new Float32Array(data), octets = new Uint8Array(data);
    let i = 0;
    const put = ({outline, at: from}, lasts, red, green, blue, opacity) => {
      const strength = opacity * Math.max(0, 1 - (now - from) / lasts);
      for (let k = 0; k < 6; k += 2, i += 3) {
        floats[i] = (outline[k] - c.x) * c.scale;
        floats[i + 1] = (outline[k + 1] - c.y) * c.scale;
        octets.set([red, green, blue, strength], 4 * i + 8);
      }
    };
    for (const item of this.fading) put(item, kGone, 40, 90, 220, 90);
    for (const item of this.fresh.values()) put(item, kFade, 255, 140, 0, 150);
    gl.useProgram(at.program);
    gl.bindVertexArray(null);
    gl.uniform2f(at.half_size, this.width / 2, this.height / 2);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.fade_buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STREAM_DRAW);
    const place = this.attribute(at, 'at', 2, gl.FLOAT, 12, 0);
    const tint = gl.getAttribLocation(at.program, 'tint');
    gl.enableVertexAttribArray(tint);
    gl.vertexAttribPointer(tint, 4, gl.UNSIGNED_BYTE, true, 12, 8);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.drawArrays(gl.TRIANGLES, 0, 3 * count);
    gl.disable(gl.BLEND);
    this.end([place, tint]);
  }

  // --- Picking ---------------------------------------------------------------------------------

  // The point of the input nearest to a position on the page: its id, or null.
  pick_point(x, y, reach = kReach) {
    const [px, py] = this.place(x, y), r = reach * this.pixel();
    let best = r * r, found = null;
    for (const tile of this.points.within([px - r, py - r, px + r, py + r])) {
      for (const n of this.points.items(tile)) {
        const [qx, qy] = this.mesh.points.get(this.point_ids[n]);
        const d = (qx - px) ** 2 + (qy - py) ** 2;
        if (d < best) [best, found] = [d, this.point_ids[n]];
      }
    }
    return found;
  }

  // The line whose edge is nearest.
  pick_line(x, y) {
    const [px, py] = this.place(x, y), r = kReach * this.pixel();
    let best = r * r, found = null;
    for (const tile of this.edges.within([px - r, py - r, px + r, py + r])) {
      for (const e of this.edges.items(tile)) {
        const a = 2 * this.mesh.edges[2 * e], b = 2 * this.mesh.edges[2 * e + 1];
        const p = this.mesh.places;
        const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1];
        const vx = px - p[a], vy = py - p[a + 1];
        const t = Math.min(1, Math.max(0, (ux * vx + uy * vy) / (ux * ux + uy * uy)));
        const d = (vx - t * ux) ** 2 + (vy - t * uy) ** 2;
        if (d < best) [best, found] = [d, this.mesh.edge_lines[e]];
      }
    }
    return found;
  }
}
