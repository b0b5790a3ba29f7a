// Curves of two runs in one chart instead of two side by side.
import { changed, keepControl } from './address';
import { Chart, chartOf, Curve } from './chart';
import { element, tick } from './dom';

/** Values at all abscissas of both, none where a curve has no point of its own. */
function onto(x: number[], own: number[], curve: Curve, label: string, dashed: boolean): Curve {
  const at = new Map(own.map((v, i) => [v, i]));
  return { ...curve, label: `${curve.label}, ${label}`, dashed, joined: true,
    values: x.map((v) => (at.has(v) ? curve.values[at.get(v)!] : null)) };
}

function merged(charts: [Chart, Chart], titles: string[]): { x: number[]; curves: Curve[] } {
  const x = [...new Set(charts.flatMap((c) => c.abscissas))].sort((a, b) => a - b);
  return { x, curves: charts.flatMap((chart, i) => chart.shown.map((curve) => onto(x, chart.abscissas, curve, titles[i], i === 1))) };
}

function oneOf(charts: [Chart, Chart], titles: string[]): Chart {
  const [first, second] = charts.map((c) => c.described);
  const least = (of: 'least' | 'greatest', end: (...v: number[]) => number) =>
    first[of] === undefined || second[of] === undefined ? first[of] : end(first[of]!, second[of]!);
  const { x, curves } = merged(charts, titles);
  const chart = new Chart({ ...first, least: least('least', Math.min), greatest: least('greatest', Math.max) }, x, curves);
  for (const one of charts) one.onUpdate(() => {
    const now = merged(charts, titles);
    chart.become({}, now.x, now.curves);
  });
  return chart;
}

/** A box to tick above a section that has rows with the charts of two runs; undefined where they share none. */
export function bothInOne(section: HTMLElement, titles: string[]): HTMLElement | undefined {
  const rows = [...section.querySelectorAll<HTMLElement>('.row')].flatMap((row): { row: HTMLElement; pair: [Chart, Chart] }[] => {
    const charts = [...row.querySelectorAll('figure.chart')].flatMap((figure) => chartOf(figure) ?? []);
    return charts.length === 2 ? [{ row, pair: [charts[0], charts[1]] }] : [];
  });
  if (rows.length === 0) return undefined;
  const box = tick('both runs in one chart', false, (on) => {
    for (const { row, pair } of rows) {
      let together = row.querySelector<HTMLElement>(':scope > .together');
      if (on && !together) row.append(together = element('div', { class: 'together' }, oneOf(pair, titles).box));
      for (const cell of [...row.children] as HTMLElement[]) cell.hidden = (cell === together) !== on;
    }
    changed();
  });
  section.querySelector('h2')!.after(box);
  keepControl(`both-${section.id}`, box.querySelector('input')!);
  return box;
}
