// node tests/screenshots.mjs PAGE.html FOLDER: the page at two widths, light and dark, for people to look at.
import { mkdirSync } from 'node:fs';
import { basename, resolve } from 'node:path';
import { closeBrowsers, inBrowser } from './browser.mjs';

const [page, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
for (const colorScheme of ['light', 'dark'])
  for (const width of [1280, 400])
    await inBrowser({ viewport: { width, height: 900 }, colorScheme }, async (context) => {
      const tab = await context.newPage();
      tab.on('console', (m) => console.log(m.type(), m.text()));
      tab.on('pageerror', (e) => console.log('error', e.message));
      await tab.goto('file://' + resolve(page));
      await tab.waitForTimeout(1500);
      await tab.screenshot({ path: `${folder}/${basename(page, '.html')}-${width}-${colorScheme}.png`, fullPage: true });
    });
await closeBrowsers();
