// What the page shows: one or two result folders, as src/report/page.cc writes them.
import { Packed, unpack, unpackIntegers } from './packing';

interface PackedTable { names: string[]; columns: Packed[] }

interface PackedResult {
  name: string;
  title: string;
  dimension: 2 | 3;
  case: string;
  summary: any | null;
  remarks: string[];
  times: number[];
  steps: number[];
  fields: { name: string; unit: string; on: 'points' | 'cells'; components: string[]; values: Packed[] }[];
  boundaries: { name: string; kind: string; conditions: string[]; sizes: Packed; nodes: Packed }[];
  parts: { name: string; material: string }[];
  poling: Packed | null;
  grid?: Record<'points' | 'nodes' | 'cells' | 'triangles' | 'triangleCells' | 'edges', Packed>;
  history?: PackedTable;
  contact?: PackedTable;
  frictionBound?: Packed;
}

/** The skin of a body: nodes, triangles and the cells that they belong to, sides of cells. */
export interface Grid {
  points: Float32Array;
  nodes: Uint32Array;
  cells: Uint32Array;
  triangles: Uint32Array;
  triangleCells: Uint32Array;
  edges: Uint32Array;
}

export interface Boundary { name: string; kind: string; conditions: string[]; facets: Uint32Array[] }

/** A component of a field, or its size, over all states. */
export class Values {
  least = Infinity;
  greatest = -Infinity;
  private ends?: { low: number; high: number };

  /** `error`: largest error by rounding for the page */
  constructor(readonly data: Float32Array, readonly places: number, readonly error: number) {
    for (const value of data) {
      if (value < this.least) this.least = value;
      if (value > this.greatest) this.greatest = value;
    }
  }

  /** The range over all states, each without its lowest and highest hundredth. */
  usual(): { low: number; high: number } {
    if (!this.ends) {
      this.ends = { low: Infinity, high: -Infinity };
      const stride = Math.ceil(this.places / 5000);
      for (let first = 0; first < this.data.length; first += this.places) {
        const sorted = this.data.subarray(first, first + this.places).filter((_, i) => i % stride === 0).sort();
        const last = sorted.length - 1;
        this.ends.low = Math.min(this.ends.low, sorted[Math.floor(0.01 * last)]);
        this.ends.high = Math.max(this.ends.high, sorted[Math.ceil(0.99 * last)]);
      }
    }
    return this.ends;
  }
}

export class Field {
  readonly name: string;
  readonly unit: string;
  readonly onPoints: boolean;
  /** components that can be shown; "size" is the length of a vector */
  readonly components: string[];
  private readonly unpacked = new Map<string, Values>();

  constructor(private readonly packed: PackedResult['fields'][number]) {
    this.name = packed.name;
    this.unit = packed.unit;
    this.onPoints = packed.on === 'points';
    this.components = [...packed.components];
    if (packed.components.includes('x')) this.components.unshift('size');
  }

  values(component: string): Values {
    let values = this.unpacked.get(component);
    if (!values) {
      values = component === 'size' ? this.size() : this.component(component);
      this.unpacked.set(component, values);
    }
    return values;
  }

  has(component: string): boolean { return this.components.includes(component); }

  private component(name: string): Values {
    const packed = this.packed.values[this.packed.components.indexOf(name)];
    return new Values(unpack(packed), packed.columns, packed.coding === 'levels' ? packed.step! / 2 : 0);
  }

  private size(): Values {
    const parts = this.packed.components.map((c) => this.values(c));
    const data = new Float32Array(parts[0].data.length);
    for (let i = 0; i < data.length; ++i) data[i] = Math.hypot(...parts.map((p) => p.data[i]));
    return new Values(data, parts[0].places, Math.max(...parts.map((p) => p.error)));
  }
}

export class Table {
  private readonly unpacked = new Map<string, Float32Array>();
  constructor(private readonly packed: PackedTable) {}
  get names(): string[] { return this.packed.names; }
  get rows(): number { return this.packed.columns[0]?.columns ?? 0; }
  column(name: string): Float32Array | undefined {
    const i = this.packed.names.indexOf(name);
    if (i < 0) return undefined;
    if (!this.unpacked.has(name)) this.unpacked.set(name, unpack(this.packed.columns[i]));
    return this.unpacked.get(name);
  }
}

export class Result {
  readonly fields: Field[];
  readonly grid?: Grid;
  readonly boundaries: Boundary[];
  /** tail and tip [m] of arrows along the poling, six numbers each */
  readonly poling?: Float32Array;
  readonly history?: Table;
  readonly contact?: Table;
  readonly frictionBound?: Float32Array;

  constructor(private readonly packed: PackedResult) {
    this.fields = packed.fields.map((f) => new Field(f));
    if (packed.grid)
      this.grid = {
        points: unpack(packed.grid.points),
        nodes: unpackIntegers(packed.grid.nodes),
        cells: unpackIntegers(packed.grid.cells),
        triangles: unpackIntegers(packed.grid.triangles),
        triangleCells: unpackIntegers(packed.grid.triangleCells),
        edges: unpackIntegers(packed.grid.edges),
      };
    this.boundaries = packed.boundaries.map((b) => ({ ...b, facets: facetsOf(b.sizes, b.nodes) }));
    if (packed.poling) this.poling = unpack(packed.poling);
    if (packed.history) this.history = new Table(packed.history);
    if (packed.contact) this.contact = new Table(packed.contact);
    if (packed.frictionBound) this.frictionBound = unpack(packed.frictionBound);
  }

  get name(): string { return this.packed.name; }
  get title(): string { return this.packed.title || this.packed.name; }
  get dimension(): 2 | 3 { return this.packed.dimension; }
  get caseText(): string { return this.packed.case; }
  get summary(): any | null { return this.packed.summary; }
  /** Regions and what they consist of; empty where the body is one. */
  get parts(): { name: string; material: string }[] { return this.packed.parts; }
  get remarks(): string[] { return this.packed.remarks; }
  get steps(): number[] { return this.packed.steps; }

  /** Moments that can be looked at: those of the fields, or else the steps of the history. */
  get times(): number[] {
    return this.grid ? this.packed.times : [...(this.history?.column('time') ?? [])];
  }

  field(name: string): Field | undefined { return this.fields.find((f) => f.name === name); }

  /** The state whose time is nearest. */
  stateAt(time: number): number {
    const times = this.times;
    let best = 0;
    for (let i = 1; i < times.length; ++i)
      if (Math.abs(times[i] - time) < Math.abs(times[best] - time)) best = i;
    return best;
  }
}

function facetsOf(sizes: Packed, nodes: Packed): Uint32Array[] {
  const all = unpackIntegers(nodes);
  let at = 0;
  return [...unpackIntegers(sizes)].map((size) => all.subarray(at, (at += size)));
}

export interface PageData {
  results: Result[];
  colourMaps: Record<'even' | 'signed', string>;
}

export function load(): PageData {
  const page = JSON.parse(document.getElementById('results')!.textContent!);
  return { results: page.results.map((r: PackedResult) => new Result(r)), colourMaps: page.colourMaps };
}
