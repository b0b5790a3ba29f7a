// Along the contact boundary of a plane body, each connected piece apart: opening and tractions with the bound, slip,
// temperature and potential, what crosses, and a map of stick and slip over place and time.
import { Cell, Group } from './arrangement';
import { allZero, Chart, Curve } from './chart';
import { ContactLine, contactLines, contactNodes, stepAt, stepEnds } from './contact_line';
import { ContactNode, hasDiagrams } from './contact_node';
import { lineColours } from './colours';
import { contactRoundOff } from './contact_round_off';
import { element } from './dom';
import { shown } from './numbers';
import { Result } from './results';
import { StatusMap } from './status_map';
import { Timeline } from './timeline';

/** What tangential components on the line mean. */
const direction = (line: ContactLine) =>
  `positive ${line.label === 'x [m]' ? 'towards growing x' : line.label === 'y [m]' ? 'towards growing y' : 'along the curve'}`;

type Series = { label: string; values: (row: number, at: number) => number; colour: string; dashed?: boolean };

export class Contact {
  /** one for each piece */
  readonly groups: Group[] = [];
  private readonly updates: (() => void)[] = [];
  private readonly nodes: number;
  private readonly ends: number[];

  constructor(private readonly result: Result, private readonly timeline: Timeline, private readonly sync: string) {
    this.nodes = contactNodes(result);
    this.ends = stepEnds(result);
    const lines = contactLines(result);
    lines.forEach((line, i) => this.groups.push(this.piece(line, i, lines.length > 1)));
    if (lines.length > 0 && hasDiagrams(result)) {
      const node = new ContactNode(result, timeline, lines);
      this.groups.push(node.group);
      this.updates.push(() => node.update());
    }
  }

  update() { for (const update of this.updates) update(); }

  private piece(line: ContactLine, number: number, several: boolean): Group {
    const cells: Cell[] = [];
    const add = (title: string, unit: string, series: Series[], noise = false, note = '') =>
      cells.push(this.chart(line, `${number} ${this.sync}`, title, unit, series, noise, note));
    const { normal, tangential, slip, gap } = contactRoundOff(this.result);
    const theta = !!this.result.field('temperature')?.belowRoundOff;
    const traction = this.of('normal_traction');
    if (this.result.contactOpens) {
      add('Opening', 'm', [{ label: 'opening', values: this.of('gap'), colour: lineColours[0] }], gap, 'negative: pressed in');
      add('Contact pressure', 'N/m²', [{ label: 'p = −σν·ν', values: (row) => -traction(row), colour: lineColours[0] }], normal);
    } else
      add('Normal traction on the body', 'N/m²', [{ label: 'σν·ν', values: traction, colour: lineColours[0] }], normal);
    add(this.result.frictionBound ? 'Tangential traction and the bound ±S' : 'Tangential traction on the body', 'N/m²', [
      { label: 'tangential', values: this.tangential('tangential_traction_', line), colour: lineColours[1] },
      ...this.bounds(),
    ], tangential, direction(line));
    add('Slip', 'm', [{ label: 'slip', values: this.tangential('slip_', line), colour: lineColours[1] }], slip, direction(line));
    if (this.result.has('temperature'))
      add('Temperature', 'K', [{ label: 'θ', values: this.of('temperature'), colour: lineColours[3] }], theta);
    if (this.result.contact!.column('heat_flux')!.some((v) => v !== 0))
      add('Heat flux out of the body', 'W/m²', [{ label: 'q·ν', values: this.of('heat_flux'), colour: lineColours[3] }], theta);
    const phi = !!this.result.field('potential')?.belowRoundOff;
    if (this.result.has('potential'))
      add('Potential', 'V', [{ label: 'φ', values: this.of('potential'), colour: lineColours[4] }], phi);
    if (this.result.contact!.column('charge_flux')?.some((v) => v !== 0))
      add('Charge out of the body', 'C/m²', [{ label: 'D·ν', values: this.of('charge_flux'), colour: lineColours[4] }], phi);
    const map = new StatusMap(this.result, line, this.nodes, this.ends, this.timeline);
    cells.push({ title: map.title, box: map.box });
    this.updates.push(() => map.redraw());
    const from = [line.name, line.origin].filter((text) => text).join(': ');
    const heading = several || line.origin !== '' ? element('h4', {}, several ? from : line.origin) : undefined;
    return { key: `piece ${line.name}`, heading, piece: line.name, cells };
  }

  private chart(line: ContactLine, sync: string, title: string, unit: string, series: Series[], noise: boolean,
    note: string): Cell {
    const at = (k: number, s: Series) => line.order.map((row, j) => s.values(k * this.nodes + row, j));
    const all = series.filter((s) => !s.dashed).flatMap((s) => this.ends.flatMap((_, k) => at(k, s)));
    if (allZero(all)) return said(title, `0 everywhere, at all moments`);
    if (noise) return said(title, `below round-off, at most ${shown(Math.max(...all.map(Math.abs)), 2)} ${unit}`);
    let least = 0, greatest = 0;
    for (const s of series)
      for (let k = 0; k < this.ends.length; ++k)
        for (const v of at(k, s)) { if (v < least) least = v; if (v > greatest) greatest = v; }
    const curves = (): Curve[] => {
      const k = stepAt(this.ends, this.timeline.time);
      return series.map((s) => ({ ...s, points: line.order.length < 3 && !s.dashed,
        values: k < 0 ? line.order.map(() => null) : at(k, s) }));
    };
    const chart = new Chart({ title, note, group: 'contact', xLabel: line.label, unit, sync: 'place' + sync, least, greatest }, line.along, curves());
    this.updates.push(() => chart.update(curves()));
    return { title, box: chart.box };
  }

  private of(name: string) {
    const column = this.result.contact!.column(name)!;
    return (row: number) => column[row];
  }

  /** The part of a vector along the line. */
  private tangential(name: string, line: ContactLine) {
    const x = this.of(name + 'x'), y = this.of(name + 'y');
    return (row: number, at: number) => x(row) * line.tangents[at][0] + y(row) * line.tangents[at][1];
  }

  private bounds(): Series[] {
    const bound = this.result.frictionBound;
    if (!bound) return [];
    const colour = lineColours[2];
    return [
      { label: '+S', values: (row) => bound[row], colour, dashed: true },
      { label: '−S', values: (row) => -bound[row], colour, dashed: true },
    ];
  }
}

/** In the place of a chart that would have nothing to draw. */
function said(title: string, text: string): Cell {
  const box = element('figure', { class: 'chart' }, element('figcaption', {}, title), element('p', { class: 'note' }, text));
  return { title, box };
}
