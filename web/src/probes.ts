// What the case's probes told over time: the fields at places, what goes through boundaries, what regions hold.
import { Group } from './arrangement';
import { allZero } from './chart';
import { element } from './dom';
import { Curves, Quantity } from './history';
import { Result, Table } from './results';
import { Timeline } from './timeline';

/** Of a plane body forces, charges, heats and energies hold for a metre of its depth. */
function groups(table: Table, perDepth: boolean): Quantity[] {
  const per = perDepth ? '/m' : '';
  const components = (prefix: string) => ['x', 'y', 'z'].filter((axis) => table.names.includes(prefix + axis))
    .map((axis): [string, string] => [prefix + axis, axis]);
  const range = (field: string) => [['mean_', 'mean'], ['min_', 'lowest'], ['max_', 'highest']]
    .map(([prefix, label]): [string, string] => [prefix + field, label]);
  const all: Quantity[] = [
    { title: 'Force on the body', unit: 'N' + per, columns: components('force_') },
    { title: 'Moment of the force', unit: 'N m' + per, columns: components('moment_') },
    { title: 'Charge, the integral of D·ν', unit: 'C' + per, columns: [['charge', 'charge']] },
    { title: 'Heat out of the body', unit: 'W' + per, columns: [['heat', 'heat']] },
    { title: 'Stored energy', unit: 'J' + per, columns: ['elastic', 'electric', 'thermal', 'coupling']
      .map((kind): [string, string] => [kind + '_energy', kind]) },
    { title: 'Displacement, mean', unit: 'm', columns: components('mean_u_') },
    { title: 'Potential, mean and extremes', unit: 'V', columns: range('potential') },
    { title: 'Temperature, mean and extremes', unit: 'K', columns: range('temperature') },
    { title: 'Displacement', unit: 'm', columns: components('u_') },
    { title: 'Potential', unit: 'V', columns: [['potential', 'potential']] },
    { title: 'Temperature', unit: 'K', columns: [['temperature', 'temperature']] },
  ];
  // Most boundaries let no charge or heat through at all.
  return all.filter(({ columns }) => !columns.every(([name]) =>
    ['charge', 'heat'].includes(name) && allZero(table.column(name) ?? [])));
}

export function probes(result: Result, timeline: Timeline, sync: string): Group[] {
  return result.probes.map(({ name, table }) => ({ key: name, heading: element('h3', {}, name),
    cells: new Curves(table, groups(table, result.perDepth), timeline, sync, `probe ${name}`).cells }));
}
