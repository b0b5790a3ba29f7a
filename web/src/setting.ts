// The physical setting: boundaries coloured by their conditions, with a legend.
import { Result } from './results';
import { furtherColours, palette } from './colours';
import { element } from './dom';

export interface Group { colour: string; names: string[]; conditions: string[] }

/** Boundaries with the same conditions share a colour; across results too. */
export function groupsOf(results: Result[]): Group[] {
  const groups = new Map<string, Group>();
  const used = new Set<string>();
  const further = [...furtherColours];
  for (const result of results)
    for (const boundary of result.boundaries) {
      const key = boundary.kind + boundary.conditions.join('|');
      const known = groups.get(key);
      if (known) {
        if (!known.names.includes(boundary.name)) known.names.push(boundary.name);
        continue;
      }
      let colour = boundary.kind === 'free' && boundary.conditions.length > 0
        ? furtherColours[0] : palette[boundary.kind as keyof typeof palette];
      while (used.has(colour) && further.length > 0) colour = further.shift()!;
      used.add(colour);
      groups.set(key, { colour, names: [boundary.name], conditions: boundary.conditions });
    }
  return [...groups.values()];
}

export function coloursOf(result: Result, groups: Group[]): Map<string, string> {
  const colours = new Map<string, string>();
  for (const boundary of result.boundaries) {
    const group = groups.find((g) => g.names.includes(boundary.name) &&
      g.conditions.join('|') === boundary.conditions.join('|'));
    colours.set(boundary.name, group?.colour ?? palette.free);
  }
  return colours;
}

export function legend(result: Result, groups: Group[]): HTMLElement {
  const own = groups.filter((g) => result.boundaries.some((b) =>
    g.names.includes(b.name) && g.conditions.join('|') === b.conditions.join('|')));
  return element('ul', { class: 'legend' }, ...own.map((g) => element('li', {},
    element('span', { class: 'swatch', style: `background:${g.colour}` }),
    element('span', {}, element('b', {}, g.names.join(', ')), ' ',
      g.conditions.join('; ') || 'no condition'))));
}
