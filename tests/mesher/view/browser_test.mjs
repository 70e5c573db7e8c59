// mesher view in headless Chromium: what people do with it, and how fast it follows.
//
//   node browser_test.mjs TOOL DATA SCRATCH [PICTURES]
//
// Needs the npm package playwright-core (NODE_PATH or beside), and Chromium (CHROMIUM, or in PATH).
// PICTURES: a folder for screenshots. FIGURES=1: measures drags of meshes up to 10^6 points, too.
// PAGES: a folder with page files to be used instead of the tool's, which needs no build then.

import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';

const [tool, data, scratch, pictures] = process.argv.slice(2).map((p) => path.resolve(p));
const folder = path.join(scratch, 'browser_test');
fs.rmSync(folder, {recursive: true, force: true});
fs.mkdirSync(folder, {recursive: true});
process.chdir(folder);

const require = createRequire(import.meta.url);
const {chromium} = require(process.env.PLAYWRIGHT || 'playwright-core');
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--ignore-gpu-blocklist',
    // Pages that are not from the server may not connect to it otherwise.
    ...process.env.PAGES ? ['--disable-features=LocalNetworkAccessChecks'] : []],
});

// --- Servers and pages -----------------------------------------------------------------------

const servers = [];
async function serve(...args) {
  const child = spawn(tool, ['view', ...args], {stdio: ['ignore', 'pipe', 'pipe']});
  servers.push(child);
  let said = '';
  child.stderr.on('data', (text) => { said += text; });
  const address = await new Promise((done, failed) => {
    child.stdout.once('data', (text) => done(String(text).trim()));
    child.once('exit', () => failed(new Error(said)));
  });
  return {child, address, port: new URL(address).port, said: () => said,
    end: (signal = 'SIGINT') => new Promise((done) => {
      child.once('exit', done);
      child.kill(signal);
    })};
}

const until = async (what, holds, seconds = 30) => {
  for (const end = Date.now() + seconds * 1000; Date.now() < end;) {
    if (await holds()) return;
    await new Promise((done) => setTimeout(done, 40));
  }
  assert.fail('this did not happen: ' + what);
};

const faults = [];
async function open(server, size = {width: 1280, height: 800}) {
  const page = await browser.newPage({viewport: size});
  page.on('pageerror', (error) => faults.push(error.stack));
  page.on('console', (message) => {
    if (message.type() === 'error' && !/WebSocket/.test(message.text())) faults.push(message.text());
  });
  if (process.env.PAGES) {
    await page.route(/\/[0-9a-f]+\/(\w+\.(js|css))?$/, (route) => route.fulfill({path:
      path.join(process.env.PAGES, path.basename(new URL(route.request().url()).pathname)
        .replace(/^[0-9a-f]{32}$/, 'page.html'))}));
  }
  await page.goto(server.address);
  await quiet(page);
  return page;
}
const quiet = (page) => until('the page is quiet', () => page.evaluate(() =>
  Boolean(window.mesher && window.mesher.mesh && !window.mesher.busy)), 120);
const state = (page) => page.evaluate(() => window.mesher.state);
const point = (page, id) => page.evaluate((n) => window.mesher.mesh.points.get(n), id);
// Where a place of the mesh is in the window.
const at = (page, place) => page.evaluate((p) => {
  const box = document.getElementById('scene').getBoundingClientRect();
  const [x, y] = window.mesher.view.on_page(p);
  return [x + box.left, y + box.top];
}, place);
const click = async (page, place, times = 1) => {
  const [x, y] = await at(page, place);
  await page.mouse.click(x, y, {clickCount: times});
};
const tool_of = (page, name) => page.click('#tool_' + name);
async function pull(page, from, to, steps = 8) {
  const [x0, y0] = await at(page, from), [x1, y1] = await at(page, to);
  await page.mouse.move(x0, y0);
  await page.mouse.down();
  for (let i = 1; i <= steps; ++i) {
    await page.mouse.move(x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps);
    await page.waitForTimeout(15);
  }
  await page.mouse.up();
  await quiet(page);
}
const shot = async (page, name) => {
  if (!pictures) return;
  fs.mkdirSync(pictures, {recursive: true});
  await page.screenshot({path: path.join(pictures, name + '.png')});
};
async function saved(page, selector) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click(selector)]);
  return fs.readFileSync(await download.path());
}
// The colour of the picture at a place, of the next frame.
const pixel = (page, place) => page.evaluate((p) => new Promise((done) => {
  requestAnimationFrame(() => {
    const {view} = window.mesher, gl = view.gl;
    view.frame(performance.now());
    const [x, y] = view.on_page(p), out = new Uint8Array(4);
    gl.readPixels(x * view.ratio, view.height - y * view.ratio, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, out);
    done(Array.from(out));
  });
}), place);

// The mean colour of the picture around a place.
const patch = (page, place, reach = 10) => page.evaluate(([p, r]) => new Promise((done) => {
  requestAnimationFrame(() => {
    const {view} = window.mesher, gl = view.gl, side = 2 * r + 1;
    view.frame(performance.now());
    const [x, y] = view.on_page(p), out = new Uint8Array(4 * side * side);
    gl.readPixels(x * view.ratio - r, view.height - y * view.ratio - r, side, side, gl.RGBA,
      gl.UNSIGNED_BYTE, out);
    done([0, 1, 2].map((c) => out.reduce((sum, v, i) => sum + (i % 4 === c ? v : 0), 0) / side ** 2));
  });
}), [place, reach]);
// The colour of what is drawn over the picture, with its opacity.
const mark = (page, place) => page.evaluate((p) => {
  const {view} = window.mesher, canvas = document.getElementById('marks');
  if (canvas.style.visibility === 'hidden') return [0, 0, 0, 0];
  const [x, y] = view.on_page(p).map((c) => Math.round(c * view.ratio));
  return Array.from(canvas.getContext('2d').getImageData(x, y, 1, 1).data);
}, place);
const is_near = (colour, wanted, most = 60) => colour.every((c, i) =>
  i > 2 || Math.abs(c - wanted[i]) < most);
const ORANGE = [224, 122, 0], RED = [200, 16, 46];
const command = async (page, what) => {
  await page.evaluate((c) => window.mesher.command(c), what);
  await quiet(page);
};
const problems = (page) => page.evaluate(() => window.mesher.problems);
// Cells of the table of the last update.
const figures_of = (page) => page.evaluate(() => Array.from(
  document.querySelectorAll('#update tr'), (row) => Array.from(row.cells, (c) => c.textContent)));

const tests = {};

// --- Tests -----------------------------------------------------------------------------------

const SQUARE = '4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 1\n1 1 2 1\n2 2 3 2\n3 3 4 3\n4 4 1 4\n0\n';

tests['drag, draw, undo, errors and saving'] = async () => {
  fs.writeFileSync('square.poly', SQUARE);
  const server = await serve('square.poly');
  const page = await open(server);
  assert.equal((await state(page)).updates, 0);

  await tool_of(page, 'point');
  await click(page, [0.3, 0.4]);
  await quiet(page);
  const made = await point(page, 5);
  assert.ok(Math.hypot(made[0] - 0.3, made[1] - 0.4) < 0.01, String(made));

  await tool_of(page, 'move');
  const before = await state(page);
  await pull(page, made, [0.6, 0.55]);
  const moved = await point(page, 5);
  assert.ok(Math.hypot(moved[0] - 0.6, moved[1] - 0.55) < 0.01, String(moved));
  assert.equal((await state(page)).updates, before.updates + 1);
  assert.ok((await state(page)).revision > before.revision + 1, 'it followed on the way');

  await tool_of(page, 'segment');
  await click(page, [0.2, 0.2]);
  await click(page, [0.4, 0.25]);
  await quiet(page);
  await tool_of(page, 'polyline');
  for (const p of [[0.2, 0.7], [0.3, 0.8], [0.4, 0.7]]) await click(page, p);
  await page.keyboard.press('Enter');
  await quiet(page);
  await tool_of(page, 'polygon');
  for (const p of [[0.6, 0.7], [0.85, 0.72], [0.8, 0.9]]) await click(page, p);
  await page.keyboard.press('Enter');
  await quiet(page);
  await tool_of(page, 'region');
  await page.fill('#attribute', '3');
  await click(page, [0.75, 0.77]);
  await quiet(page);
  assert.deepEqual(await page.evaluate(() => window.mesher.seeds.map((s) => [s.kind, s.attribute])),
    [['region', 3]]);
  const kept = (await state(page)).kept;
  assert.equal((await state(page)).updates, 6);

  // A hole: what it encloses is no longer kept, and no longer painted.
  await page.keyboard.press('Control+z');
  await until('undo', async () => (await state(page)).updates === 7);
  await tool_of(page, 'hole');
  await click(page, [0.75, 0.77]);
  await quiet(page);
  assert.ok((await state(page)).kept < kept);
  await page.waitForTimeout(1500);
  const [r, g, b] = await pixel(page, [0.76, 0.8]);
  assert.ok(Math.abs(r - 247) < 3 && Math.abs(g - 247) < 3 && Math.abs(b - 243) < 4, `${r} ${g} ${b}`);

  // What crosses is refused where it crosses; what was drawn is not lost.
  await tool_of(page, 'segment');
  await click(page, [0.3, 0.1]);
  await click(page, [0.3, 0.3]);
  await quiet(page);
  const problem = await page.evaluate(() => window.mesher.problems[0]);
  assert.match(problem.text, /cross/);
  assert.ok(Math.hypot(problem.places[0][0] - 0.3, problem.places[0][1] - 0.225) < 0.02);
  assert.equal((await page.evaluate(() => window.mesher.draft)).length, 2);
  await shot(page, 'square_error');
  await page.keyboard.press('Escape');

  // Undo until nothing is left gives the first mesh again; redo gives the last.
  const last = await state(page);
  while ((await state(page)).undo > 0) {
    const {undo} = await state(page);
    await page.click('#undo');
    await until('undo', async () => (await state(page)).undo < undo);
  }
  assert.equal(await page.evaluate(() => window.mesher.mesh.points.size), 4);
  while ((await state(page)).redo > 0) {
    const {redo} = await state(page);
    await page.click('#redo');
    await until('redo', async () => (await state(page)).redo < redo);
  }
  assert.equal((await state(page)).simplices, last.simplices);
  await quiet(page);

  // Snapped to a grid, of a power of ten.
  await tool_of(page, 'point');
  await page.click('#snap');
  await click(page, [0.504, 0.117]);
  await quiet(page);
  const snapped = await page.evaluate(() =>
    window.mesher.mesh.points.get(Math.max(...window.mesher.mesh.points.keys())));
  assert.deepEqual(snapped, [0.5, 0.12]);
  await page.click('#snap');

  // Delete: of a point with its lines.
  await tool_of(page, 'delete');
  const corner = await page.evaluate(() => Array.from(window.mesher.mesh.points).find(([, p]) =>
    Math.hypot(p[0] - 0.3, p[1] - 0.8) < 0.02)[1]);
  await click(page, corner);
  await quiet(page);
  assert.equal(await page.evaluate(() => window.mesher.mesh.edge_lines.includes(6)), false);

  // What is saved is what `mesher edit` makes of the script.
  const script = await saved(page, '#save_script');
  fs.writeFileSync('edits.txt', script);
  for (const format of ['vtu', 'msh', 'obj']) {
    await page.selectOption('#format', format);
    execFileSync(tool, ['edit', 'square.poly', '--script', 'edits.txt', '-o', 'own.' + format,
      '--quiet']);
    assert.deepEqual(await saved(page, '#save'), fs.readFileSync('own.' + format), format);
  }
  await page.click('#fresh');
  await until('a fresh run', () => page.evaluate(() =>
    document.getElementById('fresh_result').textContent.includes('the same mesh')));

  // A page that is loaded again shows the same.
  const counts = await state(page);
  await page.reload();
  await quiet(page);
  assert.deepEqual(await state(page), counts);
  await page.close();
  assert.equal(await server.end(), 0);
};

tests['colours of sizes follow edits'] = async () => {
  fs.writeFileSync('sizes.poly', SQUARE);
  const server = await serve('sizes.poly');
  const page = await open(server);
  await page.click('#changes');
  await page.click('input[value=size]');
  const places = [[0.15, 0.15], [0.85, 0.85], [0.2, 0.8]];
  const colours = async () => {
    await page.waitForTimeout(200);
    await quiet(page);
    const all = [];
    for (const place of places) all.push(await patch(page, place));
    return all;
  };
  const scale = () => page.evaluate(() => document.getElementById('scale').textContent);
  const first = [await colours(), await scale()];
  await command(page, {do: 'limit', largest: 0.03});
  await command(page, {do: 'limit', largest: 2e-5, box: [[0, 0], [0.3, 0.3]]});
  await command(page, {do: 'limit', largest: 1e-3, box: [[0.7, 0.7], [1, 1]]});
  const last = await colours();
  await shot(page, 'sizes');
  for (let i = 0; i < 3; ++i) {
    const away = Math.hypot(...last[i].map((c, k) => c - last[(i + 1) % 3][k]));
    assert.ok(away > 60, `${i}: ${last.join(' | ')}`);
  }
  // Small ones are dark, large ones pale.
  assert.ok(last[0][0] < 90 && last[2][0] > 120, last.join(' | '));
  const [least, most] = await page.evaluate(() => {
    const m = window.mesher.mesh, areas = [];
    for (let s = 0; s < m.slots; ++s) if (m.is_kept(s)) areas.push(2 ** m.measure[s]);
    return [Math.min(...areas), Math.max(...areas)];
  });
  const [, from, to] = (await scale()).match(/^area from (\S+) to (\S+)$/).map(Number);
  assert.ok(from <= least * 1.1 && 2.2 * from > least && to >= most * 0.9 && to < 2.2 * most,
    `${from} ${least} ${most} ${to}`);
  for (let i = 0; i < 3; ++i) await command(page, {do: 'undo'});
  assert.deepEqual([await colours(), await scale()], first);
  await page.close();
  await server.end();
};

tests['what is marked is counted after edits, and visited'] = async () => {
  fs.writeFileSync('marked.poly', SQUARE);
  const server = await serve('marked.poly');
  const page = await open(server);
  // By itself, from the corners alone: which triangles have an angle below that.
  const below = (degrees) => page.evaluate((most) => {
    const m = window.mesher.mesh, found = [];
    for (let s = 0; s < m.slots; ++s) {
      if (!m.is_kept(s)) continue;
      const p = m.outline(s), side = (i, k) => Math.hypot(p[2 * i] - p[2 * k], p[2 * i + 1] - p[2 * k + 1]);
      const [a, b, c] = [side(0, 1), side(1, 2), side(2, 0)].sort((x, y) => x - y);
      const angle = Math.acos((b * b + c * c - a * a) / (2 * b * c)) * 180 / Math.PI;
      if (angle < most) found.push(p);
    }
    return found;
  }, degrees);
  const told = async () => {
    await page.waitForTimeout(200);
    await quiet(page);
    return page.evaluate(() => document.getElementById('marked').textContent);
  };
  const bound = await page.evaluate(() =>
    Math.asin(1 / (2 * window.mesher.mesh.rho)) * 180 / Math.PI);
  const agrees = async (degrees) => {
    const count = (await below(degrees)).length;
    assert.equal(await told(), count + ' marked');
    return count;
  };
  assert.equal(await told(), '');
  await page.fill('#below', '35');
  await page.press('#below', 'Tab');
  await page.click('#poor');
  const counts = [await agrees(35)];
  await command(page, {do: 'line', through: [1, [0.9, 0.05]]});  // 3 degrees
  counts.push(await agrees(35));
  await command(page, {do: 'limit', largest: 0.002});
  counts.push(await agrees(35));
  await pull(page, [0.9, 0.05], [0.7, 0.3]);
  counts.push(await agrees(35));
  assert.ok(new Set(counts).size > 2, counts.join());
  await command(page, {do: 'undo'});
  assert.equal(await agrees(35), counts[2]);
  await page.click('#poor');
  assert.equal(await told(), '');
  await page.click('#forced');
  await agrees(bound - 1e-4);
  await command(page, {do: 'undo'});
  const forced = await agrees(bound - 1e-4);
  assert.ok(forced > 0 && forced < 40, `${forced} stay above the bound`);
  // All of them are visited, one after the other.
  const marked = (await below(bound - 1e-4)).map((p) => p.join());
  const visited = new Set();
  for (let i = 0; i < forced; ++i) {
    await page.click('#next_marked');
    visited.add(await page.evaluate(() => {
      const m = window.mesher.mesh, {x, y} = window.mesher.view.camera;
      for (let s = 0; s < m.slots; ++s) {
        if (!m.is_kept(s)) continue;
        const p = m.outline(s), signs = [0, 1, 2].map((k) => {
          const a = 2 * k, b = 2 * ((k + 1) % 3);
          return Math.sign((p[b] - p[a]) * (y - p[a + 1]) - (p[b + 1] - p[a + 1]) * (x - p[a]));
        });
        if (signs.every((sign) => sign === signs[0])) return p.join();
      }
      return null;
    }));
  }
  assert.deepEqual(Array.from(visited).sort(), marked.sort());
  await page.waitForTimeout(300);
  assert.ok(is_near(await patch(page, await page.evaluate(() => {
    const {x, y} = window.mesher.view.camera;
    return [x, y];
  }), 1), [199, 26, 128], 40), 'it has the colour of a mark');
  await shot(page, 'marked');
  await page.close();
  await server.end();
};

tests['a fresh run beside an update'] = async () => {
  fs.writeFileSync('fresh.poly', SQUARE);
  const server = await serve('fresh.poly');
  const page = await open(server);
  await command(page, {do: 'limit', largest: 0.001});
  await command(page, {do: 'point', at: [0.4, 0.45]});
  const alone = await figures_of(page);
  assert.ok(alone.every((row) => row.length === 2), JSON.stringify(alone));
  const fresh = async () => {
    await page.click('#fresh');
    await until('a fresh run', () => page.evaluate(() =>
      document.getElementById('fresh_result').textContent.includes('the same mesh')));
  };
  await fresh();
  const {vertices, simplices} = await state(page);
  const table = Object.fromEntries((await figures_of(page)).map(([name, ...rest]) => [name, rest]));
  assert.deepEqual(table[''], ['update', 'fresh run']);
  assert.match(table.time[1], /^[\d.]+ ms$/);
  assert.deepEqual(table['triangles that came, went'][1], `${simplices}, 0`);
  assert.deepEqual(table.vertices[1], `${vertices}, 0`);
  const calls = table['calls that ran, were reused'].map((text) => parseInt(text, 10));
  assert.ok(calls[0] > 0 && calls[1] > calls[0], calls.join());
  assert.deepEqual(alone.map((row) => row[1]).slice(1),
    Object.values(table).slice(2).map((rest) => rest[0]));
  await shot(page, 'fresh');
  await command(page, {do: 'point', at: [0.6, 0.45]});
  assert.deepEqual((await figures_of(page))[0], ['', 'update', 'earlier run']);
  await page.close();
  await server.end();
};

tests['an update without end is stopped, and a fresh run'] = async () => {
  fs.writeFileSync('stop.poly', SQUARE);
  const server = await serve('stop.poly');
  const [page, other] = [await open(server), await open(server)];
  const shows = (tab) => tab.isVisible('#under_way');
  assert.ok(!await shows(page));
  await page.fill('#limit_value', '0.00001');
  await page.click('#limit_all');
  for (const tab of [page, other]) await until('it is told', () => shows(tab));
  assert.match(await other.textContent('#under_way_text'), /has run for [0-9.]+ s, \d+ calls/);
  await shot(page, 'under_way');
  // A tab that is opened now has no mesh yet, but may stop it.
  const late = await browser.newPage({viewport: {width: 800, height: 600}});
  await late.goto(server.address);
  await until('it is told, too', () => shows(late));
  await tool_of(other, 'point');
  await click(other, [0.3, 0.4]);
  await late.click('#stop');
  for (const tab of [page, other, late]) await quiet(tab);
  for (const tab of [page, other, late]) {
    await until('it is over', async () => !await shows(tab));
    await until('the point', async () => await point(tab, 5) !== undefined);
    assert.equal((await state(tab)).updates, 1);
  }
  assert.match((await problems(page))[0].text, /stopped/);
  assert.deepEqual(await problems(other), []);

  await command(page, {do: 'limit', size: 0.004});
  await page.click('#fresh');
  await page.click('#stop_fresh');
  await until('the fresh run is stopped', async () => (await problems(page)).length === 2);
  assert.equal(await page.textContent('#fresh_result'), '');
  assert.ok(await page.isEnabled('#fresh') && !await page.isVisible('#stop_fresh'));
  await Promise.all([page, other, late].map((tab) => tab.close()));
  await server.end();
};

tests['errors are shown where they are'] = async () => {
  fs.writeFileSync('errors.poly', SQUARE);
  const server = await serve('errors.poly');
  const page = await open(server);
  await command(page, {do: 'line', through: [[0.2, 0.5], [0.8, 0.5]]});
  await command(page, {do: 'line', through: [[0.5, 0.6], [0.55, 0.8]]});
  assert.deepEqual(await mark(page, [0.7, 0.5]), [0, 0, 0, 0]);
  const [low, high] = await page.evaluate(() => Array.from(window.mesher.mesh.points)
    .filter(([, p]) => p[0] === 0.5 || p[0] === 0.55).map(([id]) => id));
  await pull(page, [0.5, 0.6], [0.5, 0.25], 14);
  const [problem, ...others] = await problems(page);
  assert.equal(others.length, 0, 'a drag is one error');
  assert.ok(problem.times > 2, `${problem.times} refusals`);
  assert.match(problem.text, /crosses/);
  assert.equal(problem.places.length, 1);
  assert.equal(await page.evaluate(() => document.querySelectorAll('#errors li').length), 1);
  assert.match(await page.textContent('#errors li'), /\(\d+ times in a drag\)/);
  assert.ok((await point(page, low))[1] > 0.5, 'it is where it was not refused');
  // The lines that it names are red, also where it is not.
  await page.keyboard.press('Escape');
  await quiet(page);
  assert.ok(is_near(await mark(page, [0.7, 0.5]), RED), 'the line that is crossed');
  const [a, b] = [await point(page, low), await point(page, high)];
  assert.ok(is_near(await mark(page, a.map((x, i) => 0.3 * x + 0.7 * b[i])), RED), 'the line that crosses');
  await shot(page, 'drag_error');
  // Another drag is another error; a click shows the first again.
  await pull(page, a, [0.5, 0.2], 6);
  await command(page, {do: 'line', through: [1, [0.3, -0.4]]});
  const texts = (await problems(page)).map((p) => p.text);
  assert.equal(texts.length, 3, texts.join('\n'));
  await page.click('#clear_errors');
  await quiet(page);
  assert.deepEqual(await mark(page, [0.7, 0.5]), [0, 0, 0, 0]);
  // A line that is selected is dragged as a whole.
  const line = [[0.2, 0.5], [0.8, 0.5]];
  const ids = await page.evaluate(() => Array.from(window.mesher.mesh.points)
    .filter(([, p]) => p[1] === 0.5).map(([id]) => id));
  await click(page, [0.65, 0.5]);
  await quiet(page);
  assert.ok(is_near(await mark(page, [0.7, 0.5]), ORANGE), 'it is selected');
  const {updates} = await state(page);
  await pull(page, [0.65, 0.5], [0.6, 0.3]);
  const moved = [await point(page, ids[0]), await point(page, ids[1])];
  assert.ok(Math.abs(moved[0][0] - 0.15) < 0.01 && Math.abs(moved[0][1] - 0.3) < 0.01, String(moved));
  assert.ok(Math.abs(moved[1][0] - moved[0][0] - 0.6) < 1e-12 && moved[0][1] === moved[1][1]);
  assert.equal((await state(page)).updates, updates + 1);
  assert.ok(is_near(await mark(page, [0.7, moved[0][1]]), ORANGE), 'what is selected follows');
  await command(page, {do: 'undo'});
  assert.deepEqual([await point(page, ids[0]), await point(page, ids[1])], line);
  await page.close();
  await server.end();
};

// The colour at each place right after an update, after half the time of what came, and later.
const faded = (page, what, places) => page.evaluate(async ([c, all]) => {
  const {revision} = window.mesher.state;
  window.mesher.command(c);
  for (const end = performance.now() + 10000; window.mesher.state.revision === revision;) {
    if (performance.now() > end) throw new Error('no update: ' + window.mesher.problems[0]?.text);
    await new Promise((d) => setTimeout(d, 1));
  }
  const {view} = window.mesher, gl = view.gl, now = performance.now();
  return [0, 200, 5000].map((later) => all.map((p) => {
    view.frame(now + later);
    const [x, y] = view.on_page(p), out = new Uint8Array(4);
    gl.readPixels(x * view.ratio, view.height - y * view.ratio, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, out);
    return Array.from(out.subarray(0, 3));
  }));
}, [what, places]);
// Of [first, later, last].
function require_fading([first, later, last], came) {
  const text = [first, later, last].join(' | '), [red, blue] = came ? [2, 0] : [0, 2];
  assert.ok(first[red] < last[red] - 40, 'it has another colour: ' + text);
  assert.ok(first[blue] > first[red] + 40, (came ? 'orange: ' : 'blue: ') + text);
  assert.ok(first[red] + 5 < later[red] && later[red] + 5 < last[red], 'it fades: ' + text);
}

tests['what came is orange, what went is blue, and both fade'] = async () => {
  fs.writeFileSync('fading.poly', SQUARE);
  let server = await serve('fading.poly');
  let page = await open(server);
  const column = (all, i) => all.map((row) => row[i]);
  const corner = {do: 'drag', point: 3, at: [0.8, 0.8], drop: true};
  // The middle of the largest triangle that it brings.
  const outlines = () => page.evaluate(() => {
    const m = window.mesher.mesh, all = [];
    for (let s = 0; s < m.slots; ++s) if (m.is_kept(s)) all.push([m.measure[s], m.outline(s)]);
    return all.sort((a, b) => b[0] - a[0]).map(([, outline]) => outline);
  });
  const old = new Set((await outlines()).map(String));
  await command(page, corner);
  const [p] = (await outlines()).filter((outline) => !old.has(String(outline)));
  await command(page, {do: 'undo'});
  await page.waitForTimeout(1500);
  const new_place = [(p[0] + p[2] + p[4]) / 3, (p[1] + p[3] + p[5]) / 3];
  const seen = await faded(page, corner, [new_place, [0.95, 0.92]]);
  require_fading(column(seen, 0), true);
  require_fading(column(seen, 1), false);
  await page.click('#changes');
  await command(page, {do: 'undo'});
  const plain = await faded(page, corner, [new_place, [0.95, 0.92]]);
  assert.deepEqual(plain, [seen[2], seen[2], seen[2]], 'not if it is not wanted');
  await page.close();
  await server.end();

  execFileSync(tool, ['gen', 'cube', '-o', 'fading_cube.poly']);
  server = await serve('fading_cube.poly', '--domain', '-1', '-1', '-1', '2', '2', '2');
  page = await open(server);
  await page.click('#cut');
  await quiet(page);
  // The upper face goes down: behind its far corner there is nothing.
  const top = await page.evaluate(() => {
    const m = window.mesher.mesh, f = Array.from(m.face_polygons.keys())
      .find((i) => [0, 1, 2].every((k) => m.place(m.faces[3 * i + k])[2] === 1));
    return m.face_polygons[f];
  });
  const down = {do: 'drag', feature: ['polygon', top], by: [0, 0, -0.3], drop: true};
  await command(page, down);
  const middle = await page.evaluate((id) => {
    const m = window.mesher.mesh, area = ([a, b, c]) =>
      Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    const [f] = m.polygon_faces(id).map((face) => face.map((v) => m.place(v)))
      .sort((x, y) => area(y) - area(x));
    return [0, 1, 2].map((i) => (f[0][i] + f[1][i] + f[2][i]) / 3);
  }, top);
  await command(page, {do: 'undo'});
  await page.waitForTimeout(1500);
  const places = [middle, [0.9, 0.93, 1]];
  const space = await faded(page, down, places);
  require_fading(column(space, 0), true);
  require_fading(column(space, 1), false);
  await page.click('#changes');
  await command(page, {do: 'undo'});
  assert.deepEqual(await faded(page, down, places), [space[2], space[2], space[2]]);
  await page.close();
  await server.end();
};

tests['in space: a face and a line moved along an axis'] = async () => {
  execFileSync(tool, ['gen', 'cube', '-o', 'faces.poly']);
  const domain = ['--domain', '-1', '-1', '-1', '2', '2', '2'];
  const server = await serve('faces.poly', ...domain);
  const page = await open(server);
  await page.click('#cut');
  await quiet(page);
  const points = () => page.evaluate(() => Array.from(window.mesher.mesh.points).sort((a, b) => a[0] - b[0]));
  const before = await points();
  const selected = () => page.evaluate(() => window.mesher.selected);
  const same_mesh = async () => {
    await page.click('#fresh');
    await until('a fresh run', () => page.evaluate(() =>
      document.getElementById('fresh_result').textContent.includes('the same mesh')));
    await page.evaluate(() => { document.getElementById('fresh_result').textContent = ''; });
  };

  // The upper face is selected, and moved along its normal.
  const middle = [0.53, 0.46, 1];
  assert.deepEqual(await mark(page, middle), [0, 0, 0, 0]);
  await click(page, middle);
  await quiet(page);
  assert.equal((await selected())[0], 'polygon');
  const faint = await mark(page, middle);
  assert.ok(is_near(faint, ORANGE) && faint[3] > 50 && faint[3] < 120, String(faint));
  assert.ok(is_near(await mark(page, [0, 0.5, 1]), ORANGE), 'its outline');
  assert.deepEqual(await mark(page, [0.5, 0, 0.5]), [0, 0, 0, 0], 'no other face');
  await shot(page, 'face_selected');
  await pull(page, middle, [0.53, 0.46, 1.3]);
  const after = await points();
  const height = after.find(([, p]) => p[2] > 1)[1][2];
  assert.ok(Math.abs(height - 1.3) < 0.03, String(height));
  assert.deepEqual(after, before.map(([id, [x, y, z]]) => [id, [x, y, z === 1 ? height : z]]));
  assert.equal((await state(page)).updates, 1, 'it is one update');
  assert.deepEqual(await problems(page), []);
  await same_mesh();
  await shot(page, 'face_moved');
  await page.keyboard.press('Control+z');
  await until('undo', async () => (await state(page)).updates === 2);
  assert.deepEqual(await points(), before);
  assert.equal((await state(page)).undo, 0);
  await page.keyboard.press('Control+y');
  await until('redo', async () => (await state(page)).updates === 3);
  assert.deepEqual(await points(), after);

  // Along another axis: its neighbours are sheared, and stay flat.
  await page.keyboard.press('x');
  const upper = [0.53, 0.46, height];
  await pull(page, upper, [0.73, 0.46, height]);
  const sheared = await points();
  const by = sheared.find(([, p]) => p[2] === height)[1][0];
  assert.ok(Math.abs(by - 0.2) < 0.03 || Math.abs(by - 1.2) < 0.03, String(by));
  await same_mesh();
  await page.keyboard.press('n');

  // A line inside; then the face through it, which is refused, and told where.
  await page.keyboard.press('Escape');
  await command(page, {do: 'line', through: [[0.5, 0.5, 0.3], [0.5, 0.5, 0.6]]});
  await click(page, [0.5, 0.5, 0.45]);
  await quiet(page);
  assert.equal((await selected())[0], 'line');
  assert.ok(is_near(await mark(page, [0.5, 0.5, 0.4]), ORANGE), 'the line');
  await page.keyboard.press('z');
  await pull(page, [0.5, 0.5, 0.45], [0.5, 0.5, 0.55]);
  const line = (await points()).slice(-2).map(([, p]) => p);
  assert.ok(Math.abs(line[0][2] - 0.4) < 0.02, String(line));
  assert.ok(Math.abs(line[1][2] - line[0][2] - 0.3) < 1e-12 && line[0][0] === 0.5);
  await same_mesh();
  await page.keyboard.press('Escape');
  await click(page, upper);
  await quiet(page);
  const held = await state(page);
  await pull(page, upper, [upper[0], upper[1], 0.55], 6);
  const [problem, ...others] = await problems(page);
  assert.match(problem.text, /goes through/);
  assert.equal(others.length, 0);
  assert.ok(Math.abs(problem.places[0][0] - 0.5) < 1e-9 && problem.places[0][2] > line[0][2] &&
    problem.places[0][2] < line[1][2], String(problem.places));
  assert.deepEqual(problem.features.map(([kind]) => kind).sort(), ['line', 'polygon']);
  assert.ok((await state(page)).updates <= held.updates + 1);
  await page.keyboard.press('Escape');
  await quiet(page);
  assert.ok(is_near(await mark(page, line[1].map((x, i) => i === 2 ? x - 0.02 : x)), RED));
  await shot(page, 'face_refused');
  await page.click('#clear_errors');
  await same_mesh();

  // One corner alone would bend the faces: the corner that is off is told.
  const corner = (await points()).find(([, p]) => p[2] === 0)[0];
  await command(page, {do: 'drag', point: corner, at: [-0.2, -0.3, -0.4], drop: true});
  const [bent] = await problems(page);
  assert.match(bent.text, /is not flat/);
  assert.equal(bent.places.length, 1);
  assert.equal(bent.features[0][0], 'polygon');
  await page.click('#clear_errors');

  const script = await saved(page, '#save_script');
  assert.match(String(script), /begin\n(move .*\n){4}commit\n/);
  fs.writeFileSync('faces.txt', script);
  execFileSync(tool, ['edit', 'faces.poly', ...domain, '--script', 'faces.txt', '-o', 'faces.vtu', '--quiet']);
  assert.deepEqual(await saved(page, '#save'), fs.readFileSync('faces.vtu'));
  await page.close();
  await server.end();
};

tests['the calls of an update'] = async () => {
  fs.writeFileSync('calls.poly', SQUARE);
  const server = await serve('calls.poly');
  const page = await open(server);
  await page.click('#calls');
  await quiet(page);
  await tool_of(page, 'segment');
  await click(page, [0.3, 0.4]);
  await click(page, [0.6, 0.5]);
  await until('the picture', () => page.evaluate(() =>
    document.getElementById('calls_picture').naturalWidth > 100));
  await page.evaluate(() => document.getElementById('calls_picture').scrollIntoView());
  await shot(page, 'calls');
  // A click opens it at full size, with labels.
  const small = await page.evaluate(() => document.getElementById('calls_picture').clientWidth);
  const [large] = await Promise.all([page.waitForEvent('popup'), page.click('#calls_picture')]);
  await large.waitForLoadState();
  assert.ok(await large.evaluate(() => document.documentElement.getBoundingClientRect().width) >
    2 * small);
  assert.ok(await large.evaluate(() => document.querySelectorAll('title').length) > 10);
  await shot(large, 'calls_large');
  await large.close();
  await page.close();
  await server.end();
};

tests['two tabs, and a server that is killed'] = async () => {
  fs.writeFileSync('tabs.poly', SQUARE);
  let server = await serve('tabs.poly');
  const one = await open(server), two = await open(server);
  await tool_of(one, 'polyline');
  for (const p of [[0.2, 0.3], [0.5, 0.6], [0.8, 0.3]]) await click(one, p);
  await one.keyboard.press('Enter');
  await quiet(one);
  await until('the other tab sees it', async () => (await state(two)).updates === 1);
  const middle = await two.evaluate(() => Array.from(window.mesher.mesh.points.keys()).pop());
  const from = await point(two, middle);
  await pull(two, from, [from[0], from[1] + 0.1]);
  await until('the first tab sees the drag', async () => (await state(one)).updates === 2);
  await until('the same place', async () =>
    JSON.stringify(await point(one, middle)) === JSON.stringify(await point(two, middle)));
  const content = (page) => page.evaluate(() => {
    const m = window.mesher.mesh, all = [];
    for (let s = 0; s < m.slots; ++s) if (m.is_live(s)) all.push(m.outline(s).join() + m.labels[s]);
    return all.sort().join(' ') + Array.from(m.bins).join();
  });
  const was = await content(one);
  assert.equal(was, await content(two));

  // It is killed, and comes back at its address from the journal: both tabs find it.
  const text = (page, id) => page.textContent('#' + id);
  const {address} = server;
  await server.end('SIGKILL');
  await until('the page says so', () => one.evaluate(() => !document.getElementById('lost').hidden));
  assert.match(await text(one, 'lost_text'), /does not answer; looking for it again in .* s/);
  await shot(one, 'lost');
  server = await serve('tabs.poly');
  assert.equal(server.address, address);
  await until('it says so', async () => /2 updates resumed/.test(server.said()));
  for (const page of [one, two]) {
    await until('the tab finds it', () => page.evaluate(() =>
      document.getElementById('lost').hidden && !document.getElementById('back').hidden));
    assert.match(await text(page, 'back'),
      /^The server was started again, and went on from its journal of 2 updates\.$/);
    await quiet(page);
    assert.equal(await content(page), was);
  }
  await shot(one, 'back');
  await one.click('#undo');
  await until('undo after a kill', async () => (await state(two)).updates === 3);
  assert.deepEqual(await point(two, middle), from);

  // The intervals grow; a click looks at once.
  await server.end();
  await until('longer intervals', () => one.evaluate(() =>
    / in [48] s/.test(document.getElementById('lost_text').textContent)));
  server = await serve('tabs.poly');
  const clicked = Date.now();
  await one.click('#try_now');
  await until('the tab is there', async () => /3 updates/.test(await text(one, 'back')), 2);
  assert.ok(Date.now() - clicked < 2000);

  // Another server there, with another token: the tab says that it is refused.
  await server.end();
  server = await serve('tabs.poly', '--new-address', '--port', String(server.port));
  await one.click('#try_now');
  await until('the tab is refused', async () =>
    /has another address now/.test(await text(one, 'lost_text')));
  const three = await open(server);
  await three.click('#redo');
  await until('redo', async () => (await state(three)).updates === 4);
  assert.equal(await content(three), was);
  await three.click('#undo');
  await until('undo after a kill', async () => (await state(three)).updates === 5);
  assert.deepEqual(await point(three, middle), from);
  for (const page of [one, two, three]) await page.close();
  // The browser reports each attempt, also one that is cut as the server ends.
  assert.ok(faults.every((text) => /403|ERR_CONNECTION_RE(FUSED|SET)/.test(text)), faults.join());
  faults.length = 0;
  await server.end();
};

tests['limits of size'] = async () => {
  fs.writeFileSync('limits.poly', SQUARE);
  let server = await serve('limits.poly');
  const page = await open(server);
  const limits = () => page.evaluate(() => window.mesher.limits);
  const kept = async () => (await state(page)).kept;
  const listed = () => page.evaluate(() =>
    Array.from(document.querySelectorAll('#limits tr')).map((row) => row.innerText));
  const none = await kept();
  await page.fill('#limit_value', '0.1');
  await page.click('#limit_all');
  await until('a limit everywhere', async () => await kept() > none);
  const all = await kept();

  // A box is drawn by dragging; with the limit at the right.
  await tool_of(page, 'limit');
  await page.click('#snap');
  await page.selectOption('#limit_kind', 'largest');
  await page.fill('#limit_value', '0.0005');
  await pull(page, [0.1, 0.1], [0.4, 0.5]);
  await until('a limit in a box', async () => (await limits()).boxes.length === 1);
  const [box] = (await limits()).boxes;
  assert.deepEqual([box.lo, box.hi, box.largest], [[0.1, 0.1], [0.4, 0.5], 0.0005]);
  await quiet(page);
  const fine = await kept();
  assert.ok(fine > all + 100, `${fine} ${all}`);
  await shot(page, 'limits');

  // Changed, written, deleted, undone.
  await page.fill('#limit_value', '0.002');
  await page.click('text=Change');
  await until('it is changed', async () => (await limits()).boxes[0].largest === 0.002);
  assert.ok(await kept() < fine);
  await page.fill('#limit_box', '0.6 0.6 0.9 0.9');
  await page.click('#limit_in');
  await until('another box', async () => (await limits()).boxes.length === 2);
  assert.equal((await listed()).length, 3);
  await page.click('#limits tr:nth-child(2) >> text=Delete');
  await until('the first is deleted', async () => (await limits()).boxes.length === 1);
  assert.deepEqual((await limits()).boxes[0].lo, [0.6, 0.6]);
  await page.click('#undo');
  await until('undo', async () => (await limits()).boxes.length === 2);
  await page.fill('#limit_box', '1 2 3');
  await page.click('#limit_in');
  assert.match(await page.evaluate(() => window.mesher.problems[0].text), /A box is 4 numbers/);
  await page.fill('#limit_value', '');
  await page.click('#limit_all');
  await until('no limits', async () => await kept() === none);
  assert.equal((await listed()).length, 1);

  const script = await saved(page, '#save_script');
  fs.writeFileSync('limits.txt', script);
  assert.match(String(script), /limit area 5e-04 in 0\.1 0\.1 0\.4 0\.5/);
  for (const format of ['vtu', 'svg']) {
    await page.selectOption('#format', format);
    execFileSync(tool, ['edit', 'limits.poly', '--script', 'limits.txt', '-o', 'limits.' + format,
      '--quiet']);
    assert.deepEqual(await saved(page, '#save'), fs.readFileSync('limits.' + format), format);
  }
  await page.close();
  await server.end();

  // In space a box is written.
  execFileSync(tool, ['gen', 'cube', '-o', 'limited.poly']);
  server = await serve('limited.poly');
  const space = await open(server);
  assert.equal(await space.isVisible('#tool_limit'), false);
  const before = (await state(space)).kept;
  await space.selectOption('#limit_kind', 'largest');
  await space.fill('#limit_value', '0.001');
  await space.fill('#limit_box', '0 0 0, 0.5 0.5 0.5');
  await space.click('#limit_in');
  await until('a limit in space', async () => (await state(space)).kept > before);
  await space.waitForTimeout(500);
  await shot(space, 'limits_space');
  await space.close();
  await server.end();
};

tests['a page of another site is refused'] = async () => {
  fs.writeFileSync('origin.poly', SQUARE);
  const server = await serve('origin.poly');
  const other = await serve('origin.poly', '--journal', 'other.journal');
  const page = await open(other);  // of another origin, which may not speak to the first
  const outcome = await page.evaluate((address) => new Promise((done) => {
    const socket = new WebSocket(address.replace('http', 'ws') + 'socket');
    socket.onopen = () => done('open');
    socket.onerror = () => done('refused');
  }), server.address);
  assert.equal(outcome, 'refused');
  const answer = await page.evaluate((address) =>
    fetch(address).then(() => 'read', () => 'refused'), server.address);
  assert.equal(answer, 'refused');
  faults.length = 0;  // the browser reports both
  await page.close();
  await server.end();
  await other.end();
};

tests['the Great Lakes: a wall that is pulled'] = async () => {
  fs.copyFileSync(path.join(data, 'great_lakes.poly'), 'great_lakes.poly');
  const server = await serve('great_lakes.poly');
  const page = await open(server);
  await page.waitForTimeout(800);
  await shot(page, 'great_lakes');
  await page.evaluate(() => window.mesher.go_to([-87.0, 43.4], 1.2));
  await quiet(page);
  await page.waitForTimeout(800);
  await tool_of(page, 'polyline');
  for (const p of [[-87.2, 43.2], [-87.0, 43.5], [-86.8, 43.4]]) await click(page, p);
  await page.keyboard.press('Enter');
  await quiet(page);
  await tool_of(page, 'move');
  const middle = await page.evaluate(() => Math.max(...window.mesher.mesh.points.keys()) - 1);
  const from = await point(page, middle);
  await page.click('input[value=quality]');
  await pull(page, from, [from[0] + 0.15, from[1] + 0.2], 12);
  await page.click('input[value=region]');
  await page.click('#undo');
  await until('undo', async () => (await state(page)).updates === 3);
  await page.click('#redo');
  await until('redo', async () => (await state(page)).updates === 4);
  await shot(page, 'wall');
  // What is kept as a picture is what is drawn anew.
  await page.waitForTimeout(1600);
  const differs = await page.evaluate(() => {
    const {view} = window.mesher, gl = view.gl, n = view.width * view.height * 4;
    const read = () => {
      gl.bindFramebuffer(gl.FRAMEBUFFER, view.frames[view.shown]);
      const out = new Uint8Array(n);
      gl.readPixels(0, 0, view.width, view.height, gl.RGBA, gl.UNSIGNED_BYTE, out);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      return out;
    };
    const kept = read();
    view.draw(0, 0, view.width, view.height);
    const drawn = read();
    let count = 0;
    for (let i = 0; i < n; ++i) if (Math.abs(kept[i] - drawn[i]) > 2) ++count;
    return count;
  });
  assert.equal(differs, 0, 'the kept picture is out of date');
  await page.close();
  await server.end();
};

tests['in space: a corner moved along an axis'] = async () => {
  execFileSync(tool, ['gen', 'pump', '-o', 'pump.poly']);
  execFileSync(tool, ['gen', 'cube', '-o', 'cube.poly']);
  const pump = await serve('pump.poly');
  let page = await open(pump);
  await page.click('input[value=quality]');
  await page.waitForTimeout(600);
  await shot(page, 'pump');
  const faces = await page.evaluate(() => window.mesher.view.buffers.faces.count);
  await page.fill('#cut_at', '300');
  await quiet(page);
  assert.notEqual(await page.evaluate(() => window.mesher.view.buffers.faces.count), faces);
  await page.click('#cut');
  await page.click('#slivers');
  await page.click('#only_marked');
  await quiet(page);
  assert.ok(await page.evaluate(() => window.mesher.view.buffers.faces.count) > 0);
  await page.waitForTimeout(300);
  await shot(page, 'slivers');
  await page.close();
  await pump.end();

  const server = await serve('cube.poly', '--domain', '-1', '-1', '-1', '2', '2', '2');
  page = await open(server);
  await page.click('#cut');
  await tool_of(page, 'point');
  const spot = await page.evaluate(() => {
    const v = window.mesher.view;
    for (let y = 300; y < 600; y += 7) {
      for (let x = 300; x < 600; x += 7) {
        const face = v.pick_face(x, y);
        if (face) return v.on_page(face.place).map((c, i) => Math.abs(c - [x, y][i]) < 0.5);
      }
    }
    return null;
  });
  assert.deepEqual(spot, [true, true], 'what is picked is where the pointer is');
  await tool_of(page, 'move');
  // A point inside, in view of no face, is moved along z.
  await page.evaluate(() => window.mesher.command({do: 'point', at: [0.5, 0.5, 0.5]}));
  await quiet(page);
  const id = await page.evaluate(() => Math.max(...window.mesher.mesh.points.keys()));
  await page.keyboard.press('z');
  const from = await at(page, await point(page, id));
  await page.mouse.move(...from);
  await page.mouse.down();
  for (let i = 1; i <= 6; ++i) await page.mouse.move(from[0] + 2 * i, from[1] - 6 * i);
  await page.mouse.up();
  await quiet(page);
  const moved = await point(page, id);
  assert.ok(moved[2] > 0.52 && moved[0] === 0.5 && moved[1] === 0.5, String(moved));
  await page.keyboard.press('Control+z');
  await until('undo', async () => (await point(page, id))[2] === 0.5);
  await page.mouse.move(500, 400);
  await page.mouse.down();
  await page.mouse.move(560, 380);
  await page.mouse.up();
  assert.notEqual(await page.evaluate(() => window.mesher.view.camera.yaw), -0.5);
  await page.close();
  await server.end();
};

// Updates and frames a second while a point is dragged, at three zooms, from the page itself.
async function figures(points, name) {
  execFileSync(tool, ['gen', 'uniform', '--n', String(points), '--seed', '7', '-o', name]);
  const server = await serve(name);
  const page = await open(server);
  const lines = [];
  await until('the picture is drawn', () => page.evaluate(() => !window.mesher.busy), 120);
  for (const zoom of [1, 8, 64]) {
    await page.evaluate((by) => {
      const {view} = window.mesher;
      view.show_all();
      view.zoom(by, view.width / 2 / view.ratio, view.height / 2 / view.ratio);
      window.dispatchEvent(new Event('resize'));
    }, zoom);
    await page.waitForTimeout(300);
    await quiet(page);
    if (zoom === 1) await shot(page, `uniform_${points}`);
    const got = await page.evaluate(() => window.mesher.measure(3));
    await quiet(page);
    const figure = (x) => x.toFixed(x < 10 ? 1 : 0);
    lines.push({zoom, updates: got.updates, text:
      `${got.triangles} triangles, zoom ${zoom}: ${figure(got.updates)} updates/s, ` +
      `${figure(got.frames)} frames/s; engine ${got.engine_ms.toFixed(2)} ms, round trip ` +
      `${got.trip_ms.toFixed(1)} ms, change ${got.apply_ms.toFixed(2)} ms, paint ` +
      `${got.paint_ms.toFixed(1)} ms`});
    console.log('  ' + lines[lines.length - 1].text);
  }
  await page.close();
  await server.end();
  return lines;
}

tests['a mesh of 10^4 triangles follows a drag'] = async () => {
  for (const {updates, zoom} of await figures(3200, 'uniform_4.node')) {
    assert.ok(updates > 10, `${updates} updates a second at zoom ${zoom}`);
  }
};
if (process.env.FIGURES) {
  tests['figures: 10^5 and 10^6 triangles'] = async () => {
    await figures(31500, 'uniform_5.node');
    for (const {updates, zoom} of await figures(315000, 'uniform_6.node')) {
      assert.ok(updates >= 30, `${updates} updates a second at zoom ${zoom}`);
    }
  };
  tests['figures: 10^6 points'] = async () => {
    for (const {updates, zoom} of await figures(1000000, 'uniform_7.node')) {
      assert.ok(updates >= 30, `${updates} updates a second at zoom ${zoom}`);
    }
  };
}

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  if (process.env.ONLY && !name.includes(process.env.ONLY)) continue;
  try {
    await test();
    assert.deepEqual(faults, [], 'the page reported errors');
    console.log('ok      ' + name);
  } catch (error) {
    failed += 1;
    console.log(['FAILED  ' + name, error.stack, ...faults].join('\n'));
    faults.length = 0;
  }
}
await browser.close();
for (const child of servers) if (child.exitCode === null) child.kill('SIGKILL');
process.exit(failed === 0 ? 0 : 1);
