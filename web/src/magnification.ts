// How far displacements may be magnified. The counterpart of src/report/scale.cc.
import { Field, Grid, Values } from './results';

/** The first s > 0 at which 1 + b s + c s² has fallen to a tenth. */
function tenthAt(b: number, c: number): number {
  const inside = b * b - 3.6 * c;
  if (inside < 0) return Infinity;
  const q = -0.5 * (b + (b < 0 ? -1 : 1) * Math.sqrt(inside));
  const roots = [c === 0 ? Infinity : q / c, q === 0 ? Infinity : 0.9 / q].filter((s) => s > 0);
  return Math.min(Infinity, ...roots);
}

/** The normal's part of the first half of `p` times the second half of `q`. */
function along(p: Float64Array, q: Float64Array, nx: number, ny: number, nz: number): number {
  return (p[1] * q[5] - p[2] * q[4]) * nx + (p[2] * q[3] - p[0] * q[5]) * ny + (p[0] * q[4] - p[1] * q[3]) * nz;
}

/** The largest magnification at which every triangle of the skin keeps a tenth of its area, seen along its normal. */
function unfoldedTriangles(grid: Grid, displacement: Field): number {
  const { points, triangles } = grid;
  const n = points.length / 3;
  const axes = ['x', 'y', 'z'].map((c) => (displacement.has(c) ? displacement.values(c).data : undefined));
  const states = (axes[0]?.length ?? 0) / n;
  const e = new Float64Array(6), d = new Float64Array(6);
  let largest = Number.MAX_VALUE;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = triangles[t];
    for (let k = 0; k < 2; ++k)
      for (let c = 0; c < 3; ++c) e[3 * k + c] = points[3 * triangles[t + k + 1] + c] - points[3 * a + c];
    const nx = e[1] * e[5] - e[2] * e[4], ny = e[2] * e[3] - e[0] * e[5], nz = e[0] * e[4] - e[1] * e[3];
    const square = nx * nx + ny * ny + nz * nz;
    if (square === 0) continue;
    for (let state = 0; state < states; ++state) {
      const first = state * n;
      for (let k = 0; k < 2; ++k)
        for (let c = 0; c < 3; ++c) {
          const u = axes[c];
          d[3 * k + c] = u ? u[first + triangles[t + k + 1]] - u[first + a] : 0;
        }
      const b = along(e, d, nx, ny, nz) + along(d, e, nx, ny, nz), c = along(d, d, nx, ny, nz);
      // It has not fallen so far before the least of those found.
      if (1 - (Math.abs(b) * largest + Math.abs(c) * largest * largest) / square >= 0.1) continue;
      largest = Math.min(largest, tenthAt(b / square, c / square));
    }
  }
  return largest;
}

/** The least eigenvalue of a symmetric matrix. */
function least(xx: number, yy: number, zz: number, xy: number, yz: number, xz: number): number {
  const mean = (xx + yy + zz) / 3, a = xx - mean, b = yy - mean, c = zz - mean;
  const p = Math.sqrt((a * a + b * b + c * c + 2 * (xy * xy + yz * yz + xz * xz)) / 6);
  if (p === 0) return mean;
  const half = (a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)) / (2 * p * p * p);
  return mean + 2 * p * Math.cos(Math.acos(Math.max(-1, Math.min(1, half))) / 3 + (2 * Math.PI) / 3);
}

/** The largest magnification at which no cell is pressed to less than a tenth in any direction, by its mean strain. */
function unfoldedCells(strain: Field, values: (component: string) => Values): number {
  const parts = ['xx', 'yy', 'zz', 'xy', 'yz', 'xz'].map((c) => (strain.has(c) ? values(c).data : undefined));
  let lowest = 0;
  const count = parts.find((p) => p)?.length ?? 0;
  for (let i = 0; i < count; ++i) {
    const [xx, yy, zz, xy, yz, xz] = parts.map((p) => p?.[i] ?? 0);
    lowest = Math.min(lowest, least(xx, yy, zz, xy, yz, xz));
  }
  return lowest < 0 ? 0.9 / -lowest : Infinity;
}

/**
 * One digit times 10^n, at which the greatest displacement of all states is at most a tenth of the body's `size` and no
 * cell is pressed to less than a tenth. 1 when nothing moves. `inside`: the page has what is behind the skin, for cuts.
 */
export function suitableMagnification(grid: Grid, size: number, displacement?: Field, strain?: Field, inside = false): number {
  const greatest = Math.max(0, ...(inside ? displacement?.insideToo('size') ?? [] : [displacement?.values('size')])
    .map((values) => values?.greatest ?? 0));
  if (!displacement || !(greatest > 0)) return 1;
  const solid = grid.points.some((v, i) => i % 3 === 2 && v !== 0);
  const wanted = Math.min((0.1 * size) / greatest, unfoldedTriangles(grid, displacement),
    solid && strain ? unfoldedCells(strain, (c) => strain.values(c)) : Infinity,
    inside && strain ? unfoldedCells(strain, (c) => strain.insideToo(c)[1]) : Infinity);
  const power = 10 ** Math.floor(Math.log10(wanted));
  return Number.isFinite(wanted) ? ([8, 6, 5, 4, 3, 2].find((m) => m * power <= wanted * 1.000001) ?? 1) * power : 1;
}
