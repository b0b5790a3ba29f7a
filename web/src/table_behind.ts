// The numbers of a picture as a table, for those who cannot see it or want them exactly.
import { element } from './dom';
import { shown } from './numbers';

export interface Column { name: string; unit: string; values: ArrayLike<number | string | null> }

/** More rows are in the files. */
const mostRows = 2000;

function cell(value: number | string | null | undefined): HTMLElement {
  if (typeof value !== 'number') return element('td', {}, value ?? '–');
  return element('td', { 'data-value': value }, shown(value, 6));
}

export class TableBehind {
  readonly box: HTMLDetailsElement;
  private readonly place = element('div', { class: 'facts' });
  private readonly summary = element('summary', {}, 'table');
  private stale = true;

  /** `columns` are asked for only while the table is open. */
  constructor(private readonly title: () => string, private readonly columns: () => Column[]) {
    this.summary.setAttribute('aria-label', `table of ${title()}`);
    this.box = element('details', { class: 'behind' }, this.summary, this.place);
    this.box.addEventListener('toggle', () => this.fill());
  }

  /** Other values. */
  refresh() {
    this.stale = true;
    this.summary.setAttribute('aria-label', `table of ${this.title()}`);
    this.fill();
  }

  private fill() {
    if (!this.box.open || !this.stale) return;
    this.stale = false;
    const columns = this.columns();
    const rows = Math.max(0, ...columns.map(({ values }) => values.length));
    const head = element('tr', {}, ...columns.map(({ name, unit }) =>
      element('th', { scope: 'col' }, name + (unit && !name.includes('[') ? ` [${unit}]` : ''))));
    const lines = Array.from({ length: Math.min(rows, mostRows) }, (_, i) =>
      element('tr', {}, ...columns.map(({ values }) => cell(values[i]))));
    this.place.replaceChildren(element('table', {}, element('caption', {}, this.title()), element('thead', {}, head),
      element('tbody', {}, ...lines)),
    ...(rows > mostRows ? [element('p', { class: 'note' }, `The first ${mostRows} of ${rows} rows; the files have all.`)] : []));
  }
}
