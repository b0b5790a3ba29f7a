// node tests/readings.mjs TOURMALINE: values under the pointer, hand ranges, colours of solid bodies, units.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { inBrowser } from './browser.mjs';
import { desktop, end, goTo, numberIn, open, phone, run, runText, settled, tableOf, test } from './harness.mjs';

const out = run('conductive', 'ouafik-2020/conductive.toml', 'mesh.box.cells=[16, 16]');
const page = join(out, 'report.html');
const rows = tableOf(out, 'contact.csv');
const frames = async (tab) => { for (let i = 0; i < 3; ++i) await settled(tab); };
const valuesIn = (tab) => tab.locator('.readout').first().evaluate((readout) => ({
  place: readout.querySelector('.value')?.textContent ?? '',
  values: Object.fromEntries([...readout.querySelectorAll('[data-field]')].map((e) => [e.dataset.field + e.dataset.component, Number(e.dataset.value)])) }));
const isClose = (value, wanted, what) =>
  assert.ok(Math.abs(value - wanted) <= 2e-7 * Math.abs(wanted) + 1e-30, `${what}: the page says ${value}, contact.csv ${wanted}`);

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, page);
  await test('by keyboard one goes from node to node, and the values follow the moment', async () => {
    const canvas = tab.locator('.view > canvas').first();
    await canvas.scrollIntoViewIfNeeded();
    await canvas.focus();
    for (let i = 0; i < 20; ++i) await tab.keyboard.press('Shift+ArrowLeft');
    const seen = new Set();
    for (const step of [20, 5, 12]) {
      await goTo(tab, step);
      await frames(tab);
      const { place, values } = await valuesIn(tab);
      const [, x, y] = place.match(/at (\S+), (\S+)/).map((text) => numberIn(`x ${text}`));
      assert.equal(x, 0, place);
      const row = rows.find((r) => r.step === step && Math.abs(r.y - y) < 1e-6);
      assert.ok(row, `contact.csv has no node at ${place}`);
      for (const name of ['temperature', 'potential']) isClose(values[name], row[name], `${name} in step ${step}`);
      seen.add(values.temperature);
    }
    assert.equal(seen.size, 3);
    const before = await canvas.evaluate((c) => c.toDataURL());
    await canvas.focus();
    await tab.keyboard.press('Escape');
    await frames(tab);
    assert.notEqual(await canvas.evaluate((c) => c.toDataURL()), before);
    assert.deepEqual((await valuesIn(tab)).values, {});
  });
  await test('typed limits are taken in any order, mark what is beyond them, and are those of one field', async () => {
    await goTo(tab, 20);
    await tab.selectOption('#field', 'potential');
    await tab.selectOption('#range', 'hand');
    const input = (i) => tab.locator('.hand input').nth(i);
    const type = async (low, high) => {
      await input(0).fill(low);
      await input(1).fill(high);
      await tab.keyboard.press('Tab');
      await frames(tab);
    };
    await type('0.03', '-0.03');
    const ticks = await tab.locator('.view .ticks span:not(.unit)').allTextContents();
    const numbers = ticks.map((text) => numberIn(`x ${text.replace(/[≤≥] /, '')}`));
    assert.equal(numbers.length, 5);
    for (let i = 1; i < 5; ++i) assert.ok(numbers[i] > numbers[i - 1], String(ticks));
    const all = tableOf(out, 'history.csv').slice(-1)[0];
    assert.ok(all.max_potential > 0.03 && all.min_potential < -0.03);
    assert.ok(ticks[0].startsWith('≤ ') && ticks[4].startsWith('≥ '), String(ticks));
    await type('-1', '1');
    assert.doesNotMatch(await tab.locator('.view .ticks').textContent(), /[≤≥]/);
    await tab.selectOption('#field', 'temperature');
    await frames(tab);
    const [least, greatest] = [Number(await input(0).inputValue()), Number(await input(1).inputValue())];
    assert.ok(least < 0 && least > 2 * all.min_temperature && greatest < 0.01, `${least}, ${greatest}`);
    await tab.selectOption('#field', 'potential');
    await frames(tab);
    assert.deepEqual([await input(0).inputValue(), await input(1).inputValue()], ['-1', '1']);
  });
  await test('of readings nothing is complained of', () => assert.deepEqual(complaints, []));
});

for (const viewport of [{ width: 1400, height: 900 }, { width: 1366, height: 768 }])
  await inBrowser({ viewport }, async (context) => {
    const { tab } = await open(context, page);
    await test(`with the fields at the top the values are in front of the time bar (${viewport.width} x ${viewport.height})`, async () => {
      await tab.locator('#fields').evaluate((e) => e.scrollIntoView({ behavior: 'instant' }));
      const box = await tab.locator('.view > canvas').first().boundingBox();
      await tab.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
      await frames(tab);
      const [readout, bar] = [await tab.locator('.readout').first().boundingBox(), await tab.locator('.timebar').boundingBox()];
      assert.ok((await tab.locator('.readout .value').count()) >= 4);
      assert.ok(readout.y + readout.height <= bar.y + 1, `the readout ends at ${readout.y + readout.height}, the bar begins at ${bar.y}`);
      assert.ok(box.y >= 0 && box.y + box.height <= bar.y, 'the picture is cut off by the time bar');
    });
  });

await inBrowser(phone, async (context) => {
  const { tab } = await open(context, page);
  await test('the values stay when the finger is lifted', async () => {
    const canvas = tab.locator('.view > canvas').first();
    await canvas.scrollIntoViewIfNeeded();
    const box = await canvas.boundingBox();
    await tab.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2);
    await frames(tab);
    const late = await valuesIn(tab);
    assert.ok('temperature' in late.values);
    await goTo(tab, 5);
    await frames(tab);
    const early = await valuesIn(tab);
    assert.ok('temperature' in early.values && early.values.temperature !== late.values.temperature);
    assert.equal(early.place, late.place);
  });
});

const solid = runText('solid', `mesh.box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [6, 6, 6], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
boundary = [ { on = "right", displacement = [0, 0, 0], potential = 0, temperature = 0 }, { on = "left", temperature = "-20*y/0.1" },
             { on = "top", traction = [0, 0, "-50*t"] } ]
`);
await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(solid, 'report.html'));
  await test('on a solid body the colours are those of the colour bar, on every side that is seen', async () => {
    await tab.selectOption('#field', 'temperature');
    for (const id of ['axes', 'marks']) await tab.locator(`#${id}`).uncheck();
    await tab.locator('.tick', { hasText: 'mesh' }).locator('input').uncheck();
    await tab.locator('.view > canvas').scrollIntoViewIfNeeded();
    await frames(tab);
    const share = () => tab.locator('.view > canvas').evaluate((canvas) => {
      const bar = canvas.parentElement.querySelector('img.strip');
      const map = new OffscreenCanvas(256, 1).getContext('2d');
      map.drawImage(bar, 0, 0, 256, 1);
      const of = map.getImageData(0, 0, 256, 1).data;
      const near = new Set();
      for (let i = 0; i < 256; ++i)
        for (let r = -2; r <= 2; ++r) for (let g = -2; g <= 2; ++g) for (let b = -2; b <= 2; ++b)
          near.add(((of[4 * i] + r) << 16) | ((of[4 * i + 1] + g) << 8) | (of[4 * i + 2] + b));
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
      copy.drawImage(canvas, 0, 0);
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
      let all = 0, found = 0;
      for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] < 255) continue;
        ++all;
        if (near.has((data[i] << 16) | (data[i + 1] << 8) | data[i + 2])) ++found;
      }
      return found / all;
    });
    const unlit = await share();
    assert.ok(unlit > 0.93, `only ${unlit} of the pixels have a colour of the bar`);
    await tab.locator('.tick', { hasText: 'light' }).locator('input').check();
    await frames(tab);
    assert.ok((await share()) < 0.5, 'the light changes nothing');
    assert.deepEqual(complaints, []);
  });
});
end();
