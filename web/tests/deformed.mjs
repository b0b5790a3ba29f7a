// node tests/deformed.mjs TOURMALINE: the deformed body of the page is nowhere folded.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { inBrowser } from './browser.mjs';
import { desktop, end, nodesOf, numberIn, open, run, settled, test } from './harness.mjs';

// In the layer that cools first, one cell thick, the body shrinks.
const out = run('layer', 'ouafik-2020/conductive.toml', 'mesh.box.cells=[128, 128]', 'time.end=0.02', 'time.steps=2');
const nodes = nodesOf(out);

/** The least area of a cell's triangles as a share of the undeformed one; nodes are listed by x, then y. */
function leastShare(magnification) {
  const [key, n] = [(x, y) => `${Math.round(x * 1e7)} ${Math.round(y * 1e7)}`, 128];
  const at = new Map(nodes.map((node) => [key(node.x, node.y), node]));
  const [right, top] = [Math.max(...nodes.map((v) => v.x)), Math.max(...nodes.map((v) => v.y))];
  let least = Infinity;
  for (let i = 0; i < n; ++i)
    for (let j = 0; j < n; ++j) {
      const corner = (a, b) => at.get(key(((i + a) * right) / n, ((j + b) * top) / n));
      for (const [p, q, r] of [[corner(0, 0), corner(1, 0), corner(1, 1)], [corner(0, 0), corner(1, 1), corner(0, 1)],
        [corner(0, 0), corner(1, 0), corner(0, 1)], [corner(1, 0), corner(1, 1), corner(0, 1)]]) {
        const area = (s) => {
          const [x, y] = [(v) => v.x + s * v.u_x, (v) => v.y + s * v.u_y];
          return (x(q) - x(p)) * (y(r) - y(p)) - (y(q) - y(p)) * (x(r) - x(p));
        };
        least = Math.min(least, area(magnification) / area(0));
      }
    }
  return least;
}

await inBrowser(desktop, async (context) => {
  const { tab, complaints } = await open(context, join(out, 'report.html'));
  await test('no cell is folded, neither at a glance nor among the fields, and as much is shown as that allows', async () => {
    await tab.locator('.view > canvas').scrollIntoViewIfNeeded();
    for (let i = 0; i < 3; ++i) await settled(tab);
    const notes = [await tab.locator('.card', { hasText: 'Deformed mesh' }).locator('.note').textContent(), await tab.locator('.view .note').textContent()];
    for (const note of notes) {
      const magnification = numberIn(`x ${note.match(/displacement × (\S+)/)[1]}`);
      const share = leastShare(magnification);
      assert.ok(share > 0.05, `at ${magnification} a triangle has ${share} of its area`);
      const shown = magnification * Math.max(...nodes.map((v) => Math.hypot(v.u_x, v.u_y)));
      assert.ok(leastShare(2.1 * magnification) < 0.1 || shown > 0.04 * 0.1, `× ${magnification} is less than could be shown`);
    }
    assert.deepEqual(complaints, []);
  });
});
end();
