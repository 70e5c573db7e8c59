// The mesh in arrays by slot, as the server has it, with the quality of each simplex.

const DEGREES = 180 / Math.PI;
export const FREE = 255;  // the label of a free slot
const NONE = 0xffffffff;
const kOctaves = 1024, kFirstOctave = -640;  // of areas and volumes that coordinates allow

// An array that has at least `size` items, with what it had.
function grown(array, size) {
  if (array.length >= size) return array;
  const larger = new array.constructor(Math.max(size, Math.ceil(array.length * 1.5)));
  larger.set(array);
  return larger;
}

export class Mesh {
  // marks: called with this and a slot; 0 if it is not marked.
  constructor(head, arrays, marks) {
    this.marks = marks;
    this.dimension = head.dimension;
    this.corners = head.dimension + 1;
    this.rho = head.rho;
    this.lo = head.lo;
    this.hi = head.hi;
    this.box_measure = this.lo.reduce((sum, low, i) => sum + Math.log2(this.hi[i] - low), 0);  // log2
    this.places = arrays.places.slice();
    this.simplices = arrays.simplices.slice();
    this.labels = arrays.labels.slice();
    this.slots = this.labels.length;
    this.edges = arrays.edges.slice();
    this.edge_lines = arrays.edge_lines.slice();
    this.edge_slots = this.edge_lines.length;
    if (this.dimension === 3) {
      this.neighbours = arrays.neighbours.slice();
      this.faces = arrays.faces.slice();
      this.face_polygons = arrays.face_polygons.slice();
    }
    this.angle = new Float32Array(this.slots);  // the smallest, in degrees; in space dihedral
    this.ratio = new Float32Array(this.slots);  // circumradius over shortest edge
    this.measure = new Float32Array(this.slots);  // log2 of area or volume
    // Of what is kept:
    this.bins = new Uint32Array(this.dimension === 2 ? 60 : 72);  // by degrees of `angle`
    this.octaves = new Uint32Array(kOctaves);  // by whole numbers of `measure`
    this.marked = 0;
    this.parts = new Map();  // of lines and polygons, as they were asked for
    this.points = new Map();  // of the input: id -> place
    this.take_points(arrays);
    for (let s = 0; s < this.slots; ++s) {
      if (this.labels[s] === FREE) continue;
      this.judge(s);
      if (this.labels[s] !== 0) this.count(s, 1);
    }
  }

  is_live(s) { return s < this.slots && this.labels[s] !== FREE; }
  is_kept(s) { return this.labels[s] !== 0 && this.labels[s] !== FREE; }
  is_forced(s) { return this.ratio[s] > this.rho * (1 + 1e-6); }
  bin(s) { return Math.min(this.bins.length - 1, Math.max(0, Math.floor(this.angle[s]))); }
  count(s, by) {
    this.bins[this.bin(s)] += by;
    const octave = Math.floor(this.measure[s]) - kFirstOctave;
    this.octaves[Math.min(kOctaves - 1, Math.max(0, octave))] += by;
    if (this.marks(this, s) !== 0) this.marked += by;
  }
  // After what is marked has changed.
  count_marked() {
    this.marked = 0;
    for (let s = 0; s < this.slots; ++s) if (this.marks(this, s) !== 0) ++this.marked;
  }
  // The octaves between which all that is kept lies, as log2 of area or volume.
  sizes() {
    const low = this.octaves.findIndex((count) => count > 0);
    if (low < 0) return [0, 1];
    return [low + kFirstOctave, this.octaves.findLastIndex((count) => count > 0) + 1 + kFirstOctave];
  }

  take_points(arrays) {
    const d = this.dimension;
    for (let i = 0; i < arrays.point_ids.length; ++i) {
      this.points.set(arrays.point_ids[i], Array.from(arrays.point_places.subarray(i * d, i * d + d)));
    }
  }

  judge(s) { this.dimension === 2 ? this.judge_triangle(s) : this.judge_tetrahedron(s); }

  judge_triangle(s) {
    const p = this.places, t = this.simplices;
    const a = 2 * t[3 * s], b = 2 * t[3 * s + 1], c = 2 * t[3 * s + 2];
    const abx = p[b] - p[a], aby = p[b + 1] - p[a + 1];
    const acx = p[c] - p[a], acy = p[c + 1] - p[a + 1];
    const bcx = acx - abx, bcy = acy - aby;
    const ab = abx * abx + aby * aby, ac = acx * acx + acy * acy, bc = bcx * bcx + bcy * bcy;
    const twice = abx * acy - aby * acx;
    // The smallest angle is across from the shortest edge.
    const least = Math.min(ab, ac, bc);
    const cosine = (ab + ac + bc - 2 * least) / 2;  // times the product of the two edges
    this.angle[s] = Math.atan2(Math.abs(twice), cosine) * DEGREES;
    this.ratio[s] = Math.sqrt(ab * ac * bc) / (2 * Math.abs(twice)) / Math.sqrt(least);
    this.measure[s] = Math.log2(Math.abs(twice) / 2);
  }

  judge_tetrahedron(s) {
    const p = this.places, t = this.simplices;
    const at = (k) => { const v = 3 * t[4 * s + k]; return [p[v], p[v + 1], p[v + 2]]; };
    const x = [at(0), at(1), at(2), at(3)];
    const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
      a[0] * b[1] - a[1] * b[0]];
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const u = minus(x[1], x[0]), v = minus(x[2], x[0]), w = minus(x[3], x[0]);
    // Normals of the faces across from each corner, outward or all inward.
    const n = [cross(minus(x[2], x[1]), minus(x[3], x[1])), cross(w, v), cross(u, w), cross(v, u)];
    const six = Math.abs(dot(u, cross(v, w)));
    let smallest = 180;
    for (let i = 0; i < 4; ++i) {
      for (let k = i + 1; k < 4; ++k) {
        const c = -dot(n[i], n[k]) / Math.sqrt(dot(n[i], n[i]) * dot(n[k], n[k]));
        smallest = Math.min(smallest, Math.acos(Math.min(1, Math.max(-1, c))) * DEGREES);
      }
    }
    this.angle[s] = smallest;
    const uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    const a = cross(v, w), b = cross(w, u), c = cross(u, v);
    const r = [0, 1, 2].map((i) => uu * a[i] + vv * b[i] + ww * c[i]);
    const e = minus(x[2], x[1]), f = minus(x[3], x[1]), g = minus(x[3], x[2]);
    const shortest = Math.sqrt(Math.min(uu, vv, ww, dot(e, e), dot(f, f), dot(g, g)));
    this.ratio[s] = Math.sqrt(dot(r, r)) / (2 * six) / shortest;
    this.measure[s] = Math.log2(six / 6);
  }

  // The coordinates of the corners of a simplex, one after the other.
  outline(s) {
    const d = this.dimension, n = this.corners, out = [];
    for (let k = 0; k < n; ++k) {
      const v = d * this.simplices[n * s + k];
      for (let i = 0; i < d; ++i) out.push(this.places[v + i]);
    }
    return out;
  }

  place(vertex) {
    const d = this.dimension;
    return Array.from(this.places.subarray(d * vertex, d * vertex + d));
  }

  // Slots whose number in `owners` is `id`. Found anew after a change, at the cost of all.
  slots_of(name, owners, id) {
    const key = name + id;
    if (!this.parts.has(key)) {
      const slots = [];
      for (let s = 0; s < owners.length; ++s) if (owners[s] === id) slots.push(s);
      this.parts.set(key, slots);
    }
    return this.parts.get(key);
  }
  // The edges of a line, as pairs of vertices.
  line_edges(id) {
    return this.slots_of('line', this.edge_lines, id)
      .map((e) => [this.edges[2 * e], this.edges[2 * e + 1]]);
  }
  // The faces of a polygon, as triples of vertices.
  polygon_faces(id) {
    if (this.dimension === 2) return [];
    return this.slots_of('polygon', this.face_polygons, id)
      .map((f) => Array.from(this.faces.subarray(3 * f, 3 * f + 3)));
  }
  // Edges that one face has alone.
  static outline_of(faces) {
    const edges = new Map();
    for (const face of faces) {
      for (let k = 0; k < 3; ++k) {
        const edge = [face[k], face[(k + 1) % 3]].sort((a, b) => a - b);
        if (!edges.delete(edge.join())) edges.set(edge.join(), edge);
      }
    }
    return Array.from(edges.values());
  }

  // Applies a change. `store` follows: it is told what goes before, and what came after.
  apply(head, arrays, store) {
    this.parts.clear();
    const n = this.corners, d = this.dimension;
    for (const s of arrays.simplices_removed) {
      if (this.is_kept(s)) this.count(s, -1);
      store.simplex_goes(s);
      this.labels[s] = FREE;
    }
    for (const e of arrays.edges_removed) {
      store.edge_goes(e);
      this.edge_lines[e] = NaN;
    }
    const largest = (slots) => slots.reduce((a, b) => Math.max(a, b), -1) + 1;
    this.places = grown(this.places, d * largest(arrays.vertices_added));
    arrays.vertices_added.forEach((v, i) => {
      this.places.set(arrays.places.subarray(d * i, d * i + d), d * v);
    });
    const slots = largest(arrays.simplices_added);
    if (slots > this.slots) {
      const before = this.slots;
      this.slots = slots;
      for (const name of ['labels', 'angle', 'ratio', 'measure']) {
        this[name] = grown(this[name], slots);
      }
      this.labels.fill(FREE, before, this.labels.length);
      this.simplices = grown(this.simplices, n * slots);
      if (d === 3) this.neighbours = grown(this.neighbours, n * slots);
    }
    arrays.simplices_added.forEach((s, i) => {
      this.simplices.set(arrays.simplices.subarray(n * i, n * i + n), n * s);
      this.labels[s] = arrays.labels[i];
      this.judge(s);
      if (this.is_kept(s)) this.count(s, 1);
    });
    if (d === 3) this.take_neighbours(arrays);
    arrays.simplices_added.forEach((s) => store.simplex_came(s));
    arrays.relabelled.forEach((s, i) => {
      if (this.labels[s] === arrays.new_labels[i]) return;
      if (this.is_kept(s)) this.count(s, -1);
      store.simplex_goes(s, true);
      this.labels[s] = arrays.new_labels[i];
      if (this.is_kept(s)) this.count(s, 1);
      store.simplex_came(s, true);
    });
    const edge_slots = largest(arrays.edges_added);
    if (edge_slots > this.edge_slots) {
      const before = this.edge_slots;
      this.edge_slots = edge_slots;
      this.edges = grown(this.edges, 2 * edge_slots);
      this.edge_lines = grown(this.edge_lines, edge_slots);
      this.edge_lines.fill(NaN, before, this.edge_lines.length);
    }
    arrays.edges_added.forEach((e, i) => {
      this.edges.set(arrays.edges.subarray(2 * i, 2 * i + 2), 2 * e);
      this.edge_lines[e] = arrays.edge_lines[i];
      store.edge_came(e);
    });
    if (d === 3) this.take_faces(arrays, largest(arrays.faces_added));
    for (const id of arrays.points_removed) {
      store.point_goes(id);
      this.points.delete(id);
    }
    for (const id of arrays.point_ids) {
      if (this.points.has(id)) store.point_goes(id);
    }
    this.take_points(arrays);
    for (const id of arrays.point_ids) store.point_came(id);
  }

  take_neighbours(arrays) {
    arrays.simplices_added.forEach((s, i) => {
      this.neighbours.set(arrays.neighbours.subarray(4 * i, 4 * i + 4), 4 * s);
    });
    // What stays beside what came: the side whose far corner the new one does not have.
    for (const s of arrays.simplices_added) {
      const own = this.simplices.subarray(4 * s, 4 * s + 4);
      for (let k = 0; k < 4; ++k) {
        const t = this.neighbours[4 * s + k];
        if (t === NONE) continue;
        for (let j = 0; j < 4; ++j) {
          if (!own.includes(this.simplices[4 * t + j])) this.neighbours[4 * t + j] = s;
        }
      }
    }
  }

  take_faces(arrays, slots) {
    for (const f of arrays.faces_removed) this.face_polygons[f] = NaN;
    if (slots > this.face_polygons.length) {
      const before = this.face_polygons.length;
      this.face_polygons = grown(this.face_polygons, slots);
      this.face_polygons.fill(NaN, before, this.face_polygons.length);
      this.faces = grown(this.faces, 3 * this.face_polygons.length);
    }
    arrays.faces_added.forEach((f, i) => {
      this.faces.set(arrays.faces.subarray(3 * i, 3 * i + 3), 3 * f);
      this.face_polygons[f] = arrays.face_polygons[i];
    });
  }
}
