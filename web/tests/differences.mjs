// node tests/differences.mjs TOURMALINE: what two runs have in common and what not, on one mesh and on two; lines and pins.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { inBrowser } from './browser.mjs';
import { centred, desktop, end, folder, open, program, runText, settled, tableOf, test } from './harness.mjs';

const plain = `symmetry = "isotropic", young = 1e11, poisson = 0.3, eps11 = 100, k11 = 1, density = 1000, specific_heat = 1000,
  reference_temperature = 293`.replace(/\n */, ' ');

function pageOf(name, ...runs) {
  const page = join(folder, `${name}.html`);
  execFileSync(program, ['report', ...runs, '-o', page]);
  return page;
}

const view = (tab, i) => tab.locator('.view').nth(i);
const bar = (tab, i) => view(tab, i).locator('.ticks').textContent();
const ticks = (tab, i) => view(tab, i).locator('.ticks span:not(.unit)').allTextContents();

async function choose(tab, field, component) {
  await tab.locator('#field').selectOption(field);
  if (component !== undefined) await tab.locator('#component').selectOption(component);
  await tab.locator('.view:not([hidden])').last().scrollIntoViewIfNeeded();
  await settled(tab);
  await settled(tab);
}

/** Rows of the CSV that a chart below the views saves. */
async function saved(tab, chart) {
  const coming = tab.waitForEvent('download');
  await tab.locator(`.asked ${chart} [data-kind=CSV]`).click();
  const lines = readFileSync(await (await coming).path(), 'utf8').trim().split('\n').filter((line) => !line.startsWith('#'));
  return lines.slice(1).map((line) => line.split(','));
}

const charged = (volts) => runText(`charged-${volts}`, `
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [6, 6] }
material = { ${plain} }
time = { end = 1, steps = 2 }
boundary = [ { on = "bottom", displacement = [0, 0], potential = 0, temperature = 0 },
  { on = "top", traction = [0, -1e5], potential = ${volts} } ]
`);

await inBrowser(desktop, async (context) => {
  const [none, some] = [charged(0), charged(100)];
  const { tab, complaints } = await open(context, pageOf('charged', none, some));
  await tab.locator('#difference').check();
  await test('beside a run without voltage neither the voltage of the other nor the difference is called round-off', async () => {
    await choose(tab, 'potential');
    for (const i of [0, 1, 2]) assert.deepEqual([await ticks(tab, i)].map((t) => [t[0], t[4]]), [['0', '100']], String(i));
  });
  await test('of sizes the difference is what the second has more, and may be less than nothing', async () => {
    const { tab: turned } = await open(context, pageOf('turned', some, none));
    await turned.locator('#difference').check();
    await choose(turned, 'electric_field', 'size');
    const [least, , , , greatest] = await ticks(turned, 2);
    assert.deepEqual([least, greatest, await view(turned, 2).locator('.unit').textContent()], ['−1', '0', '10³ V/m']);
  });
  await test('a line over two runs says whose field is of another moment', async () => {
    const finer = runText('finer', readFileSync(join(folder, 'charged-100.toml'), 'utf8'), 'time.steps=5');
    const { tab: two } = await open(context, pageOf('two', some, finer) + '#t=0.4&line=0.01,0.01,0.09,0.09');
    const labels = await two.locator('.asked .line .u-legend').textContent();
    assert.match(labels, /, t = 0\.5 s/);
    assert.doesNotMatch(labels, /, t = 0\.4 s/);
  });
  await test('what only the second run has can be chosen, and the first says that it has not', async () => {
    const bare = runText('bare', `
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [6, 6] }
model = { electric = false, thermal = false }
material = { ${plain} }
time = { end = 1, steps = 2 }
boundary = [ { on = "bottom", displacement = [0, 0] }, { on = "top", traction = [0, -1e5] } ]
`);
    const { tab: mixed } = await open(context, pageOf('mixed', bare, some));
    await choose(mixed, 'potential');
    assert.equal(await bar(mixed, 0), 'not in this run');
    assert.deepEqual((await ticks(mixed, 1))[4], '100');
  });
  await test('of differences nothing is complained of', () => assert.deepEqual(complaints, []));
});

await inBrowser(desktop, async (context) => {
  const layered = (name, cells) => runText(name, `
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [${cells}], cell = "triangle" }
time = { end = 1, steps = 2 }
model = { thermal = false, electric = false }
boundary = [ { on = ["left", "right", "bottom", "top"], displacement = [0, "1e-4*y*t"] } ]
[[region]]
name = "soft"
where = "x < 0.05"
material = { symmetry = "isotropic", young = 1e9, poisson = 0 }
[[region]]
name = "hard"
where = "x > 0.05"
material = { symmetry = "isotropic", young = 2e9, poisson = 0 }
`);
  const { tab } = await open(context, pageOf('layered', layered('coarse', '4, 4'), layered('fine', '8, 6')));
  await tab.locator('#difference').check();
  await test('what jumps between regions is compared on either side of the jump', async () => {
    await choose(tab, 'recovered_stress', 'yy');
    assert.match(await bar(tab, 2), /^0 (everywhere|but for the rounding of the page)/);
  });
});

await inBrowser(desktop, async (context) => {
  const ring = (name, cells) => runText(name, `
mesh.annulus = { inner = 0.03, outer = 0.05, cells = [3, ${cells}] }
material = { ${plain} }
time = { end = 1, steps = 2 }
boundary = [ { on = "inner", displacement = [0, 0], potential = 0, temperature = 0 }, { on = "outer", potential = "${cells}*t" } ]
`);
  const { tab } = await open(context, pageOf('rings', ring('ring16', 16), ring('ring24', 24)));
  await tab.locator('#difference').check();
  await test('where the second body is not the difference has no colour', async () => {
    await choose(tab, 'potential');
    const shares = await view(tab, 2).locator('canvas').evaluate((canvas) => {
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
      copy.drawImage(canvas, 0, 0);
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
      const [r, g, b] = getComputedStyle(document.documentElement).getPropertyValue('--body').trim().match(/[0-9a-f]{2}/gi).map((v) => parseInt(v, 16));
      let bare = 0, body = 0;
      for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] < 255) continue;
        ++body;
        if (Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 6) ++bare;
      }
      return bare / body;
    });
    assert.ok(shares > 0.01 && shares < 0.5, String(shares));
    assert.match(await view(tab, 2).locator('.note').textContent(), /without colour where the second is not/);
  });
});

await inBrowser(desktop, async (context) => {
  const block = (name, further) => runText(name, `
mesh.box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [6, 6, 6], cell = "hexahedron"${further} }
material = { ${plain} }
time = { end = 1, steps = 1 }
boundary = [ { on = "left", displacement = [0, 0, 0], potential = 0, temperature = 0 }, { on = "right", potential = 100 } ]
`);
  const { tab } = await open(context, pageOf('blocks', block('even', ''), block('graded', ', grading = { left = 5 }')));
  await test('along a line over solids on two meshes each has the values of its own places', async () => {
    await tab.locator('#field').selectOption('potential');
    await tab.locator('#tool').selectOption('line');
    const { x, y, width, height } = await centred(tab, '.view canvas');
    await tab.mouse.move(x + 0.3 * width, y + 0.5 * height);
    await tab.mouse.down();
    await tab.mouse.move(x + 0.6 * width, y + 0.55 * height, { steps: 3 });
    await tab.mouse.up();
    await settled(tab);
    const rows = (await saved(tab, '.line')).map((row) => row.map(Number));
    assert.ok(rows.length > 50);
    for (const [, x, , , ...values] of rows)  // V = 1000 x in both
      for (const value of values) assert.ok(Math.abs(value - 1000 * x) < 0.02, `${values} at x = ${x}`);
    assert.ok(rows.some(([, x]) => x > 0.01));
  });
});

await inBrowser(desktop, async (context) => {
  const swinging = runText('swinging', `
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [4, 4] }
material = { ${plain} }
time = { end = 1, steps = 100 }
boundary = [ { on = "bottom", displacement = [0, 0], potential = 0, temperature = 0 }, { on = "top", potential = "100*sin(20*_pi*t)" } ]
[[probe]]
name = "middle"
at = [0.05, 0.05]
`, 'output.every=7');
  const { tab } = await open(context, join(swinging, 'report.html') + '#field=potential&pins=0.05,0.05,0');
  await test('a pin has values at the moments of fields, those of a probe there, and none between', async () => {
    const probed = tableOf(swinging, 'probe-middle.csv');
    const rows = (await saved(tab, '.pins')).map((row) => row.map((v) => (v === '' ? NaN : Number(v))));
    const known = rows.filter(([, value]) => !Number.isNaN(value));
    assert.ok(known.length >= 14 && known.length < 20, String(known.length));
    for (const [time, value] of known) {
      const there = probed.find((row) => Math.abs(row.time - time) < 1e-6);
      if (there) assert.ok(Math.abs(value - there.potential) < 1e-4, `${value} at ${time}, ${there.potential}`);
    }
  });
  await test('limits by hand are those of a logarithmic bar, too', async () => {
    await tab.locator('#field').selectOption('potential');
    await tab.selectOption('#range', 'hand');
    for (const [i, limit] of ['-1', '50'].entries()) await tab.locator('.hand input').nth(i).fill(limit);
    await tab.keyboard.press('Tab');
    await tab.locator('#scale').selectOption('log');
    await settled(tab);
    await settled(tab);
    const [least, , , , greatest] = await ticks(tab, 0);
    assert.deepEqual([least, greatest], ['≤ −1', '≥ 50']);
  });
});

await inBrowser(desktop, async (context) => {
  const far = runText('far', `
mesh.box = { min = [10, 0], max = [10.001, 0.001], cells = [4, 4] }
material = { ${plain} }
time = { end = 1, steps = 1 }
initial.temperature = "100 + 20*y"
boundary = [ { on = "bottom", displacement = [0, 0], potential = 0, temperature = 100 }, { on = "top", temperature = 100.02 } ]
`);
  const { tab } = await open(context, join(far, 'report.html') + '#field=temperature');
  await test('the numbers of a bar differ, however little its ends do', async () => {
    await choose(tab, 'temperature');
    const texts = await ticks(tab, 0);
    assert.equal(new Set(texts).size, 5, String(texts));
    assert.deepEqual([texts[0], texts[4]], ['100', '100.02']);
  });
  await test('axes of a body far from the origin have its coordinates', async () => {
    const coming = tab.waitForEvent('download');
    await tab.locator('.view [data-kind=SVG]').click();
    const names = [...readFileSync(await (await coming).path(), 'utf8').matchAll(/>(\d{5}(?:\.\d)?)</g)].map(([, text]) => Number(text));
    assert.ok(names.length >= 2 && names.every((v) => v > 9999 && v < 10002), String(names));  // 10⁻³ m
  });
  await test('pins of a body far from the origin come back where they were', async () => {
    const pinned = '10.000253,0.00051,0';
    const { tab: again } = await open(context, `${join(far, 'report.html')}#field=temperature&pins=${pinned}`);
    await again.locator('#steps').selectOption('bands');
    await again.waitForFunction(() => location.hash.includes('bands'));
    assert.equal(new URLSearchParams(await again.evaluate(() => location.hash.slice(1))).get('pins'), pinned);
    assert.ok((await saved(again, '.pins')).length > 0);
    // A link that is opened in the same tab shows what it says, and nothing of what was there before.
    await Promise.all([again.waitForEvent('load'), again.evaluate(() => { location.hash = 'field=potential'; })]);
    await again.waitForSelector('#run');
    await settled(again);
    assert.deepEqual([await again.locator('#field').inputValue(), await again.locator('#steps').inputValue(),
      await again.locator('.asked .pins').isVisible()], ['potential', 'smooth', false]);
  });
});

end();
