// Light and dark: the reader's system decides until the button is used.
import { drawEverything } from './on_screen';
import { changed, keep } from './address';

type Listener = () => void;
const listeners: Listener[] = [];
const system = matchMedia('(prefers-color-scheme: dark)');
const printer = matchMedia('print');
let chosen: 'light' | 'dark' | undefined;
let isPrinted = false;

/** Paper is light. */
export const isDark = () => !isPrinted && !printer.matches && (chosen ?? (system.matches ? 'dark' : 'light')) === 'dark';

/** The value of a colour variable of style.css. */
export const colour = (name: string) =>
  getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export function onTheme(listener: Listener) { listeners.push(listener); }

function apply() {
  document.documentElement.dataset.theme = isDark() ? 'dark' : 'light';
  for (const listener of listeners) listener();
}

export function toggleTheme() {
  chosen = isDark() ? 'light' : 'dark';
  apply();
  changed();
}

function print() {
  apply();
  if (isPrinted || printer.matches) drawEverything();
}

export function startTheme() {
  system.addEventListener('change', apply);
  keep('theme', () => chosen, (text) => { chosen = text === 'dark' ? 'dark' : 'light'; apply(); });
  printer.addEventListener('change', print);
  addEventListener('beforeprint', () => { isPrinted = true; print(); });
  addEventListener('afterprint', () => { isPrinted = false; print(); });
  apply();
}
