// node tests/reader.mjs TOURMALINE: what a reader may ask of a picture, compared with the tables of the run.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { inBrowser } from './browser.mjs';
import { cases, end, folder, isOfThePage, program, run, runText, settled, test } from './harness.mjs';

/** Rows of a CSV as objects; empty is null, what is no number stays text. */
function rowsOf(text) {
  const [names, ...lines] = text.trim().split('\n').map((line) =>
    [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)].map(([, quoted, plain]) => quoted?.replace(/""/g, '"') ?? plain));
  return lines.map((line) => Object.fromEntries(line.map((v, i) =>
    [names[i], v === '' ? null : Number.isNaN(Number(v)) ? v : Number(v)])));
}
const tableOf = (out, name) => rowsOf(readFileSync(join(out, name), 'utf8'));

const desktop = { viewport: { width: 1366, height: 768 }, acceptDownloads: true };

/** A page with what the address says, its large view on the screen. */
async function open(context, page, address = '') {
  const tab = await context.newPage();
  const complaints = [];
  tab.on('console', (m) => isOfThePage(m) && complaints.push(m.text()));
  tab.on('pageerror', (e) => complaints.push(e.message));
  tab.on('request', (r) => /^(file|data|blob):/.test(r.url()) || complaints.push(`request of ${r.url()}`));
  await tab.goto('file://' + page + (address ? `#${address}` : ''));
  await tab.waitForSelector('#run');
  await onScreen(tab, '.view canvas');
  return { tab, complaints };
}

async function onScreen(tab, selector, which = 0) {
  const one = tab.locator(selector).nth(which);
  await one.evaluate((e) => e.scrollIntoView({ block: 'center', behavior: 'instant' }));
  await settled(tab);
  return one;
}

/** The file that a click on a button leaves, as text or bytes. */
async function saved(tab, selector, encoding = 'utf8') {
  await onScreen(tab, selector);
  const [download] = await Promise.all([tab.waitForEvent('download'), tab.locator(selector).first().click()]);
  return readFileSync(await download.path(), encoding);
}

/** Words, lines and surfaces of a saved picture, in the pixels of the canvas. */
async function drawnIn(tab, svg) {
  return tab.evaluate((text) => {
    const sheet = new DOMParser().parseFromString(text, 'image/svg+xml');
    const inner = sheet.querySelector('g');
    const numbers = (d) => d.split(/[ML]/).slice(1).map((p) => p.replace('Z', '').trim().split(' ').map(Number));
    return {
      faulty: !!sheet.querySelector('parsererror'),
      words: [...inner.querySelectorAll('text:not([fill=none])')].map((e) =>
        ({ text: e.textContent, x: Number(e.getAttribute('x')), y: Number(e.getAttribute('y')) })),
      // Each path by itself.
      lines: [...inner.querySelectorAll('path[fill=none]')].flatMap((e) => e.getAttribute('d').split('M').slice(1)
        .map((d) => ({ points: numbers('M' + d), colour: e.getAttribute('stroke'), width: Number(e.getAttribute('stroke-width')) }))),
      surfaces: [...inner.querySelectorAll('path:not([fill=none])')].map((e) =>
        ({ points: numbers(e.getAttribute('d')), colour: e.getAttribute('fill') })),
    };
  }, svg);
}

/** "−3.96·10⁻¹¹" to a number. */
const numberIn = (text) => Number(text.replace(/−/g, '-').replace(/·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/, (_, power) =>
  'e' + [...power].map((c) => (c === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c))).join('')));

/** Metres of a pixel by the numbers at the axes of a plane body. */
function byAxes({ words }) {
  const numbers = words.filter((w) => /^[−0-9.]+$/.test(w.text)).map((w) => ({ ...w, value: numberIn(w.text) }));
  const foot = Math.max(...numbers.map((w) => w.y));
  const across = numbers.filter((w) => Math.abs(w.y - foot) < 1), up = numbers.filter((w) => Math.abs(w.y - foot) >= 1);
  const line = (ticks, at) => {
    const [a, b] = [ticks[0], ticks[ticks.length - 1]];
    const slope = (b.value - a.value) / (b[at] - a[at]);
    for (const t of ticks) assert.ok(Math.abs(a.value + slope * (t[at] - a[at]) - t.value) < 0.05 * Math.abs(slope), `the tick ${t.text} stands elsewhere`);
    return (pixel) => a.value + slope * (pixel - a[at]);
  };
  return { x: line(across, 'x'), y: line(up, 'y'), pixel: Math.abs(line(across, 'x')(1) - line(across, 'x')(0)) };
}

/** What the first readout says with the pointer at a pixel of the first picture. */
async function readAt(tab, x, y, which = 0) {
  const box = await tab.locator('.view canvas').first().boundingBox();
  await tab.mouse.move(box.x + x, box.y + y);
  return tab.locator('.readout').nth(which).evaluate((readout) => ({
    node: readout.dataset.node === undefined || !readout.querySelector('[data-field]') ? undefined : Number(readout.dataset.node),
    place: readout.querySelector('.value')?.textContent ?? '',
    values: Object.fromEntries([...readout.querySelectorAll('[data-field]')].map((e) =>
      [`${e.dataset.field} ${e.dataset.component}`.trim(), Number(e.dataset.value)])),
  }));
}

/** Places in the first picture that have a node under them, found by going over it. */
async function nodesSeen(tab, wanted, which = 0) {
  const found = new Map();
  const box = await (await onScreen(tab, '.view canvas')).boundingBox();
  for (let k = 0; k < 600 && found.size < wanted; ++k) {
    const [x, y] = [((0.31 + 0.618034 * k) % 1) * box.width, ((0.17 + 0.7548777 * k) % 1) * box.height];
    const said = await readAt(tab, x, y, which);
    if (said.node !== undefined) found.set(said.node, { x, y, ...said });
  }
  assert.ok(found.size >= wanted, `only ${found.size} nodes were found`);
  return [...found.values()];
}

const pixelsOf = async (tab, selector = '.view canvas', which = 0) =>
  (await onScreen(tab, selector, which)).evaluate((canvas) => canvas.toDataURL());

/** The colour at a pixel of the first picture. */
const colourAt = (tab, x, y) => tab.locator('.view canvas').first().evaluate((canvas, [u, v]) => {
  const copy = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
  copy.drawImage(canvas, -Math.round(u), -Math.round(v));
  return [...copy.getImageData(0, 0, 1, 1).data].slice(0, 3);
}, [x, y]);

const close = (a, b, share = 2e-7, more = 0) => Math.abs(a - b) <= share * Math.abs(b) + more;
const bare = 'mesh=0&axes=0&marks=0';

const fine = ['mesh.box.cells=[16, 16]'];
const [insulated, conductive] = ['insulated', 'conductive'].map((name) => run(name, `ouafik-2020/${name}.toml`, ...fine));
const coarse = run('coarse', 'ouafik-2020/insulated.toml', 'mesh.box.cells=[8, 8]');
const page = join(conductive, 'report.html');
const nodes = tableOf(conductive, 'nodes.csv');
const extreme = (name, least) => nodes.reduce((best, row) => ((least ? row[name] < best[name] : row[name] > best[name]) ? row : best));

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, page, 'stretch=0&t=0.2');
  const svg = await saved(tab, '.view [data-kind=SVG]');
  const drawn = await drawnIn(tab, svg);
  const axes = byAxes(drawn);
  await test('axes of a plane body count its coordinates', async () => {
    assert.ok(!drawn.faulty);
    for (const { x, y, node } of await nodesSeen(tab, 5)) {
      assert.ok(Math.abs(axes.x(x) - nodes[node].x) <= 6 * axes.pixel, `x of node ${node}: ${axes.x(x)}`);
      assert.ok(Math.abs(axes.y(y) - nodes[node].y) <= 6 * axes.pixel, `y of node ${node}: ${axes.y(y)}`);
    }
  });
  await test('the scale bar is as long as it says', () => {
    const said = drawn.words.find((w) => /^[0-9.]+ m$/.test(w.text));
    const bar = drawn.lines.find((l) => l.points.length === 4 && l.points[1][1] === l.points[2][1]);
    assert.ok(close((bar.points[2][0] - bar.points[1][0]) * axes.pixel, numberIn(said.text.replace(' m', '')), 1e-3), said.text);
  });
  await test('marks stand at the least and the greatest value of nodes.csv', () => {
    for (const [kind, row] of [['min', extreme('potential', true)], ['max', extreme('potential', false)]]) {
      const said = drawn.words.find((w) => w.text.startsWith(kind));
      assert.ok(close(numberIn(said.text.slice(4)), row.potential, 5.1e-4), `${said.text}, nodes.csv has ${row.potential}`);
      assert.ok(drawn.surfaces.some(({ points }) => {
        const [x, y] = [(points[1][0] + points[2][0]) / 2, (points[0][1] + (points[1][1] - points[0][1]) * 0.6)];
        return Math.abs(axes.x(x) - row.x) < 3 * axes.pixel && Math.abs(axes.y(y) - row.y) < 3 * axes.pixel;
      }), `no mark at ${row.x}, ${row.y}`);
    }
  });
  await test('a magnification that is typed is the one that is drawn', async () => {
    const scale = 2e8;
    await tab.locator('#magnification').fill(String(scale));
    await tab.keyboard.press('Enter');
    await settled(tab);
    assert.match(await tab.locator('.view .note').first().textContent(), /displacement × 2·10⁸/);
    const moved = nodes.map((row) => ({ row, by: Math.hypot(row.u_x, row.u_y) * scale })).sort((a, b) => b.by - a.by);
    assert.ok(moved[0].by > 5 * axes.pixel, `nothing moves: ${moved[0].by / axes.pixel} pixels`);
    let right = 0;
    for (const { x, y, node } of await nodesSeen(tab, 8)) {
      const row = nodes[node];
      assert.ok(Math.abs(axes.x(x) - row.x - scale * row.u_x) <= 6 * axes.pixel, `node ${node}`);
      assert.ok(Math.abs(axes.y(y) - row.y - scale * row.u_y) <= 6 * axes.pixel, `node ${node}`);
      right += 1;
    }
    assert.ok(right >= 8);
  });
  await test('of axes and pictures nothing is complained of', () => assert.deepEqual(complaints, []));
});

await inBrowser(desktop, async (context) => {
  await test('along an isoline the field has the value of its place on the bar', async () => {
    const { tab } = await open(context, page, `stretch=0&marks=0&steps=lines&range=peaks`);
    const drawn = await drawnIn(tab, await saved(tab, '.view [data-kind=SVG]'));
    const axes = byAxes(drawn), side = 0.1 / 16;
    const at = new Map(nodes.map((r) => [`${Math.round(r.x / side)} ${Math.round(r.y / side)}`, r.potential]));
    const most = Math.max(...nodes.map((r) => Math.abs(r.potential)));
    const levels = Array.from({ length: 9 }, (_, i) => most * (2 * ((i + 1) / 10) - 1));
    let compared = 0;
    for (const { points, width } of drawn.lines.filter((l) => l.colour === '#000000' && l.width === 1))
      for (const [px, py] of points) {
        assert.equal(width, 1);
        const [x, y] = [axes.x(px) / side, axes.y(py) / side];
        if (Math.abs(y - Math.round(y)) > 0.003) continue;  // only along sides of squares is the field straight for sure
        const left = Math.floor(x + 1e-9), share = x - left;
        const [a, b] = [at.get(`${left} ${Math.round(y)}`), at.get(`${left + 1} ${Math.round(y)}`)];
        if (a === undefined || b === undefined || Math.abs(b - a) < 1e-3 * most) continue;
        const value = a + share * (b - a), off = Math.min(...levels.map((l) => Math.abs(l - value)));
        assert.ok(off <= 0.003 * Math.abs(b - a) + 1e-3 * most, `${value} V at ${x * side}, ${y * side}`);
        compared += 1;
      }
    assert.ok(compared > 10, `only ${compared} places were compared`);
  });
  await test('each of three colour maps colours a node by its value, even, by logarithms and in bands', async () => {
    const maps = { cividis: [[0, 0x20, 0x4d], [0xff, 0xea, 0x46]], grey: [[0x1a, 0x1a, 0x1a], [0xf2, 0xf2, 0xf2]] };
    const { tab } = await open(context, page, `${bare}&stretch=0&field=displacement&range=step`);
    const size = (row) => Math.hypot(row.u_x, row.u_y);
    const most = Math.max(...nodes.map(size));
    const seen = new Set();
    for (const map of ['viridis', 'cividis', 'grey']) {
      await tab.selectOption('#map', map);
      seen.add(await pixelsOf(tab));
      if (!maps[map]) continue;
      const bar = await tab.locator('.view .strip').first().evaluate((img) => {
        const copy = new OffscreenCanvas(256, 1).getContext('2d');
        copy.drawImage(img, 0, 0, 256, 1);
        const { data } = copy.getImageData(0, 0, 256, 1);
        return [[...data.slice(0, 3)], [...data.slice(-4, -1)]];
      });
      for (const i of [0, 1])
        for (const c of [0, 1, 2]) assert.ok(Math.abs(bar[i][c] - maps[map][i][c]) < 6, `${map}: ${bar[i]}, not ${maps[map][i]}`);
    }
    assert.equal(seen.size, 3);
    // Grey is straight between its ends.
    const grey = (level) => 0x1a + level * (0xf2 - 0x1a);
    // Sides have an outline.
    const inside = ({ node }) => [nodes[node].x, nodes[node].y].every((v) => v > 1e-9 && v < 0.1 - 1e-9);
    const places = (await nodesSeen(tab, 14)).filter(inside).slice(0, 6);
    assert.ok(places.length > 3);
    for (const [scale, steps, level] of [
      ['even', 'smooth', (v) => v / most], ['log', 'smooth', (v) => Math.max(0, 1 + Math.log10(v / most) / 4)],
      ['even', 'bands', (v) => (Math.min(9, Math.floor((10 * v) / most)) + 0.5) / 10]]) {
      await tab.selectOption('#scale', scale);
      await tab.selectOption('#steps', steps);
      await settled(tab);
      for (const { x, y } of places) {
        const { values } = await readAt(tab, x, y);
        // Under a pointer that is near a node the readout is the node's; its neighbourhood has the same colour but for a little.
        const [r] = await colourAt(tab, x, y), wanted = grey(level(values['displacement size']));
        assert.ok(Math.abs(r - wanted) <= (steps === 'bands' ? 24 : 10), `${scale}, ${steps}: ${r}, not ${wanted}`);
      }
    }
  });
  await test('a logarithmic bar goes down four powers of ten and marks that less is there', async () => {
    const { tab } = await open(context, page, `field=displacement&scale=log&range=peaks`);
    const ticks = await tab.locator('.view .ticks span:not(.unit)').allTextContents();
    const [low, , middle, , high] = ticks.map((text) => numberIn(text.replace('≤ ', '')));
    assert.ok(ticks[0].startsWith('≤ '), ticks[0]);
    assert.ok(close(low, high * 1e-4, 0.02) && close(middle, high * 1e-2, 0.02), ticks.join());
  });
  await test('arrows show which way nodes move', async () => {
    const { tab } = await open(context, page, 'stretch=0&marks=0&arrows=displacement');
    const drawn = await drawnIn(tab, await saved(tab, '.view [data-kind=SVG]'));
    const axes = byAxes(drawn);
    // The field inside the squares' triangles, whichever way they are cut.
    const side = 0.1 / 16, at = new Map(nodes.map((r) => [`${Math.round(r.x / side)} ${Math.round(r.y / side)}`, r]));
    const movedAt = (x, y, falling) => {
      const [i, j] = [x, y].map((v) => Math.min(15, Math.max(0, Math.floor(v / side))));
      const [s, t] = [x / side - i, y / side - j];
      const weights = falling
        ? s + t < 1 ? [1 - s - t, s, t, 0] : [0, 1 - t, 1 - s, s + t - 1]
        : s > t ? [1 - s, s - t, 0, t] : [1 - t, 0, t - s, s];
      return ['u_x', 'u_y'].map((u) => [[0, 0], [1, 0], [0, 1], [1, 1]].reduce((sum, [a, b], k) =>
        sum + weights[k] * at.get(`${i + a} ${j + b}`)[u], 0));
    };
    let compared = 0;
    for (const { points } of drawn.lines.filter((l) => l.width === 1.3 && l.points.length === 2)) {
      const [[px, py], [qx, qy]] = points, [x, y] = [axes.x(px), axes.y(py)];
      const length = Math.hypot(qx - px, qy - py);
      if (length < 4) continue;
      const cosine = Math.max(...[true, false].map((falling) => {
        const u = movedAt(x, y, falling);
        return ((qx - px) * u[0] - (qy - py) * u[1]) / length / Math.hypot(...u);
      }));
      assert.ok(cosine > 0.97, `at ${x}, ${y} the arrow is off, ${cosine}`);
      compared += 1;
    }
    assert.ok(compared > 20, `only ${compared} arrows`);
    const said = (await tab.locator('.view .note').first().textContent()).match(/longest arrow (\S+) m/)[1];
    const most = Math.max(...nodes.map((r) => Math.hypot(r.u_x, r.u_y)));
    assert.ok(numberIn(said) <= most * 1.006 && numberIn(said) > 0.8 * most, `${said}, the largest displacement is ${most}`);
  });
  await test('arrows of D, E and q point as the cell under them has it, those of slip as contact.csv', async () => {
    const { tab } = await open(context, page, 'stretch=0&marks=0');
    for (const field of ['electric_field', 'electric_displacement', 'heat_flux']) {
      await tab.selectOption('#field', field);
      await tab.selectOption('#arrows', field);
      const drawn = await drawnIn(tab, await saved(tab, '.view [data-kind=SVG]'));
      const arrows = drawn.lines.filter((l) => l.width === 1.3 && l.points.length === 2 &&
        Math.hypot(l.points[1][0] - l.points[0][0], l.points[1][1] - l.points[0][1]) > 6).slice(0, 4);
      assert.ok(arrows.length > 0, field);
      for (const { points: [[px, py], [qx, qy]] } of arrows) {
        const vector = [];
        for (const component of ['x', 'y']) {
          await tab.selectOption('#component', component);
          await onScreen(tab, '.view canvas');
          vector.push((await readAt(tab, px, py)).values[`${field} ${component}`]);
        }
        const cosine = ((qx - px) * vector[0] - (qy - py) * vector[1]) / Math.hypot(qx - px, qy - py) / Math.hypot(...vector);
        assert.ok(cosine > 0.98, `${field}: ${cosine}`);
      }
    }
    await tab.selectOption('#arrows', 'slip');
    const drawn = await drawnIn(tab, await saved(tab, '.view [data-kind=SVG]')), axes = byAxes(drawn);
    const last = tableOf(conductive, 'contact.csv').filter((r) => r.step === 20);
    let compared = 0;
    for (const { points: [[px, py], [qx, qy]] } of drawn.lines.filter((l) => l.width === 1.3 && l.points.length === 2)) {
      const row = last.reduce((best, r) => (Math.abs(r.y - axes.y(py)) < Math.abs(best.y - axes.y(py)) ? r : best));
      assert.ok(Math.abs(axes.x(px) - row.x) < 2 * axes.pixel);
      assert.ok(Math.hypot(qx - px, qy - py) < 3 || Math.sign(py - qy) === Math.sign(row.slip_y), `at y = ${row.y}`);
      compared += 1;
    }
    assert.ok(compared > 3, `${compared} arrows of slip`);
  });
});

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, page);
  await test('single steps go one moment on and back; a loop begins again; speed is speed', async () => {
    await tab.locator('#time').fill('5');
    await tab.getByLabel('one moment on').click();
    assert.equal(await tab.locator('#time').inputValue(), '6');
    await tab.getByLabel('one moment back').click();
    await tab.getByLabel('one moment back').click();
    assert.equal(await tab.locator('#time').inputValue(), '4');
    const paceAt = async (speed) => {
      await tab.selectOption('#speed', speed);
      await tab.evaluate(() => {
        window.moments = [];
        const text = document.querySelector('.moment');
        window.watching?.disconnect();
        window.watching = new MutationObserver(() => window.moments.push(performance.now()));
        window.watching.observe(text, { childList: true, characterData: true, subtree: true });
      });
      await tab.locator('#time').fill('0');
      await tab.locator('#play').click();
      await tab.waitForFunction(() => window.moments.length > 5);
      await tab.locator('#play').click();
      return tab.evaluate(() => (window.moments[5] - window.moments[1]) / 4);
    };
    const [slow, fast] = [await paceAt('0.25'), await paceAt('2')];
    assert.ok(slow > 2 * fast, `${slow} and ${fast} ms a moment`);
    await tab.locator('#loop').check();
    await tab.locator('#time').fill('19');
    await tab.locator('#play').click();
    await tab.waitForFunction(() => Number(document.querySelector('#time').value) < 10);
    await tab.locator('#play').click();
  });
  await test('what is off the screen is not drawn while playing', async () => {
    await tab.evaluate(() => {
      window.drawn = [];
      const clear = CanvasRenderingContext2D.prototype.clearRect;
      CanvasRenderingContext2D.prototype.clearRect = function (...at) {
        const box = this.canvas.getBoundingClientRect();
        window.drawn.push(box.bottom > -100 && box.top < innerHeight + 100 && box.width > 0);
        return clear.apply(this, at);
      };
    });
    await tab.locator('#time').fill('0');
    for (const selector of ['#run', '.view canvas']) {
      await onScreen(tab, selector);
      await tab.evaluate(() => { window.drawn = []; });
      const from = Number(await tab.locator('#time').inputValue());
      await tab.getByLabel('one moment on').click();
      await tab.getByLabel('one moment on').click();
      await settled(tab);
      assert.equal(Number(await tab.locator('#time').inputValue()), from + 2);
      const drawn = await tab.evaluate(() => window.drawn);
      assert.ok(drawn.every((seen) => seen), `${drawn.filter((seen) => !seen).length} pictures were drawn that nobody saw`);
      if (selector !== '#run') assert.ok(drawn.length > 0);
    }
  });
  await test('of playing nothing is complained of', () => assert.deepEqual(complaints, []));
});

await inBrowser(desktop, async (context) => {
  await test('the address brings back field, moment, camera, range, theme and the rest', async () => {
    const { tab, complaints } = await open(context, page);
    await tab.selectOption('#field', 'temperature');
    await tab.selectOption('#range', 'hand');
    await tab.locator('.hand input').nth(0).fill('-0.001');
    await tab.locator('.hand input').nth(1).fill('0.0002');
    await tab.keyboard.press('Tab');
    await tab.selectOption('#map', 'cividis');
    await tab.selectOption('#steps', 'both');
    await tab.locator('#time').fill('7');
    await tab.locator('#theme').click();
    await onScreen(tab, '.view canvas');
    await tab.locator('.view canvas').first().focus();
    await tab.keyboard.press('+');
    await tab.keyboard.press('ArrowLeft');
    await tab.locator('#theme').focus();
    const before = await pixelsOf(tab);
    await tab.waitForFunction(() => location.hash.includes('camera') && location.hash.includes('theme'));
    await tab.waitForTimeout(500);
    const url = tab.url();
    const again = await open(context, page, url.split('#')[1]);
    assert.equal(await pixelsOf(again.tab), before);
    assert.match(await again.tab.locator('.moment').textContent(), /t = 0\.07 s/);
    assert.equal(await again.tab.evaluate(() => document.documentElement.dataset.theme), 'dark');
    await again.tab.reload();
    await again.tab.waitForSelector('#run');
    assert.equal(await pixelsOf(again.tab), before);
    assert.deepEqual([...complaints, ...again.complaints], []);
  });
  await test('an address that means nothing changes nothing', async () => {
    const plain = await open(context, page);
    const before = await pixelsOf(plain.tab);
    const { tab, complaints } = await open(context, page, 'field=none&component=q&t=x&camera=1,2&range=wrong&map=9&line=a&pins=b&speed=x');
    assert.equal(await pixelsOf(tab), before);
    assert.deepEqual(complaints, []);
  });
  await test('a picture is saved as PNG with the pixels of the screen', async () => {
    const { tab } = await open(context, page);
    const shown = await pixelsOf(tab);
    const png = (await saved(tab, '.view [data-kind=PNG]', null)).toString('base64');
    const off = await tab.evaluate(async ([saved, shown]) => {
      const pictures = await Promise.all([`data:image/png;base64,${saved}`, shown].map((src) => new Promise((done) => {
        const image = new Image();
        image.onload = () => done(image);
        image.src = src;
      })));
      const [sheet, canvas] = pictures.map((image) => {
        const copy = new OffscreenCanvas(image.width, image.height).getContext('2d', { willReadFrequently: true });
        copy.fillStyle = '#fff';
        copy.fillRect(0, 0, image.width, image.height);
        copy.drawImage(image, 0, 0);
        return { width: image.width, height: image.height, data: (y) => copy.getImageData(0, y, image.width, 1).data };
      });
      if (sheet.width !== canvas.width || sheet.height <= canvas.height) return 'another size';
      for (let y = 0; y < canvas.height; y += 7) {
        const [a, b] = [sheet.data(y + 34), canvas.data(y)];
        if (a.some((v, i) => Math.abs(v - b[i]) > 3)) return `another picture in row ${y}`;
      }
      return '';
    }, [png, shown]);
    assert.equal(off, '');
  });
});

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, page);
  await test('a curve is saved with the numbers of contact.csv, and as a drawing of as many points', async () => {
    const chart = '#contact figure.chart:has(figcaption:text-is("Normal traction on the body"))';
    const rows = rowsOf(await saved(tab, `${chart} [data-kind=CSV]`));
    const last = tableOf(conductive, 'contact.csv').filter((r) => r.step === 20).sort((a, b) => a.y - b.y);
    assert.equal(rows.length, last.length);
    rows.forEach((row, i) => {
      const [y, traction] = Object.values(row);
      assert.ok(close(y, last[i].y) && close(traction, last[i].normal_traction), `${y}: ${traction}`);
    });
    const drawing = await saved(tab, `${chart} [data-kind=SVG]`);
    const points = await tab.evaluate((text) => {
      const sheet = new DOMParser().parseFromString(text, 'image/svg+xml');
      if (sheet.querySelector('parsererror')) return 0;
      return Math.max(...[...sheet.querySelectorAll('path')].map((p) => p.getAttribute('d').split(/[ML]/).length - 1));
    }, drawing);
    assert.equal(points, last.length);
  });
  await test('a curve over time is saved with the numbers of history.csv', async () => {
    const rows = rowsOf(await saved(tab, '#history figure.chart:has(figcaption:text-is("Energies")) [data-kind=CSV]'));
    const history = tableOf(conductive, 'history.csv');
    assert.equal(rows.length, history.length);
    rows.forEach((row, i) => {
      for (const kind of ['elastic', 'electric', 'thermal'])
        assert.ok(close(row[`${kind} [J/m]`], history[i][`${kind}_energy`]), `${kind} in row ${i}`);
    });
  });
  await test('of saving nothing is complained of', () => assert.deepEqual(complaints, []));
});

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, page, 'line=0,0.05,0.1,0.05');
  const onLine = nodes.filter((r) => Math.abs(r.y - 0.05) < 1e-9).sort((a, b) => a.x - b.x);
  await test('along a line the field is that of nodes.csv', async () => {
    const rows = rowsOf(await saved(tab, '.asked .line [data-kind=CSV]'));
    assert.equal(onLine.length, 17);
    let compared = 0;
    for (const node of onLine) {
      const row = rows.find((r) => Math.abs(r['x [m]'] - node.x) < 1e-7);
      if (!row) continue;
      assert.ok(Math.abs(row['s [m]'] - node.x) < 1e-7 && Math.abs(row['y [m]'] - 0.05) < 1e-7);
      assert.ok(close(row['φ [V]'], node.potential, 2e-6, 1e-9), `at x = ${node.x}: ${row['φ [V]']}, nodes.csv has ${node.potential}`);
      compared += 1;
    }
    assert.ok(compared >= 9, `${compared} nodes of ${rows.length} rows`);
  });
  await test('a line that is dragged runs where it was dragged', async () => {
    await tab.locator('#unask').click();
    await tab.locator('#stretch').fill('0');
    const axes = byAxes(await drawnIn(tab, await saved(tab, '.view [data-kind=SVG]')));
    await tab.selectOption('#tool', 'line');
    const box = await (await onScreen(tab, '.view canvas')).boundingBox();
    const [from, to] = [[0.45 * box.width, 0.3 * box.height], [0.6 * box.width, 0.7 * box.height]];
    const before = await pixelsOf(tab);
    await tab.mouse.move(box.x + from[0], box.y + from[1]);
    await tab.mouse.down();
    await tab.mouse.move(box.x + to[0], box.y + to[1], { steps: 3 });
    await tab.mouse.up();
    assert.notEqual(await pixelsOf(tab), before);
    const rows = rowsOf(await saved(tab, '.asked .line [data-kind=CSV]'));
    for (const [row, [x, y]] of [[rows[0], from], [rows[rows.length - 1], to]])
      assert.ok(Math.abs(row['x [m]'] - axes.x(x)) < 2 * axes.pixel && Math.abs(row['y [m]'] - axes.y(y)) < 2 * axes.pixel);
  });
  await test('of lines nothing is complained of', () => assert.deepEqual(complaints, []));
});

await test('a pin has the curve of a probe of the case at the same place', async () => {
  const text = readFileSync(join(cases, 'ouafik-2020/conductive.toml'), 'utf8').replace('cells = [64, 64]', 'cells = [8, 8]') +
    '\n[[probe]]\nname = "middle"\nat = [0.05, 0.05]\n\n[[probe]]\nname = "corner"\nat = [0, 0]\n';
  const out = runText('pinned', text);
  await inBrowser(desktop, async (context) => {
    const { tab, complaints } = await open(context, join(out, 'report.html'), 'pins=0.05,0.05,0 0,0,0');
    const rows = rowsOf(await saved(tab, '.asked .pins [data-kind=CSV]'));
    for (const [pin, name] of [['pin 1 [V]', 'middle'], ['pin 2 [V]', 'corner']]) {
      const told = tableOf(out, `probe-${name}.csv`);
      assert.equal(rows.length, told.length + 1);  // the page has the start as well
      told.forEach((step, i) => assert.ok(close(rows[i + 1]['t [s]'], step.time) && close(rows[i + 1][pin], step.potential, 1e-6, 1e-15),
        `${name}, step ${i + 1}: ${rows[i + 1][pin]}, the probe has ${step.potential}`));
    }
    // A click sets one more.
    await tab.selectOption('#tool', 'pin');
    const box = await (await onScreen(tab, '.view canvas')).boundingBox();
    await tab.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await settled(tab);
    assert.equal(Object.keys(rowsOf(await saved(tab, '.asked .pins [data-kind=CSV]'))[0]).length, 4);
    await tab.locator('#unask').click();
    assert.ok(!(await tab.locator('.asked .pins').isVisible()));
    assert.deepEqual(complaints, []);
  });
});

await test('a line probe of the case is a curve of its table at the moment that is shown', async () => {
  const text = readFileSync(join(cases, 'ouafik-2020/conductive.toml'), 'utf8').replace('cells = [64, 64]', 'cells = [8, 8]') +
    '\n[[probe]]\nname = "across"\nfrom = [0, 0.05]\nto = [0.1, 0.03]\npoints = 13\n';
  const out = runText('line-of-the-case', text);
  const told = tableOf(out, 'probe-across.csv');
  await inBrowser(desktop, async (context) => {
    const { tab, complaints } = await open(context, join(out, 'report.html'));
    for (const step of [20, 7]) {
      await tab.locator('#time').fill(String(step));
      await settled(tab);
      for (const [title, columns] of [['Potential along the line', { 'φ [V]': 'potential' }],
        ['Displacement along the line', { 'x [m]': 'u_x', 'y [m]': 'u_y' }]]) {
        const rows = rowsOf(await saved(tab, `#probes figure.chart:has(figcaption:text-is("${title}")) [data-kind=CSV]`));
        const there = told.filter((r) => r.step === step);
        assert.equal(rows.length, 13);
        rows.forEach((row, i) => {
          assert.ok(close(row['s [m]'], there[i].s, 1e-6, 1e-12));
          for (const [shown, column] of Object.entries(columns))
            assert.ok(close(row[shown], there[i][column], 1e-6, 1e-18), `${column} in step ${step}: ${row[shown]}, the table has ${there[i][column]}`);
        });
      }
    }
    assert.deepEqual(complaints, []);
  });
});

const pageOf = (name, ...outs) => {
  const file = join(folder, `${name}.html`);
  execFileSync(program, ['report', ...outs, '-o', file]);
  return file;
};
await inBrowser(desktop, async (context) => {
  for (const [what, one, other] of [['of one mesh', insulated, conductive], ['of a coarse and a fine mesh', coarse, conductive]])
    await test(`the difference of two runs ${what} is that of their nodes.csv`, async () => {
      const { tab, complaints } = await open(context, pageOf('both', one, other), 'difference=1');
      const [a, b] = [one, other].map((out) => tableOf(out, 'nodes.csv'));
      const at = new Map(b.map((r) => [`${r.x.toFixed(7)} ${r.y.toFixed(7)}`, r]));
      let compared = 0;
      for (const { node, values } of await nodesSeen(tab, 6, 2)) {
        const theirs = at.get(`${a[node].x.toFixed(7)} ${a[node].y.toFixed(7)}`);
        const most = Math.max(Math.abs(a[node].potential), Math.abs(theirs.potential));
        assert.ok(Math.abs(values.potential - (theirs.potential - a[node].potential)) <= 4e-7 * most, `node ${node}: ${values.potential}`);
        compared += 1;
      }
      assert.ok(compared >= 6);
      await onScreen(tab, '.difference canvas');
      assert.match(await tab.locator('.difference .note').textContent(), one === coarse ? /interpolated/ : /displacement/);
      assert.deepEqual(complaints, []);
    });
  await test('both runs in one chart have the curves of both', async () => {
    const { tab, complaints } = await open(context, pageOf('both', insulated, conductive), 'both-history=1');
    const rows = rowsOf(await saved(tab, '#history .together figure.chart:has(figcaption:text-is("Energies")) [data-kind=CSV]'));
    const titles = await tab.locator('h1').allTextContents();
    const tables = [insulated, conductive].map((out) => tableOf(out, 'history.csv'));
    rows.forEach((row, i) => {
      const elastic = Object.entries(row).filter(([name]) => name.includes('elastic')).map(([, v]) => v);
      assert.equal(elastic.length, 2);
      elastic.forEach((v, k) => assert.ok(close(v, tables[k][i].elastic_energy), `${titles[k]}, row ${i}: ${v}`));
    });
    assert.deepEqual(complaints, []);
  });
});

await inBrowser(desktop, async (context) => {
  await test('a solid body has a triad that turns with it', async () => {
    const out = run('solid', 'block-3d/twisted.toml', 'mesh.box.cells=[3, 3, 3]', 'time.steps=2');
    const { tab, complaints } = await open(context, join(out, 'report.html'));
    const triad = async () => {
      const { words } = await drawnIn(tab, await saved(tab, '.view [data-kind=SVG]'));
      return Object.fromEntries(words.filter((w) => /^[xyz]$/.test(w.text)).map((w) => [w.text, [w.x, w.y]]));
    };
    const before = await triad();
    assert.deepEqual(Object.keys(before).sort(), ['x', 'y', 'z']);
    await onScreen(tab, '.view canvas');
    await tab.locator('.view canvas').first().focus();
    await tab.keyboard.press('ArrowRight');
    const after = await triad();
    assert.ok(Math.hypot(after.x[0] - before.x[0], after.x[1] - before.x[1]) > 1);
    assert.ok(Math.abs(after.z[0] - before.z[0]) < 0.1, 'up stays up');
    assert.deepEqual(complaints, []);
  });
  await test('heat, charge and potential along the contact are those of contact.csv', async () => {
    const out = run('exchange', 'conducting-foundation/conducting.toml', 'mesh.box.cells=[8, 8]');
    const { tab, complaints } = await open(context, join(out, 'report.html'));
    const all = tableOf(out, 'contact.csv'), last = all.filter((r) => r.step === all[all.length - 1].step);
    for (const [title, column] of [['Heat flux out of the body', 'heat_flux'], ['Charge out of the body', 'charge_flux'], ['Potential', 'potential']]) {
      const rows = rowsOf(await saved(tab, `#contact figure.chart:has(figcaption:text-is("${title}")) [data-kind=CSV]`));
      assert.equal(rows.length, last.length);
      for (const row of rows) {
        const [s, value] = Object.values(row);
        assert.ok(last.some((r) => [r.x, r.y].some((v) => close(v, s, 1e-6, 1e-12)) && close(value, r[column])), `${title} at ${s}: ${value}`);
      }
    }
    assert.deepEqual(complaints, []);
  });
});

end();
