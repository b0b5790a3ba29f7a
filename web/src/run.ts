// The run itself: what was asked, how large it was, where the time went, what it warns of.
import { element } from './dom';
import { seconds, shown } from './numbers';
import { Result } from './results';

type Row = [string, string];

function table(title: string, rows: Row[]): HTMLElement {
  return element('section', { class: 'facts' }, element('h3', {}, title), element('table', {}, element('tbody', {},
    ...rows.map(([name, value]) => element('tr', {}, element('th', { scope: 'row' }, name), element('td', {}, value))))));
}

const words = (name: string) => name.replace(/_/g, ' ');

function sizes(summary: any): Row[] {
  const rows = Object.entries({ ...summary.sizes, ...summary.iterations }).map(([name, value]): Row =>
    [words(name), Number(value) >= 1e7 ? shown(Number(value), 3) : Number(value).toLocaleString('en').replace(/,/g, ' ')]);
  if (summary.memory) rows.push(['largest memory', `${shown(summary.memory / 1e6, 3)} MB`]);
  if (typeof summary.backward_error === 'number') rows.push(['backward error', shown(summary.backward_error, 2)]);
  return rows;
}

function balances(result: Result): Row[] {
  const history = result.history;
  return (history?.names ?? []).filter((n) => n.endsWith('_imbalance')).map((name): Row => {
    const worst = history!.column(name)!.reduce((w, v) => Math.max(w, Math.abs(v)), 0);
    return [`${name.slice(0, -'_imbalance'.length)}, worst step`, shown(worst, 2)];
  });
}

// In the order in which they happen.
const stages = ['start', 'mesh', 'assemble', 'analyse', 'factorise', 'condense', 'step', 'output'];

function times(summary: any): HTMLElement {
  const parts: [string, number][] = [];
  for (const name of stages) {
    const value = summary.seconds[name];
    const time = name === 'step' ? value?.total : value;
    if (typeof time === 'number') parts.push([name === 'step' ? 'all steps' : name, time]);
  }
  const most = Math.max(...parts.map((p) => p[1]), 1e-9);
  return element('section', { class: 'facts' }, element('h3', {}, `Time: ${seconds(summary.seconds.total ?? 0)}`),
    element('table', { class: 'times' }, element('tbody', {}, ...parts.map(([name, time]) => element('tr', {},
      element('th', { scope: 'row' }, name),
      element('td', {}, element('span', { class: 'length', style: `width:${(60 * time) / most}%` }), ' ', seconds(time)))))));
}

/** What the page says first: remarks of its reader and the run's own warnings. */
export function warnings(result: Result): string[] {
  return [...result.remarks, ...(result.summary?.warnings ?? [])];
}

export function runSection(result: Result): HTMLElement {
  const { summary } = result;
  const balance = balances(result);
  return element('div', { class: 'run' },
    summary && table('Size', sizes(summary)),
    summary && times(summary),
    balance.length > 0 && table('What the balances lack (relative)', balance),
    summary && table('Versions', Object.entries(summary.versions).map(([n, v]): Row => [n, String(v)])),
    element('details', { class: 'case' }, element('summary', {}, 'The case as run'),
      element('pre', { tabindex: 0 }, result.caseText)));
}

/** One line under the title. */
export function inBrief(result: Result): string {
  const { summary } = result;
  const parts = [`${result.dimension}D`];
  if (summary) {
    parts.push(`${Number(summary.sizes.nodes).toLocaleString('en').replace(/,/g, ' ')} nodes`, `${summary.sizes.steps} ${summary.sizes.steps === 1 ? 'step' : 'steps'}`);
    if (summary.seconds?.total) parts.push(`computed in ${seconds(summary.seconds.total)}`);
    parts.push(`Tourmaline ${summary.versions.tourmaline}`);
  }
  return parts.join(' · ');
}
