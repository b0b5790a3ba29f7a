// node tests/printed.mjs TOURMALINE: the page on paper, from a dark screen and without background graphics.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { inBrowser } from './browser.mjs';
import { end, goTo, open, run, settled, test } from './harness.mjs';

const out = run('conductive', 'ouafik-2020/conductive.toml', 'mesh.box.cells=[16, 16]');
await inBrowser({ viewport: { width: 1366, height: 768 }, colorScheme: 'dark' }, async (context) => {
  const { tab, complaints } = await open(context, join(out, 'report.html'));
  await goTo(tab, 10);
  /** Brightness of the darkest and the brightest of the letters and lines of a canvas, 0 to 255: of its grey pixels. */
  const grey = (selector) => tab.locator(selector).first().evaluate((canvas) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    let [least, most] = [255, 0];
    for (let i = 0; i < data.length; i += 4)
      if (data[i + 3] > 200 && Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) < 40)
        [least, most] = [Math.min(least, data[i]), Math.max(most, data[i])];
    return [least, most];
  });
  await tab.locator('#contact canvas').first().scrollIntoViewIfNeeded();
  await settled(tab);
  const dark = await grey('#contact canvas');
  await tab.emulateMedia({ media: 'print', colorScheme: 'dark' });
  await settled(tab);
  await test('paper is light, whatever the screen is', async () => {
    assert.equal(await tab.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(252, 252, 251)');
    const light = await grey('#contact canvas');
    // Letters are the brightest on the dark screen, the darkest on paper.
    assert.ok(dark[1] > 140 && dark[0] < 100 && light[0] < 120 && light[1] > 180, `greys on the screen ${dark}, on paper ${light}`);
  });
  await test('colour bars and squares of legends are no backgrounds', async () => {
    for (const strip of await tab.locator('.strip:visible').all()) {
      assert.equal(await strip.evaluate((e) => `${e.tagName} ${getComputedStyle(e).backgroundImage}`), 'IMG none');
      const colours = await strip.evaluate((img) => {
        const copy = new OffscreenCanvas(256, 1).getContext('2d');
        copy.drawImage(img, 0, 0, 256, 1);
        const { data } = copy.getImageData(0, 0, 256, 1);
        return new Set(Array.from({ length: 256 }, (_, i) => data.slice(4 * i, 4 * i + 3).join())).size;
      });
      assert.ok(colours > 100, `${colours} colours`);
    }
    const squares = await tab.locator('.swatch').evaluateAll((all) => all.map((e) => {
      const style = getComputedStyle(e);
      return [style.borderTopColor, parseFloat(style.borderTopWidth), style.backgroundColor, e.dataset.colour];
    }));
    assert.ok(squares.length >= 5);
    for (const [, width, background] of squares) assert.ok(width > 4 && background === 'rgba(0, 0, 0, 0)', String([width, background]));
  });
  await test('the moment is printed, the controls are not', async () => {
    for (const id of ['overview', 'fields', 'contact'])
      assert.match(await tab.locator(`#${id}-title`).innerText(), /, t = 0\.1 s$/);
    for (const selector of ['.timebar', '.toolbar', '.zoom', '.save', '#theme'])
      assert.equal(await tab.locator(selector).first().isVisible(), false, selector);
  });
  await test('nothing is cut in two by the end of a sheet', async () => {
    for (const selector of ['.card', '.view', '.chart', '.facts'])
      assert.deepEqual(new Set(await tab.locator(selector).evaluateAll((all) => all.map((e) => getComputedStyle(e).breakInside))), new Set(['avoid']), selector);
  });
  await test('a printed page has some sheets, and the screen is as it was', async () => {
    await tab.emulateMedia({ media: null, colorScheme: 'dark' });
    const pdf = await tab.pdf({ format: 'A4', printBackground: false });
    assert.ok(pdf.length > 50000);
    await settled(tab);
    assert.equal(await tab.evaluate(() => document.documentElement.dataset.theme), 'dark');
    await tab.locator('#contact canvas').first().scrollIntoViewIfNeeded();
    await settled(tab);
    (await grey('#contact canvas')).forEach((level, i) => assert.ok(Math.abs(level - dark[i]) < 10));
    assert.deepEqual(complaints, []);
  });
});
end();
