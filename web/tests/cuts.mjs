// node tests/cuts.mjs TOURMALINE: planes through solid bodies, what they show of the inside.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { execFileSync } from 'node:child_process';
import { readFileSync, statSync } from 'node:fs';
import { inBrowser } from './browser.mjs';
import { centred, compare, desktop, end, nodesOf, numberIn, open, pixels, program, run, runText, settled, test } from './harness.mjs';

const set = async (tab, axis, at, otherSide) => {
  await tab.locator('#cut').selectOption(axis);
  await tab.locator('#cut-at').fill(String(at));
  await tab.locator('#cut-side').setChecked(otherSide);
  await settled(tab);
};

/** The picture when it no longer changes, however busy the machine is. */
async function still(tab) {
  for (let last, now = await pixels(tab, '.view canvas'); ; last = now, now = await pixels(tab, '.view canvas')) {
    if (now === last) return now;
    await settled(tab);
  }
}

const saidIn = (tab) => tab.locator('.readout').first().evaluate((readout) => ({
  node: readout.dataset.node, text: readout.querySelector('.value')?.textContent ?? '',
  values: [...readout.querySelectorAll('[data-field]')].map((e) => [e.dataset.field, e.dataset.component, Number(e.dataset.value), e.textContent]),
}));

/** Nodes that the keyboard goes to, with what the page says of each. */
async function byKeyboard(tab, steps) {
  const found = new Map();
  await tab.locator('.view > canvas').first().focus();
  for (let k = 0; k < steps; ++k) {
    await tab.keyboard.press(`Shift+Arrow${['Left', 'Up', 'Right', 'Right', 'Down', 'Left', 'Down'][(k * k + k) % 7]}`);
    const said = await saidIn(tab);
    if (said.node !== undefined) found.set(Number(said.node), said.values);
  }
  await tab.keyboard.press('Escape');
  return found;
}

/** What the page says of places under the pointer whose coordinate along `axis` is `at`. */
async function onCut(tab, axis, at, wanted) {
  const found = [];
  const box = await centred(tab, '.view canvas');
  for (let k = 0; k < 1500 && found.length < wanted; ++k) {
    const [u, v] = [(0.31 + 0.618034 * k) % 1, (0.17 + 0.7548777 * k) % 1];
    await tab.mouse.move(box.x + u * box.width, box.y + v * box.height);
    const said = await saidIn(tab);
    const place = said.text.match(/at (\S+), (\S+), (\S+)/)?.slice(1).map((text) => numberIn(`x ${text}`));
    if (place && Math.abs(place[axis] - at) < 1e-4 * 0.1) found.push({ ...said, place });
  }
  assert.ok(found.length >= wanted, `only ${found.length} places of the cut were found under the pointer`);
  return found;
}

const twisted = (name, cell, degree) => run(name, 'block-3d/twisted.toml', `mesh.box.cells=${degree === 2 ? '[4, 4, 4]' : '[8, 8, 8]'}`,
  `mesh.box.cell="${cell}"`, `mesh.degree=${degree}`, 'time.steps=2');

for (const [cell, degree] of [['hexahedron', 1], ['tetrahedron', 1], ['hexahedron', 2]]) {
  const out = twisted(`${cell}${degree}`, cell, degree);
  await inBrowser(desktop, async (context) => {
    const { tab, complaints } = await open(context, join(out, 'report.html'));
    await test(`${cell} of degree ${degree}: a plane through nodes inside shows what nodes.csv has`, async () => {
      const nodes = nodesOf(out), whole = await pixels(tab, '.view canvas');
      for (const [name, other] of [['x', true], ['y', true], ['z', false]]) {
        await set(tab, name, 0.5, other);
        assert.notEqual(await pixels(tab, '.view canvas'), whole);
        const found = await byKeyboard(tab, 60);
        const inner = [...found.keys()].filter((i) => ['x', 'y', 'z'].every((c) => nodes[i][c] > 1e-6 && nodes[i][c] < 0.1 - 1e-6));
        assert.ok(inner.length > 0, `no node inside was met, of ${found.size}`);
        for (const i of inner) assert.ok(Math.abs(nodes[i][name] - 0.05) < 1e-9);
        compare(found, nodes);
      }
      await tab.locator('#cut').selectOption('');
      assert.equal(await pixels(tab, '.view canvas'), whole);
    });
    await test(`${cell} of degree ${degree}: the browser has nothing to complain of`, async () => assert.deepEqual(complaints, []));
  });
}

/** A capacitor: V = 1000 z exactly, 0 to 100 V. */
const pushedInside = () => runText('pushed', `
[mesh]
box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [6, 6, 6], cell = "hexahedron" }
[model]
thermal = false
electric = false
[material]
symmetry = "isotropic"
young = 1e11
poisson = 0.3
[load]
force = [0, 0, "max(max(abs(x - 0.05), abs(y - 0.05)), abs(z - 0.05)) < 0.02 ? 1e8*t : 0"]
[time]
end = 1
steps = 1
[[boundary]]
on = ["left", "right", "bottom", "top", "front", "back"]
displacement = [0, 0, 0]
`);

await inBrowser(desktop, async (context) => {
  const out = pushedInside();
  const { tab } = await open(context, join(out, 'report.html') + '#field=displacement&cut=y');
  await test('what only the inside of a body does is not magnified beyond a tenth of it', async () => {
    const most = Math.max(...nodesOf(out).map((row) => Math.hypot(row.u_x, row.u_y, row.u_z)));
    const [, factor] = (await tab.locator('.view .note').first().textContent()).match(/displacement × (\S+)/);
    const scale = numberIn(`x ${factor}`);
    assert.ok(scale * most <= 0.01 && scale * most > 0.0001, `${scale} times ${most} m`);
  });
});

const linear = (cell, degree) => runText(`linear-${cell}${degree}`, `
[mesh]
box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [5, 4, 3], cell = "${cell}" }
degree = ${degree}
[material]
symmetry = "isotropic"
young = 1e11
poisson = 0.3
eps11 = 100
k11 = 1
density = 1000
specific_heat = 1000
reference_temperature = 293
[time]
end = 1
steps = 1
[[boundary]]
on = "left"
displacement = [0, 0, 0]
temperature = 0
[[boundary]]
on = "bottom"
potential = 0
[[boundary]]
on = "top"
potential = 100
`);

for (const [cell, degree] of [['hexahedron', 1], ['tetrahedron', 2]])
  await inBrowser(desktop, async (context) => {
    const { tab } = await open(context, join(linear(cell, degree), 'report.html'));
    await test(`${cell} of degree ${degree}: a linear field is linear on any cut`, async () => {
      await tab.locator('#field').selectOption('potential');
      for (const [axis, name, share, other] of [[0, 'x', 0.37, true], [1, 'y', 0.61, true], [2, 'z', 0.445, false]]) {
        await set(tab, name, share, other);
        for (const { place, values } of await onCut(tab, axis, share * 0.1, 20)) {
          const [, , value] = values.find(([field]) => field === 'potential');
          assert.ok(Math.abs(value - 1000 * place[2]) < 2e-3, `V = ${value} at ${place}`);
        }
      }
    });
    await test(`${cell} of degree ${degree}: the address brings a cut back`, async () => {
      await set(tab, 'y', 0.61, true);
      // The address follows a moment later; until then it holds the cut of the test before.
      await tab.waitForFunction(() => /cut=y&cut-at=0\.61/.test(location.hash));
      const before = await still(tab);
      await tab.reload();
      await tab.waitForSelector('#run');
      await settled(tab);
      assert.equal(await tab.locator('#cut').inputValue(), 'y');
      assert.ok(await still(tab) === before, 'another picture');
    });
  });

await inBrowser(desktop, async (context) => {
  const folders = ['hexahedron', 'tetrahedron'].map((cell) => twisted(`other-${cell}`, cell, 1));
  const page = join(folders[0], 'two.html');
  execFileSync(program, ['report', ...folders, '-o', page]);
  const { tab, complaints } = await open(context, page);
  await test('two bodies and their difference are cut at one place', async () => {
    await tab.locator('#difference').check();
    await settled(tab);
    const whole = await Promise.all([0, 1, 2].map((i) => pixels(tab, '.view canvas', i)));
    await set(tab, 'x', 0.5, true);
    for (let i = 0; i < 3; ++i) assert.notEqual(await pixels(tab, '.view canvas', i), whole[i]);
    assert.deepEqual(complaints, []);
  });
  await test('the magnification of a difference stays that of the whole bodies', async () => {
    await tab.locator('#field').selectOption('strain');
    const said = () => tab.locator('.difference').evaluate((view) => view.querySelector('.note').textContent);
    await tab.locator('#cut').selectOption('');
    await settled(tab);
    const whole = await said();
    for (const at of [0.3, 0.9]) {
      await set(tab, 'x', at, true);
      assert.equal(await said(), whole);
    }
  });
  await test('marks of fields in cells stand on what is left, in a difference too', async () => {
    await set(tab, 'x', 0.9, true);
    for (const figure of ['.view:not(.difference)', '.difference']) {
      const waiting = tab.waitForEvent('download');
      await tab.locator(`${figure} [data-kind=SVG]`).first().click();
      const drawing = readFileSync(await (await waiting).path(), 'utf8');
      assert.ok(!drawing.includes('NaN'), figure);
      assert.match(drawing, />min [^<]*\d/);
    }
  });
  const large = run('large', 'block-3d/twisted.toml', 'mesh.box.cells=[10, 10, 10]', 'time.steps=10');
  for (const [megabytes, isThere] of [[1.3, false], [3, true]])
    await test(`a page of ${megabytes} MB has ${isThere ? 'room for the inside' : 'no room for the inside, and says so'}`, async () => {
      const sized = join(large, `${megabytes}.html`);
      execFileSync(program, ['report', large, '-o', sized, '--size', String(megabytes)]);
      assert.ok(statSync(sized).size <= megabytes * 1e6);
      const { tab: there } = await open(context, sized);
      assert.equal(await there.locator('#cut').isEnabled(), isThere);
      if (!isThere) assert.match(await there.locator('.cut .control').getAttribute('title'), /--size/);
    });
});
end();
