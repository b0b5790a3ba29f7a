// Over time: energies, powers, iterations, the state of the contact, charges, extremes.
import { allZero, Chart, Curve } from './chart';
import { lineColours } from './colours';
import { element } from './dom';
import { shown } from './numbers';
import { Result, Table } from './results';
import { Timeline } from './timeline';

interface Group { title: string; unit: string; columns: [name: string, label: string][]; bars?: boolean }

/** Of a plane body everything holds for a metre of its depth. */
function groups(history: Table, dimension: 2 | 3): Group[] {
  const per = dimension === 2 ? '/m' : '';
  const named = (prefix: string) => history.names.filter((n) => n.startsWith(prefix) && !n.endsWith('_imbalance'))
    .map((n): [string, string] => [n, n.slice(prefix.length)]);
  const electrodes = (quantity: string) => history.names.filter((n) => n.startsWith('electrode_') && n.endsWith(quantity))
    .map((n): [string, string] => [n, n.slice('electrode_'.length, -quantity.length - 1)]);
  return [
    { title: 'Voltage of electrodes', unit: 'V', columns: electrodes('voltage') },
    { title: 'Charge on electrodes', unit: 'C' + per, columns: electrodes('charge') },
    { title: 'Current into electrodes', unit: 'A' + per, columns: electrodes('current') },
    { title: 'Energies', unit: 'J' + per, columns: [['elastic_energy', 'elastic'], ['electric_energy', 'electric'],
      ['thermal_energy', 'thermal'], ['coupling_energy', 'coupling']] },
    { title: 'Friction dissipation and power of the loads', unit: 'W' + per,
      columns: [['friction_dissipation', 'friction'], ['load_power', 'loads']] },
    { title: 'Power and losses', unit: 'W' + per, columns: [['stored_energy_rate', 'stored'], ['thermal_power', 'thermal'],
      ['conduction_loss', 'conduction'], ['time_step_loss', 'time step']] },
    { title: 'Newton iterations', unit: '', columns: [['newton_iterations', 'iterations']], bars: true },
    { title: 'Contact nodes', unit: '', columns: [['stick', 'stick'], ['slip', 'slip'], ['open', 'open']] },
    { title: 'Charge', unit: 'C' + per, columns: named('charge_') },
    { title: 'Heat out of the body', unit: 'W' + per, columns: named('heat_').filter(([n]) => n !== 'heat_source') },
    { title: 'Largest displacement', unit: 'm', columns: [['max_displacement', '|u|']] },
    { title: 'Potential, lowest and highest', unit: 'V', columns: [['min_potential', 'lowest'], ['max_potential', 'highest']] },
    { title: 'Temperature, lowest and highest', unit: 'K',
      columns: [['min_temperature', 'lowest'], ['max_temperature', 'highest']] },
  ];
}

/** Up to so many steps are a table: a curve through them would be hardly more than a mark. */
const mostStepsInTable = 3;

export class History {
  readonly content: HTMLElement;

  constructor(result: Result, private readonly timeline: Timeline, private readonly sync: string) {
    const history = result.history!;
    const time = [...(history.column('time') ?? [])];
    const parts = groups(history, result.dimension).map((group) => ({ group, curves: curvesOf(group, history) }))
      .filter(({ curves }) => curves.length > 0);
    this.content = time.length <= mostStepsInTable ? tableOf(parts, time)
      : element('div', { class: 'charts' }, ...parts.map(({ group, curves }) => this.chart(group, curves, time)));
  }

  private chart(group: Group, curves: Curve[], time: number[]): HTMLElement {
    return new Chart({ title: group.title, xLabel: 't [s]', unit: group.unit, sync: 'time' + this.sync,
      least: 0, mark: () => this.timeline.time }, time, curves).box;
  }
}

function curvesOf(group: Group, history: Table): Curve[] {
  return group.columns.flatMap(([name, label], i): Curve[] => {
    const values = history.column(name);
    if (!values || (group.columns.length > 1 && allZero(values))) return [];
    return [{ label, values, colour: lineColours[i % lineColours.length], bars: group.bars,
      points: values.length < 12 && !group.bars }];
  });
}

/** A row for each quantity, a column for each step. */
function tableOf(parts: { group: Group; curves: Curve[] }[], time: number[]): HTMLElement {
  const head = element('tr', {}, element('th', { scope: 'col' }, 't'),
    ...time.map((t) => element('th', { scope: 'col' }, `${shown(t, 4)} s`)));
  const rows = parts.flatMap(({ group, curves }) => curves.map((curve) => element('tr', {},
    element('th', { scope: 'row' }, curves.length > 1 || group.columns.length > 1 ? `${group.title}: ${curve.label}` : group.title),
    ...time.map((_, i) => element('td', { 'data-value': curve.values[i] ?? '' },
      `${shown(curve.values[i] ?? NaN, 5)}${group.unit ? ' ' + group.unit : ''}`)))));
  return element('div', { class: 'facts steps' }, element('table', {}, element('thead', {}, head), element('tbody', {}, ...rows)));
}
