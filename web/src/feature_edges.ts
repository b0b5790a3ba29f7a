// Edges of a solid body that give it its shape where no light does.
import { Grid } from './results';

/** Faces that meet at less than this are one curved face. */
const smooth = Math.cos((30 * Math.PI) / 180);

/** Sides of triangles by their two nodes, each with the first two triangles that have it. */
class Sides {
  private readonly mask: number;
  private readonly slots: Int32Array;
  readonly ends: Uint32Array;
  readonly first: Int32Array;
  readonly second: Int32Array;
  count = 0;

  constructor(most: number) {
    let size = 1;
    while (size < 2 * most) size *= 2;
    this.mask = size - 1;
    this.slots = new Int32Array(size).fill(-1);
    this.ends = new Uint32Array(2 * most);
    this.first = new Int32Array(most);
    this.second = new Int32Array(most).fill(-1);
  }

  add(a: number, b: number, triangle: number) {
    const [low, high] = a < b ? [a, b] : [b, a];
    let slot = (Math.imul(low, 0x9e3779b1) ^ Math.imul(high, 0x85ebca6b)) & this.mask;
    for (; this.slots[slot] >= 0; slot = (slot + 1) & this.mask) {
      const known = this.slots[slot];
      if (this.ends[2 * known] !== low || this.ends[2 * known + 1] !== high) continue;
      this.second[known] = triangle;
      return;
    }
    this.slots[slot] = this.count;
    this.ends.set([low, high], 2 * this.count);
    this.first[this.count++] = triangle;
  }
}

/** Unit normals of all triangles. */
function normalsOf({ points, triangles }: Grid): Float32Array {
  const normals = new Float32Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx, length = Math.hypot(x, y, z) || 1;
    normals[t] = x / length;
    normals[t + 1] = y / length;
    normals[t + 2] = z / length;
  }
  return normals;
}

/** Pairs of nodes: sides at which faces of the skin meet at an angle, or that one triangle alone has. */
export function featureEdges(grid: Grid): Uint32Array {
  const { triangles } = grid;
  const sides = new Sides(triangles.length);
  for (let i = 0; i < triangles.length; ++i)
    sides.add(triangles[i], triangles[i % 3 === 2 ? i - 2 : i + 1], Math.floor(i / 3));
  const normals = normalsOf(grid);
  const edges: number[] = [];
  for (let i = 0; i < sides.count; ++i) {
    const p = 3 * sides.first[i], q = 3 * sides.second[i];
    if (q >= 0 && Math.abs(normals[p] * normals[q] + normals[p + 1] * normals[q + 1] + normals[p + 2] * normals[q + 2]) >= smooth)
      continue;
    edges.push(sides.ends[2 * i], sides.ends[2 * i + 1]);
  }
  return Uint32Array.from(edges);
}
