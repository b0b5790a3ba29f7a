// The contact boundary of a solid body, laid out in a plane: state, opening, tractions, slip and temperature of its nodes
// at the moment that is shown. A click chooses the node of the diagrams.
import { Cell, Group } from './arrangement';
import { colourRange, mapBytes, Range } from './colours';
import { ColourBar } from './colour_bar';
import { contactNodes, stepAt, stepEnds } from './contact_line';
import { ContactNode, hasDiagrams } from './contact_node';
import { contactRoundOff } from './contact_round_off';
import { element, swatch } from './dom';
import { FaceMap } from './face_map';
import { shown } from './numbers';
import { Drawing } from './on_screen';
import { ContactFacePart, Result } from './results';
import { fitted } from './stage';
import { statusColours, statusNames, statusTitle } from './status_map';
import { Column, TableBehind } from './table_behind';
import { colour, onTheme } from './theme';
import { Timeline } from './timeline';

type Rgb = [number, number, number];

interface Quantity { title: string; unit: string; values: Float32Array; noise: boolean }

/** Ranges of one quantity in all runs of the page: their colours mean the same while they are shared. */
const ranges = new Map<string, { least: number; greatest: number }>();
const faces: ContactFace[] = [];
let areShared = true;

/** Whether the colours of the contact's faces mean the same in both runs; they do at first. */
export function shareFaceColours(on: boolean) {
  areShared = on;
  for (const face of faces) face.update();
}

const rgbOf = (hex: string): Rgb => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)) as Rgb;

/** Any colour that CSS knows. */
function rgbOfCss(name: string): Rgb {
  const context = new OffscreenCanvas(1, 1).getContext('2d')!;
  context.fillStyle = name;
  context.fillRect(0, 0, 1, 1);
  return [...context.getImageData(0, 0, 1, 1).data.slice(0, 3)] as Rgb;
}

export class ContactFace {
  readonly groups: Group[];
  private readonly updates: (() => void)[] = [];
  private readonly nodes: number;
  private readonly ends: number[];
  private readonly node?: ContactNode;
  private readonly quantities: Quantity[];

  constructor(private readonly result: Result, private readonly timeline: Timeline) {
    this.nodes = contactNodes(result);
    this.ends = stepEnds(result);
    this.quantities = this.quantitiesOf();
    for (const { title, values } of this.quantities) {
      const range = ranges.get(title) ?? { least: Infinity, greatest: -Infinity };
      for (const v of values) { range.least = Math.min(range.least, v); range.greatest = Math.max(range.greatest, v); }
      ranges.set(title, range);
    }
    if (hasDiagrams(result)) this.node = new ContactNode(result, timeline);
    this.groups = result.contactFaces.map((part, i) => this.group(part, i));
    if (this.node && this.groups.length > 0) {
      this.groups.push(this.node.group);
      this.updates.push(() => this.node!.update());
      this.node.onChange(() => this.update());
    }
    onTheme(() => this.update());
    faces.push(this);
  }

  update() { for (const update of this.updates) update(); }

  private column(name: string): Float32Array { return this.result.contact!.column(name)!; }

  private size(name: string): Float32Array {
    const parts = ['x', 'y', 'z'].map((axis) => this.column(name + axis));
    return parts[0].map((_, i) => Math.hypot(...parts.map((p) => p[i])));
  }

  private quantitiesOf(): Quantity[] {
    const { normal, tangential, slip, gap } = contactRoundOff(this.result);
    const noiseOf = (field: string) => !!this.result.field(field)?.belowRoundOff;
    const all: Quantity[] = [];
    const add = (title: string, unit: string, values: Float32Array, noise: boolean) => all.push({ title, unit, values, noise });
    const traction = this.column('normal_traction');
    if (this.result.contactOpens) {
      add('Opening', 'm', this.column('gap'), gap);
      add('Contact pressure', 'N/m²', traction.map((v) => -v), normal);
    } else
      add('Normal traction on the body', 'N/m²', traction, normal);
    add('Tangential traction, size', 'N/m²', this.size('tangential_traction_'), tangential);
    add('Slip, size', 'm', this.size('slip_'), slip);
    if (this.result.has('temperature')) add('Temperature', 'K', this.column('temperature'), noiseOf('temperature'));
    const crosses = (name: string) => !!this.result.contact!.column(name)?.some((v) => v !== 0);
    if (crosses('heat_flux')) add('Heat flux out of the body', 'W/m²', this.column('heat_flux'), noiseOf('temperature'));
    if (crosses('charge_flux')) {
      add('Potential', 'V', this.column('potential'), noiseOf('potential'));
      add('Charge out of the body', 'C/m²', this.column('charge_flux'), noiseOf('potential'));
    }
    return all;
  }

  private group(part: ContactFacePart, number: number): Group {
    const map = new FaceMap(part);
    const name = [part.contact, part.place].filter((text) => text).join(': ');
    const heading = element('div', {}, element('h4', {}, name),
      element('p', { class: 'note' }, [`${part.across} to the right, ${part.up} up`, part.origin].filter((t) => t).join('; ')));
    return { key: `face ${number}`, heading, piece: name,
      cells: [this.status(map), ...this.quantities.map((quantity) => this.quantity(map, quantity))] };
  }

  // The first row of the moment; -1 for the initial state, which has none, and where the run has ended.
  private first(): number {
    const step = stepAt(this.ends, this.timeline.time);
    return step < 0 ? -1 : step * this.nodes;
  }

  private frame(map: FaceMap, title: string, unit: string, below: HTMLElement, fill: (row: number) => Rgb,
    text: (row: number) => number | string): Cell {
    const canvas = element('canvas', { class: 'face', role: 'img', 'aria-label': title,
      style: `aspect-ratio: ${Math.min(4, Math.max(0.5, map.width / map.height))}` });
    const table = new TableBehind(() => title, () => this.columns(map, title, unit, text));
    const drawing = new Drawing(canvas, () => this.paint(canvas, map, fill));
    this.updates.push(() => { drawing.ask(); table.refresh(); });
    if (this.node) canvas.addEventListener('click', (event) => {
      const box = canvas.getBoundingClientRect();
      this.node!.choose(map.nearest(event.clientX - box.left, event.clientY - box.top, map.placed(box.width, box.height)).row);
    });
    return { title, box: element('figure', { class: 'chart' }, element('figcaption', {}, title), canvas, below, table.box) };
  }

  private columns({ part }: FaceMap, title: string, unit: string, text: (row: number) => number | string): Column[] {
    const rows = [...new Set(part.rows)].sort((a, b) => a - b), first = this.first();
    return [...['x', 'y', 'z'].map((axis) => ({ name: axis, unit: 'm', values: rows.map((row) => this.column(axis)[row]) })),
      { name: title, unit, values: rows.map((row) => (first < 0 ? null : text(first + row))) }];
  }

  private paint(canvas: HTMLCanvasElement, map: FaceMap, fill: (row: number) => Rgb) {
    const size = fitted(canvas);
    if (!size) return;
    const { width, height } = size;
    const context = canvas.getContext('2d')!;
    const image = context.createImageData(width, height);
    const owners = map.ownersFor(width, height);
    const first = this.first(), bare = rgbOfCss(colour('--body'));
    const colours = Array.from(map.part.rows, (row) => (first < 0 ? bare : fill(first + row)));
    for (let i = 0; i < owners.length; ++i) {
      if (owners[i] < 0) continue;
      image.data.set(colours[owners[i]], 4 * i);
      image.data[4 * i + 3] = 255;
    }
    context.putImageData(image, 0, 0);
    if (this.node) this.ring(context, map, size);
  }

  /** Around the node of the diagrams. */
  private ring(context: CanvasRenderingContext2D, map: FaceMap, { width, height, ratio }: { width: number; height: number; ratio: number }) {
    const placement = map.placed(width, height);
    map.part.rows.forEach((row, i) => {
      if (row !== this.node!.row) return;
      const [x, y] = map.at(i, placement);
      for (const [ink, line] of [[colour('--card'), 4], [colour('--ink'), 2]] as const) {
        context.strokeStyle = ink;
        context.lineWidth = line * ratio;
        context.beginPath();
        context.arc(x, y, 6 * ratio, 0, 2 * Math.PI);
        context.stroke();
      }
    });
  }

  private status(map: FaceMap): Cell {
    const status = this.column('status');
    const there = new Set(status);
    const key = element('ul', { class: 'legend inline' }, ...statusNames.map((name, i) =>
      there.has(i) && element('li', {}, swatch(statusColours[i]), name)));
    const known = statusColours.map(rgbOf), unknown: Rgb = [136, 136, 136];
    return this.frame(map, statusTitle(there), '', key, (row) => known[status[row]] ?? unknown,
      (row) => statusNames[status[row]] ?? '');
  }

  private rangeOf({ title, unit, values, noise }: Quantity): Range {
    let { least, greatest } = { least: Infinity, greatest: -Infinity };
    for (const v of values) { least = Math.min(least, v); greatest = Math.max(greatest, v); }
    const instead = least === 0 && greatest === 0 ? '0 everywhere, at all moments'
      : noise ? `below round-off, at most ${shown(Math.max(-least, greatest), 2)} ${unit}` : undefined;
    const all = areShared ? ranges.get(title)! : { least, greatest };
    return { ...colourRange(all.least, all.greatest), instead };
  }

  private quantity(map: FaceMap, quantity: Quantity): Cell {
    const bar = new ColourBar(true);
    let range: Range, bytes: Uint8Array, bare: Rgb;
    const choose = () => {
      range = this.rangeOf(quantity);
      bytes = mapBytes(range.signed);
      bare = rgbOfCss(colour('--body'));
      bar.show(range, quantity.unit);
    };
    this.updates.push(choose);
    // The other run's values are known only when all of the page is.
    queueMicrotask(choose);
    choose();
    return this.frame(map, quantity.title, quantity.unit, bar.box, (row) => {
      if (range.instead) return bare;
      const share = (quantity.values[row] - range.low) / (range.high - range.low);
      const level = Math.round(255 * Math.min(1, Math.max(0, share)));
      return [bytes[4 * level], bytes[4 * level + 1], bytes[4 * level + 2]];
    }, (row) => quantity.values[row]);
  }
}
