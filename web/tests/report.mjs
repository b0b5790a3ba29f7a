// node tests/report.mjs TOURMALINE: runs the paper's case and looks at its page in Chromium, as a reader would.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { inBrowser } from './browser.mjs';
import {
  run, nodesOf, open, seen, centred, settled, shownOne, pixels, colours,
  goTo, probe, numberIn, compare, desktop, phone, tableOf, runText, program, cases, folder, test, end,
} from './harness.mjs';

const conductive = run('conductive', 'ouafik-2020/conductive.toml', 'time.steps=50');
const page = join(conductive, 'report.html');

await inBrowser(desktop, async (context) => {
  const { tab, complaints, seconds } = await open(context, page);
  await test('50 steps of 64 x 64 squares stay below 8 MB', () => {
    const size = statSync(page).size;
    assert.ok(size < 8e6, `${size} bytes`);
  });
  await test('two seconds of a processor are enough to put the page on the screen', () => {
    assert.ok(seconds > 0.05 && seconds < 2, `${seconds} s`);
    console.log(`      it took ${seconds.toFixed(2)} s`);
  });
  await test('setting, deformed mesh, potential, temperature and stress are there at once', async () => {
    assert.deepEqual(await tab.locator('.card figcaption').allTextContents(),
      ['Physical setting', 'Deformed mesh', 'Electric potential', 'Temperature', 'von Mises stress']);
    for (const card of [2, 4]) assert.ok((await colours(tab, '.card canvas', card)) > 100, `card ${card} is empty`);
  });
  await test('the setting names every boundary with its conditions', async () => {
    const text = await tab.locator('.legend').first().textContent();
    for (const piece of ['left', 'Tresca friction, S = 15 N/m²', '-27 K', 'u = (0, 0) m', 'φ = 0 V', '-0.5*t', 'bottom'])
      assert.ok(text.includes(piece), `"${piece}" is missing in: ${text}`);
  });
  await test('every field and component can be drawn, and no two look alike', async () => {
    const seen = new Map();
    for (const field of await tab.locator('#field option').evaluateAll((os) => os.map((o) => o.value))) {
      await tab.selectOption('#field', field);
      const components = await tab.locator('#component option').evaluateAll((os) => os.map((o) => o.value));
      for (const component of components) {
        if (components.length > 1) await tab.selectOption('#component', component);
        const name = `${field} ${component}`;
        const image = await pixels(tab, '.view canvas');
        assert.ok((await colours(tab, '.view canvas')) > 20, `${name} is empty`);
        assert.ok(!seen.has(image), `${name} looks like ${seen.get(image)}`);
        seen.set(image, name);
      }
    }
    assert.ok(seen.size >= 14, `only ${seen.size} pictures`);
  });
  await test('every moment looks different', async () => {
    await tab.selectOption('#field', 'potential');
    const images = new Set();
    for (const step of [0, 1, 10, 25, 49, 50]) {
      await goTo(tab, step);
      images.add(await pixels(tab, '.view canvas'));
    }
    assert.equal(images.size, 6);
    assert.match(await tab.locator('.moment').textContent(), /t = 0\.2 s/);
  });
  await test('deformation, mesh and colour range change the picture', async () => {
    const before = await pixels(tab, '.view canvas');
    await tab.locator('#stretch').fill('0');
    const flat = await pixels(tab, '.view canvas');
    await tab.locator('.tick', { hasText: 'mesh' }).locator('input').uncheck();
    const bare = await pixels(tab, '.view canvas');
    await goTo(tab, 10);
    const all = await pixels(tab, '.view canvas');
    await tab.selectOption('#range', 'step');
    const own = await pixels(tab, '.view canvas');
    await tab.selectOption('#range', 'hand');
    await tab.locator('.hand input').nth(1).fill('0.5');
    await tab.keyboard.press('Tab');
    const byHand = await pixels(tab, '.view canvas');
    assert.equal(new Set([before, flat, bare, all, own, byHand]).size, 6);
    await tab.selectOption('#range', 'all');
    await tab.locator('#stretch').fill('1');
    await goTo(tab, 50);
  });
  await test('stresses say how they come about, and peaks do not blacken them', async () => {
    assert.match(await tab.locator('.card', { hasText: 'von Mises stress' }).textContent(), /recovered at the nodes/);
    await tab.selectOption('#field', 'recovered_von_mises');
    await settled(tab);
    assert.match(await tab.locator('.view .note').textContent(), /recovered at the nodes/);
    const robust = await tab.locator('.view .ticks').textContent();
    await tab.selectOption('#range', 'peaks');
    await settled(tab);
    const whole = await tab.locator('.view .ticks').textContent();
    assert.match(robust, /≥/);
    assert.ok(!whole.includes('≥') && whole !== robust);
    await tab.selectOption('#field', 'electric_field');
    await settled(tab);
    assert.match(await tab.locator('.view .note').textContent(), /mean of each cell/);
    await tab.selectOption('#range', 'all');
  });
  await test('values under the pointer are those of nodes.csv', async () =>
    compare(await probe(tab, 12), nodesOf(conductive)));
  await test('play runs through the moments', async () => {
    await tab.locator('#play').click();
    await tab.waitForFunction(() => Number(document.querySelector('#time').value) > 3);
    await tab.locator('#play').click();
    assert.ok(Number(await tab.locator('#time').inputValue()) < 50);
    await goTo(tab, 50);
  });
  await test('keys zoom and bring the whole body back', async () => {
    await tab.locator('.view canvas').first().focus();
    const before = await pixels(tab, '.view canvas');
    await tab.keyboard.press('+');
    assert.notEqual(await pixels(tab, '.view canvas'), before);
    await tab.keyboard.press('0');
    assert.equal(await pixels(tab, '.view canvas'), before);
  });
  await test('tractions with the bound, slip, temperature and the map of stick and slip are drawn', async () => {
    const titles = await tab.locator('#contact figcaption').allTextContents();
    for (const title of ['Normal traction on the body', 'Tangential traction and the bound ±S', 'Slip', 'Temperature',
      'Stick and slip']) assert.ok(titles.includes(title), `no "${title}" in ${titles}`);
    for (let i = 0; i < titles.length; ++i)
      assert.ok((await colours(tab, '#contact canvas', i)) > 3, `"${titles[i]}" is empty`);
  });
  await test('the curves along the contact follow the moment', async () => {
    const late = await pixels(tab, '#contact canvas', 1);
    await goTo(tab, 5);
    assert.notEqual(await pixels(tab, '#contact canvas', 1), late);
    await goTo(tab, 50);
  });
  await test('energies, dissipation and iterations are drawn over time', async () => {
    const titles = await tab.locator('#history figcaption').allTextContents();
    for (const title of ['Energies', 'Friction dissipation and power of the loads', 'Newton iterations'])
      assert.ok(titles.includes(title), `no "${title}" in ${titles}`);
  });
  await test('the charge of the only grounded side, which is 0 but for round-off, is not drawn as a curve', async () => {
    const charges = tableOf(conductive, 'history.csv').map((row) => Math.abs(row.charge_right));
    assert.ok(Math.max(...charges) > 0 && Math.max(...charges) < 1e-18, String(Math.max(...charges)));
    assert.ok(!(await tab.locator('#history figcaption').allTextContents()).includes('Charge'));
    assert.match(await tab.locator('#history').textContent(), /Below round-off: Charge\./);
  });
  await test('the case as run, sizes, versions and timings are told', async () => {
    const text = await tab.locator('#run').textContent();
    for (const piece of ['library = "BaTiO3-Liu2014"', '4 225', 'MUMPS', 'factorise'])
      assert.ok(text.includes(piece), `"${piece}" is missing`);
  });
  await test('light becomes dark', async () => {
    const paper = () => tab.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await paper();
    await tab.locator('#theme').click();
    assert.notEqual(await paper(), light);
  });
  await test('nothing is complained of and nothing asked of the network', () => assert.deepEqual(complaints, []));
});

await inBrowser(phone, async (context) => {
  const { tab, complaints } = await open(context, page);
  await test('on a phone nothing is wider than the screen', async () => {
    const wide = await tab.evaluate(() => [...document.querySelectorAll('body *')]
      .filter((e) => e.getBoundingClientRect().right > innerWidth + 1 && !e.closest('pre, .u-wrap, .u-legend'))
      .map((e) => `${e.tagName}.${e.className}`));
    assert.deepEqual(wide, []);
    assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  });
  await test('on a phone nothing is complained of', () => assert.deepEqual(complaints, []));
});

const tables = run('tables', 'ouafik-2020/conductive.toml', 'output.fields=false', 'mesh.box.cells=[16, 16]');
await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(tables, 'report.html'));
  await test('without field files the page says why and shows the curves', async () => {
    assert.match(await tab.locator('.notices').textContent(), /output\.fields = false/);
    assert.equal(await tab.locator('.view').count(), 0);
    assert.ok((await colours(tab, '#contact canvas', 0)) > 3);
    await goTo(tab, 3);
    assert.match(await tab.locator('.moment').textContent(), /t = 0\.04 s/);
    assert.deepEqual(complaints, []);
  });
});

await inBrowser(desktop, async (context) => {
  const { tab } = await open(context, page);
  await test('without WebGL the page says so and shows the curves', async () => {
    assert.match(await tab.locator('.notices').textContent(), /no WebGL/);
    assert.ok((await colours(tab, '#contact canvas', 0)) > 3);
  });
}, ['--disable-3d-apis']);

const [insulated, coarse] = ['insulated', 'conductive'].map((name) =>
  run(`${name}-16`, `ouafik-2020/${name}.toml`, 'mesh.box.cells=[16, 16]'));
const both = join(folder, 'both.html');
execFileSync(program, ['report', insulated, coarse, '-o', both]);
await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, both);
  const images = async () => [await pixels(tab, '.view canvas', 0), await pixels(tab, '.view canvas', 1)];
  const ends = () => tab.locator('.view .ticks').evaluateAll((bars) => bars.map((b) => b.textContent));
  await test('two results stand side by side and differ', async () => {
    const [left, right] = await images();
    assert.notEqual(left, right);
  });
  await test('their colours mean the same until they are told not to', async () => {
    const [left, right] = await ends();
    assert.equal(left, right);
    await tab.locator('.tick', { hasText: 'same colours' }).locator('input').uncheck();
    await settled(tab);
    const [alone, other] = await ends();
    assert.notEqual(alone, other);
    await tab.locator('.tick', { hasText: 'same colours' }).locator('input').check();
  });
  await test('moment and camera move together', async () => {
    const before = await images();
    await goTo(tab, 10);
    const earlier = await images();
    await tab.locator('.view canvas').nth(1).focus();
    await tab.keyboard.press('+');
    const closer = await images();
    for (const i of [0, 1]) assert.equal(new Set([before[i], earlier[i], closer[i]]).size, 3, `view ${i}`);
    await tab.keyboard.press('0');
    await goTo(tab, 20);
  });
  await test('the pointer on one tells the values of both at the same place', async () => {
    const found = await probe(tab, 4);
    compare(found, nodesOf(insulated));
    const other = await tab.locator('.readout').nth(1).evaluate((readout) => ({
      node: Number(readout.dataset.node),
      values: [...readout.querySelectorAll('[data-field]')].map((e) =>
        [e.dataset.field, e.dataset.component, Number(e.dataset.value), e.textContent]) }));
    compare(new Map([[other.node, other.values]]), nodesOf(coarse));
  });
  await test('side by side nothing is complained of', () => assert.deepEqual(complaints, []));
});

const solid = join(folder, 'solid.toml');
writeFileSync(solid, `title = "A block"
mesh.box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [6, 6, 6], cell = "tetrahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 3 }
boundary = [ { on = "right", displacement = [0, 0, 0], potential = 0, temperature = 0 },
             { on = "top", traction = [0, 0, "-50*t"] } ]
[contact]
on = "left"
friction = { law = "tresca", bound = 15 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }
`);
const block = join(folder, 'block');
execFileSync(program, ['run', solid, '-q', '-o', block]);
await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(block, 'report.html'));
  await test('a solid body turns under the mouse and zooms with the wheel', async () => {
    const box = await centred(tab, '.view canvas');
    const middle = [box.x + box.width / 2, box.y + box.height / 2];
    const before = await pixels(tab, '.view canvas');
    await tab.mouse.move(...middle);
    await tab.mouse.down();
    await tab.mouse.move(middle[0] + 120, middle[1] - 40, { steps: 4 });
    await tab.mouse.up();
    const turned = await pixels(tab, '.view canvas');
    await tab.locator('.view canvas').first().focus();
    await tab.mouse.wheel(0, -300);
    await tab.waitForTimeout(200);
    const closer = await pixels(tab, '.view canvas');
    assert.equal(new Set([before, turned, closer]).size, 3);
    await tab.keyboard.press('0');
  });
  await test('values on the surface of a solid body are those of nodes.csv', async () =>
    compare(await probe(tab, 3), nodesOf(block)));
  await test('the contact face shows stick and slip, tractions, slip, temperature and heat', async () => {
    assert.equal(await tab.locator('#contact canvas.face').count(), 6);
    for (const i of [1, 3]) assert.ok((await colours(tab, '#contact canvas.face', i)) > 3, `face ${i} is empty`);
    const late = await pixels(tab, '#contact canvas.face', 1);
    await goTo(tab, 1);
    assert.notEqual(await pixels(tab, '#contact canvas.face', 1), late);
  });
  await test('of a solid body nothing is complained of', () => assert.deepEqual(complaints, []));
});

/** The setting and the deformed mesh of a page, in light and dark. */
async function pictures(file) {
  const seen = {};
  for (const colorScheme of ['light', 'dark'])
    await inBrowser({ ...desktop, colorScheme }, async (context) => {
      const { tab, complaints } = await open(context, file);
      seen[colorScheme] = { setting: await pixels(tab, '.card canvas', 0), mesh: await pixels(tab, '.card canvas', 1) };
      seen.legend = await tab.locator('.card.setting .legend').textContent();
      seen.complaints = [...(seen.complaints ?? []), ...complaints];
    });
  return seen;
}

for (const [what, out, names] of [
  ['a strip of two layers', run('bimorph', 'devices/bimorph.toml', 'time.steps=1'), ['poling', 'upper', 'lower', 'BaTiO3-Liu2014']],
  ['a solid body', block, ['poling']]])
  await test(`the setting of ${what} has arrows along the poling, in light and dark`, async () => {
    const text = readFileSync(join(out, 'report.html'), 'utf8');
    const without = join(out, 'without.html');
    writeFileSync(without, text.replace(/"poling":\{[^}]*\}/, '"poling":null'));
    const [arrows, none] = [await pictures(join(out, 'report.html')), await pictures(without)];
    for (const theme of ['light', 'dark']) {
      assert.notEqual(arrows[theme].setting, none[theme].setting, theme);
      assert.equal(arrows[theme].mesh, none[theme].mesh, theme);
    }
    for (const name of names) assert.ok(arrows.legend.includes(name), `the legend lacks "${name}": ${arrows.legend}`);
    assert.ok(!none.legend.includes('poling'));
    assert.deepEqual([...arrows.complaints, ...none.complaints], []);
  });
for (const layers of [[1, -1], [-1, 1]]) run(`poled${layers[0]}`, 'devices/bimorph.toml', 'time.steps=1',
  ...layers.map((up, i) => `region[${i}].material.poling=[0, ${up}]`));
await test('arrows turn with the poling', async () => {
  const [one, other] = [await pictures(join(folder, 'poled1/report.html')), await pictures(join(folder, 'poled-1/report.html'))];
  assert.notEqual(one.light.setting, other.light.setting);
});

const plate = (on) => `mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [32, 16], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 10 }
boundary = [ { on = "left", displacement = ["1e-9*t", "free"], potential = 0 } ]
[contact]
on = ${on}
friction = { law = "tresca", bound = 500 }
`;

/** The colour in a map of stick and slip at a moment and a place along the piece, both from 0 to 1. */
const mapColour = (tab, piece, time, along) => tab.locator(`[data-piece="${piece}"] .chart`).last().evaluate((chart, [t, s]) => {
  const canvas = chart.querySelector('canvas'), frame = canvas.getBoundingClientRect();
  const over = chart.querySelector('.u-over').getBoundingClientRect();
  const ratio = canvas.width / frame.width;
  const x = (over.left - frame.left + t * over.width) * ratio, y = (over.bottom - frame.top - s * over.height) * ratio;
  const at = Math.min((over.bottom - frame.top) * ratio - 1, Math.max((over.top - frame.top) * ratio, y));
  const copy = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
  copy.drawImage(canvas, -Math.floor(x), -Math.floor(at));
  const [r, g, b] = copy.getImageData(0, 0, 1, 1).data;
  return '#' + [r, g, b].map((v) => v.toString(16).padStart(2, '0')).join('');
}, [time, along]);

/** What the legend of a chart says with the pointer there, as numbers. */
async function hovered(tab, piece, chart, across) {
  const over = tab.locator(`[data-piece="${piece}"] .chart`).nth(chart).locator('.u-over');
  await over.evaluate((e) => e.scrollIntoView({ block: 'center', behavior: 'instant' }));
  await settled(tab);  // what comes to the screen is drawn now, of the moment that is shown
  const box = await over.boundingBox();
  await tab.mouse.move(box.x + across * (box.width - 1), box.y + box.height / 2);
  await settled(tab);
  const texts = await tab.locator(`[data-piece="${piece}"] .chart`).nth(chart).locator('.u-value').allTextContents();
  return texts.map((text) => numberIn(`x ${text}`));
}

const two = runText('two', plate('["bottom", "top"]'));
await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(two, 'report.html'));
  const rows = tableOf(two, 'contact.csv');
  const of = { bottom: rows.filter((r) => r.y === 0), top: rows.filter((r) => r.y > 0) };
  await test('two contacts have curves of their own', async () => {
    assert.deepEqual(await tab.locator('.piece h4').allTextContents(), ['bottom', 'top']);
    for (const piece of ['bottom', 'top']) {
      const last = of[piece].filter((r) => r.step === 10);
      for (const across of [0, 0.4, 1]) {
        const [x, traction] = await hovered(tab, piece, 0, across);
        const row = last.find((r) => Math.abs(r.x - x) < 1e-5);
        assert.ok(row, `nothing stands at x = ${x}`);
        const power = 1e3 ** Math.round(Math.log10(row.normal_traction / traction) / 3);
        assert.ok(Math.abs(traction * power - row.normal_traction) <= 1e-3 * Math.abs(row.normal_traction),
          `${piece} at ${x}: ${traction}, contact.csv has ${row.normal_traction}`);
      }
    }
  });
  await test('every node of the map has the status of contact.csv, those at the ends too', async () => {
    const colour = { stick: '#3f7fb5', slip: '#e07b39' };
    await goTo(tab, 0);
    await settled(tab);
    const seen = new Set();
    for (const piece of ['bottom', 'top'])
      for (const row of of[piece]) {
        seen.add(row.status);
        assert.equal(await mapColour(tab, piece, (row.step - 0.4) / 10, row.x / 0.02), colour[row.status],
          `${piece}, x = ${row.x}, step ${row.step}: ${row.status}`);
      }
    assert.equal(seen.size, 2);
    await goTo(tab, 10);
  });
  await test('of a plane body units are those of a metre of depth', async () => {
    const units = await tab.locator('#history .chart').evaluateAll((charts) => charts.map((c) =>
      [c.querySelector('figcaption').textContent, c.dataset.unit]));
    for (const [title, unit] of [['Energies', 'J/m'], ['Power and losses', 'W/m']])
      assert.equal(new Map(units).get(title), unit);
  });
  await test('of two contacts nothing is complained of', () => assert.deepEqual(complaints, []));
});

const isothermal = runText('isothermal', plate('"bottom"'), 'material.m11=0', 'material.m33=0', 'material.pyroelectric=[0, 0]');
await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(isothermal, 'report.html'));
  await test('a temperature that is 0 everywhere has no invented scale', async () => {
    assert.ok(nodesOf(isothermal).every((row) => row.temperature === 0));
    assert.equal(await tab.locator('.card', { hasText: 'Temperature' }).locator('.ticks').textContent(), '0 everywhere');
    assert.match(await tab.locator('#contact .chart', { hasText: 'Temperature' }).textContent(), /0 everywhere/);
    await tab.selectOption('#field', 'temperature');
    await settled(tab);
    assert.equal(await tab.locator('.view .ticks').textContent(), '0 everywhere');
    assert.deepEqual(complaints, []);
  });
});

await test('a case of one step has a table instead of curves', async () => {
  const out = join(folder, 'bimorph');
  await inBrowser(desktop, async (context) => {
    const { tab } = await open(context, join(out, 'report.html'));
    assert.equal(await tab.locator('#history canvas').count(), 0);
    assert.match(await tab.locator('.brief').first().textContent(), / · 1 step · /);
    const said = new Map(await tab.locator('#history tbody tr').evaluateAll((rows) => rows.map((r) =>
      [r.querySelector('th').textContent, [Number(r.querySelector('td').dataset.value), r.querySelector('td').textContent]])));
    const [row] = tableOf(out, 'history.csv');
    const charges = [...said].filter(([name]) => name.startsWith('Charge'));
    assert.ok(charges.length > 0 && charges.every(([, [, text]]) => text.endsWith(' C/m')), String(charges));
    for (const [name, column, unit] of [['Energies: elastic', 'elastic_energy', 'J/m'], ['Largest displacement', 'max_displacement', 'm']]) {
      const [value, text] = said.get(name);
      assert.ok(Math.abs(value - row[column]) <= 1e-6 * Math.abs(row[column]), `${name}: ${value}, history.csv has ${row[column]}`);
      assert.ok(text.endsWith(` ${unit}`), text);
    }
  });
});

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(two, 'report.html'));
  await test('the page says which way tangential traction and slip are positive', async () => {
    for (const title of ['Tangential traction', 'Slip'])
      assert.match(await tab.locator('#contact .chart', { hasText: title }).first().textContent(), /positive towards growing x/);
    assert.doesNotMatch(await tab.locator('#contact .chart', { hasText: 'Normal traction' }).first().textContent(), /positive/);
    assert.deepEqual(complaints, []);
  });
});

const ring = (on, displacement) => `mesh.annulus = { inner = 0.02, outer = 0.04, cells = [4, 32], cell = "quadrilateral" }
mesh.degree = 2
material.library = "steel"
time = { end = 1, steps = 4 }
boundary = [ { on = "outer", displacement = ${displacement}, potential = 0 } ]
[contact]
on = "${on}"
friction = { law = "tresca", bound = 3e6 }
`;
const turned = runText('turned', ring('inner', '["-1e-6*t*y/0.04", "1e-6*t*x/0.04"]'));
const pressed = runText('pressed', ring('inner', '["-1e-6*t*x/0.04", "-1e-6*t*y/0.04"]'));
for (const [out, what, silent, drawn] of [[turned, 'turned', 'Normal traction', 'Tangential traction'],
  [pressed, 'pressed', 'Tangential traction', 'Normal traction']])
  await inBrowser(desktop, async (context) => {
    const { tab, complaints } = await open(context, join(out, 'report.html'));
    await test(`of a ring that is only ${what} round-off is no curve`, async () => {
      const chart = (title) => tab.locator('#contact .chart', { hasText: title }).first();
      assert.match(await chart(silent).textContent(), /below round-off, at most|0 everywhere/);
      assert.equal(await chart(silent).locator('canvas').count(), 0);
      assert.equal(await chart(drawn).locator('canvas').count(), 1);
      if (what === 'turned') {
        assert.match(await chart(silent).textContent(), /below round-off, at most/);
        assert.match(await chart(drawn).textContent(), /positive along the curve/);
      }
      assert.deepEqual(complaints, []);
    });
  });

const lifting = (box, displacement) => `mesh.box = ${box}
material.library = "BaTiO3-Liu2014"
time = { end = 2, steps = 5 }
boundary = [ { on = "top", displacement = ${displacement}, potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
gap = "2e-7*(1 - x/0.02)"
foundation_displacement = ${displacement.split(',').length === 3 ? '["1e-7*t", 0, 0]' : '["1e-7*t", 0]'}
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.3 }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }
`;
const plane = runText('lifting', lifting('{ min = [0, 0], max = [0.02, 0.01], cells = [20, 10], cell = "quadrilateral" }',
  '["1e-6*sin(2*t)", "-5e-7*t"]'));
const thick = runText('lifting-solid', lifting(
  '{ min = [0, 0, 0], max = [0.02, 0.01, 0.01], cells = [8, 3, 3], cell = "hexahedron" }', '["1e-6*sin(2*t)", 0, "-5e-7*t"]'));

/** What the page says of the chosen contact node. */
const saidOfNode = async (tab) => Object.fromEntries(await tab.locator('.node .values [data-quantity]').evaluateAll((spans) =>
  spans.map((s) => [s.dataset.quantity, s.dataset.value === undefined ? s.textContent : Number(s.dataset.value)])));
const isClose = (value, wanted) => assert.ok(Math.abs(value - wanted) <= 1e-6 * Math.abs(wanted) + 1e-30, `${value}, contact.csv has ${wanted}`);

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(plane, 'report.html'));
  const rows = tableOf(plane, 'contact.csv');
  const at = (step) => rows.filter((r) => r.step === step);
  await test('of contact that opens there are opening and pressure, with the values of contact.csv', async () => {
    const titles = await tab.locator('[data-piece] figcaption').allTextContents();
    assert.deepEqual(titles.slice(0, 3), ['Opening', 'Contact pressure', 'Tangential traction and the bound ±S']);
    assert.ok(!titles.includes('Normal traction on the body') && titles.at(-1) === 'Open, stick and slip', String(titles));
    await goTo(tab, 1);
    for (const [chart, value] of [[0, (r) => r.gap], [1, (r) => -r.normal_traction]])
      for (const across of [0, 0.3, 0.85]) {
        const [x, said] = await hovered(tab, 'bottom', chart, across);
        const row = at(1).find((r) => Math.abs(r.x - x) < 1e-5);
        assert.ok(row, `nothing stands at x = ${x}`);
        const wanted = value(row);
        const power = Math.abs(wanted) < 1e-15 ? 1 : 1e3 ** Math.round(Math.log10(wanted / said) / 3);
        assert.ok(Math.abs(said * power - wanted) <= 1e-3 * Math.abs(wanted) + 1e-15, `chart ${chart} at ${x}: ${said}, contact.csv has ${wanted}`);
      }
  });
  await test('open nodes have a colour of their own, and every node of the map the status of contact.csv', async () => {
    const colour = { open: '#aeb6c0', stick: '#3f7fb5', slip: '#e07b39' };
    await goTo(tab, 0);
    await settled(tab);
    for (const row of rows)
      assert.equal(await mapColour(tab, 'bottom', (row.step - 0.4) / 5, row.x / 0.02), colour[row.status],
        `x = ${row.x}, step ${row.step}: ${row.status}`);
    assert.deepEqual(new Set(rows.map((r) => r.status)), new Set(['open', 'stick', 'slip']));
    assert.deepEqual(await tab.locator('[data-piece] .chart').last().locator('.legend li').allTextContents(), ['open', 'stick', 'slip']);
  });
  await test('a contact node is told and drawn over the steps as contact.csv has it', async () => {
    assert.deepEqual(await tab.locator('.node figcaption').allTextContents(),
      ['Tangential traction over slip', 'Friction bound over pressure', 'Pressure over opening']);
    for (let i = 0; i < 3; ++i) assert.ok((await colours(tab, '.node canvas', i)) > 3, `diagram ${i} is empty`);
    const images = new Set();
    for (const node of [0, 7, 20]) {
      await tab.locator('.node input').fill(String(node));
      images.add(await pixels(tab, '.node canvas', 0));
      for (const step of [1, 3, 5]) {
        await goTo(tab, step);
        await settled(tab);
        const row = at(step).sort((a, b) => a.x - b.x)[node];
        const said = await saidOfNode(tab);
        isClose(said.slip, row.slip_x);
        isClose(said.traction, row.tangential_traction_x);
        isClose(said.pressure, -row.normal_traction);
        isClose(said.bound, row.friction_bound);
        isClose(said.opening, row.gap);
        assert.equal(said.status, row.status);
      }
    }
    assert.equal(images.size, 3);
  });
  await test('open nodes, the foundation\'s power and the contact are among what is drawn over time', async () => {
    const legend = (title) => tab.locator('#history .chart', { hasText: title }).locator('.u-label').allTextContents();
    assert.ok((await legend('Contact nodes')).includes('open'));
    assert.ok((await legend('Friction dissipation and power of the loads')).includes('foundation'));
  });
  await test('of contact that opens nothing is complained of', () => assert.deepEqual(complaints, []));
});

const crossed = runText('crossed', lifting('{ min = [0, 0], max = [0.02, 0.01], cells = [20, 10], cell = "quadrilateral" }',
  '["1e-6*sin(2*t)", "-5e-7*t"]') + 'electric = { law = "leak", coefficient = 1e-6, foundation_potential = 5, ramp = 2e-7 }\n',
  'contact.heat.friction_share=0.5');
await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(crossed, 'report.html'));
  await test('heat of friction with its two shares, the potential and the charge at the contact are drawn', async () => {
    assert.deepEqual(await tab.locator('#history .chart', { hasText: 'Heat of friction' }).locator('.u-label').allTextContents(),
      ['t [s]', 'made', 'into the body', 'into the foundation']);
    const titles = await tab.locator('[data-piece] figcaption').allTextContents();
    for (const title of ['Temperature', 'Heat flux out of the body', 'Potential', 'Charge out of the body'])
      assert.ok(titles.includes(title), `no "${title}" in ${titles}`);
    assert.deepEqual(complaints, []);
  });
  await test('without friction heat there is no chart of it', async () => {
    const other = await open(context, join(plane, 'report.html'));
    assert.ok(!(await other.tab.locator('#history figcaption').allTextContents()).includes('Heat of friction'));
  });
});

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(thick, 'report.html'));
  const rows = tableOf(thick, 'contact.csv').filter((r) => r.step === 5);
  await test('on the contact face of a solid body a click chooses the node that is told', async () => {
    const titles = await tab.locator('#contact figcaption').allTextContents();
    for (const title of ['Open, stick and slip', 'Opening', 'Contact pressure']) assert.ok(titles.includes(title), String(titles));
    const chosen = new Set();
    for (const across of [0.1, 0.9]) {
      const box = await centred(tab, '#contact canvas.face');
      await tab.mouse.click(box.x + across * box.width, box.y + box.height / 2);
      await settled(tab);
      const where = (await tab.locator('.node output').textContent()).split(', ').map((text) => numberIn(text.replace('= ', '')));
      chosen.add(String(where));
      const row = rows.find((r) => [r.x, r.y, r.z].every((v, i) => Math.abs(v - where[i]) < 1e-5));
      assert.ok(row, `no node at ${where}`);
      assert.ok(across < 0.5 ? row.x < 0.01 : row.x > 0.01, `x = ${row.x}`);
      const said = await saidOfNode(tab);
      isClose(said.pressure, -row.normal_traction);
      isClose(said.bound, row.friction_bound);
      isClose(said.opening, row.gap);
      assert.ok(Math.abs(said.slip) <= Math.hypot(row.slip_x, row.slip_y, row.slip_z) * (1 + 1e-6));
      assert.ok(Math.abs(said.traction) <= row.friction_bound * (1 + 1e-6) + 1e-9);
    }
    assert.equal(chosen.size, 2);
    await seen(tab);
    for (let i = 0; i < 3; ++i) assert.ok((await colours(tab, '.node canvas', i)) > 3, `diagram ${i} is empty`);
    assert.deepEqual(complaints, []);
  });
});
await test('bilateral contact with Tresca\'s law has no opening and no diagrams of pressure', async () => {
  await inBrowser(desktop, async (context) => {
    const { tab } = await open(context, join(two, 'report.html'));
    assert.equal(await tab.locator('.node').count(), 0);
    const titles = await tab.locator('#contact figcaption').allTextContents();
    assert.ok(titles.includes('Normal traction on the body') && titles.includes('Stick and slip'));
    for (const title of ['Opening', 'Contact pressure', 'Open, stick and slip']) assert.ok(!titles.includes(title), title);
  });
});

const alone = runText('alone', plate('"bottom"').replace(/\[contact\][^]*/, '').replace('"free"', '0'));
await inBrowser(desktop, async (context) => {
  const titles = async (out) => {
    const { tab } = await open(context, join(out, 'report.html'));
    return tab.locator('#history figcaption').allTextContents();
  };
  await test('without contact there is no chart of iterations', async () => {
    assert.ok(!(await titles(alone)).includes('Newton iterations'));
    assert.ok((await titles(alone)).includes('Largest displacement'));
    assert.ok((await titles(two)).includes('Newton iterations'));
  });
});

await test('probes have their curves under their names', async () => {
  const out = runText('probed', `${plate('"bottom"')}
[[probe]]
name = "tip"
at = [0.02, 0.01]
[[probe]]
name = "clamp"
on = "left"
[[probe]]
name = "line"
from = [0, 0]
to = [0.02, 0]
points = 3
`);
  await inBrowser(desktop, async (context) => {
    const { tab, complaints } = await open(context, join(out, 'report.html'));
    assert.deepEqual(await tab.locator('#probes h3').allTextContents(), ['tip', 'clamp', 'line']);
    const titles = await tab.locator('#probes figcaption').allTextContents();
    for (const title of ['Displacement', 'Potential', 'Force on the body', 'Displacement along the line']) assert.ok(titles.includes(title), title);
    assert.equal(await tab.locator('#probes canvas').count(), titles.length);
    assert.deepEqual(complaints, []);
  });
});

await test('two runs of one title are told apart, also in folders of one name', async () => {
  const title = 'The same case';
  for (const [one, other, names] of [['twins/a', 'twins/b', ['a', 'b']], ['twins/x/run', 'twins/y/run', ['x/run', 'y/run']]]) {
    for (const name of [one, other]) {
      mkdirSync(join(folder, name, '..'), { recursive: true });
      cpSync(two, join(folder, name), { recursive: true });
      const resolved = join(folder, name, 'resolved.toml');
      writeFileSync(resolved, readFileSync(resolved, 'utf8').replace(/^title = .*$/m, `title = "${title}"`));
    }
    const page = join(folder, 'twins.html');
    execFileSync(program, ['report', join(folder, one), join(folder, other), '-o', page]);
    await inBrowser(desktop, async (context) => {
      const { tab } = await open(context, page);
      const wanted = names.map((name) => `${title} (${name})`);
      assert.deepEqual(await tab.locator('h1').allTextContents(), wanted);
      for (const section of ['#contact', '#history', '#run'])
        assert.deepEqual(await tab.locator(`${section} h3.whose`).allTextContents(), wanted);
      assert.equal(await tab.title(), wanted.join(' | '));
    });
  }
});

writeFileSync(join(folder, 'post.geo'), `SetFactory("Built-in");
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Line {1, 2, 3, 4} = 4; Transfinite Surface {1};
out[] = Extrude {0, 0, 2} { Surface{1}; Layers{4}; };
Physical Surface("foot") = {1}; Physical Surface("head") = {out[0]}; Physical Volume("post") = {out[1]};
`);
const post = runText('post', `mesh = { file = "post.geo", scale = 1e-2, unnamed = "natural" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
boundary = [ { on = "foot", displacement = [0, 0, 0], potential = 0 }, { on = "head", potential = 1 } ]
`);
const opaque = (tab, which) => tab.locator('.card canvas').nth(which).evaluate((canvas) => {
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true });
  copy.drawImage(canvas, 0, 0);
  return copy.getImageData(0, 0, canvas.width, canvas.height).data.filter((v, i) => i % 4 === 3 && v > 0).length / (canvas.width * canvas.height);
});
await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(post, 'report.html'));
  await test('the setting of a solid body shows its faces without a name, and the legend says so', async () => {
    const [setting, deformed] = [await opaque(tab, 0), await opaque(tab, 1)];
    assert.ok(setting > 0.7 * deformed, `${setting} of the picture, the deformed body ${deformed}`);
    assert.match(await tab.locator('.card.setting .legend').textContent(), /other faces no condition/);
    assert.deepEqual(complaints, []);
  });
});
await test('a body all of whose sides have names has no others', async () => {
  await inBrowser(desktop, async (context) => {
    const { tab } = await open(context, join(two, 'report.html'));
    assert.doesNotMatch(await tab.locator('.card.setting .legend').textContent(), /other sides/);
  });
});

await test('what the run warns of stands first on the page', async () => {
  const warned = join(folder, 'warned.html');
  const text = readFileSync(join(two, 'report.html'), 'utf8');
  writeFileSync(warned, text.replace('"warnings":[]', '"warnings":["the energies do not balance"]'));
  await inBrowser(desktop, async (context) => {
    const { tab } = await open(context, warned);
    assert.match(await tab.locator('.notices').textContent(), /the energies do not balance/);
  });
});

end();
