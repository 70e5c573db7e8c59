// Items of a plane (triangles, edges, points) in one large buffer, in tiles that are near together.
//
// Items are sorted once along the Morton curve and cut into tiles of kFill items; a tile has room for
// kRoom. What comes goes to the tile of its place on the curve, which is split when it is full; what
// goes leaves its place to the last of its tile. Positions in the buffer are relative to the tile's
// origin: 32 bits are enough at any zoom.

const kRoom = 512, kFill = 384;
const NOWHERE = 0xffffffff;

function spread(x) {  // 16 bits to every second of 32
  x = (x | x << 8) & 0x00ff00ff;
  x = (x | x << 4) & 0x0f0f0f0f;
  x = (x | x << 2) & 0x33333333;
  return (x | x << 1) & 0x55555555;
}

export class Tiles {
  // `bytes`: of an item. `write(item, origin, floats, bytes, at)`: puts it at word `at` of both views.
  // `bounds(item, out)`: its box. Items are numbers from 0 on.
  constructor(gl, {bytes, write, bounds, lo, hi}) {
    Object.assign(this, {gl, bytes, write, bounds, lo});
    this.scale = 65535 / Math.max(hi[0] - lo[0], hi[1] - lo[1]);
    this.box = [0, 0, 0, 0];
    this.tiles = [];  // ascending by key
    this.made = [];   // by place in the buffer
    this.place_of = new Uint32Array(0).fill(NOWHERE);
    this.item_at = new Uint32Array(0);
    this.buffer = gl.createBuffer();
    this.capacity = 0;  // in tiles
    this.scratch = new ArrayBuffer(kRoom * bytes);
    this.floats = new Float32Array(this.scratch);
    this.octets = new Uint8Array(this.scratch);
    this.dirty = new Set();
  }

  key(item) {
    this.bounds(item, this.box);
    const x = Math.min(65535, Math.max(0, ((this.box[0] + this.box[2]) / 2 - this.lo[0]) * this.scale));
    const y = Math.min(65535, Math.max(0, ((this.box[1] + this.box[3]) / 2 - this.lo[1]) * this.scale));
    return (spread(x | 0) | spread(y | 0) << 1) >>> 0;
  }

  build(items) {
    const bits = Math.max(1, Math.ceil(Math.log2(items.length + 1)));
    const drop = Math.max(0, 32 - (52 - bits)), span = 2 ** bits;
    const sorted = new Float64Array(items.length);
    for (let i = 0; i < items.length; ++i) {
      sorted[i] = (this.key(items[i]) >>> drop) * span + i;
    }
    sorted.sort();
    for (let from = 0; from < sorted.length || this.tiles.length === 0; from += kFill) {
      const part = [];
      for (let i = from; i < Math.min(from + kFill, sorted.length); ++i) {
        part.push(items[sorted[i] % span]);
      }
      const first = this.tiles.length === 0;
      this.tiles.push(this.new_tile(first ? 0 : this.key(part[0]), part));
    }
    this.flush();
  }

  new_tile(key, items) {
    const tile = {key, at: this.made.length, count: 0, box: [Infinity, Infinity, -Infinity, -Infinity],
      origin: null, from: 0, to: 0};
    this.made.push(tile);
    const room = this.made.length * kRoom;
    if (this.item_at.length < room) {
      const larger = new Uint32Array(Math.ceil(room * 1.5));
      larger.set(this.item_at);
      this.item_at = larger;
    }
    for (const item of items) this.put(tile, item);
    return tile;
  }

  put(tile, item) {
    this.bounds(item, this.box);
    const [x0, y0, x1, y1] = this.box, box = tile.box;
    box[0] = Math.min(box[0], x0);
    box[1] = Math.min(box[1], y0);
    box[2] = Math.max(box[2], x1);
    box[3] = Math.max(box[3], y1);
    if (!tile.origin) tile.origin = [x0, y0];
    if (item >= this.place_of.length) {
      const larger = new Uint32Array(Math.ceil((item + 1) * 1.5)).fill(NOWHERE);
      larger.set(this.place_of);
      this.place_of = larger;
    }
    const i = tile.count++;
    this.item_at[tile.at * kRoom + i] = item;
    this.place_of[item] = tile.at * kRoom + i;
    this.touch(tile, i);
  }

  touch(tile, i) {
    if (tile.from === tile.to) [tile.from, tile.to] = [i, i + 1];
    tile.from = Math.min(tile.from, i);
    tile.to = Math.max(tile.to, i + 1);
    this.dirty.add(tile);
  }

  tile_of(key) {
    let low = 0, high = this.tiles.length;
    while (high - low > 1) {
      const middle = low + high >> 1;
      if (this.tiles[middle].key <= key) low = middle; else high = middle;
    }
    return low;
  }

  has(item) { return item < this.place_of.length && this.place_of[item] !== NOWHERE; }

  add(item) {
    const key = this.key(item);
    let number = this.tile_of(key);
    if (this.tiles[number].count === kRoom) {
      this.split(number);
      number = this.tile_of(key);
    }
    if (this.tiles[number].count < kRoom) return this.put(this.tiles[number], item);
    // All of one key: a tile more beside it.
    this.tiles.splice(number + 1, 0, this.new_tile(key, [item]));
  }

  split(number) {
    const tile = this.tiles[number];
    const items = [];
    for (let i = 0; i < tile.count; ++i) items.push(this.item_at[tile.at * kRoom + i]);
    const keys = new Map(items.map((item) => [item, this.key(item)]));
    items.sort((a, b) => keys.get(a) - keys.get(b));
    let half = items.length >> 1;
    while (half < items.length && keys.get(items[half]) === keys.get(items[half - 1])) ++half;
    if (half === items.length) return;
    tile.count = 0;
    tile.box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const item of items.slice(0, half)) this.put(tile, item);
    this.tiles.splice(number + 1, 0,
      this.new_tile(keys.get(items[half]), items.slice(half)));
  }

  remove(item) {
    if (!this.has(item)) return;
    const place = this.place_of[item];
    const tile = this.made[Math.floor(place / kRoom)];
    const last = tile.at * kRoom + --tile.count;
    this.place_of[item] = NOWHERE;
    if (place === last) return;
    const moved = this.item_at[last];
    this.item_at[place] = moved;
    this.place_of[moved] = place;
    this.touch(tile, place % kRoom);
  }

  // What is in the buffer is to be written again: colours have changed.
  rewrite(item) {
    if (!this.has(item)) return;
    const place = this.place_of[item];
    this.touch(this.made[Math.floor(place / kRoom)], place % kRoom);
  }
  rewrite_all() {
    for (const tile of this.made) {
      if (tile.count > 0) [tile.from, tile.to] = [0, tile.count];
      this.dirty.add(tile);
    }
  }

  // Brings what has changed into the buffer.
  flush() {
    const gl = this.gl;
    if (this.dirty.size === 0) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    if (this.made.length > this.capacity) {
      this.capacity = Math.ceil(this.made.length * 1.3) + 4;
      gl.bufferData(gl.ARRAY_BUFFER, this.capacity * kRoom * this.bytes, gl.DYNAMIC_DRAW);
      this.rewrite_all();
    }
    for (const tile of this.dirty) {
      const from = tile.from, to = Math.min(tile.to, tile.count);
      tile.from = tile.to = 0;
      if (from >= to) continue;
      for (let i = from; i < to; ++i) {
        this.write(this.item_at[tile.at * kRoom + i], tile.origin, this.floats, this.octets,
          (i - from) * this.bytes / 4);
      }
      gl.bufferSubData(gl.ARRAY_BUFFER, (tile.at * kRoom + from) * this.bytes, this.octets, 0,
        (to - from) * this.bytes);
    }
    this.dirty.clear();
  }

  // The tiles that touch a box.
  within([x0, y0, x1, y1]) {
    return this.made.filter(({box, count}) =>
      count > 0 && box[0] <= x1 && box[2] >= x0 && box[1] <= y1 && box[3] >= y0);
  }
  // Where a tile's items begin in the buffer, in items.
  first(tile) { return tile.at * kRoom; }
  *items(tile) {
    for (let i = 0; i < tile.count; ++i) yield this.item_at[tile.at * kRoom + i];
  }
}
