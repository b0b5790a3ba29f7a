// Over time: energies, powers, iterations, the state of the contact, charges, extremes.
import { Cell } from './arrangement';
import { allZero, Chart, Curve } from './chart';
import { lineColours } from './colours';
import { element } from './dom';
import { shown } from './numbers';
import { Result, Table } from './results';
import { Timeline } from './timeline';

export interface Quantity {
  title: string;
  unit: string;
  columns: [name: string, label: string][];
  bars?: boolean;
  /** sizes up to this one are round-off */
  least?: number;
}

/** A column's greatest size; 0 when it is not there. */
function greatest(history: Table, name: string): number {
  return (history.column(name) ?? new Float32Array()).reduce((most, v) => Math.max(most, Math.abs(v)), 0);
}

/**
 * What potentials, charges and temperatures have to exceed to be more than round-off. An energy that is 1e-28 of the
 * largest says so of its field (judge_round_off in src/report/result.cc); charges are measured by electric energy over
 * potential: where nothing flows through the rest of the boundary, that of an earth is 0 but for round-off.
 */
function roundOff(history: Table) {
  const energies = ['elastic_energy', 'electric_energy', 'thermal_energy'].map((n) => greatest(history, n));
  const all = Math.max(...energies);
  const below = (name: string) => history.names.includes(name) && greatest(history, name) < 1e-28 * all;
  const potential = Math.max(greatest(history, 'min_potential'), greatest(history, 'max_potential'));
  const electric = below('electric_energy') ? Infinity : 0, thermal = below('thermal_energy') ? Infinity : 0;
  return { electric, thermal, charge: electric + (potential > 0 ? (1e-11 * energies[1]) / potential : 0) };
}

function groups(history: Table, perDepth: boolean): Quantity[] {
  const per = perDepth ? '/m' : '';
  const named = (prefix: string) => history.names.filter((n) => n.startsWith(prefix) && !n.endsWith('_imbalance'))
    .map((n): [string, string] => [n, n.slice(prefix.length)]);
  const electrodes = (quantity: string) => history.names.filter((n) => n.startsWith('electrode_') && n.endsWith(quantity))
    .map((n): [string, string] => [n, n.slice('electrode_'.length, -quantity.length - 1)]);
  const least = roundOff(history);
  return [
    { title: 'Voltage of electrodes', unit: 'V', columns: electrodes('voltage'), least: least.electric },
    { title: 'Charge on electrodes', unit: 'C' + per, columns: electrodes('charge'), least: least.charge },
    { title: 'Current into electrodes', unit: 'A' + per, columns: electrodes('current'), least: least.electric },
    { title: 'Power in resistors', unit: 'W' + per, columns: [...electrodes('resistor_power'),
      ...named('foundation_resistor_power').map(([n, name]): [string, string] => [n, `foundation${name.replace('_', ' ')}`])],
      least: least.electric },
    { title: 'Energies', unit: 'J' + per, columns: [['elastic_energy', 'elastic'], ['electric_energy', 'electric'],
      ['thermal_energy', 'thermal'], ['coupling_energy', 'coupling'], ['contact_energy', 'contact'],
      ['kinetic_energy', 'kinetic']] },
    { title: 'Friction dissipation and power of the loads', unit: 'W' + per,
      columns: [['friction_dissipation', 'friction'], ['load_power', 'loads'], ['foundation_power', 'foundation'],
        ['contact_dissipation', 'damped contact']] },
    { title: 'Heat of friction', unit: 'W' + per, columns: history.names.includes('friction_heat_body')
      ? [['friction_dissipation', 'made'], ['friction_heat_body', 'into the body'],
        ['friction_heat_foundation', 'into the foundation']] : [] },
    { title: 'Power and losses', unit: 'W' + per, columns: [['stored_energy_rate', 'stored'], ['thermal_power', 'thermal'],
      ['electric_power', 'electric'], ['conduction_loss', 'conduction'], ['viscous_dissipation', 'damping'], ['kinetic_energy_rate', 'kinetic'],
      ['time_step_loss', 'time step']] },
    { title: 'Newton iterations', unit: '', columns: [['newton_iterations', 'iterations']], bars: true },
    { title: 'Contact nodes', unit: '', columns: [['stick', 'stick'], ['slip', 'slip'], ['open', 'open']] },
    ...named('stick_').map(([, name]): Quantity => ({ title: `Contact nodes of ${name}`, unit: '',
      columns: [[`stick_${name}`, 'stick'], [`slip_${name}`, 'slip'], [`open_${name}`, 'open']] })),
    { title: 'Charge', unit: 'C' + per, columns: named('charge_'), least: least.charge },
    { title: 'Heat out of the body', unit: 'W' + per, columns: named('heat_').filter(([n]) => n !== 'heat_source'),
      least: least.thermal },
    { title: 'Largest displacement', unit: 'm', columns: [['max_displacement', '|u|']] },
    { title: 'Potential, lowest and highest', unit: 'V', columns: [['min_potential', 'lowest'], ['max_potential', 'highest']],
      least: least.electric },
    { title: 'Temperature, lowest and highest', unit: 'K',
      columns: [['min_temperature', 'lowest'], ['max_temperature', 'highest']], least: least.thermal },
  ];
}

/** Up to so many steps are a table: a curve through them would be hardly more than a mark. */
const mostStepsInTable = 3;

/** Curves of a table that has a row for each step. */
export class Curves {
  readonly cells: Cell[];

  /** `group`: of charts that share their axes with those of another run */
  constructor(history: Table, all: Quantity[], private readonly timeline: Timeline, private readonly sync: string,
    private readonly group: string) {
    const time = [...(history.column('time') ?? [])];
    const parts = all.map((group) => ({ group, curves: curvesOf(group, history) })).filter(({ curves }) => curves.length > 0);
    const silent = all.filter((g) => g.columns.some(([n]) => isRoundOff(g, history, n)) && !parts.some((p) => p.group === g));
    const notes = silent.length > 0 && element('p', { class: 'note' }, `Below round-off: ${silent.map((g) => g.title).join(', ')}.`);
    const isTable = time.length <= mostStepsInTable;
    this.cells = isTable ? [{ title: '', box: element('div', {}, tableOf(parts, time), notes) }]
      : [...parts.map(({ group, curves }) => ({ title: group.title, box: this.chart(group, curves, time) })),
        ...(notes ? [{ title: '', box: notes }] : [])];
  }

  private chart(group: Quantity, curves: Curve[], time: number[]): HTMLElement {
    return new Chart({ title: group.title, xLabel: 't [s]', unit: group.unit, group: this.group, sync: 'time' + this.sync,
      least: 0, mark: () => this.timeline.time }, time, curves).box;
  }
}

export class History extends Curves {
  constructor(result: Result, timeline: Timeline, sync: string) {
    const history = result.history!;
    super(history, groups(history, result.perDepth)
      .filter((g) => !g.bars || !!result.contact?.rows || !g.columns.every(([n]) => greatest(history, n) === 0)),
      timeline, sync, 'history');
  }
}

function isRoundOff(group: Quantity, history: Table, name: string): boolean {
  const size = greatest(history, name);
  return size > 0 && size <= (group.least ?? 0);
}

function curvesOf(group: Quantity, history: Table): Curve[] {
  return group.columns.flatMap(([name, label], i): Curve[] => {
    const values = history.column(name);
    if (!values || (group.columns.length > 1 && allZero(values)) || isRoundOff(group, history, name)) return [];
    return [{ label, values, colour: lineColours[i % lineColours.length], bars: group.bars,
      points: values.length < 12 && !group.bars }];
  });
}

/** A row for each quantity, a column for each step. */
function tableOf(parts: { group: Quantity; curves: Curve[] }[], time: number[]): HTMLElement {
  const head = element('tr', {}, element('th', { scope: 'col' }, 't'),
    ...time.map((t) => element('th', { scope: 'col' }, `${shown(t, 4)} s`)));
  const rows = parts.flatMap(({ group, curves }) => curves.map((curve) => element('tr', {},
    element('th', { scope: 'row' }, curves.length > 1 || group.columns.length > 1 ? `${group.title}: ${curve.label}` : group.title),
    ...time.map((_, i) => element('td', { 'data-value': curve.values[i] ?? '' },
      `${shown(curve.values[i] ?? NaN, 5)}${group.unit ? ' ' + group.unit : ''}`)))));
  return element('div', { class: 'facts steps' }, element('table', {}, element('thead', {}, head), element('tbody', {}, ...rows)));
}
