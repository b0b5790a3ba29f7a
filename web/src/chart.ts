// Curves by uPlot, with powers of ten in the axis titles and a mark at the moment.
import uPlot from 'uplot';
import { takeKeys } from './chart_keys';
import { curveSheet } from './curve_sheet';
import { element } from './dom';
import { shown, thousands, unitWith } from './numbers';
import { Drawing } from './on_screen';
import { Point } from './pen';
import { csv, fileName, saveButtons, saveText } from './save';
import { TableBehind } from './table_behind';
import { colour, onTheme } from './theme';

export interface Curve {
  label: string;
  values: ArrayLike<number | null>;
  colour: string;
  dashed?: boolean;
  points?: boolean;
  bars?: boolean;
  /** over abscissas at which it has no value */
  joined?: boolean;
}

export interface ChartOptions {
  title: string;
  /** below the title */
  note?: string;
  xLabel: string;
  /** of the values as given; the chart may show a power of ten of it */
  unit: string;
  /** cursors with the same name move together */
  sync: string;
  /** values the y axis always holds, over all moments */
  least?: number;
  greatest?: number;
  /** charts of one group and title, of runs side by side, can share their axes */
  group?: string;
  /** where to draw the line of the moment */
  mark?: () => number | undefined;
  height?: number;
  /** columns that a CSV has beside the abscissa */
  further?: () => [name: string, values: number[]][];
}

const charts: Chart[] = [];
const ofBox = new WeakMap<Element, Chart>();
const apart = new Set<string>();
const listeners: (() => void)[] = [];

export const chartOf = (box: Element) => ofBox.get(box);

/** Whether the charts of a group have the same axes as their counterparts; they do at first. */
export function shareAxes(group: string, on: boolean) {
  if (on) apart.delete(group);
  else apart.add(group);
  for (const chart of charts) if (chart.isIn(group)) chart.rebuild();
  for (const listener of listeners) listener();
}

/** For pictures of a group that are no charts of this kind. */
export const areAxesShared = (group: string) => !apart.has(group);
export function onSharing(listener: () => void) { listeners.push(listener); }

export function allZero(values: ArrayLike<number | null>): boolean {
  for (let i = 0; i < values.length; ++i) if (values[i] !== 0 && values[i] !== null) return false;
  return true;
}

export class Chart {
  readonly box: HTMLElement;
  private readonly place = element('div', { class: 'plot' });
  private readonly caption = element('figcaption', {});
  private readonly table: TableBehind;
  private plot?: uPlot;
  private power = 0;
  private other = false;
  private readonly listeners: (() => void)[] = [];
  private readonly drawing: Drawing;

  constructor(private options: ChartOptions, private x: number[], private curves: Curve[]) {
    this.caption.textContent = options.title;
    this.table = new TableBehind(() => this.options.title, () => [{ name: this.options.xLabel, unit: '', values: this.x },
      ...this.curves.map(({ label, values }) => ({ name: label, unit: this.options.unit, values }))]);
    this.box = element('figure', { class: 'chart', 'data-unit': options.unit }, this.caption,
      saveButtons('the curves', [['SVG', () => this.saveDrawing()], ['CSV', () => this.saveNumbers()]]),
      !!options.note && element('p', { class: 'note' }, options.note), this.place, this.table.box);
    charts.push(this);
    ofBox.set(this.box, this);
    this.drawing = new Drawing(this.place, () => this.draw());
  }

  /** Other values for the same curves. */
  update(curves: Curve[]) {
    this.curves = curves;
    this.table.refresh();
    this.other = true;
    this.drawing.ask();
    for (const listener of this.listeners) listener();
  }

  /** Told of other values. */
  onUpdate(listener: () => void) { this.listeners.push(listener); }

  get described(): ChartOptions { return this.options; }
  get abscissas(): number[] { return this.x; }
  get shown(): Curve[] { return this.curves; }

  /** Another chart in its place. */
  become(options: Partial<ChartOptions>, x: number[], curves: Curve[]) {
    this.options = { ...this.options, ...options };
    this.x = x;
    this.curves = curves;
    this.caption.textContent = this.options.title;
    this.table.refresh();
    this.box.dataset.unit = this.options.unit;
    this.rebuild();
  }

  redraw() { this.drawing.ask(); }

  /** Anew, in other colours. */
  rebuild() {
    this.plot?.destroy();
    this.plot = undefined;
    this.drawing.ask();
  }

  private draw() {
    const width = this.place.clientWidth;
    if (width === 0) return;
    if (!this.plot) return this.build(width);
    if (Math.abs(width - this.plot.width) > 1) this.plot.setSize({ width, height: this.plot.height });
    if (this.other) this.plot.setData(this.data(), false);
    this.plot.redraw(false);
    // The values under a pointer that stays are those of the new moment.
    const { left, top } = this.plot.cursor;
    if (this.other && left !== undefined && left >= 0) this.plot.setCursor({ left, top: top ?? 0 }, false);
    this.other = false;
  }

  private build(width: number) {
    this.power = thousands(this.greatestSize());
    this.plot = new uPlot(this.plotOptions(width), this.data(), this.place);
    takeKeys(this.plot, this.options.title);
    this.other = false;
  }

  private saveNumbers() {
    const { title, xLabel, unit } = this.options, further = this.options.further?.() ?? [];
    saveText(fileName(title) + '.csv', 'text/csv', csv(
      [xLabel, ...further.map(([name]) => name), ...this.curves.map((c) => (unit ? `${c.label} [${unit}]` : c.label))],
      [this.x, ...further.map(([, values]) => values), ...this.curves.map((c) => c.values)]));
  }

  private saveDrawing() {
    const { title, xLabel, unit } = this.options;
    const power = thousands(this.greatestSize()), factor = 10 ** -power;
    saveText(fileName(title) + '.svg', 'image/svg+xml', curveSheet({ title,
      x: { label: xLabel, ends: [Math.min(...this.x), Math.max(...this.x)] },
      y: { label: unitWith(power, unit), ends: padded(...this.limits(), factor) },
      curves: this.curves.map((c) => ({ ...c, points: this.x.map((x, i): Point | null => {
        const v = c.values[i];
        return v === null || !Number.isFinite(v) ? null : [x, v * factor];
      }) })) }));
  }

  private data(): uPlot.AlignedData {
    const factor = 10 ** -this.power;
    return [this.x, ...this.curves.map((c) =>
      Array.from(c.values, (v) => (v === null || !Number.isFinite(v) ? null : v * factor)))] as uPlot.AlignedData;
  }

  isIn(group: string): boolean { return this.options.group === group; }

  /** This chart, and those that have its axes. */
  private alike(): Chart[] {
    const { group, title, xLabel, unit } = this.options;
    if (group === undefined || apart.has(group)) return [this];
    return charts.filter(({ options }) =>
      options.group === group && options.title === title && options.xLabel === xLabel && options.unit === unit);
  }

  private limits(): [number, number] {
    let least = Infinity, greatest = -Infinity;
    for (const chart of this.alike()) {
      least = Math.min(least, chart.options.least ?? Infinity);
      greatest = Math.max(greatest, chart.options.greatest ?? -Infinity);
      for (const curve of chart.curves)
        for (const v of Array.from(curve.values))
          if (v !== null && Number.isFinite(v)) { least = Math.min(least, v); greatest = Math.max(greatest, v); }
    }
    return least <= greatest ? [least, greatest] : [0, 1];
  }

  private ends(): [number, number] {
    const all = this.alike().flatMap(({ x }) => [x[0], x[x.length - 1]]).filter((v) => v !== undefined);
    const [least, greatest] = [Math.min(...all), Math.max(...all)];
    return least < greatest ? [least, greatest] : [least - 1, greatest + 1];
  }

  private greatestSize(): number { return Math.max(...this.limits().map(Math.abs)); }

  private plotOptions(width: number): uPlot.Options {
    const { xLabel, unit, sync } = this.options;
    const axis = { stroke: colour('--muted'), grid: { stroke: colour('--grid'), width: 1 },
      ticks: { stroke: colour('--grid'), width: 1 }, font: '12px system-ui, sans-serif', labelFont: '12px system-ui, sans-serif' };
    const numbers = (_: uPlot, splits: number[]) => splits.map((v) => shown(v, 4));
    return {
      width, height: this.options.height ?? 230,
      cursor: { sync: { key: sync }, drag: { x: true, y: false } },
      scales: { x: { time: false, ...(this.alike().length > 1 ? { range: () => this.ends() } : {}) }, y: { range: () => padded(...this.limits(), 10 ** -this.power) } },
      axes: [
        { ...axis, label: xLabel, labelSize: 18, size: 34, values: numbers },
        { ...axis, label: unitWith(this.power, unit), labelSize: 18, size: 56, values: numbers },
      ],
      series: [
        { label: xLabel, value: (_, v) => (v === null ? '–' : shown(v, 4)) },
        ...this.curves.map((c): uPlot.Series => ({
          label: c.label, stroke: c.colour, width: 1.8, spanGaps: c.joined, dash: c.dashed ? [6, 4] : undefined,
          points: { show: c.points ?? false, size: 5, fill: c.colour },
          fill: c.bars ? c.colour + '55' : undefined,
          paths: c.bars ? uPlot.paths.bars!({ size: [0.7, 40] }) : undefined,
          value: (_, v) => (v === null ? '–' : shown(v, 4)),
        })),
      ],
      hooks: { draw: [(plot) => this.drawMark(plot)] },
    };
  }

  private drawMark(plot: uPlot) {
    const { x: across, y: up } = plot.scales;
    this.box.dataset.axes = [across.min, across.max, ...[up.min, up.max].map((v) => (v ?? 0) * 10 ** this.power)].join(' ');
    const at = this.options.mark?.();
    if (at === undefined) return;
    const x = plot.valToPos(at, 'x', true);
    plot.ctx.save();
    plot.ctx.strokeStyle = colour('--accent');
    plot.ctx.lineWidth = 1.5 * devicePixelRatio;
    plot.ctx.setLineDash([]);
    plot.ctx.beginPath();
    plot.ctx.moveTo(x, plot.bbox.top);
    plot.ctx.lineTo(x, plot.bbox.top + plot.bbox.height);
    plot.ctx.stroke();
    plot.ctx.restore();
  }
}

/** A range with room around it, times `factor`; 0 stays an end. */
export function padded(least: number, greatest: number, factor: number): [number, number] {
  if (least === 0 && greatest === 0) return [0, 1];
  if (least === greatest) return [(least - (Math.abs(least) || 1)) * factor, (greatest + (Math.abs(greatest) || 1)) * factor];
  const room = (greatest - least) * 0.06;
  return [(least === 0 ? 0 : least - room) * factor, (greatest === 0 ? 0 : greatest + room) * factor];
}

onTheme(() => { for (const chart of charts) chart.rebuild(); });

export function redrawMarks() { for (const chart of charts) chart.redraw(); }
