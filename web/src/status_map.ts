// Which contact node sticks or slips, over place and time.
import uPlot from 'uplot';
import { ContactLine } from './contact_line';
import { element } from './dom';
import { shown } from './numbers';
import { Result } from './results';
import { colour, onTheme } from './theme';
import { Timeline } from './timeline';

// In the order of output::ContactStatus.
export const statusNames = ['open', 'stick', 'slip'];
export const statusColours = ['#c28400', '#3f7fb5', '#e07b39'];

export class StatusMap {
  readonly box: HTMLElement;
  private readonly place = element('div', { class: 'plot' });
  private plot?: uPlot;
  private readonly status: Float32Array;
  private readonly ends: number[];

  constructor(result: Result, private readonly line: ContactLine, private readonly steps: number[],
    private readonly timeline: Timeline) {
    this.status = result.contact!.column('status')!;
    const time = result.contact!.column('time')!;
    const nodes = line.order.length;
    this.ends = steps.map((_, k) => time[k * nodes]);
    const there = new Set(this.status);
    const key = element('ul', { class: 'legend inline' }, ...statusNames.map((name, i) => there.has(i) &&
      element('li', {}, element('span', { class: 'swatch', style: `background:${statusColours[i]}` }), name)));
    this.box = element('figure', { class: 'chart' }, element('figcaption', {}, 'Stick and slip'), this.place, key);
    new ResizeObserver(() => {
      const width = this.place.clientWidth;
      if (!this.plot) this.build();
      else if (width > 0 && Math.abs(width - this.plot.width) > 1) this.plot.setSize({ width, height: 230 });
    }).observe(this.place);
    onTheme(() => this.build());
  }

  redraw() { this.plot?.redraw(false); }

  private build() {
    this.plot?.destroy();
    const width = this.place.clientWidth;
    if (width === 0) return;
    const axis = { stroke: colour('--muted'), grid: { show: false }, ticks: { stroke: colour('--grid'), width: 1 },
      font: '12px system-ui, sans-serif', labelFont: '12px system-ui, sans-serif',
      values: (_: uPlot, splits: number[]) => splits.map((v) => shown(v, 4)) };
    const { along, label } = this.line;
    const end = this.ends[this.ends.length - 1];
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
    for (let k = 0; k < this.steps.length; ++k) {
      const left = plot.valToPos(k > 0 ? this.ends[k - 1] : 0, 'x', true);
      const right = plot.valToPos(this.ends[k], 'x', true);
      for (let j = 0; j < order.length; ++j) {
        const low = j > 0 ? (along[j - 1] + along[j]) / 2 : along[0];
        const high = j + 1 < order.length ? (along[j] + along[j + 1]) / 2 : along[j];
        const top = plot.valToPos(high, 'y', true), bottom = plot.valToPos(low, 'y', true);
        ctx.fillStyle = statusColours[this.status[k * order.length + order[j]]] ?? '#888';
        ctx.fillRect(Math.floor(left), Math.floor(top), Math.ceil(right - left) + 1, Math.ceil(bottom - top) + 1);
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
