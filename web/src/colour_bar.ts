// A colour bar with unit and the values at its ends and in the middle.
import { mapGradient, Range } from './colours';
import { element } from './dom';
import { shown, thousands, unitWith } from './numbers';

export class ColourBar {
  readonly box: HTMLElement;
  private readonly strip = element('div', { class: 'strip' });
  private readonly ticks = element('div', { class: 'ticks' });
  private readonly unit = element('div', { class: 'unit' });

  constructor() { this.box = element('div', { class: 'colourbar' }, this.strip, this.ticks, this.unit); }

  show(range: Range, unit: string) {
    const power = thousands(Math.max(Math.abs(range.low), Math.abs(range.high)));
    this.strip.style.background = mapGradient(range.signed, 'to right');
    this.unit.textContent = unitWith(power, unit);
    this.ticks.replaceChildren(...[0, 0.5, 1].map((at) =>
      element('span', {}, shown((range.low + at * (range.high - range.low)) / 10 ** power, 3))));
  }
}
