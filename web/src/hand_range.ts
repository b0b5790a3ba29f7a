// Limits of the colours that are typed, for each field and component its own.
import { Range } from './colours';
import { element } from './dom';
import { Extremes } from './shown_range';

export class HandRange {
  readonly box: HTMLElement;
  private readonly inputs: HTMLInputElement[];
  private readonly limits = new Map<string, [number, number]>();
  private key = '';

  constructor(changed: () => void) {
    this.inputs = ['least', 'greatest'].map((label, i) => {
      const input = element('input', { type: 'number', step: 'any', 'aria-label': label, onchange: () => {
        const known = this.limits.get(this.key);
        if (known && input.value !== '' && Number.isFinite(Number(input.value))) known[i] = Number(input.value);
        this.say();
        changed();
      } });
      return input;
    });
    this.box = element('span', { class: 'hand', hidden: true }, this.inputs[0], '…', this.inputs[1]);
  }

  /** Limits of another field: those that were typed for it, else `suggested`. */
  use(key: string, suggested: () => Range) {
    this.key = key;
    if (!this.limits.has(key)) {
      const { low, high } = suggested();
      this.limits.set(key, [low, high].map((v) => Number(v.toPrecision(4))) as [number, number]);
    }
    this.say();
  }

  /** The typed limits in order, whichever was typed first; `all`: the values that there are. */
  range(all: Extremes): Range {
    const [one, other] = this.limits.get(this.key) ?? [0, 1];
    const low = Math.min(one, other);
    const high = one === other ? low + (Math.abs(low) || 1) : Math.max(one, other);
    return { low, high, signed: low < 0 && high === -low, cutBelow: all.least < low, cutAbove: all.greatest > high };
  }

  private say() {
    const limits = this.limits.get(this.key);
    this.inputs.forEach((input, i) => { input.value = limits ? String(limits[i]) : ''; });
  }
}
