// What a plane across an axis leaves of a solid body: the skin on one side of it and the cut. New nodes lie on sides of
// cells, where fields are linear, so that nothing is lost by interpolation.
import { Grid, Solid } from './results';

/** `at` [m]; `lower`: what lies below it is left */
export interface Plane { axis: number; at: number; lower: boolean }

export interface Section {
  grid: Grid;
  /** the two nodes of the whole body between which each node lies, and how far on from the first */
  ends: Uint32Array;
  shares: Float32Array;
}

const sidesOf: Record<number, [number, number][]> = {
  4: [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]],
  8: [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]],
};

class Cutter {
  private readonly ends: number[] = [];
  private readonly shares: number[] = [];
  private readonly places: number[] = [];
  private readonly triangles: number[] = [];
  private readonly triangleCells: number[] = [];
  private readonly edges: number[] = [];
  private readonly nodes = new Map<number, number>();
  private readonly cells = new Map<number, number>();
  private readonly sides = new Set<number>();
  private readonly points: Float32Array;
  private readonly count: number;
  /** of each node from the plane, below 0 where it is left */
  private readonly off: Float64Array;

  constructor(private readonly grid: Grid, private readonly solid: Solid, private readonly plane: Plane, size: number) {
    this.points = new Float32Array(grid.points.length + solid.points.length);
    this.points.set(grid.points);
    this.points.set(solid.points, grid.points.length);
    this.count = this.points.length / 3;
    this.off = Float64Array.from({ length: this.count }, (_, i) => {
      const off = (this.points[3 * i + plane.axis] - plane.at) * (plane.lower ? 1 : -1);
      return Math.abs(off) < 1e-7 * size ? 0 : off;  // otherwise slivers beside the nodes of the plane
    });
  }

  section(): Section {
    this.clipSkin();
    this.cut();
    const names = (node: number) => (node < this.grid.nodes.length ? this.grid.nodes[node] : this.solid.nodes[node - this.grid.nodes.length]);
    const isNode = (i: number) => this.ends[2 * i] === this.ends[2 * i + 1];
    return {
      ends: Uint32Array.from(this.ends), shares: Float32Array.from(this.shares),
      grid: {
        points: Float32Array.from(this.places),
        nodes: Int32Array.from(this.shares, (_, i) => (isNode(i) ? names(this.ends[2 * i]) : -1)),
        cells: Uint32Array.from(this.cells.keys()), triangles: Uint32Array.from(this.triangles),
        triangleCells: Uint32Array.from(this.triangleCells), edges: Uint32Array.from(this.edges),
      },
    };
  }

  private isLeft(node: number): boolean { return this.off[node] < 0; }

  private node(a: number, b = a): number {
    const key = a * this.count + b;
    let node = this.nodes.get(key);
    if (node !== undefined) return node;
    this.nodes.set(key, (node = this.shares.length));
    const share = a === b ? 0 : this.off[a] / (this.off[a] - this.off[b]);
    this.ends.push(a, b);
    this.shares.push(share);
    for (let c = 0; c < 3; ++c) this.places.push((1 - share) * this.points[3 * a + c] + share * this.points[3 * b + c]);
    return node;
  }

  private between(a: number, b: number): number {
    if (this.off[a] === 0 || this.off[b] === 0) return this.node(this.off[a] === 0 ? a : b);
    return a < b ? this.node(a, b) : this.node(b, a);
  }

  private surface(polygon: number[], cell: number) {
    if (polygon.length < 3) return;
    if (!this.cells.has(cell)) this.cells.set(cell, this.cells.size);
    for (let i = 2; i < polygon.length; ++i) {
      this.triangles.push(polygon[0], polygon[i - 1], polygon[i]);
      this.triangleCells.push(this.cells.get(cell)!);
    }
  }

  private edge(a: number, b: number) {
    const key = Math.min(a, b) * 4294967296 + Math.max(a, b);
    if (a === b || this.sides.has(key)) return;
    this.sides.add(key);
    this.edges.push(a, b);
  }

  private clipSkin() {
    const { triangles, triangleCells, edges } = this.grid;
    for (let t = 0; t < triangleCells.length; ++t) {
      const polygon: number[] = [];
      for (let k = 0; k < 3; ++k) {
        const a = triangles[3 * t + k], b = triangles[3 * t + ((k + 1) % 3)];
        if (this.isLeft(a)) polygon.push(this.node(a));
        if (this.isLeft(a) !== this.isLeft(b)) polygon.push(this.between(a, b));
      }
      this.surface(polygon.filter((node, i) => polygon.indexOf(node) === i), triangleCells[t]);
    }
    for (let i = 0; i < edges.length; i += 2) {
      const [a, b] = this.isLeft(edges[i]) ? [edges[i], edges[i + 1]] : [edges[i + 1], edges[i]];
      if (this.isLeft(a)) this.edge(this.node(a), this.isLeft(b) ? this.node(b) : this.between(a, b));
    }
  }

  private cut() {
    const { parts, partCells, corners } = this.solid;
    // Sides that two parts of one cell share are none of the cell's.
    let own = new Map<string, [number, number]>();
    const draw = () => { for (const [a, b] of own.values()) this.edge(a, b); own = new Map(); };
    partCells.forEach((cell, p) => {
      if (p > 0 && cell !== partCells[p - 1]) draw();
      const polygon = this.cutOf(parts.subarray(corners * p, corners * (p + 1)));
      this.surface(polygon, cell);
      if (polygon.length < 3) return;
      polygon.forEach((a, i) => {
        const b = polygon[(i + 1) % polygon.length], key = `${Math.min(a, b)} ${Math.max(a, b)}`;
        if (!own.delete(key)) own.set(key, [a, b]);
      });
    });
    draw();
  }

  /** Where the plane meets the sides of a convex part, in a circle about what is left. */
  private cutOf(part: Uint32Array): number[] {
    const found = new Set<number>();
    for (const [i, k] of sidesOf[part.length])
      if (this.isLeft(part[i]) !== this.isLeft(part[k])) found.add(this.between(part[i], part[k]));
    const nodes = [...found], u = (this.plane.axis + 1) % 3, v = (this.plane.axis + 2) % 3;
    const middle = (c: number) => nodes.reduce((sum, n) => sum + this.places[3 * n + c], 0) / nodes.length;
    const [x, y] = [middle(u), middle(v)], turn = this.plane.lower ? 1 : -1;
    const angle = (n: number) => turn * Math.atan2(this.places[3 * n + v] - y, this.places[3 * n + u] - x);
    return nodes.map((n) => [angle(n), n]).sort((p, q) => p[0] - q[0]).map(([, n]) => n);
  }
}

/** `size`: largest extent of the body [m] */
export function sectionOf(grid: Grid, solid: Solid, plane: Plane, size: number): Section {
  return new Cutter(grid, solid, plane, size).section();
}
