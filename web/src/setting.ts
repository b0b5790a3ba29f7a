// The physical setting: boundaries coloured by their conditions, with a legend.
import { Result } from './results';
import { furtherColours, palette } from './colours';
import { arrowMark } from './arrow';
import { element, swatch } from './dom';

export interface Group { colour: string; names: string[]; conditions: string[] }

/** Boundaries with the same conditions share a colour. The counterpart of groups_of in src/report/setting.cc. */
export function groupsOf(result: Result): Group[] {
  const groups = new Map<string, Group>();
  const used = new Set<string>();
  const further = [...furtherColours];
  const kinds = Object.keys(palette);
  const ordered = [...result.boundaries].sort((a, b) => kinds.indexOf(a.kind) - kinds.indexOf(b.kind));
  for (const boundary of ordered) {
    const key = boundary.kind + boundary.conditions.join('|');
    const known = groups.get(key);
    if (known) {
      known.names.push(boundary.name);
      continue;
    }
    let colour = boundary.kind === 'free' && boundary.conditions.length > 0
      ? further[0] : palette[boundary.kind as keyof typeof palette];
    while (used.has(colour) && further.length > 0) colour = further.shift()!;
    used.add(colour);
    groups.set(key, { colour, names: [boundary.name], conditions: boundary.conditions });
  }
  return [...groups.values()];
}

/** A facet may be in several groups; the first one, the contact, is painted last. */
export function inOrderOfPainting(result: Result, colours?: Map<string, string>) {
  const order = [...(colours?.keys() ?? [])];
  return [...result.boundaries].sort((a, b) => order.indexOf(b.name) - order.indexOf(a.name));
}

export function coloursOf(groups: Group[]): Map<string, string> {
  return new Map(groups.flatMap((g) => g.names.map((name): [string, string] => [name, g.colour])));
}

/** Boundaries, what of the body's has no name, the arrows if there are any, regions if there are several. */
export function legend(groups: Group[], result: Result): HTMLElement {
  const line = (mark: HTMLElement, name: string, said: string) =>
    element('li', {}, mark, element('span', {}, element('b', {}, name), ' ', said));
  return element('ul', { class: 'legend' },
    ...groups.map((g) => line(swatch(g.colour),
      g.names.join(', '), g.conditions.join('; ') || 'no condition')),
    result.unnamed !== '' && line(element('span', { class: 'swatch bare' }), result.unnamed, 'no condition'),
    result.poling && line(arrowMark(), 'poling', 'direction of the crystal axis 3'),
    ...result.parts.map((part) => line(element('span', { class: 'mark' }), part.name, part.material)));
}
