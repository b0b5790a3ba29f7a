// What the tests of the page have in common: runs of the program, pages in Chromium, the tables beside them.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { closeBrowsers } from './browser.mjs';

export const program = resolve(process.argv[2]);
export const cases = resolve(import.meta.dirname ?? new URL('.', import.meta.url).pathname, '../../cases');
export const folder = mkdtempSync(join(tmpdir(), 'tourmaline-report-'));
let failures = 0;

export async function test(claim, work) {
  try {
    await work();
    console.log(`ok    ${claim}`);
  } catch (error) {
    failures += 1;
    console.log(`WRONG ${claim}\n      ${String(error.message).replace(/\n/g, '\n      ')}`);
  }
}

/** Says what came out, and ends the process. */
export async function end() {
  await closeBrowsers();
  rmSync(folder, { recursive: true, force: true });
  console.log(failures === 0 ? 'all is as it should be' : `${failures} claims are wrong`);
  process.exit(failures === 0 ? 0 : 1);
}

export function run(name, file, ...settings) {
  const out = join(folder, name);
  execFileSync(program, ['run', join(cases, file), '-q', '-o', out, ...settings.flatMap((s) => ['--set', s])]);
  return out;
}

/** Rows of nodes.csv as objects. */
export function nodesOf(out) {
  const [header, ...lines] = readFileSync(join(out, 'nodes.csv'), 'utf8').trim().split('\n');
  const names = header.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((v, i) => [names[i], Number(v)])));
}

/** A graphics card in software is slow to read, which is nothing of the page. */
export const isOfThePage = (message) => ['error', 'warning'].includes(message.type())
  && !message.text().includes('GPU stall due to ReadPixels');

/** Opens a page; whatever it complains of or asks the network for is kept. */
export async function open(context, file) {
  const tab = await context.newPage();
  tab.setDefaultTimeout(240000);  // on a busy machine the clock says nothing of the page
  const complaints = [];
  tab.on('console', (m) => isOfThePage(m) && complaints.push(m.text()));
  tab.on('pageerror', (e) => complaints.push(e.message));
  tab.on('request', (r) => /^(file|data|blob):/.test(r.url()) || complaints.push(`request of ${r.url()}`));
  // The processor's time: on a busy machine the clock says nothing of the page.
  const session = await context.newCDPSession(tab);
  await session.send('Performance.enable', { timeDomain: 'threadTicks' });
  await tab.goto('file://' + file);
  await tab.waitForSelector('#run');
  await settled(tab);
  const { metrics } = await session.send('Performance.getMetrics');
  await seen(tab);
  return { tab, complaints, seconds: metrics.find((m) => m.name === 'TaskDuration').value };
}

/** Once through the page: what never was on the screen has not been drawn. */
export async function seen(tab) {
  const screens = await tab.evaluate(() => Math.ceil(document.documentElement.scrollHeight / innerHeight));
  for (let i = screens - 1; i >= 0; --i) {
    await tab.evaluate((y) => scrollTo({ top: y * innerHeight, behavior: 'instant' }), i);
    await settled(tab);
  }
}

/** Scrolls an element to the middle of the window; its place there. */
export async function centred(tab, selector) {
  await tab.locator(selector).first().evaluate((e) => e.scrollIntoView({ block: 'center', behavior: 'instant' }));
  return tab.locator(selector).first().boundingBox();
}

/** Three frames later everything that was asked for is drawn: one for what has come to the screen, one to draw. */
export const settled = (tab) => tab.evaluate(() => new Promise((done) =>
  requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));

/** One of the elements, on the screen and drawn. */
export async function shownOne(tab, selector, which) {
  const one = tab.locator(selector).nth(which);
  await one.evaluate((e) => { const box = e.getBoundingClientRect();
    if (box.bottom < 0 || box.top > innerHeight) e.scrollIntoView({ block: 'center', behavior: 'instant' }); });
  await settled(tab);
  return one;
}

/** The pixels of a canvas as one text. */
export async function pixels(tab, selector, which = 0) {
  return (await shownOne(tab, selector, which)).evaluate((canvas) => canvas.toDataURL());
}

export const colours = async (tab, selector, which = 0) => (await shownOne(tab, selector, which)).evaluate((canvas) => {
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true });
  copy.drawImage(canvas, 0, 0);
  const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
  const seen = new Set();
  for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 0) seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
  return seen.size;
});

export const goTo = (tab, step) => tab.locator('#time').fill(String(step));

/** Moves the pointer over the body until it finds `wanted` nodes; what the page says of each. */
export async function probe(tab, wanted) {
  const found = new Map();
  const box = await centred(tab, '.view canvas');
  for (let k = 0; k < 400 && found.size < wanted; ++k) {
    const [u, v] = [(0.31 + 0.618034 * k) % 1, (0.17 + 0.7548777 * k) % 1];
    await tab.mouse.move(box.x + u * box.width, box.y + v * box.height);
    const said = await tab.locator('.readout').first().evaluate((readout) => ({
      node: readout.dataset.node,
      values: [...readout.querySelectorAll('[data-field]')].map((e) =>
        [e.dataset.field, e.dataset.component, Number(e.dataset.value), e.textContent]),
    }));
    if (said.values.length > 0 && said.node !== undefined) found.set(Number(said.node), said.values);
  }
  assert.ok(found.size >= wanted, `only ${found.size} nodes were found under the pointer`);
  return found;
}

/** "u_x −3.96·10⁻¹¹ m" to a number. */
export function numberIn(text) {
  const [, number] = text.match(/^\S+ (\S+)/);
  const plain = number.replace(/−/g, '-').replace(/·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/, (_, power) =>
    'e' + [...power].map((c) => (c === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c))).join(''));
  return Number(plain);
}

/** What the page says of nodes is what nodes.csv says: to single precision inside, to six digits as text. */
export function compare(found, nodes) {
  for (const [node, values] of found) {
    const row = nodes[node];
    for (const [field, component, value, text] of values) {
      const column = field === 'displacement' ? `u_${component}` : field;
      if (component === 'size' || !(column in row)) continue;
      assert.ok(Math.abs(value - row[column]) <= 1.2e-7 * Math.abs(row[column]),
        `node ${node}: ${column} = ${value}, nodes.csv has ${row[column]}`);
      assert.ok(Math.abs(numberIn(text) - row[column]) <= 5.1e-6 * Math.abs(row[column]),
        `node ${node}: the page says "${text}", nodes.csv has ${row[column]}`);
    }
  }
}

export const desktop = { viewport: { width: 1280, height: 900 } };
export const phone = { viewport: { width: 400, height: 800 }, hasTouch: true, colorScheme: 'dark' };

/** Rows of a table of a result folder as objects; what is no number stays text. */
export function tableOf(out, name) {
  const [header, ...lines] = readFileSync(join(out, name), 'utf8').trim().split('\n');
  const names = header.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((v, i) => [names[i], Number.isNaN(Number(v)) ? v : Number(v)])));
}

export function runText(name, text, ...settings) {
  const file = join(folder, `${name}.toml`);
  writeFileSync(file, text);
  const out = join(folder, name);
  execFileSync(program, ['run', file, '-q', '-o', out, ...settings.flatMap((s) => ['--set', s])]);
  return out;
}
