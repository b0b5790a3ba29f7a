// node tests/contact_faces.mjs TOURMALINE: the contact of solid bodies laid out, every node with the values of contact.csv.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { inBrowser } from './browser.mjs';
import { desktop, end, open, run, settled, tableOf, test } from './harness.mjs';

const out = run('sleeve', 'ring/sleeve.toml', 'mesh.annulus.cells=[2, 40, 7]', 'time.steps=4');
const last = tableOf(out, 'contact.csv').filter((row) => row.step === 4);
const radius = 0.02, height = 0.03;

/** The colour of a canvas at places [m] right and up in the unrolled contact. */
const coloursAt = (tab, title, places) => tab.locator('#contact .chart', { has: tab.locator(`figcaption:text-is("${title}")`) })
  .locator('canvas.face').evaluate((canvas, { places, wide, high }) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    const scale = 0.94 * Math.min(canvas.width / wide, canvas.height / high);
    const left = (canvas.width - wide * scale) / 2, foot = (canvas.height + high * scale) / 2;
    return places.map(([x, y]) => {
      const at = 4 * (Math.round(foot - y * scale - 0.5) * canvas.width + Math.round(left + x * scale - 0.5));
      return [...data.slice(at, at + 4)];
    });
  }, { places, wide: 2 * Math.PI * radius, high: height });

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(out, 'report.html'));
  const show = async (title) => {
    await tab.locator('#contact .chart', { has: tab.locator(`figcaption:text-is("${title}")`) }).scrollIntoViewIfNeeded();
    for (let i = 0; i < 3; ++i) await settled(tab);
  };
  // A little inwards of the ends, which belong to the nodes there.
  const inside = (v, most) => Math.min(Math.max(v, 0.004 * most), 0.996 * most);
  const places = last.map((row) => {
    const angle = Math.atan2(row.y, row.x);
    return [inside((angle < -1e-6 ? angle + 2 * Math.PI : Math.max(angle, 0)) * radius, 2 * Math.PI * radius), inside(row.z, height)];
  });
  await test('the inside of a sleeve is unrolled: every node has a place of its own, with its status', async () => {
    assert.equal(last.length, 320);
    assert.equal(new Set(places.map(String)).size, 320);
    assert.match(await tab.locator('#contact h4').first().textContent(), /around z, radius 0\.02 m/);
    assert.match(await tab.locator('#contact .note').first().textContent(), /unrolled from x = 0\.02 m, y = 0 m, counter-clockwise/);
    await show('Stick and slip');
    const colours = { stick: [0x3f, 0x7f, 0xb5, 255], slip: [0xe0, 0x7b, 0x39, 255] };
    const found = await coloursAt(tab, 'Stick and slip', places);
    last.forEach((row, i) => assert.deepEqual(found[i], colours[row.status], `${row.x}, ${row.y}, ${row.z}: ${row.status}`));
  });
  for (const [title, value] of [['Normal traction on the body', (row) => row.normal_traction],
    ['Slip, size', (row) => Math.hypot(row.slip_x, row.slip_y, row.slip_z)]])
    await test(`every node has the colour of its value: ${title}`, async () => {
      await show(title);
      const maps = await tab.evaluate(() => JSON.parse(document.getElementById('results').textContent).colourMaps);
      const all = tableOf(out, 'contact.csv').map(value);
      const [low, high] = [Math.min(...all), Math.max(...all)];
      const signed = low < 0 && high > 0 && Math.min(-low, high) > Math.max(-low, high) / 10;
      const size = Math.max(-low, high);
      const [from, to] = signed ? [-size, size] : [low, high];
      const found = await coloursAt(tab, title, places);
      const seen = new Set();
      last.forEach((row, i) => {
        const level = Math.round((255 * (value(row) - from)) / (to - from));
        // One level less or more, as the page has single precision.
        const near = [level - 1, level, level + 1].filter((l) => l >= 0 && l < 256).map((l) => maps[signed ? 'signed' : 'even'].substr(6 * l, 6));
        const hex = found[i].slice(0, 3).map((v) => v.toString(16).padStart(2, '0')).join('');
        assert.ok(near.includes(hex), `${row.x}, ${row.y}, ${row.z}: ${value(row)} is #${hex}, not one of ${near}`);
        seen.add(hex);
      });
      assert.ok(seen.size > 5, `only ${seen.size} colours`);
    });
  await test('the table behind a face has the rows of contact.csv', async () => {
    const chart = tab.locator('#contact .chart', { has: tab.locator('figcaption:text-is("Normal traction on the body")') });
    await chart.locator('summary').click();
    await chart.locator('tbody tr').nth(319).waitFor();  // the table is made as it is opened
    const said = await chart.locator('tbody tr').evaluateAll((trs) => trs.map((tr) => [...tr.children].map((td) => Number(td.dataset.value))));
    assert.equal(said.length, 320);
    said.forEach((values, i) => [last[i].x, last[i].y, last[i].z, last[i].normal_traction].forEach((wanted, k) =>
      assert.ok(Math.abs(values[k] - wanted) <= 1e-7 * Math.abs(wanted) + 1e-12, `row ${i}: ${values}`)));
    assert.deepEqual(complaints, []);
  });
});
end();
