// What the case's probes along lines told: the fields along each at the moment that is shown.
import { Cell, Group } from './arrangement';
import { allZero, Chart, Curve } from './chart';
import { lineColours } from './colours';
import { stepAt } from './contact_line';
import { element } from './dom';
import { Result, Table } from './results';
import { Timeline } from './timeline';

interface Quantity { title: string; unit: string; columns: [name: string, label: string][] }

const quantities: Quantity[] = [
  { title: 'Displacement along the line', unit: 'm', columns: [['u_x', 'x'], ['u_y', 'y'], ['u_z', 'z']] },
  { title: 'Potential along the line', unit: 'V', columns: [['potential', 'φ']] },
  { title: 'Temperature along the line', unit: 'K', columns: [['temperature', 'θ']] },
];

/** Places of a line in each step. */
function placesOf(table: Table): number {
  const step = table.column('step')!, second = step.findIndex((s) => s !== step[0]);
  return second < 0 ? step.length : second;
}

/** The end of each step [s]. */
export function endsOfLine(table: Table): number[] {
  const places = placesOf(table), time = table.column('time')!;
  return Array.from({ length: places > 0 ? time.length / places : 0 }, (_, k) => time[k * places]);
}

class Line {
  readonly cells: Cell[];
  private readonly updates: (() => void)[] = [];
  private readonly places: number;
  private readonly ends: number[];
  private readonly along: number[];

  constructor(private readonly name: string, private readonly table: Table, private readonly timeline: Timeline,
    private readonly sync: string) {
    this.places = placesOf(table);
    this.ends = endsOfLine(table);
    this.along = [...table.column('s')!.subarray(0, this.places)];
    this.cells = quantities.filter(({ columns }) => columns.some(([column]) => !allZero(table.column(column) ?? [])))
      .map((quantity) => this.chart(quantity));
  }

  update() { for (const update of this.updates) update(); }

  private chart({ title, unit, columns }: Quantity): Cell {
    const there = columns.filter(([column]) => this.table.column(column));
    let least = 0, greatest = 0;
    for (const [column] of there)
      for (const v of this.table.column(column)!) { if (v < least) least = v; if (v > greatest) greatest = v; }
    const curves = (): Curve[] => {
      const k = stepAt(this.ends, this.timeline.time);
      return there.map(([column, label], i) => ({ label, colour: lineColours[i],
        values: k < 0 ? this.along.map(() => null) : this.table.column(column)!.subarray(k * this.places, (k + 1) * this.places) }));
    };
    const chart = new Chart({ title, xLabel: 's [m]', unit, group: `probe ${this.name}`, sync: `line ${this.name}${this.sync}`, least, greatest },
      this.along, curves());
    this.updates.push(() => chart.update(curves()));
    return { title, box: chart.box };
  }
}

/** The lines of a run; they follow the moment. */
export function probeLines(result: Result, timeline: Timeline, sync: string): Group[] {
  const lines = result.lines.map(({ name, table }) => ({ name, line: new Line(name, table, timeline, sync) }));
  timeline.onChange(() => { for (const { line } of lines) line.update(); });
  return lines.map(({ name, line }) => ({ key: name, heading: element('h3', {}, name), cells: line.cells }));
}
