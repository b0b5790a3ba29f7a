// What a second run has more than a first one: the same fields on the first one's body and at its moments.
import { Body, Hit } from './body';
import { Locator } from './locate';
import { isSameMesh } from './same_mesh';
import { Field, Grid, Values } from './results';

type Place = [number, number, number];

/** Places of one body in another. */
class Passage {
  readonly same: boolean;
  private nodes?: (Hit | undefined)[];
  private cells?: (Hit | undefined)[];
  constructor(private readonly from: Body, private readonly to: Body) { this.same = isSameMesh(from, to); }

  /** On the side of an interface where a triangle of the node lies: what is recovered jumps there. */
  ofNodes(): (Hit | undefined)[] {
    if (this.nodes) return this.nodes;
    const { points, triangles } = this.from.grid;
    const inside = new Array<number>(points.length / 3);
    triangles.forEach((node, k) => (inside[node] ??= 3 * Math.floor(k / 3)));
    const at = (node: number): Place => [points[3 * node], points[3 * node + 1], points[3 * node + 2]];
    const locator = new Locator(this.to.grid, this.to.size);
    return (this.nodes = Array.from(inside, (first, node) => {
      const place = at(node);
      if (first === undefined) return locator.find(...place);
      const corners = [0, 1, 2].map((k) => at(triangles[first + k]));
      const nudged = place.map((v, c) => v + 1e-3 * ((corners[0][c] + corners[1][c] + corners[2][c]) / 3 - v)) as Place;
      return locator.findBeside(place, nudged);
    }));
  }

  /** By the middle of a triangle of each. */
  ofCells(): (Hit | undefined)[] {
    const { points, triangles, triangleCells, cells } = this.from.grid;
    const first = new Array<number>(cells.length);
    triangleCells.forEach((cell, t) => (first[cell] ??= t));
    return (this.cells ??= this.find(cells.length, (i) => [0, 1, 2].map((c) =>
      [0, 1, 2].reduce((sum, k) => sum + points[3 * triangles[3 * first[i] + k] + c] / 3, 0)) as Place));
  }

  private find(count: number, at: (i: number) => Place): (Hit | undefined)[] {
    const locator = new Locator(this.to.grid, this.to.size);
    return Array.from({ length: count }, (_, i) => locator.find(...at(i)));
  }
}

/** Between which states of a run a time lies, and how far on; its ends beyond them. */
function between(times: number[], time: number): { first: number; share: number } {
  const last = times.length - 1;
  if (last < 1 || time <= times[0]) return { first: 0, share: 0 };
  if (time >= times[last]) return { first: last - 1, share: 1 };
  const first = times.findIndex((t, i) => i < last && time < times[i + 1] && t <= time);
  return { first, share: (time - times[first]) / (times[first + 1] - times[first]) };
}

/** Of numbers on the page. */
const singlePrecision = 6e-8;
const largest = ({ least, greatest }: Values) => Math.max(0, -least, greatest);

class DifferenceField extends Field {
  constructor(private readonly one: Field, private readonly other: Field, private readonly passage: Passage,
    private readonly times: number[], private readonly otherTimes: number[], private readonly otherGrid: Grid,
    private readonly ofWhole?: Field) {
    super({ ...one.description, belowRoundOff: one.belowRoundOff && other.belowRoundOff });
  }

  override ranges(component: string): Values[] {
    return [this, ...(this.ofWhole ? [this.ofWhole] : [])].map((field) => field.values(component));
  }

  protected component(name: string): Values {
    const own = this.one.values(name), theirs = this.other.values(name);
    const data = new Float32Array(own.data.length);
    const end = this.otherTimes[this.otherTimes.length - 1] * (1 + 3e-7);
    this.times.forEach((time, state) => {
      if (time > end) return void data.fill(NaN, state * own.places, (state + 1) * own.places);
      const there = this.otherAt(theirs, time);
      const first = state * own.places;
      for (let i = 0; i < own.places; ++i) data[first + i] = there(i) - own.data[first + i];
    });
    return new Values(data, own.places, own.error + theirs.error + singlePrecision * (largest(own) + largest(theirs)));
  }

  override get partsOfSize(): string[] { return []; }

  /** What the second has more, as of every component; not the size of the difference. */
  protected override size(): Values { return this.component('size'); }

  /** The other run's value at a place of this one. */
  private otherAt({ data, places }: Values, time: number): (i: number) => number {
    const { first, share } = between(this.otherTimes, time);
    const next = Math.min(first + 1, this.otherTimes.length - 1);
    const at = (k: number) => (share === 0 ? data[first * places + k] : share === 1 ? data[next * places + k]
      : (1 - share) * data[first * places + k] + share * data[next * places + k]);
    if (this.passage.same) return at;
    const { triangles, triangleCells } = this.otherGrid;
    const hits = this.onPoints ? this.passage.ofNodes() : this.passage.ofCells();
    return (i) => {
      const hit = hits[i];
      if (!hit) return NaN;
      if (!this.onPoints) return at(triangleCells[hit.triangle]);
      return hit.weights.reduce((sum, w, k) => sum + w * at(triangles[3 * hit.triangle + k]), 0);
    };
  }
}

export interface Difference { body: Body; said: string }

/** Undefined where two bodies have nothing in common. `whole`: the difference of the bodies that these are cut from. */
export function differenceOf(one: Body, other: Body, whole?: Body): Difference | undefined {
  const [a, b] = [one.result, other.result];
  if (a.dimension !== b.dimension) return undefined;
  const passage = new Passage(one, other);
  const fields = a.fields.flatMap((field) => {
    const theirs = b.field(field.name);
    return theirs && theirs.onPoints === field.onPoints
      ? [new DifferenceField(field, theirs, passage, a.stateTimes, b.stateTimes, other.grid,
        whole?.result.field(field.name))] : [];
  });
  const said = passage.same ? '' : 'interpolated to the mesh of the first, without colour where the second is not';
  return fields.length === 0 ? undefined
    : { body: new Body(a.withFields(`${b.title} less ${a.title}`, 'difference', fields), a, whole), said };
}
