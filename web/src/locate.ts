// Places [m] on the skin of an undeformed body.
import { Hit } from './body';
import { Grid } from './results';

type Place = [number, number, number];

/** How far outside of a triangle a place may be by rounding, as a share of it. */
const tolerance = 1e-4;

export class Locator {
  private readonly buckets = new Map<number, number[]>();
  private readonly low: Place;
  private readonly side: number;
  private readonly across: number;

  /** `size`: largest extent [m] */
  constructor(private readonly grid: Grid, private readonly size: number) {
    this.low = [0, 1, 2].map((c) => {
      let low = Infinity;
      for (let i = c; i < grid.points.length; i += 3) low = Math.min(low, grid.points[i]);
      return low;
    }) as Place;
    this.across = Math.max(1, Math.ceil(Math.sqrt(grid.triangles.length / 6))) + 1;
    this.side = size / (this.across - 1);
    for (let t = 0; t < grid.triangles.length / 3; ++t) this.enter(t);
  }

  /** The triangle at a place, and where in it; the nearest one of a solid body's. */
  find(...place: Place): Hit | undefined {
    let best: Hit | undefined, off = Infinity;
    for (const triangle of this.buckets.get(this.key(place.map((v, c) => this.index(v, c)) as Place)) ?? []) {
      const { weights, outside } = this.weightsIn(triangle, place);
      if (outside < off) { off = outside; best = { triangle, weights }; }
    }
    return off <= tolerance ? best : undefined;
  }

  /** The same on the side where `inside` lies, a place near by. */
  findBeside(place: Place, inside: Place): Hit | undefined {
    const there = this.find(...inside);
    if (!there) return this.find(...place);
    const { weights, outside } = this.weightsIn(there.triangle, place);
    return outside <= tolerance ? { triangle: there.triangle, weights } : this.find(...place);
  }

  private index(v: number, c: number): number { return Math.floor((v - this.low[c]) / this.side + 1e-9); }
  private key([i, j, k]: Place): number { return (k * (this.across + 2) + j) * (this.across + 2) + i; }

  private corner(t: number, k: number): Place {
    const node = 3 * this.grid.triangles[3 * t + k];
    return [this.grid.points[node], this.grid.points[node + 1], this.grid.points[node + 2]];
  }

  private enter(t: number) {
    const corners = [0, 1, 2].map((k) => this.corner(t, k));
    const room = 1e-6 * this.size;
    const ends = [0, 1, 2].map((c) => {
      const along = corners.map((p) => p[c]);
      return [this.index(Math.min(...along) - room, c), this.index(Math.max(...along) + room, c)];
    });
    for (let k = ends[2][0]; k <= ends[2][1]; ++k)
      for (let j = ends[1][0]; j <= ends[1][1]; ++j)
        for (let i = ends[0][0]; i <= ends[0][1]; ++i) {
          const key = this.key([i, j, k]), there = this.buckets.get(key);
          if (there) there.push(t);
          else this.buckets.set(key, [t]);
        }
  }

  // Of the foot of the place in the triangle's plane; `outside`: how far from the triangle, in shares of it and of the body.
  private weightsIn(t: number, place: Place): { weights: Hit['weights']; outside: number } {
    const [a, b, c] = [0, 1, 2].map((k) => this.corner(t, k));
    const minus = (p: Place, q: Place) => p.map((v, i) => v - q[i]) as Place;
    const dot = (p: Place, q: Place) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    const u = minus(b, a), v = minus(c, a), w = minus(place, a);
    const [uu, uv, vv, uw, vw] = [dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)];
    const area = uu * vv - uv * uv;
    const second = (vv * uw - uv * vw) / area, third = (uu * vw - uv * uw) / area;
    const foot = w.map((x, i) => x - second * u[i] - third * v[i]) as Place;
    const weights: Hit['weights'] = [1 - second - third, second, third];
    return { weights, outside: Math.max(0, -Math.min(...weights)) + Math.sqrt(dot(foot, foot)) / this.size };
  }
}
