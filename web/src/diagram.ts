// One quantity over another, step by step: a path that may turn back, with a mark at the moment.
import uPlot from 'uplot';
import { padded } from './chart';
import { curveSheet } from './curve_sheet';
import { element, swatch } from './dom';
import { Drawing } from './on_screen';
import { shown, thousands, unitWith } from './numbers';
import { Point } from './pen';
import { csv, fileName, saveButtons, saveText } from './save';
import { TableBehind } from './table_behind';
import { colour, onTheme } from './theme';

export interface Path {
  label: string;
  colour: string;
  /** a value of each for every step */
  x: number[];
  y: number[];
  dashed?: boolean;
}

export interface DiagramOptions {
  title: string;
  x: { label: string; unit: string };
  y: { label: string; unit: string };
}

export class Diagram {
  readonly box: HTMLElement;
  private readonly place = element('div', { class: 'plot' });
  private plot?: uPlot;
  private readonly drawing: Drawing;
  private readonly table: TableBehind;

  /** `at`: the step to be marked, or -1 */
  constructor(private readonly options: DiagramOptions, private paths: Path[], private readonly at: () => number) {
    this.table = new TableBehind(() => options.title, () => [
      { name: `${options.x.label}`, unit: options.x.unit, values: this.paths[0]?.x ?? [] },
      ...this.paths.map((path) => ({ name: path.label, unit: options.y.unit, values: path.y }))]);
    const key = element('ul', { class: 'legend inline' }, ...paths.map((path) =>
      element('li', {}, swatch(path.colour), path.label)));
    this.box = element('figure', { class: 'chart' }, element('figcaption', {}, options.title),
      saveButtons('the curves', [['SVG', () => this.saveDrawing()], ['CSV', () => this.saveNumbers()]]), this.place,
      paths.length > 1 && key, this.table.box);
    this.drawing = new Drawing(this.place, () => this.draw());
    onTheme(() => this.rebuild());
  }

  /** Other values of the same paths. */
  update(paths: Path[]) {
    this.paths = paths;
    this.table.refresh();
    this.rebuild();
  }

  get title(): string { return this.options.title; }

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

  private range(of: 'x' | 'y'): { power: number; ends: [number, number] } {
    // 0 is always seen: where the path begins.
    let least = 0, greatest = 0;
    for (const path of this.paths)
      for (const v of path[of]) if (Number.isFinite(v)) { least = Math.min(least, v); greatest = Math.max(greatest, v); }
    const power = thousands(Math.max(-least, greatest));
    return { power, ends: padded(least, greatest, 10 ** -power) };
  }

  private saveNumbers() {
    const { title, x, y } = this.options;
    const named = ({ label, unit }: { label: string; unit: string }, of: string) => `${label} ${of} [${unit}]`;
    saveText(fileName(title) + '.csv', 'text/csv', csv(this.paths.flatMap((p) => [named(x, p.label), named(y, p.label)]),
      this.paths.flatMap((p) => [p.x, p.y])));
  }

  private saveDrawing() {
    const { title, x, y } = this.options;
    const across = this.range('x'), up = this.range('y');
    saveText(fileName(title) + '.svg', 'image/svg+xml', curveSheet({ title,
      x: { label: `${x.label} [${unitWith(across.power, x.unit)}]`, ends: across.ends },
      y: { label: `${y.label} [${unitWith(up.power, y.unit)}]`, ends: up.ends },
      curves: this.paths.map((p) => ({ ...p, points: p.x.map((v, k): Point => [v / 10 ** across.power, p.y[k] / 10 ** up.power]) })) }));
  }

  private build(width: number) {
    const { x, y } = this.options;
    const across = this.range('x'), up = this.range('y');
    const label = (name: string, power: number, unit: string) => `${name} [${unitWith(power, unit)}]`;
    const axis = { stroke: colour('--muted'), grid: { stroke: colour('--grid'), width: 1 },
      ticks: { stroke: colour('--grid'), width: 1 }, font: '12px system-ui, sans-serif', labelFont: '12px system-ui, sans-serif',
      values: (_: uPlot, splits: number[]) => splits.map((v) => shown(v, 4)) };
    this.plot = new uPlot({
      width, height: 230, legend: { show: false }, cursor: { show: false },
      scales: { x: { time: false, range: across.ends }, y: { range: up.ends } },
      axes: [{ ...axis, label: label(x.label, across.power, x.unit), labelSize: 18, size: 34 },
        { ...axis, label: label(y.label, up.power, y.unit), labelSize: 18, size: 56 }],
      series: [{}, { show: true, stroke: 'transparent', points: { show: false } }],
      hooks: { draw: [(plot) => this.paint(plot, 10 ** -across.power, 10 ** -up.power)] },
    }, [[...across.ends], [...up.ends]], this.place);
  }

  private paint(plot: uPlot, across: number, up: number) {
    const { ctx } = plot;
    ctx.save();
    for (const path of this.paths) {
      const places = path.x.map((v, k): [number, number] =>
        [plot.valToPos(v * across, 'x', true), plot.valToPos(path.y[k] * up, 'y', true)]);
      ctx.strokeStyle = ctx.fillStyle = path.colour;
      ctx.lineWidth = 1.8 * devicePixelRatio;
      ctx.setLineDash(path.dashed ? [6 * devicePixelRatio, 4 * devicePixelRatio] : []);
      ctx.beginPath();
      places.forEach(([x, y], k) => (k === 0 ? ctx.moveTo(x, y) : ctx.lineTo(x, y)));
      ctx.stroke();
      ctx.setLineDash([]);
      if (path.dashed) continue;  // the marks are those of what it limits
      const at = this.at();
      places.forEach(([x, y], k) => {
        ctx.beginPath();
        ctx.arc(x, y, (k === at ? 5 : places.length < 40 ? 2 : 0) * devicePixelRatio, 0, 2 * Math.PI);
        ctx.fill();
      });
    }
    ctx.restore();
  }
}
