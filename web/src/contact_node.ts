// One contact node of the reader's choice over the steps: tangential traction over slip, friction bound over pressure,
// pressure over opening.
import { Group } from './arrangement';
import { lineColours } from './colours';
import { ContactLine, contactNodes, stepAt, stepEnds } from './contact_line';
import { negligibleMove } from './contact_round_off';
import { Diagram, Path } from './diagram';
import { element } from './dom';
import { isReached, notReached } from './moments';
import { shown } from './numbers';
import { Result } from './results';
import { statusNames } from './status_map';
import { Timeline } from './timeline';

type Vector = [number, number, number];

const axes = ['x', 'y', 'z'];
const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const size = (v: Vector) => Math.hypot(...v);

/** Bilateral contact with Tresca's law has nothing that depends on the pressure. */
export const hasDiagrams = (result: Result) => result.contactOpens || !!result.contact?.column('friction_bound');

/** A node of one step of contact.csv; on a curve with the direction in which that runs. */
interface Place { row: number; tangent?: Vector }

export class ContactNode {
  readonly group: Group;
  private readonly nodes: number;
  private readonly ends: number[];
  private readonly places: Place[];
  private chosen: number;
  private readonly slider: HTMLInputElement;
  private readonly where = element('output', {});
  private readonly direction = element('p', { class: 'note' });
  private readonly said = element('p', { class: 'note values' });
  private readonly diagrams: { diagram: Diagram; paths: () => Path[] }[] = [];
  private readonly listeners: (() => void)[] = [];

  /** `lines`: of a plane body the pieces of the contact, along which the nodes are listed. */
  constructor(private readonly result: Result, private readonly timeline: Timeline, lines?: ContactLine[]) {
    this.nodes = contactNodes(result);
    this.ends = stepEnds(result);
    this.places = lines
      ? lines.flatMap((line) => line.order.map((row, j): Place => ({ row, tangent: [...line.tangents[j], 0] })))
      : Array.from({ length: this.nodes }, (_, row) => ({ row }));
    this.chosen = this.mostMoved();
    this.slider = element('input', { type: 'range', min: 0, max: this.places.length - 1, step: 1, value: this.chosen,
      'aria-label': 'contact node', oninput: () => this.show(Number(this.slider.value)) });
    this.addDiagrams();
    const chosen = element('div', {},
      element('label', { class: 'control' }, element('span', {}, lines ? 'node' : 'node; a click on a map chooses it too'),
        this.slider, this.where),
      this.said, this.direction);
    this.group = { key: 'node', kind: 'node', heading: element('h4', {}, 'At one node, step by step'),
      cells: [{ title: '', box: chosen }, ...this.diagrams.map(({ diagram }) => ({ title: diagram.title, box: diagram.box }))] };
    this.update();
  }

  /** of the first step, of the chosen node */
  get row(): number { return this.places[this.chosen].row; }

  onChange(listener: () => void) { this.listeners.push(listener); }

  choose(row: number) {
    const at = this.places.findIndex((place) => place.row === row);
    if (at < 0) return;
    this.slider.value = String(at);
    this.show(at);
  }

  /** Another moment. */
  update() {
    this.say();
    for (const { diagram } of this.diagrams) diagram.redraw();
  }

  private show(at: number) {
    this.chosen = at;
    for (const { diagram, paths } of this.diagrams) diagram.update(paths());
    this.say();
    for (const listener of this.listeners) listener();
  }

  private step(): number { return stepAt(this.ends, this.timeline.time); }

  private value(name: string, step: number, row = this.row): number {
    return this.result.contact!.column(name)![step * this.nodes + row];
  }

  private vector(name: string, step: number, row = this.row): Vector {
    return axes.map((axis) => (this.result.contact!.column(name + axis) ? this.value(name + axis, step, row) : 0)) as Vector;
  }

  private bound(step: number): number | undefined { return this.result.frictionBound?.[step * this.nodes + this.row]; }

  private each(of: (step: number) => number): number[] { return this.ends.map((_, step) => of(step)); }

  private mostMoved(): number {
    let best = 0, most = -1;
    this.places.forEach(({ row }, at) => {
      const farthest = Math.max(...this.ends.map((_, step) => size(this.vector('slip_', step, row))));
      if (farthest > most) { most = farthest; best = at; }
    });
    return best;
  }

  /** Along the curve; on a face along the node's greatest slip, or traction where it does not slip. */
  private along(): Vector {
    const { tangent } = this.places[this.chosen];
    if (tangent) return tangent;
    for (const name of ['slip_', 'tangential_traction_']) {
      const vectors = this.ends.map((_, step) => this.vector(name, step));
      const longest = vectors.reduce((a, b) => (size(b) > size(a) ? b : a));
      const length = size(longest);
      if (length > 0) return longest.map((v) => v / length) as Vector;
    }
    return [1, 0, 0];
  }

  private addDiagrams() {
    const add = (title: string, x: [string, string], y: [string, string], paths: () => Path[]) => this.diagrams.push({ paths,
      diagram: new Diagram({ title, x: { label: x[0], unit: x[1] }, y: { label: y[0], unit: y[1] } }, paths(), () => this.step()) });
    const pressure = () => this.each((step) => -this.value('normal_traction', step));
    const rubs = ['x', 'y', 'z'].some((axis) => this.result.contact!.column('tangential_traction_' + axis)?.some((v) => v !== 0));
    if (rubs) {
      add('Tangential traction over slip', ['slip', 'm'], ['traction', 'N/m²'], () => {
        const along = this.along();
        return [{ label: 'traction', colour: lineColours[1], x: this.each((step) => dot(this.vector('slip_', step), along)),
          y: this.each((step) => dot(this.vector('tangential_traction_', step), along)) }];
      });
      add(this.result.frictionBound ? 'Friction bound over pressure' : 'Tangential traction over pressure', ['p', 'N/m²'],
        ['S, |σ_τ|', 'N/m²'], () => [
          { label: 'size of the tangential traction', colour: lineColours[1], x: pressure(),
            y: this.each((step) => size(this.vector('tangential_traction_', step))) },
          ...(this.result.frictionBound ? [{ label: 'bound S', colour: lineColours[2], x: pressure(),
            y: this.each((step) => this.bound(step)!), dashed: true }] : [])]);
    }
    const least = negligibleMove(this.result);
    const opening = (step: number) => (Math.abs(this.value('gap', step)) > least ? this.value('gap', step) : 0);
    if (this.result.contactOpens)
      add('Pressure over opening', ['opening', 'm'], ['p', 'N/m²'], () => [
        { label: 'p', colour: lineColours[0], x: this.each(opening), y: pressure() }]);
  }

  private say() {
    const { contact, dimension } = this.result;
    const name = this.result.contactOf(this.row);
    this.where.textContent = axes.slice(0, dimension).map((axis) => `${axis} = ${shown(contact!.column(axis)![this.row])} m`)
      .concat(name ? [`contact ${name}`] : []).join(', ');
    const along = this.along();
    this.direction.textContent = this.places[this.chosen].tangent ? ''
      : `Slip and traction along (${along.map((v) => shown(v, 3)).join(', ')}), the direction of the node's greatest slip.`;
    const step = this.step();
    if (step < 0)
      return this.said.replaceChildren(isReached(this.result, this.timeline.time) ? 'At the start there is nothing to tell.'
        : `Nothing to tell: ${notReached(this.result)}.`);
    const number = (name: string, label: string, value: number | undefined, unit: string) => value !== undefined &&
      element('span', { 'data-quantity': name, 'data-value': value }, `${label} ${shown(value, 5)} ${unit}`);
    const parts = [
      number('slip', 'slip', dot(this.vector('slip_', step), along), 'm'),
      number('traction', 'σ_τ', dot(this.vector('tangential_traction_', step), along), 'N/m²'),
      number('pressure', 'p', -this.value('normal_traction', step), 'N/m²'),
      number('bound', 'S', this.bound(step), 'N/m²'),
      number('opening', 'opening', this.value('gap', step), 'm'),
      element('span', { 'data-quantity': 'status' }, statusNames[this.value('status', step)] ?? ''),
    ].filter((part): part is HTMLSpanElement => !!part);
    this.said.replaceChildren(...parts.flatMap((part, i) => (i > 0 ? [' · ', part] : [part])));
  }
}
