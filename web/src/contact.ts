// Along the contact boundary of a plane body: tractions with the bound, slip, temperature, and a map of
// stick and slip over place and time.
import { Chart, Curve } from './chart';
import { ContactLine, contactLine, contactNodes } from './contact_line';
import { lineColours } from './colours';
import { Result } from './results';
import { StatusMap } from './status_map';
import { Timeline } from './timeline';

export class Contact {
  readonly charts: HTMLElement[] = [];
  private readonly updates: (() => void)[] = [];
  private readonly line: ContactLine;
  private readonly nodes: number;
  private readonly steps: number[];

  constructor(private readonly result: Result, private readonly timeline: Timeline, private readonly sync: string) {
    this.nodes = contactNodes(result);
    this.line = contactLine(result);
    const step = result.contact!.column('step')!;
    this.steps = Array.from({ length: step.length / this.nodes }, (_, k) => step[k * this.nodes]);
    this.add('Normal traction on the body', 'N/m²', [
      { label: 'σν·ν', column: this.column('normal_traction'), colour: lineColours[0] }]);
    this.add(result.frictionBound ? 'Tangential traction and the bound ±S' : 'Tangential traction on the body', 'N/m²', [
      { label: 'tangential', column: this.tangential('tangential_traction_'), colour: lineColours[1] },
      ...this.bounds(),
    ]);
    this.add('Slip', 'm', [{ label: 'slip', column: this.tangential('slip_'), colour: lineColours[1] }]);
    this.add('Temperature', 'K', [{ label: 'θ', column: this.column('temperature'), colour: lineColours[3] }]);
    const flux = this.column('heat_flux');
    if (flux.some((v) => v !== 0))
      this.add('Heat flux out of the body', 'W/m²', [{ label: 'q·ν', column: flux, colour: lineColours[3] }]);
    const map = new StatusMap(result, this.line, this.steps, timeline);
    this.charts.push(map.box);
    this.updates.push(() => map.redraw());
  }

  update() { for (const update of this.updates) update(); }

  private add(title: string, unit: string, series: { label: string; column: Float32Array; colour: string; dashed?: boolean }[]) {
    const curves = (): Curve[] => series.map((s) => ({ ...s, values: this.now(s.column) }));
    let least = 0, greatest = 0;
    for (const s of series)
      for (const v of s.column) { if (v < least) least = v; if (v > greatest) greatest = v; }
    const chart = new Chart({ title, xLabel: this.line.label, unit, sync: 'place' + this.sync, least, greatest },
      this.line.along, curves());
    this.charts.push(chart.box);
    this.updates.push(() => chart.update(curves()));
  }

  // The rows of the shown moment, along the line. The initial state has none.
  private now(column: Float32Array): (number | null)[] {
    const time = this.result.contact!.column('time')!;
    let k = -1, away = Infinity;
    for (let i = 0; i < this.steps.length; ++i) {
      const d = Math.abs(time[i * this.nodes] - this.timeline.time);
      if (d < away) { away = d; k = i; }
    }
    if (this.timeline.time < time[0] / 2) return this.line.order.map(() => null);
    return this.line.order.map((i) => column[k * this.nodes + i]);
  }

  private column(name: string): Float32Array { return this.result.contact!.column(name)!; }

  /** The part of a vector along the line. */
  private tangential(name: string): Float32Array {
    const x = this.column(name + 'x'), y = this.column(name + 'y');
    const values = new Float32Array(x.length);
    const tangents: [number, number][] = [];
    this.line.order.forEach((i, k) => (tangents[i] = this.line.tangents[k]));
    for (let i = 0; i < x.length; ++i) {
      const t = tangents[i % this.nodes];
      values[i] = x[i] * t[0] + y[i] * t[1];
    }
    return values;
  }

  private bounds() {
    const bound = this.result.frictionBound;
    if (!bound) return [];
    const colour = lineColours[2];
    return [
      { label: '+S', column: bound, colour, dashed: true },
      { label: '−S', column: bound.map((s) => -s), colour, dashed: true },
    ];
  }
}

