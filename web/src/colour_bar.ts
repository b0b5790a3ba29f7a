// A colour bar with unit and the values at its ends and in the middle.
import { mapPicture, Range } from './colours';
import { beginsAbove, valueAtLevel } from './colour_scale';
import { element } from './dom';
import { shown, thousands, unitWith } from './numbers';

export class ColourBar {
  readonly box: HTMLElement;
  // A picture, as backgrounds are not printed.
  private readonly strip = element('img', { class: 'strip', alt: '', hidden: true });
  private readonly ticks = element('div', { class: 'ticks' });

  /** `small`: only the ends, the unit between them. */
  constructor(private readonly small = false) { this.box = element('div', { class: 'colourbar' }, this.strip, this.ticks); }

  /** What stands below the bar, for a picture that is saved. */
  get texts(): string[] { return [...this.ticks.children].filter((e) => !e.classList.contains('unit')).map((e) => e.textContent ?? ''); }
  get unit(): string { return this.ticks.querySelector('.unit')?.textContent ?? ''; }

  show(range: Range, unitOfField: string, bands = 0) {
    this.strip.hidden = !!range.instead;
    if (range.instead) {
      this.ticks.replaceChildren(element('span', { class: 'instead' }, range.instead));
      return;
    }
    const power = thousands(Math.max(Math.abs(range.low), Math.abs(range.high)));
    this.strip.src = mapPicture(range.signed, bands);
    // To three digits of the greatest, beside 1.24 the end of a bar is 0, not 9.6e-5; or of what is between the ends.
    const greatest = Math.max(Math.abs(range.low), Math.abs(range.high));
    const step = 10 ** (Math.floor(Math.log10(Math.min(greatest, range.high - range.low))) - 2);
    const digits = Math.max(3, Math.floor(Math.log10(greatest / step) + 1e-9) + 1);
    const mark = (at: number) => (range.cutAbove && at === 1 ? '≥ ' : (range.cutBelow || beginsAbove(range)) && at === 0 ? '≤ ' : '');
    const tick = (at: number) => element('span', {}, mark(at) + (range.logarithmic ? shown(valueAtLevel(range, at) / 10 ** power, 3)
      : shown((Math.round(valueAtLevel(range, at) / step) * step) / 10 ** power, digits)));
    const unit = element('span', { class: 'unit' }, unitWith(power, unitOfField));
    this.ticks.replaceChildren(...(this.small ? [tick(0), unit, tick(1)]
      : [...[0, 0.25, 0.5, 0.75, 1].map(tick), unit]));
  }
}
