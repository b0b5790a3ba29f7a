// A place on the skin: where it lies in the undeformed body and where in the scene, and how a field is there over time.
import { Body, Hit, valueAt } from './body';
import { Field } from './results';

const mixed = (from: Float32Array, nodes: Uint32Array, { triangle, weights }: Hit) => [0, 1, 2].map((c) =>
  weights.reduce((sum, w, k) => sum + (w === 0 ? 0 : w * from[3 * nodes[3 * triangle + k] + c]), 0)) as [number, number, number];

/** [m] */
export const undeformed = (body: Body, hit: Hit) => mixed(body.grid.points, body.grid.triangles, hit);
export const inScene = (body: Body, hit: Hit) => mixed(body.places, body.grid.triangles, hit);

export function overTime(body: Body, field: Field, component: string, hit: Hit): number[] {
  return body.result.stateTimes.map((_, state) => valueAt(body.grid, field, component, state, hit));
}
