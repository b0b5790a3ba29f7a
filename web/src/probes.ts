// What the case's probes told: the fields at places over time.
import { element } from './dom';
import { Curves, Group } from './history';
import { Result, Table } from './results';
import { Timeline } from './timeline';

function groups(table: Table): Group[] {
  const components = (prefix: string) => ['x', 'y', 'z'].filter((axis) => table.names.includes(prefix + axis))
    .map((axis): [string, string] => [prefix + axis, axis]);
  return [
    { title: 'Displacement', unit: 'm', columns: components('u_') },
    { title: 'Potential', unit: 'V', columns: [['potential', 'potential']] },
    { title: 'Temperature', unit: 'K', columns: [['temperature', 'temperature']] },
  ];
}

export function probes(result: Result, timeline: Timeline, sync: string): HTMLElement {
  return element('div', {}, ...result.probes.map(({ name, table }) => element('div', {}, element('h3', {}, name),
    new Curves(table, groups(table), timeline, sync).content)));
}
