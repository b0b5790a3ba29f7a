// What the case's probes told over time: the fields at places, what goes through boundaries.
import { element } from './dom';
import { Curves, Group } from './history';
import { Result, Table } from './results';
import { Timeline } from './timeline';

/** Of a plane body forces, charges and heats hold for a metre of its depth. */
function groups(table: Table, dimension: 2 | 3): Group[] {
  const per = dimension === 2 ? '/m' : '';
  const components = (prefix: string) => ['x', 'y', 'z'].filter((axis) => table.names.includes(prefix + axis))
    .map((axis): [string, string] => [prefix + axis, axis]);
  return [
    { title: 'Force on the body', unit: 'N' + per, columns: components('force_') },
    { title: 'Moment of the force', unit: 'N m' + per, columns: components('moment_') },
    { title: 'Charge, the integral of D·ν', unit: 'C' + per, columns: [['charge', 'charge']] },
    { title: 'Heat out of the body', unit: 'W' + per, columns: [['heat', 'heat']] },
    { title: 'Displacement', unit: 'm', columns: components('u_') },
    { title: 'Potential', unit: 'V', columns: [['potential', 'potential']] },
    { title: 'Temperature', unit: 'K', columns: [['temperature', 'temperature']] },
  ];
}

export function probes(result: Result, timeline: Timeline, sync: string): HTMLElement {
  return element('div', {}, ...result.probes.map(({ name, table }) => element('div', {}, element('h3', {}, name),
    new Curves(table, groups(table, result.dimension), timeline, sync).content)));
}
