import { inBrowser } from './browser.mjs';
const [page, out, width, scheme, y, h] = process.argv.slice(2);
await inBrowser({ viewport: { width: +width, height: +(h??1100) }, colorScheme: scheme }, async (c) => {
  const t = await c.newPage();
  t.on('console', m => console.log(m.text())); t.on('pageerror', e => console.log(e.message));
  await t.goto('file://' + page); await t.waitForTimeout(1000);
  await t.evaluate((y) => scrollTo(0, y), +y); await t.waitForTimeout(300);
  await t.screenshot({ path: out });
});
