// node tests/compared.mjs TOURMALINE: two runs on one page: moments, axes, rows, magnification, views.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { inBrowser } from './browser.mjs';
import { compare, desktop, end, folder, goTo, nodesOf, open, phone, probe, program, run, runText, seen, settled, tableOf, test } from './harness.mjs';

const grid = 'mesh.box.cells=[8, 8]';
const short = run('short', 'ouafik-2020/conductive.toml', grid, 'time.end=0.05', 'time.steps=5');
const long = run('long', 'ouafik-2020/insulated.toml', grid, 'time.end=0.2', 'time.steps=8');
const both = join(folder, 'both.html');
execFileSync(program, ['report', short, long, '-o', both]);

const view = (tab, i) => tab.locator('.view').nth(i);
const axesOf = (tab, title) => tab.locator('#contact .chart, #history .chart', { has: tab.locator(`figcaption:text-is("${title}")`) })
  .evaluateAll((charts) => charts.map((c) => c.dataset.axes?.split(' ').map(Number)));

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, both);
  const last = await tab.locator('#time').getAttribute('max');
  await test('two runs begin at the last moment that both have', async () => {
    assert.match(await tab.locator('.moment').textContent(), /t = 0\.05 s/);
    assert.equal(await tab.locator('.beyond').textContent(), '');
    compare(await probe(tab, 3), nodesOf(short));
  });
  await test('of a moment between the field files of a run the page says which it shows', async () => {
    await goTo(tab, 1);
    assert.match(await tab.locator('.moment').textContent(), /t = 0\.01 s/);
    await view(tab, 0).scrollIntoViewIfNeeded();
    await settled(tab);
    await settled(tab);
    assert.doesNotMatch(await view(tab, 0).locator('.note').textContent(), /nearest/);
    assert.match(await view(tab, 1).locator('.note').textContent(), /fields of t = (0|0\.025) s, the nearest/);
  });
  await test('what a run does not reach is not shown, and said', async () => {
    await goTo(tab, last);
    await view(tab, 0).scrollIntoViewIfNeeded();
    await settled(tab);
    await settled(tab);
    assert.match(await tab.locator('.beyond').textContent(), /^short: the run ends at t = 0\.05 s$/);
    assert.match(await view(tab, 0).locator('.note').textContent(), /the run ends at t = 0\.05 s/);
    assert.doesNotMatch(await view(tab, 1).locator('.note').textContent(), /ends/);
    // Only the letters of the text; the other body covers much of its picture.
    const drawnIn = (i) => view(tab, i).locator('canvas').evaluate((canvas) => {
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
      copy.drawImage(canvas, 0, 0);
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
      let drawn = 0;
      for (let i = 3; i < data.length; i += 4) if (data[i] > 0) ++drawn;
      return drawn / (data.length / 4);
    });
    const drawn = [await drawnIn(0), await drawnIn(1)];
    assert.ok(drawn[0] < 0.02 && drawn[1] > 0.2, String(drawn));
    const strays = await tab.locator('#contact .stray').allTextContents();
    assert.deepEqual(strays, ['the run ends at t = 0.05 s', '']);
    const table = tab.locator('#contact .chart', { hasText: 'Temperature' }).first().locator('details');
    await table.evaluate((d) => { d.open = true; });
    await settled(tab);
    assert.equal(await table.locator('td').nth(1).textContent(), '–');
    await table.evaluate((d) => { d.open = false; });
  });
  await test('charts of one quantity have the same axes, which hold the values of both, until they are told not to', async () => {
    await goTo(tab, last);
    await seen(tab);
    for (const [title, file, column] of [['Temperature', 'contact.csv', 'temperature'], ['Largest displacement', 'history.csv', 'max_displacement']]) {
      const [one, other] = await axesOf(tab, title);
      assert.deepEqual(one, other, title);
      for (const out of [short, long])
        for (const row of tableOf(out, file)) assert.ok(row[column] >= one[2] - 1e-9 * Math.abs(one[2]) && row[column] <= one[3] * (1 + 1e-6), title);
    }
    const [time] = await axesOf(tab, 'Energies');
    assert.ok(time[0] <= 0.01 && time[1] >= 0.2, String(time));
    await tab.locator('#history .tick', { hasText: 'same axes' }).locator('input').uncheck();
    await seen(tab);
    const [one, other] = await axesOf(tab, 'Largest displacement');
    assert.notDeepEqual(one, other);
    assert.ok(one[1] < 0.1);
  });
  await test('a chart stands beside its counterpart, and a missing one has its place', async () => {
    for (const section of ['#contact', '#history']) {
      const rows = await tab.locator(`${section} .row`).evaluateAll((all) => all.map((row) => [...row.querySelectorAll('.chart')].map((chart) =>
        [chart.querySelector('figcaption').textContent, Math.round(chart.getBoundingClientRect().top)])).filter((charts) => charts.length > 0));
      assert.ok(rows.length > 3);
      for (const charts of rows) assert.deepEqual(charts[0], charts[1]);
    }
    const heat = tab.locator('#contact .row', { hasText: 'Heat flux out of the body' }).locator('.chart');
    assert.equal(await heat.nth(0).locator('.plot').count(), 1);
    assert.match(await heat.nth(1).textContent(), /not in this run/);
  });
  await test('the magnification can be the same, and is then that of the run that moves more', async () => {
    await goTo(tab, 3);
    const notes = async () => {
      await view(tab, 0).scrollIntoViewIfNeeded();
      await settled(tab);
      await settled(tab);
      return (await tab.locator('.view:not(.difference) .note').allTextContents()).map((text) => text.match(/displacement × [^ ]+/)[0]);
    };
    const own = await notes();
    assert.notEqual(own[0], own[1]);
    await tab.locator('.tick', { hasText: 'same magnification' }).locator('input').check();
    assert.deepEqual(await notes(), [own[0], own[0]]);
  });
  await test('of two runs nothing is complained of', () => assert.deepEqual(complaints, []));
});

await inBrowser(phone, async (context) => {
  const { tab } = await open(context, both);
  await test('on a phone, where charts stand below each other, each says whose it is', async () => {
    const row = tab.locator('#history .row').first();
    assert.deepEqual(await row.locator('.narrow').allTextContents(), ['short', 'long']);
    assert.ok(await row.locator('.narrow').first().isVisible());
    assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  });
});

const beam = runText('beam', `mesh.box = { min = [0, 0, 0], max = [0.01, 0.01, 0.08], cells = [2, 2, 12], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 0.2, steps = 2 }
boundary = [ { on = "bottom", displacement = [0, 0, 0], potential = 0, temperature = 0 }, { on = "top", traction = [50, 0, 0] } ]
`);
const unlike = join(folder, 'unlike.html');
execFileSync(program, ['report', long, beam, '-o', unlike]);
await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, unlike);
  await test('a plane and a solid body are both seen whole', async () => {
    for (const id of ['axes', 'marks']) await tab.locator(`#${id}`).uncheck();
    await view(tab, 0).scrollIntoViewIfNeeded();
    for (let i = 0; i < 3; ++i) await settled(tab);
    for (const i of [0, 1]) {
      const { rim, inside } = await view(tab, i).locator('canvas').evaluate((canvas) => {
        const { width, height } = canvas;
        const copy = new OffscreenCanvas(width, height).getContext('2d');
        copy.drawImage(canvas, 0, 0);
        const { data } = copy.getImageData(0, 0, width, height);
        const found = { rim: 0, inside: 0 };
        for (let y = 0; y < height; ++y)
          for (let x = 0; x < width; ++x)
            if (data[4 * (y * width + x) + 3] > 0) ++found[x < 2 || y < 2 || x >= width - 2 || y >= height - 2 ? 'rim' : 'inside'];
        return found;
      });
      assert.equal(rim, 0, `view ${i}`);
      assert.ok(inside > 3000, `view ${i}: ${inside} pixels`);
    }
    const before = await view(tab, 0).locator('canvas').evaluate((c) => c.toDataURL());
    await view(tab, 1).locator('canvas').focus();
    await tab.keyboard.press('+');
    for (let i = 0; i < 3; ++i) await settled(tab);
    assert.equal(await view(tab, 0).locator('canvas').evaluate((c) => c.toDataURL()), before);
    assert.deepEqual(complaints, []);
  });
});
end();
