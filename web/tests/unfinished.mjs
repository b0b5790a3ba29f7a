// node tests/unfinished.mjs TOURMALINE: pages of runs that failed or were stopped, and of runs too large for all moments.
import assert from 'node:assert/strict';
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import { existsSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { inBrowser } from './browser.mjs';
import { cases, desktop, end, folder, goTo, open, program, run, settled, tableOf, test } from './harness.mjs';

const plain = (text) => text.replace(/\s+/g, ' ').trim();

const failed = join(folder, 'failed');
const { status, stderr } = spawnSync(program, ['run', join(cases, 'ouafik-2020/conductive.toml'), '-q', '-o', failed,
  '--set', 'mesh.box.cells=[32, 32]', '--set', 'solver.max_iterations=1'], { encoding: 'utf8' });
await test('a run that fails leaves a page that says so in the words of the terminal, with the planned end', async () => {
  assert.equal(status, 3, stderr);
  const said = plain(stderr).replace(/^.*?tourmaline: /, '').replace(/; the results of .*$/, '');
  assert.ok(said.length > 20, said);
  await inBrowser(desktop, async (context) => {
    const { tab, complaints } = await open(context, join(failed, 'report.html'));
    const notice = plain(await tab.locator('.notices li').first().textContent());
    assert.ok(notice.includes(said), `"${notice}" lacks "${said}"`);
    assert.match(notice, /It was to end at t = 0\.2 s/);
    const history = existsSync(join(failed, 'history.csv')) ? tableOf(failed, 'history.csv') : [];
    if (history.length > 0) assert.match(notice, new RegExp(`the last step that is recorded ends at t = ${history.at(-1).time} s`));
    assert.deepEqual(complaints, []);
  });
});

const stopped = join(folder, 'stopped');
const told = await new Promise((done) => {
  const child = spawn(program, ['run', join(cases, 'ouafik-2020/conductive.toml'), '-q', '-o', stopped, '--set', 'mesh.box.cells=[8, 8]',
    '--set', 'time.steps=200000', '--set', 'output.every=100000'], { stdio: ['ignore', 'ignore', 'pipe'] });
  let text = '';
  child.stderr.on('data', (piece) => { text += piece; });
  const timer = setInterval(() => { if (existsSync(join(stopped, 'history.csv.part')) && statSync(join(stopped, 'history.csv.part')).size > 2000) child.kill('SIGINT'); }, 200);
  child.on('exit', () => { clearInterval(timer); done(text); });
});
await test('a run that is stopped leaves a page that says after which step', async () => {
  const said = plain(told).match(/stopped by SIGINT after step \d+ of 200000/);
  assert.ok(said, told);
  await inBrowser(desktop, async (context) => {
    const { tab } = await open(context, join(stopped, 'report.html'));
    assert.ok(plain(await tab.locator('.notices li').first().textContent()).includes(said[0]));
  });
});
await test('a run that then reaches its end says nothing of it', async () => {
  const again = run('failed', 'ouafik-2020/conductive.toml', 'mesh.box.cells=[32, 32]');
  assert.ok(!existsSync(join(again, 'unfinished.txt')));
  await inBrowser(desktop, async (context) => {
    const { tab } = await open(context, join(again, 'report.html'));
    assert.doesNotMatch(await tab.locator('#page').textContent(), /did not finish/);
  });
});

const large = run('large', 'ouafik-2020/conductive.toml', 'mesh.box.cells=[48, 48]');
const report = (size, name) => {
  const page = join(folder, name);
  execFileSync(program, ['report', large, '--size', String(size), '-o', page]);
  return page;
};
const shell = 0.8e6;
const whole = statSync(join(large, 'report.html')).size;
const limit = shell + 0.4 * (whole - shell);
const [less, all] = [report(limit / 1e6, 'less.html'), report(50, 'all.html')];
await test('a page is as large as one asks for', () => {
  const size = statSync(less).size;
  assert.ok(size <= limit && size > 0.6 * limit, `${size} of ${limit} bytes`);
  assert.ok(Math.abs(statSync(all).size - whole) < 0.01 * whole);
  const refused = spawnSync(program, ['report', large, '--size', '1', '-o', join(folder, 'none.html')], { encoding: 'utf8' });
  if (refused.status !== 0) assert.match(refused.stderr, /one moment of the fields has .* MB already/);
});
await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, less);
  await test('with few moments of the fields the contact has all steps of contact.csv', async () => {
    assert.match(await tab.locator('.notices').textContent(), /Of 21 field files \d+ are shown/);
    assert.equal(await tab.locator('#time').getAttribute('max'), '20');
    const chart = tab.locator('#contact .chart', { has: tab.locator('figcaption:text-is("Temperature")') });
    await chart.locator('details').evaluate((d) => { d.open = true; });
    let stray = 0;
    for (let step = 1; step <= 20; ++step) {
      await goTo(tab, step);
      await settled(tab);
      const said = await chart.locator('details tbody tr').evaluateAll((trs) => trs.map((tr) => [...tr.children].map((td) => Number(td.dataset.value))));
      const rows = tableOf(large, 'contact.csv').filter((row) => row.step === step);
      assert.equal(said.length, rows.length);
      for (const [y, value] of said) {
        const row = rows.find((r) => Math.abs(r.y - y) < 1e-7);
        assert.ok(Math.abs(value - row.temperature) <= 1e-7 * Math.abs(row.temperature), `step ${step}, y = ${y}: ${value}, ${row.temperature}`);
      }
      await tab.locator('.view').scrollIntoViewIfNeeded();
      await settled(tab);
      if (/fields of t = .* the nearest moment/.test(await tab.locator('.view .note').textContent())) ++stray;
    }
    assert.ok(stray > 5 && stray < 20, `${stray} moments without fields of their own`);
    assert.deepEqual(complaints, []);
  });
});
end();
