// The pieces of the contact of a plane body, as src/report/contact_line.cc finds them along its facets.
import { Result } from './results';

export interface ContactLine {
  /** of the boundaries that it is made of */
  name: string;
  /** rows of one step of contact.csv, in order along the facets; a closed piece ends as it begins */
  order: number[];
  /** coordinate of each, ascending [m] */
  along: number[];
  /** what `along` is, with its unit */
  label: string;
  /** where a curve begins and which way it goes; empty for straight pieces along an axis */
  origin: string;
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

/** The end of each step [s]. */
export function stepEnds(result: Result): number[] {
  const nodes = contactNodes(result), time = result.contact!.column('time')!;
  return Array.from({ length: time.length / nodes }, (_, k) => time[k * nodes]);
}

/** The step whose end is nearest; -1 for the initial state, which has no rows, and behind the end of the run. */
export function stepAt(ends: number[], time: number): number {
  if (time < ends[0] / 2 || time > ends[ends.length - 1] * (1 + 3e-7)) return -1;
  let best = 0;
  for (let k = 1; k < ends.length; ++k) if (Math.abs(ends[k] - time) < Math.abs(ends[best] - time)) best = k;
  return best;
}

export function contactLines(result: Result): ContactLine[] {
  const x = result.contact!.column('x')!, y = result.contact!.column('y')!;
  return result.contactPieces.map((piece) => {
    const order = [...piece.rows];
    return { name: piece.name, order, along: [...piece.along], label: piece.abscissa, origin: piece.origin,
      tangents: tangentsOf(order, x, y) };
  });
}

/** From the neighbour before to the one behind, around the end of a closed piece too. */
function tangentsOf(order: number[], x: Float32Array, y: Float32Array): [number, number][] {
  const last = order.length - 1;
  const closed = last > 0 && order[0] === order[last];
  return order.map((_, k): [number, number] => {
    const a = order[k > 0 ? k - 1 : closed ? last - 1 : 0], b = order[k < last ? k + 1 : closed ? 1 : last];
    const length = Math.hypot(x[b] - x[a], y[b] - y[a]) || 1;
    return [(x[b] - x[a]) / length, (y[b] - y[a]) / length];
  });
}
