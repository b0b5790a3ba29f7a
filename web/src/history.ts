// Over time: energies, powers, iterations, the state of the contact, charges, extremes.
import { Chart, Curve } from './chart';
import { lineColours } from './colours';
import { Result, Table } from './results';
import { Timeline } from './timeline';

interface Group { title: string; unit: string; columns: [name: string, label: string][]; bars?: boolean }

function groups(history: Table): Group[] {
  const named = (prefix: string) => history.names.filter((n) => n.startsWith(prefix) && !n.endsWith('_imbalance'))
    .map((n): [string, string] => [n, n.slice(prefix.length)]);
  const electrodes = (quantity: string) => history.names.filter((n) => n.startsWith('electrode_') && n.endsWith(quantity))
    .map((n): [string, string] => [n, n.slice('electrode_'.length, -quantity.length - 1)]);
  return [
    { title: 'Voltage of electrodes', unit: 'V', columns: electrodes('voltage') },
    { title: 'Charge on electrodes', unit: 'C', columns: electrodes('charge') },
    { title: 'Current into electrodes', unit: 'A', columns: electrodes('current') },
    { title: 'Energies', unit: 'J', columns: [['elastic_energy', 'elastic'], ['electric_energy', 'electric'],
      ['thermal_energy', 'thermal'], ['coupling_energy', 'coupling']] },
    { title: 'Friction dissipation and power of the loads', unit: 'W',
      columns: [['friction_dissipation', 'friction'], ['load_power', 'loads']] },
    { title: 'Power and losses', unit: 'W', columns: [['stored_energy_rate', 'stored'], ['thermal_power', 'thermal'],
      ['conduction_loss', 'conduction'], ['time_step_loss', 'time step']] },
    { title: 'Newton iterations', unit: '', columns: [['newton_iterations', 'iterations']], bars: true },
    { title: 'Contact nodes', unit: '', columns: [['stick', 'stick'], ['slip', 'slip'], ['open', 'open']] },
    { title: 'Charge', unit: 'C', columns: named('charge_') },
    { title: 'Heat out of the body', unit: 'W', columns: named('heat_').filter(([n]) => n !== 'heat_source') },
    { title: 'Largest displacement', unit: 'm', columns: [['max_displacement', '|u|']] },
    { title: 'Potential, lowest and highest', unit: 'V', columns: [['min_potential', 'lowest'], ['max_potential', 'highest']] },
    { title: 'Temperature, lowest and highest', unit: 'K',
      columns: [['min_temperature', 'lowest'], ['max_temperature', 'highest']] },
  ];
}

export class History {
  readonly charts: HTMLElement[] = [];
  constructor(result: Result, timeline: Timeline, sync: string) {
    const history = result.history!;
    const time = [...(history.column('time') ?? [])];
    for (const group of groups(history)) {
      const curves = group.columns.flatMap(([name, label], i): Curve[] => {
        const values = history.column(name);
        if (!values || (group.columns.length > 1 && values.every((v) => v === 0))) return [];
        return [{ label, values, colour: lineColours[i % lineColours.length], bars: group.bars,
          points: values.length < 12 && !group.bars }];
      });
      if (curves.length === 0) continue;
      const chart = new Chart({ title: group.title, xLabel: 't [s]', unit: group.unit, sync: 'time' + sync,
        least: 0, mark: () => timeline.time }, time, curves);
      this.charts.push(chart.box);
    }
  }
}
