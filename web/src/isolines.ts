// Lines along which a field at nodes has one value, over the triangles of the skin.
import { Body, Look } from './body';
import { levelOf } from './colour_scale';

/** Ends of the pieces in the scene, six numbers each; `levels`: places on the colour bar, ascending. */
export function isolines(body: Body, look: Look, levels: number[]): Float32Array {
  const pieces: number[] = [];
  if (!look.field?.onPoints) return new Float32Array();
  const { data, places } = look.field.values(look.component);
  const at = new Float32Array(places);
  for (let i = 0; i < places; ++i) at[i] = levelOf(look.range, data[look.state * places + i]);
  const { triangles } = body.grid;
  for (let t = 0; t < triangles.length; t += 3) cut(body, at, [triangles[t], triangles[t + 1], triangles[t + 2]], levels, pieces);
  return Float32Array.from(pieces);
}

function cut(body: Body, at: Float32Array, corners: [number, number, number], levels: number[], pieces: number[]) {
  const [a, b, c] = corners;
  const low = Math.min(at[a], at[b], at[c]), high = Math.max(at[a], at[b], at[c]);
  for (const level of levels) {
    if (level <= low || level > high) continue;
    for (const [from, to] of [[a, b], [b, c], [c, a]]) {
      if ((at[from] < level) === (at[to] < level)) continue;
      const share = (level - at[from]) / (at[to] - at[from]);
      for (let k = 0; k < 3; ++k)
        pieces.push(body.places[3 * from + k] + share * (body.places[3 * to + k] - body.places[3 * from + k]));
    }
  }
}
