// What is shown stands in the address, so that a link or a reload brings it back.

interface Part { write: () => string | undefined; read: (text: string) => void }

const parts = new Map<string, Part>();
const given = inAddress();
let timer: number | undefined;

function inAddress(): URLSearchParams {
  return new URLSearchParams(location.hash.includes('=') ? location.hash.slice(1) : '');
}

/** `write`: undefined where the page shows what it shows by itself; `read` is called at once if the address has it. */
export function keep(name: string, write: Part['write'], read: Part['read']) {
  parts.set(name, { write, read });
  const text = given.get(name);
  if (text !== null) read(text);
}

/** A browser takes no more than some addresses in a second, so the last of several is written. */
export function changed() {
  if (timer !== undefined) return;
  timer = window.setTimeout(() => { timer = undefined; write(); }, 300);
}

function write() {
  const now = new URLSearchParams();
  for (const [name, part] of parts) {
    const text = part.write();
    if (text !== undefined) now.set(name, text);
  }
  const text = now.toString();
  if (text !== inAddress().toString()) history.replaceState(null, '', text ? `#${text}` : location.pathname + location.search);
}

// What a link leaves out is as the page has it by itself. The page's own changes of the address are no such event.
addEventListener('hashchange', () => { if (location.hash.includes('=')) location.reload(); });

/** A control whose value stands in the address where it is not the one it has by itself. */
export function keepControl(name: string, control: HTMLInputElement | HTMLSelectElement, byItself?: () => string) {
  const box = control instanceof HTMLInputElement && control.type === 'checkbox' ? control : undefined;
  const get = () => (box ? String(Number(box.checked)) : control.value);
  const first = get();
  keep(name, () => (get() === (byItself?.() ?? first) || control.closest('[hidden]') ? undefined : get()), (text) => {
    if (box) box.checked = text === '1';
    else if (!(control instanceof HTMLSelectElement) || [...control.options].some((o) => o.value === text)) control.value = text;
    control.dispatchEvent(new Event('input'));
    control.dispatchEvent(new Event('change'));
  });
}

/** Numbers as they stand in an address, and back; undefined if they are not so many finite ones. */
export const numbersText = (numbers: number[], digits = 7) => numbers.map((v) => String(Number(v.toPrecision(digits)))).join(',');
export function numbersIn(text: string, count: number): number[] | undefined {
  const numbers = text.split(',').map(Number);
  return numbers.length === count && numbers.every(Number.isFinite) ? numbers : undefined;
}
