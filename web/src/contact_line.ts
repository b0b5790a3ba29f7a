// The contact nodes of a plane body in the order in which they lie along the boundary.
import { Result } from './results';

export interface ContactLine {
  /** rows of one step of contact.csv, in order along the line */
  order: number[];
  /** coordinate of each, ascending [m] */
  along: number[];
  label: string;
  /** unit tangent at each, in the direction of `along` */
  tangents: [number, number][];
}

/** Number of contact nodes: the rows of the first step. */
export function contactNodes(result: Result): number {
  const step = result.contact?.column('step');
  if (!step || step.length === 0) return 0;
  const end = step.findIndex((s) => s !== step[0]);
  return end < 0 ? step.length : end;
}

export function contactLine(result: Result): ContactLine {
  const n = contactNodes(result);
  const x = result.contact!.column('x')!, y = result.contact!.column('y')!;
  const order = chain(n, x, y);
  const spread = (v: Float32Array) => Math.max(...order.map((i) => v[i])) - Math.min(...order.map((i) => v[i]));
  const size = Math.max(spread(x), spread(y));
  if (spread(x) < 1e-6 * size) return straight(order, y, 'y [m]', [0, 1]);
  if (spread(y) < 1e-6 * size) return straight(order, x, 'x [m]', [1, 0]);
  return curved(order, x, y);
}

function straight(order: number[], v: Float32Array, label: string, tangent: [number, number]): ContactLine {
  if (v[order[0]] > v[order[order.length - 1]]) order.reverse();
  return { order, along: order.map((i) => v[i]), label, tangents: order.map(() => tangent) };
}

function curved(order: number[], x: Float32Array, y: Float32Array): ContactLine {
  const along = [0];
  for (let k = 1; k < order.length; ++k)
    along.push(along[k - 1] + Math.hypot(x[order[k]] - x[order[k - 1]], y[order[k]] - y[order[k - 1]]));
  const tangents = order.map((_, k): [number, number] => {
    const a = order[Math.max(0, k - 1)], b = order[Math.min(order.length - 1, k + 1)];
    const length = Math.hypot(x[b] - x[a], y[b] - y[a]) || 1;
    return [(x[b] - x[a]) / length, (y[b] - y[a]) / length];
  });
  return { order, along, label: 'length along the contact [m]', tangents };
}

/** From one end of the line to the nearest neighbour, and so on. */
function chain(n: number, x: Float32Array, y: Float32Array): number[] {
  const walk = (start: number) => {
    const left = new Set(Array.from({ length: n }, (_, i) => i));
    const order = [start];
    left.delete(start);
    while (left.size > 0) {
      const from = order[order.length - 1];
      let nearest = -1, least = Infinity;
      for (const i of left) {
        const away = Math.hypot(x[i] - x[from], y[i] - y[from]);
        if (away < least) { least = away; nearest = i; }
      }
      order.push(nearest);
      left.delete(nearest);
    }
    return order;
  };
  // The end of a walk from anywhere is an end of the line.
  return walk(walk(0)[n - 1]);
}
