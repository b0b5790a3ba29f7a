// The contact boundary of a solid body, seen from the side that it faces: state, opening, tractions, slip and
// temperature of its nodes at the moment that is shown. A click chooses the node of the diagrams.
import { colourRange, mapBytes, Range } from './colours';
import { ColourBar } from './colour_bar';
import { contactNodes, stepAt, stepEnds } from './contact_line';
import { ContactNode, hasDiagrams } from './contact_node';
import { contactRoundOff } from './contact_round_off';
import { element } from './dom';
import { shown } from './numbers';
import { Drawing } from './on_screen';
import { Result } from './results';
import { fitted } from './stage';
import { statusColours, statusNames, statusTitle } from './status_map';
import { colour, onTheme } from './theme';
import { Timeline } from './timeline';

interface Plan { x: Float32Array; y: Float32Array; labels: [string, string]; width: number; height: number; spacing: number }

/** Contact nodes in the plane of the two axes along which they spread most. */
function planOf(result: Result, nodes: number): Plan {
  const names = ['x', 'y', 'z'];
  const places = names.map((name) => result.contact!.column(name)!.slice(0, nodes));
  const spread = places.map((v) => Math.max(...v) - Math.min(...v));
  const thin = spread.indexOf(Math.min(...spread));
  const [a, b] = [0, 1, 2].filter((axis) => axis !== thin);
  const from = (axis: number) => { const low = Math.min(...places[axis]); return places[axis].map((v) => v - low); };
  return { x: from(a), y: from(b), labels: [names[a], names[b]], width: spread[a], height: spread[b],
    spacing: Math.sqrt((spread[a] * spread[b]) / Math.max(1, nodes)) * 1.15 };
}

export class ContactFace {
  readonly groups: HTMLElement[];
  private readonly charts: HTMLElement[] = [];
  private readonly updates: (() => void)[] = [];
  private readonly nodes: number;
  private readonly plan: Plan;
  private readonly ends: number[];
  private readonly node?: ContactNode;

  constructor(private readonly result: Result, private readonly timeline: Timeline) {
    this.nodes = contactNodes(result);
    this.plan = planOf(result, this.nodes);
    this.ends = stepEnds(result);
    if (hasDiagrams(result)) this.node = new ContactNode(result, timeline);
    this.addStatus();
    const { normal, tangential, slip, gap } = contactRoundOff(result);
    if (result.contactOpens) {
      this.add('Opening', 'm', this.column('gap'), gap);
      this.add('Contact pressure', 'N/m²', this.column('normal_traction').map((v) => -v), normal);
    } else
      this.add('Normal traction on the body', 'N/m²', this.column('normal_traction'), normal);
    this.add('Tangential traction, size', 'N/m²', this.size('tangential_traction_'), tangential);
    this.add('Slip, size', 'm', this.size('slip_'), slip);
    if (result.has('temperature'))
      this.add('Temperature', 'K', this.column('temperature'), !!result.field('temperature')?.belowRoundOff);
    const crosses = (name: string) => !!result.contact!.column(name)?.some((v) => v !== 0);
    if (crosses('heat_flux'))
      this.add('Heat flux out of the body', 'W/m²', this.column('heat_flux'), !!result.field('temperature')?.belowRoundOff);
    if (crosses('charge_flux')) {
      const noise = !!result.field('potential')?.belowRoundOff;
      this.add('Potential', 'V', this.column('potential'), noise);
      this.add('Charge out of the body', 'C/m²', this.column('charge_flux'), noise);
    }
    this.groups = [element('div', { class: 'charts' }, ...this.charts)];
    if (this.node) {
      this.groups.push(this.node.box);
      this.updates.push(() => this.node!.update());
      this.node.onChange(() => this.update());
    }
    onTheme(() => this.update());
  }

  update() { for (const update of this.updates) update(); }

  private column(name: string): Float32Array { return this.result.contact!.column(name)!; }

  private size(name: string): Float32Array {
    const parts = ['x', 'y', 'z'].map((axis) => this.column(name + axis));
    return parts[0].map((_, i) => Math.hypot(...parts.map((p) => p[i])));
  }

  // The first row of the moment, or -1 for the initial state, which has none.
  private first(): number {
    const step = stepAt(this.ends, this.timeline.time);
    return step < 0 ? -1 : step * this.nodes;
  }

  private frame(title: string, below: HTMLElement, fill: (row: number) => string) {
    const canvas = element('canvas', { class: 'face', role: 'img', 'aria-label': title,
      style: `aspect-ratio: ${Math.min(3, Math.max(0.5, this.plan.width / this.plan.height))}` });
    this.charts.push(element('figure', { class: 'chart' }, element('figcaption', {}, title), canvas,
      element('p', { class: 'note' }, `${this.plan.labels[0]} to the right, ${this.plan.labels[1]} up`), below));
    const drawing = new Drawing(canvas, () => this.paint(canvas, fill));
    this.updates.push(() => drawing.ask());
    if (this.node) canvas.addEventListener('click', (event) => this.choose(canvas, event));
  }

  /** How the plan lies in a picture of this size. */
  private placed(size: { width: number; height: number }) {
    const { width, height, spacing } = this.plan;
    const scale = Math.min(size.width / (width + spacing), size.height / (height + spacing));
    return { scale, left: (size.width - width * scale) / 2, foot: (size.height + height * scale) / 2 };
  }

  /** Takes the node nearest to a click for the diagrams. */
  private choose(canvas: HTMLCanvasElement, event: MouseEvent) {
    const box = canvas.getBoundingClientRect();
    const { scale, left, foot } = this.placed(box);
    const { x, y } = this.plan;
    const away = (i: number) =>
      Math.hypot(left + x[i] * scale - (event.clientX - box.left), foot - y[i] * scale - (event.clientY - box.top));
    let best = 0;
    for (let i = 1; i < this.nodes; ++i) if (away(i) < away(best)) best = i;
    this.node!.choose(best);
  }

  private paint(canvas: HTMLCanvasElement, fill: (row: number) => string) {
    const size = fitted(canvas);
    if (!size) return;
    const { x, y, spacing } = this.plan;
    const context = canvas.getContext('2d')!;
    const { scale, left, foot } = this.placed(size);
    const dot = Math.max(2, spacing * scale);
    const first = this.first();
    context.clearRect(0, 0, size.width, size.height);
    for (let i = 0; i < this.nodes; ++i) {
      context.fillStyle = first < 0 ? colour('--body') : fill(first + i);
      context.fillRect(Math.floor(left + x[i] * scale - dot / 2), Math.floor(foot - y[i] * scale - dot / 2),
        Math.ceil(dot) + 1, Math.ceil(dot) + 1);
    }
    if (!this.node) return;
    const { row } = this.node;
    context.strokeStyle = colour('--ink');
    context.lineWidth = 2 * size.ratio;
    context.strokeRect(left + x[row] * scale - dot / 2, foot - y[row] * scale - dot / 2, dot, dot);
  }

  private addStatus() {
    const status = this.column('status');
    const there = new Set(status);
    this.frame(statusTitle(there), element('ul', { class: 'legend inline' }, ...statusNames.map((name, i) =>
      there.has(i) && element('li', {}, element('span', { class: 'swatch', style: `background:${statusColours[i]}` }), name))),
    (row) => statusColours[status[row]] ?? '#888');
  }

  private add(title: string, unit: string, values: Float32Array, noise = false) {
    let least = Infinity, greatest = -Infinity;
    for (const v of values) { least = Math.min(least, v); greatest = Math.max(greatest, v); }
    const range: Range = { ...colourRange(least, greatest),
      instead: least === 0 && greatest === 0 ? '0 everywhere, at all moments' : noise
        ? `below round-off, at most ${shown(Math.max(-least, greatest), 2)} ${unit}` : undefined };
    const bar = new ColourBar(true);
    bar.show(range, unit);
    this.frame(title, bar.box, (row) => {
      if (range.instead) return colour('--body');
      const level = Math.round(255 * Math.min(1, Math.max(0, (values[row] - range.low) / (range.high - range.low))));
      const bytes = mapBytes(range.signed);
      return `rgb(${bytes[4 * level]} ${bytes[4 * level + 1]} ${bytes[4 * level + 2]})`;
    });
  }
}
