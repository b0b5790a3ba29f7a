// Charts of one run in as many columns as there is room for; of two runs in rows, so that a chart stands beside its
// counterpart whatever else the one or the other run has.
import { element } from './dom';
import { Result } from './results';

export interface Cell {
  /** counterparts have the same title */
  title: string;
  box: HTMLElement;
}

/** Cells under a heading; counterparts have the same key. */
export interface Group {
  key: string;
  heading?: HTMLElement;
  /** for one piece of the contact: its name */
  piece?: string;
  cells: Cell[];
  /** a class for the group's box */
  kind?: string;
}

/** Keys of both in the order of the first, those that only the second has behind what stands before them there. */
function merged(one: string[], other: string[]): string[] {
  const all = [...one];
  other.forEach((key, i) => {
    if (all.includes(key)) return;
    const before = other.slice(0, i).reverse().find((k) => all.includes(k));
    all.splice(before === undefined ? 0 : all.indexOf(before) + 1, 0, key);
  });
  return all;
}

const missing = (title: string): HTMLElement =>
  element('figure', { class: 'chart missing' }, element('figcaption', {}, title), element('p', { class: 'note' }, 'not in this run'));

const isBare = (cell: Cell) => cell.title === '';

function alone(group: Group): HTMLElement {
  return element('div', { class: `piece ${group.kind ?? ''}`, ...(group.piece !== undefined && { 'data-piece': group.piece }) },
    group.heading, ...group.cells.filter(isBare).map((cell) => cell.box),
    element('div', { class: 'charts' }, ...group.cells.filter((cell) => !isBare(cell)).map((cell) => cell.box)));
}

function inRows(groups: (Group | undefined)[], names: string[]): HTMLElement {
  const row = (boxes: (HTMLElement | undefined)[]) => element('div', { class: `beside beside-${boxes.length} row` },
    ...boxes.map((box, i) => element('div', {}, element('p', { class: 'narrow whose' }, names[i]), box)));
  const titles = groups.map((group) => group?.cells.map((cell) => cell.title) ?? []);
  const cells = merged(titles[0], titles[1]).map((title) => row(groups.map((group) =>
    group?.cells.find((cell) => cell.title === title)?.box ?? (title === '' ? undefined : missing(title)))));
  const known = groups.find((group) => group)!;
  return element('div', { class: `piece ${known.kind ?? ''}`, ...(known.piece !== undefined && { 'data-piece': known.piece }) },
    groups.some((group) => group?.heading) && row(groups.map((group) => group?.heading)), ...cells);
}

/** What each run has to show, or says instead. */
export function arranged(results: Result[], groupsOf: (result: Result) => Group[]): HTMLElement {
  const all = results.map(groupsOf);
  if (results.length === 1) return element('div', {}, ...all[0].map(alone));
  const keys = merged(all[0].map((group) => group.key), all[1].map((group) => group.key));
  return element('div', {},
    element('div', { class: 'beside beside-2' }, ...results.map((result) => element('h3', { class: 'whose' }, result.title))),
    ...keys.map((key) => inRows(all.map((groups) => groups.find((group) => group.key === key)), results.map((r) => r.name))));
}
