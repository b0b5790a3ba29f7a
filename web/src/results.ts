// What the page shows: one or two result folders, as src/report/page.cc writes them.
import { Packed, unpack, unpackIntegers } from './packing';

interface PackedTable { names: string[]; columns: Packed[] }

interface PackedResult {
  name: string;
  title: string;
  dimension: 2 | 3;
  perDepth: boolean;
  leftOut: string[];
  case: string;
  summary: any | null;
  remarks: string[];
  times: number[];
  steps: number[];
  fields: { name: string; unit: string; on: 'points' | 'cells'; origin: string; belowRoundOff: boolean;
    components: string[]; values: Packed[]; inner?: Packed[] }[];
  boundaries: { name: string; kind: string; conditions: string[]; sizes: Packed; nodes: Packed }[];
  contactPieces: { name: string; abscissa: string; origin: string; rows: Packed; along: Packed }[];
  contactFaces: { contact: string; place: string; across: string; up: string; origin: string;
    sizes: Packed; rows: Packed; x: Packed; y: Packed }[];
  parts: { name: string; material: string }[];
  unnamed: string;
  poling: Packed | null;
  grid?: Record<'points' | 'nodes' | 'cells' | 'triangles' | 'triangleCells' | 'edges', Packed>;
  solid?: Record<'points' | 'nodes' | 'parts' | 'partCells', Packed> & { corners: number };
  history?: PackedTable;
  contact?: PackedTable;
  probes?: { name: string; isLine: boolean; table: PackedTable }[];
  /** names of several contacts, by the numbers of the column `contact` */
  contacts?: string[];
  frictionBound?: Packed;
}

/** The skin of a body: nodes, triangles and the cells that they belong to, sides of cells. */
export interface Grid {
  points: Float32Array;
  /** rows of nodes.csv; of a cut -1 where it is no node */
  nodes: Uint32Array | Int32Array;
  cells: Uint32Array;
  triangles: Uint32Array;
  triangleCells: Uint32Array;
  edges: Uint32Array;
}

/** What lies behind the skin of a solid body; nodes and cells are numbered on from those of the skin. */
export interface Solid {
  points: Float32Array;
  nodes: Uint32Array;
  /** of each part, a tetrahedron or hexahedron; of all cells */
  corners: number;
  parts: Uint32Array;
  partCells: Uint32Array;
}

/** A connected piece of the contact of a plane body; `rows` of one step of contact.csv. */
export interface ContactPiece {
  name: string;
  abscissa: string;
  origin: string;
  rows: Uint32Array;
  along: Float32Array;
}

/** A part of the contact of a solid body in a plane: the nodes of its facets, one facet behind the other. */
export interface ContactFacePart {
  contact: string;
  place: string;
  across: string;
  up: string;
  origin: string;
  /** nodes of each facet: its corners, then those amid its sides and in its middle */
  sizes: Uint32Array;
  /** of one step of contact.csv */
  rows: Uint32Array;
  x: Float32Array;
  y: Float32Array;
}

export interface Boundary { name: string; kind: string; conditions: string[]; facets: Uint32Array[] }

function endsOf(data: Float32Array, from: number, to: number) {
  let least = Infinity, greatest = -Infinity;
  for (let i = from; i < to; ++i) {
    const value = data[i];
    if (value < least) least = value;
    if (value > greatest) greatest = value;
  }
  return { least, greatest };
}

/** A component of a field, or its size, over all states. */
export class Values {
  least = Infinity;
  greatest = -Infinity;
  private readonly ends = new Map<number, { least: number; greatest: number }>();

  /** `error`: largest error by rounding for the page */
  constructor(readonly data: Float32Array, readonly places: number, readonly error: number) {
    Object.assign(this, endsOf(data, 0, data.length));
  }

  /** The range of one state. */
  of(state: number): { least: number; greatest: number } {
    return endsOf(this.data, state * this.places, (state + 1) * this.places);
  }

  /** The range of one state, or over all of them, each without `share` at its lower and upper end. */
  usual(share: number, state?: number): { least: number; greatest: number } {
    if (state !== undefined) return this.usualOf(state, share);
    let ends = this.ends.get(share);
    if (!ends) {
      ends = { least: Infinity, greatest: -Infinity };
      this.ends.set(share, ends);
      for (let i = 0; i * this.places < this.data.length; ++i) {
        const { least, greatest } = this.usualOf(i, share);
        ends.least = Math.min(ends.least, least);
        ends.greatest = Math.max(ends.greatest, greatest);
      }
    }
    return ends;
  }

  private usualOf(state: number, share: number): { least: number; greatest: number } {
    if (this.places === 0) return { least: Infinity, greatest: -Infinity };
    const stride = Math.ceil(this.places / 5000);
    const first = state * this.places;
    const sorted = new Float32Array(Math.ceil(this.places / stride));
    for (let i = 0; i < sorted.length; ++i) sorted[i] = this.data[first + i * stride];
    sorted.sort();
    const last = sorted.length - 1;
    return { least: sorted[Math.floor(share * last)], greatest: sorted[Math.ceil((1 - share) * last)] };
  }
}

type FieldDescription = PackedResult['fields'][number];

export class Field {
  readonly name: string;
  readonly unit: string;
  readonly onPoints: boolean;
  /** how the values come about; empty: as computed */
  readonly origin: string;
  readonly belowRoundOff: boolean;
  /** components that can be shown; "size" is the length of a vector */
  readonly components: string[];
  private readonly unpacked = new Map<string, Values>();
  private readonly unpackedInner = new Map<string, Values>();

  constructor(readonly description: FieldDescription) {
    const packed = description;
    this.name = packed.name;
    this.unit = packed.unit;
    this.onPoints = packed.on === 'points';
    this.origin = packed.origin;
    this.belowRoundOff = packed.belowRoundOff;
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

  get isUnknown(): boolean { return ['displacement', 'potential', 'temperature'].includes(this.name); }

  has(component: string): boolean { return this.components.includes(component); }

  /** Components whose squares are added up to the size; empty where it is none of a vector. */
  get partsOfSize(): string[] { return this.description.components; }

  /** What the colours of a component must cover. */
  ranges(component: string): Values[] { return [this.values(component)]; }

  /** On the skin and behind it, where the page holds that. */
  insideToo(component: string): [skin: Values, inner: Values] {
    let inner = this.unpackedInner.get(component);
    if (!inner) {
      const { components, inner: packed } = this.description;
      inner = component === 'size' ? sizes(components.map((c) => this.insideToo(c)[1])) : unpacked(packed![components.indexOf(component)]);
      this.unpackedInner.set(component, inner);
    }
    return [this.values(component), inner];
  }

  protected component(name: string): Values {
    return unpacked(this.description.values[this.description.components.indexOf(name)]);
  }

  protected size(): Values { return sizes(this.description.components.map((c) => this.values(c))); }
}

function unpacked(packed: Packed): Values {
  return new Values(unpack(packed), packed.columns, packed.coding === 'levels' ? packed.step! / 2 : 0);
}

function sizes(parts: Values[]): Values {
  const data = new Float32Array(parts[0].data.length);
  for (const { data: part } of parts) for (let i = 0; i < data.length; ++i) data[i] += part[i] * part[i];
  for (let i = 0; i < data.length; ++i) data[i] = Math.sqrt(data[i]);
  return new Values(data, parts[0].places, Math.max(...parts.map((p) => p.error)));
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
  /** of a solid body, where the page has room for it */
  readonly solid?: Solid;
  readonly boundaries: Boundary[];
  readonly contactPieces: ContactPiece[];
  readonly contactFaces: ContactFacePart[];
  /** tail and tip [m] of arrows along the poling, six numbers each */
  readonly poling?: Float32Array;
  readonly history?: Table;
  readonly contact?: Table;
  /** what each probe told in every step; of those along lines a row for each place */
  readonly probes: { name: string; table: Table }[];
  readonly lines: { name: string; table: Table }[];
  /** S at each row of `contact` [N/m²] */
  readonly frictionBound?: Float32Array;

  /** `ambiguous`: another result on the page has the same title. */
  constructor(private readonly packed: PackedResult, private readonly ambiguous = false) {
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
    if (packed.solid)
      this.solid = {
        points: unpack(packed.solid.points),
        nodes: unpackIntegers(packed.solid.nodes),
        corners: packed.solid.corners,
        parts: unpackIntegers(packed.solid.parts),
        partCells: unpackIntegers(packed.solid.partCells),
      };
    this.boundaries = packed.boundaries.map((b) => ({ ...b, facets: facetsOf(b.sizes, b.nodes) }));
    this.contactPieces = packed.contactPieces.map((p) => ({ ...p, rows: unpackIntegers(p.rows), along: unpack(p.along) }));
    this.contactFaces = packed.contactFaces.map((f) => ({ ...f, sizes: unpackIntegers(f.sizes), rows: unpackIntegers(f.rows),
      x: unpack(f.x), y: unpack(f.y) }));
    if (packed.poling) this.poling = unpack(packed.poling);
    if (packed.history) this.history = new Table(packed.history);
    if (packed.contact) this.contact = new Table(packed.contact);
    const told = (areLines: boolean) => (packed.probes ?? []).filter((p) => p.isLine === areLines)
      .map((p) => ({ name: p.name, table: new Table(p.table) }));
    this.probes = told(false);
    this.lines = told(true);
    if (packed.frictionBound) this.frictionBound = unpack(packed.frictionBound);
    else {
      const bound = this.contact?.column('friction_bound');
      if (bound?.some((v) => v !== 0)) this.frictionBound = bound;
    }
  }

  /** The same body with other fields, and without a contact. */
  withFields(title: string, name: string, fields: Field[]): Result {
    return this.but({ title, name, fields, contact: undefined, probes: [], lines: [] });
  }

  /** What a cut leaves of it. */
  cut(grid: Grid, fields: Field[]): Result { return this.but({ grid, fields, boundaries: [] }); }

  private but(others: Record<string, unknown>): Result {
    return Object.create(this, Object.fromEntries(Object.entries(others).map(([key, value]) => [key, { value }])));
  }

  /** Which of several contacts a row belongs to; empty where there is but one. */
  contactOf(row: number): string { return this.packed.contacts?.[this.contact?.column('contact')?.[row] ?? -1] ?? ''; }

  /** Whether the contact can open, as the balance of energy has it. */
  get contactOpens(): boolean { return !!this.history?.names.includes('contact_energy'); }

  get name(): string { return this.packed.name; }
  /** Of two results with one title the folders' names tell which is which. */
  get title(): string {
    const title = this.packed.title || this.packed.name;
    return this.ambiguous && title !== this.packed.name ? `${title} (${this.packed.name})` : title;
  }
  get dimension(): 2 | 3 { return this.packed.dimension; }
  /** Whether forces, charges, heats and energies are those of a metre across the plane. */
  get perDepth(): boolean { return this.packed.perDepth; }
  get caseText(): string { return this.packed.case; }
  get summary(): any | null { return this.packed.summary; }
  /** Regions and what they consist of; empty where the body is one. */
  get parts(): { name: string; material: string }[] { return this.packed.parts; }
  /** What a legend calls the facets that have no name; empty: all have one. */
  get unnamed(): string { return this.packed.unnamed; }
  get remarks(): string[] { return this.packed.remarks; }
  get steps(): number[] { return this.packed.steps; }

  /** Moments of the fields [s]. */
  get stateTimes(): number[] { return this.grid ? this.packed.times : []; }

  /** Whether the model has that field among its unknowns. */
  has(name: string): boolean { return !this.packed.leftOut.includes(name); }

  field(name: string): Field | undefined { return this.fields.find((f) => f.name === name); }
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
  const title = (r: PackedResult) => r.title || r.name;
  const results = page.results.map((r: PackedResult) =>
    new Result(r, page.results.some((other: PackedResult) => other !== r && title(other) === title(r))));
  return { results, colourMaps: page.colourMaps };
}
