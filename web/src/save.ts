// Files for the reader: pictures, curves and their numbers.
import { element } from './dom';

/** Hands a file to the browser. */
export function save(name: string, content: Blob) {
  const url = URL.createObjectURL(content);
  const link = element('a', { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

export const saveText = (name: string, type: string, text: string) => save(name, new Blob([text], { type }));

/** A name of a file from words. */
export const fileName = (...words: string[]) =>
  words.filter((w) => w !== '').join('-').toLowerCase().replace(/[^\p{L}\p{N}.]+/gu, '-').replace(/^-|-$/g, '');

/** As many digits as single precision has. */
export const exactly = (value: number | null | undefined) =>
  (value === null || value === undefined || !Number.isFinite(value) ? '' : String(Number(value.toPrecision(9))));

const quoted = (text: string) => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);

export function csv(names: string[], columns: ArrayLike<number | null>[]): string {
  const rows = Array.from({ length: columns[0]?.length ?? 0 }, (_, i) => columns.map((c) => exactly(c[i])).join(','));
  return [names.map(quoted).join(','), ...rows].join('\n') + '\n';
}

/** Small buttons in the corner of a figure, one for each kind of file. */
export function saveButtons(what: string, kinds: [kind: string, write: () => void][]): HTMLElement {
  return element('span', { class: 'save' }, ...kinds.map(([kind, write]) =>
    element('button', { type: 'button', 'aria-label': `save ${what} as ${kind}`, 'data-kind': kind, onclick: write }, kind)));
}
