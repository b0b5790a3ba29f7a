// A part of the contact of a solid body, laid out in a plane by src/report/contact_face.cc, as pixels: each belongs to the
// nearest node of the facet that it lies in.
import { ContactFacePart } from './results';

/** Where the part lies in a picture of some size. */
export interface Placement { scale: number; left: number; foot: number }

const margin = 0.03;

export class FaceMap {
  readonly width: number;
  readonly height: number;
  private readonly lowX: number;
  private readonly lowY: number;
  private owners = new Int32Array(0);
  private size = '';

  constructor(readonly part: ContactFacePart) {
    let [lowX, highX, lowY, highY] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const v of part.x) { lowX = Math.min(lowX, v); highX = Math.max(highX, v); }
    for (const v of part.y) { lowY = Math.min(lowY, v); highY = Math.max(highY, v); }
    [this.lowX, this.lowY, this.width, this.height] = [lowX, lowY, highX - lowX, highY - lowY];
  }

  placed(width: number, height: number): Placement {
    const scale = (1 - 2 * margin) * Math.min(width / this.width, height / this.height);
    return { scale, left: (width - this.width * scale) / 2, foot: (height + this.height * scale) / 2 };
  }

  /** Where the i-th node of the part lies. */
  at(i: number, { scale, left, foot }: Placement): [number, number] {
    return [left + (this.part.x[i] - this.lowX) * scale, foot - (this.part.y[i] - this.lowY) * scale];
  }

  /** The place in the part of the node that a pixel belongs to; -1 beside the part. */
  ownersFor(width: number, height: number): Int32Array {
    const size = `${width} ${height}`;
    if (size === this.size) return this.owners;
    this.size = size;
    this.owners = new Int32Array(width * height).fill(-1);
    const placement = this.placed(width, height);
    let first = 0;
    for (const count of this.part.sizes) {
      this.fill(first, count, width, height, placement);
      first += count;
    }
    return this.owners;
  }

  // Pixels of one facet; corners come first, in a circle.
  private fill(first: number, count: number, width: number, height: number, placement: Placement) {
    const corners = count === 9 ? 4 : count === 6 ? 3 : count;
    const places = Array.from({ length: count }, (_, k) => this.at(first + k, placement));
    const xs = places.map(([x]) => x), ys = places.map(([, y]) => y);
    const bottom = Math.min(height - 1, Math.ceil(Math.max(...ys))), right = Math.min(width - 1, Math.ceil(Math.max(...xs)));
    for (let y = Math.max(0, Math.floor(Math.min(...ys))); y <= bottom; ++y)
      for (let x = Math.max(0, Math.floor(Math.min(...xs))); x <= right; ++x) {
        if (!isInside(x + 0.5, y + 0.5, places, corners)) continue;
        let best = 0, least = Infinity;
        places.forEach(([px, py], k) => {
          const away = (px - x - 0.5) ** 2 + (py - y - 0.5) ** 2;
          if (away < least) { least = away; best = k; }
        });
        this.owners[y * width + x] = first + best;
      }
  }

  /** The row of contact.csv, in one step, of the node nearest to a place in a picture, and how far it is. */
  nearest(x: number, y: number, placement: Placement): { row: number; away: number } {
    let best = 0, least = Infinity;
    for (let i = 0; i < this.part.rows.length; ++i) {
      const [px, py] = this.at(i, placement);
      const away = Math.hypot(px - x, py - y);
      if (away < least) { least = away; best = i; }
    }
    return { row: this.part.rows[best], away: least };
  }
}

// To half a pixel outside, so that no gap is left between facets.
function isInside(x: number, y: number, places: [number, number][], corners: number): boolean {
  let positive = true, negative = true;
  for (let k = 0; k < corners; ++k) {
    const [ax, ay] = places[k], [bx, by] = places[(k + 1) % corners];
    const length = Math.hypot(bx - ax, by - ay) || 1;
    const side = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / length;
    if (side < -0.5) positive = false;
    if (side > 0.5) negative = false;
  }
  return positive || negative;
}
