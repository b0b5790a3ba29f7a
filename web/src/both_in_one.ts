// Curves of two runs in one chart instead of two side by side.
import { changed, keepControl } from './address';
import { Chart, chartOf, Curve } from './chart';
import { element, tick } from './dom';

/** Headings above a chart and its title: what makes two charts those of the same thing. */
function keyOf(figure: Element, column: Element): string {
  const words = [figure.querySelector('figcaption')?.textContent ?? ''];
  for (let at = figure.parentElement; at && at !== column.parentElement; at = at.parentElement)
    words.push(...[...at.querySelectorAll(':scope > h3:not(.whose), :scope > h4')].map((h) => h.textContent ?? ''));
  return words.join('\n');
}

function chartsIn(column: Element): Map<string, Chart> {
  return new Map([...column.querySelectorAll('figure.chart')].flatMap((figure): [string, Chart][] => {
    const chart = chartOf(figure);
    return chart ? [[keyOf(figure, column), chart]] : [];
  }));
}

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

/** A box to tick above a section whose `.beside` holds the charts of two runs; undefined where they share none. */
export function bothInOne(section: HTMLElement, titles: string[]): HTMLElement | undefined {
  const beside = section.querySelector<HTMLElement>(':scope > .beside');
  if (!beside || beside.children.length !== 2) return undefined;
  const [one, other] = [...beside.children].map(chartsIn);
  const pairs = [...one].flatMap(([key, chart]): [Chart, Chart][] => (other.has(key) ? [[chart, other.get(key)!]] : []));
  if (pairs.length === 0) return undefined;
  const together = element('div', { class: 'charts together', hidden: true });
  const box = tick('both runs in one chart', false, (on) => {
    if (on && together.children.length === 0) together.append(...pairs.map((pair) => oneOf(pair, titles).box));
    together.hidden = !on;
    for (const chart of pairs.flat()) chart.box.hidden = on;
    changed();
  });
  beside.before(box, together);
  keepControl(`both-${section.id}`, box.querySelector('input')!);
  return box;
}
