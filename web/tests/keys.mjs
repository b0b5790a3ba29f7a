// node tests/keys.mjs TOURMALINE: the page without mouse, without eyes, without JavaScript.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { inBrowser } from './browser.mjs';
import { desktop, end, goTo, numberIn, open, run, seen, settled, tableOf, test } from './harness.mjs';

const out = run('conductive', 'ouafik-2020/conductive.toml', 'mesh.box.cells=[16, 16]');
const page = join(out, 'report.html');

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, page);
  await test('play and time are the first that the tab key comes to, after the theme', async () => {
    const reached = [];
    for (let i = 0; i < 3; ++i) {
      await tab.keyboard.press('Tab');
      reached.push(await tab.evaluate(() => document.activeElement.id));
    }
    assert.deepEqual(reached, ['theme', 'play', 'time']);
  });
  await test('the values under the pointer are a live region', async () =>
    assert.equal(await tab.locator('.readout').first().getAttribute('role'), 'status'));
  const chart = (title) => tab.locator('#contact .chart', { has: tab.locator(`figcaption:text-is("${title}")`) });
  await test('the legend hides and shows a curve by keyboard', async () => {
    const one = chart('Tangential traction and the bound ±S');
    await one.scrollIntoViewIfNeeded();
    await settled(tab);
    const image = () => one.locator('canvas').evaluate((canvas) => canvas.toDataURL());
    const label = one.locator('.u-series th').nth(1);
    const before = await image();
    await label.focus();
    assert.equal(await label.getAttribute('aria-pressed'), 'true');
    await tab.keyboard.press('Enter');
    await settled(tab);
    assert.equal(await label.getAttribute('aria-pressed'), 'false');
    assert.notEqual(await image(), before);
    await tab.keyboard.press('Space');
    await settled(tab);
    assert.equal(await label.getAttribute('aria-pressed'), 'true');
  });
  await test('arrow keys go from point to point of a curve', async () => {
    const one = chart('Temperature');
    await one.scrollIntoViewIfNeeded();
    await settled(tab);
    await one.locator('.u-over').focus();
    await tab.keyboard.press('Home');
    const rows = tableOf(out, 'contact.csv').filter((row) => row.step === 20).sort((a, b) => a.y - b.y);
    for (const row of rows.slice(0, 5)) {
      await settled(tab);
      const [y, value] = (await one.locator('.u-value').allTextContents()).map((text) => numberIn(`x ${text}`));
      assert.ok(Math.abs(y - row.y) < 1e-5, `${y}, ${row.y}`);
      if (row.temperature === 0) assert.equal(value, 0);
      const power = row.temperature === 0 ? 1 : 1e3 ** Math.round(Math.log10(row.temperature / value) / 3);
      assert.ok(Math.abs(value * power - row.temperature) <= 1e-3 * Math.abs(row.temperature), `${value}, ${row.temperature}`);
      await tab.keyboard.press('ArrowRight');
    }
  });
  await test('behind each chart there is a table with the numbers of the files', async () => {
    await seen(tab);
    assert.equal(await tab.locator('.chart').count(), await tab.locator('.chart > details.behind').count());
    await chart('Slip').locator('summary').focus();
    await tab.keyboard.press('Enter');
    for (const step of [20, 7]) {
      await goTo(tab, step);
      await settled(tab);
      const said = await chart('Slip').locator('details tbody tr').evaluateAll((trs) => trs.map((tr) => [...tr.children].map((td) => Number(td.dataset.value))));
      const rows = tableOf(out, 'contact.csv').filter((row) => row.step === step).sort((a, b) => a.y - b.y);
      assert.equal(said.length, rows.length);
      said.forEach(([y, slip], i) => {
        assert.ok(Math.abs(y - rows[i].y) < 1e-8);
        assert.ok(Math.abs(slip - rows[i].slip_y) <= 1e-7 * Math.abs(rows[i].slip_y), `${slip}, ${rows[i].slip_y}`);
      });
    }
    const energies = tab.locator('#history .chart', { has: tab.locator('figcaption:text-is("Energies")') });
    await energies.locator('summary').click();
    await settled(tab);
    const said = await energies.locator('details tbody tr').evaluateAll((trs) => trs.map((tr) => [...tr.children].map((td) => Number(td.dataset.value))));
    tableOf(out, 'history.csv').forEach((row, i) => assert.ok(Math.abs(said[i][1] - row.elastic_energy) <= 1e-7 * row.elastic_energy));
    const map = tab.locator('#contact .chart', { hasText: 'Stick and slip' });
    await map.locator('summary').click();
    await settled(tab);
    const statuses = await map.locator('details tbody tr').evaluateAll((trs) => trs.map((tr) => [...tr.children].slice(1).map((td) => td.textContent)));
    tableOf(out, 'contact.csv').forEach((row) => {
      const at = Math.round((row.y / 0.1) * 16 / (Math.max(...tableOf(out, 'contact.csv').slice(0, 17).map((r) => r.y)) / 0.1));
      assert.equal(statuses[at][row.step - 1], row.status);
    });
    assert.deepEqual(complaints, []);
  });
});

await inBrowser({ ...desktop, javaScriptEnabled: false }, async (context) => {
  const tab = await context.newPage();
  await tab.goto('file://' + page);
  await test('without JavaScript the page says what else there is', async () => {
    const text = await tab.locator('noscript').innerText().catch(() => tab.locator('body').innerText());
    assert.match(text, /JavaScript/);
    assert.match(text, /contact\.csv/);
  });
});
end();
