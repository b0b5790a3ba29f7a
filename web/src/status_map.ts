// Which contact node is open, sticks or slips, over place and time.
import uPlot from 'uplot';
import { areAxesShared, onSharing } from './chart';
import { ContactLine } from './contact_line';
import { element, swatch } from './dom';
import { shown } from './numbers';
import { Drawing } from './on_screen';
import { Result } from './results';
import { Column, TableBehind } from './table_behind';
import { colour, onTheme } from './theme';
import { Timeline } from './timeline';

// In the order of output::ContactStatus.
export const statusNames = ['open', 'stick', 'slip'];
// Where nothing touches, a grey that neither theme has for paper or body; of any colour vision it is lighter or duller
// than the others.
export const statusColours = ['#aeb6c0', '#3f7fb5', '#e07b39'];

/** What a map of these states is called. */
export const statusTitle = (there: Set<number>) => (there.has(0) ? 'Open, stick and slip' : 'Stick and slip');

export class StatusMap {
  readonly box: HTMLElement;
  readonly title: string;
  private readonly place = element('div', { class: 'plot' });
  private plot?: uPlot;
  private readonly drawing: Drawing;
  private readonly status: Float32Array;

  /** `nodes`: rows of a step of contact.csv; `ends`: time at the end of each */
  constructor(result: Result, private readonly line: ContactLine, private readonly nodes: number,
    private readonly ends: number[], private readonly timeline: Timeline) {
    this.status = result.contact!.column('status')!;
    const there = new Set(this.status);
    this.title = statusTitle(there);
    const key = element('ul', { class: 'legend inline' }, ...statusNames.map((name, i) => there.has(i) &&
      element('li', {}, swatch(statusColours[i]), name)));
    this.box = element('figure', { class: 'chart' }, element('figcaption', {}, this.title), this.place, key,
      new TableBehind(() => this.title, () => this.columns()).box);
    this.drawing = new Drawing(this.place, () => this.draw());
    onTheme(() => this.rebuild());
    onSharing(() => this.rebuild());
  }

  // A row for each node, a column for each step.
  private columns(): Column[] {
    const { order, along, label } = this.line;
    return [{ name: label, unit: '', values: along }, ...this.ends.map((end, k) => ({ name: `t = ${shown(end)} s`, unit: '',
      values: order.map((row) => statusNames[this.status[k * this.nodes + row]] ?? '') }))];
  }

  redraw() { this.drawing.ask(); }

  private rebuild() {
    this.plot?.destroy();
    this.plot = undefined;
    this.drawing.ask();
  }

  private draw() {
    const width = this.place.clientWidth;
    if (width === 0) return;
    if (!this.plot) return this.build(width);
    if (Math.abs(width - this.plot.width) > 1) this.plot.setSize({ width, height: 230 });
    this.plot.redraw(false);
  }

  private build(width: number) {
    const axis = { stroke: colour('--muted'), grid: { show: false }, ticks: { stroke: colour('--grid'), width: 1 },
      font: '12px system-ui, sans-serif', labelFont: '12px system-ui, sans-serif',
      values: (_: uPlot, splits: number[]) => splits.map((v) => shown(v, 4)) };
    const { along, label } = this.line;
    // Beside that of another run over the time of both.
    const own = this.ends[this.ends.length - 1];
    const end = areAxesShared('contact') ? Math.max(own, this.timeline.end) : own;
    this.plot = new uPlot({
      width, height: 230, legend: { show: false }, cursor: { show: false },
      scales: { x: { time: false, range: [0, end] }, y: { range: [along[0], along[along.length - 1]] } },
      axes: [{ ...axis, label: 't [s]', labelSize: 18, size: 34 }, { ...axis, label, labelSize: 18, size: 56 }],
      series: [{}, { show: true, stroke: 'transparent', points: { show: false } }],
      hooks: { draw: [(plot) => this.paint(plot)] },
    }, [[0, end], [along[0], along[along.length - 1]]], this.place);
  }

  private paint(plot: uPlot) {
    const { along, order } = this.line;
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    // To whole pixels, so that no node covers a part of its neighbour's; the ends, which have half of the
    // room of others, last and at least two pixels wide.
    const last = order.length - 1;
    const middle = (a: number, b: number) => Math.round(plot.valToPos((along[a] + along[b]) / 2, 'y', true));
    const foot = Math.round(plot.valToPos(along[0], 'y', true)), head = Math.round(plot.valToPos(along[last], 'y', true));
    const places = [...Array(Math.max(0, last - 1)).keys()].map((j) => j + 1).concat(last > 0 ? [0, last] : [0]);
    for (let k = 0; k < this.ends.length; ++k) {
      const left = Math.round(plot.valToPos(k > 0 ? this.ends[k - 1] : 0, 'x', true));
      const right = Math.round(plot.valToPos(this.ends[k], 'x', true));
      for (const j of places) {
        let bottom = j > 0 ? middle(j - 1, j) : foot;
        let top = j < last ? middle(j, j + 1) : head;
        if (j === 0) top = Math.min(top, foot - 2);
        if (j === last && j > 0) bottom = Math.max(bottom, head + 2);
        ctx.fillStyle = statusColours[this.status[k * this.nodes + order[j]]] ?? '#888';
        ctx.fillRect(left, top, right - left, bottom - top);
      }
    }
    const x = plot.valToPos(this.timeline.time, 'x', true);
    ctx.strokeStyle = colour('--ink');
    ctx.lineWidth = 2 * devicePixelRatio;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }
}
