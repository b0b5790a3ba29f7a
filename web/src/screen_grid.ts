// Places on the skin of a body that are seen under an even grid of points of its picture.
import { Hit } from './body';
import { Frame } from './frame';

/** One place for each point of the grid that has the body under it, the one in front. */
export function seenPlaces(frame: Frame, apart: number): Hit[] {
  const across = Math.floor(frame.width / apart), up = Math.floor(frame.height / apart);
  const hits: (Hit | undefined)[] = new Array(across * up);
  const depths = new Float32Array(across * up).fill(Infinity);
  const { triangles } = frame.body.grid;
  const x = (node: number) => ((frame.nodes[3 * node] + 1) / 2) * frame.width / apart - 0.5;
  const y = (node: number) => ((1 - frame.nodes[3 * node + 1]) / 2) * frame.height / apart - 0.5;
  for (let t = 0; t < triangles.length / 3; ++t) {
    const [a, b, c] = [triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]];
    const [ax, ay, bx, by, cx, cy] = [x(a), y(a), x(b), y(b), x(c), y(c)];
    const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (area === 0) continue;
    const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx))), right = Math.min(across - 1, Math.floor(Math.max(ax, bx, cx)));
    const top = Math.max(0, Math.ceil(Math.min(ay, by, cy))), foot = Math.min(up - 1, Math.floor(Math.max(ay, by, cy)));
    for (let j = top; j <= foot; ++j)
      for (let i = left; i <= right; ++i) {
        const second = ((i - ax) * (cy - ay) - (j - ay) * (cx - ax)) / area;
        const third = ((bx - ax) * (j - ay) - (by - ay) * (i - ax)) / area;
        if (second < 0 || third < 0 || second + third > 1) continue;
        const weights: Hit['weights'] = [1 - second - third, second, third];
        const depth = weights[0] * frame.nodes[3 * a + 2] + second * frame.nodes[3 * b + 2] + third * frame.nodes[3 * c + 2];
        const at = j * across + i;
        if (depth >= depths[at]) continue;
        depths[at] = depth;
        hits[at] = { triangle: t, weights };
      }
  }
  return hits.filter((hit): hit is Hit => !!hit);
}
