// A line that the reader drags over a body: straight in an undeformed plane body, over the skin as it is seen of a solid
// one.
import { Body, Hit } from './body';
import { Camera } from './stage';
import { Locator } from './locate';
import { undeformed } from './skin_place';

/** Places along it; where the line leaves the body there are none. */
export interface LineProbe {
  hits: (Hit | undefined)[];
  /** from its beginning [m] */
  along: number[];
  /** [m] */
  places: [number, number, number][];
}

const pieces = 200;
const shares = Array.from({ length: pieces + 1 }, (_, i) => i / pieces);

export function straightLine(locator: Locator, from: number[], to: number[]): LineProbe {
  const places = shares.map((s) => [0, 1, 2].map((c) => from[c] + s * (to[c] - from[c])) as [number, number, number]);
  const length = Math.hypot(...from.map((v, c) => to[c] - v));
  return { places, hits: places.map((p) => locator.find(...p)), along: shares.map((s) => s * length) };
}

/** `from`, `to`: normalised device coordinates */
export function lineOnSkin(body: Body, camera: Camera, from: [number, number], to: [number, number]): LineProbe {
  const hits = shares.map((s) => body.pick(from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1]), camera.three))
    .filter((hit): hit is Hit => !!hit);
  const places = hits.map((hit) => undeformed(body, hit));
  let length = 0;
  const along = places.map((p, i) => (length += i === 0 ? 0 : Math.hypot(...p.map((v, c) => v - places[i - 1][c]))));
  return { hits, places, along };
}
