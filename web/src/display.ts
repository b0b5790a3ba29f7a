// How a field is shown: colour map, scale, bands and lines of equal values, arrows, axes, marks.
import { changed, keepControl } from './address';
import { MapName, mapNames } from './colour_maps';
import { choice, element, tick } from './dom';

/** Bands, and pieces between lines of equal values, of a colour bar. */
export const bandCount = 10;

export class Display {
  map: MapName = 'viridis';
  logarithmic = false;
  steps: 'smooth' | 'bands' | 'lines' | 'both' = 'smooth';
  arrows = '';
  axes = true;
  marks = true;
  readonly box: HTMLElement;
  private readonly listeners: (() => void)[] = [];

  constructor(vectors: [string, string][]) {
    this.box = element('div', { class: 'toolbar further' },
      this.choose('map', 'Colour map', mapNames.map((name) => [name, name]), (v) => (this.map = v as MapName), () => this.map),
      this.choose('scale', 'Scale', [['even', 'even'], ['log', 'logarithmic']],
        (v) => (this.logarithmic = v === 'log'), () => (this.logarithmic ? 'log' : 'even')),
      this.choose('steps', 'Colours', [['smooth', 'smooth'], ['bands', 'bands'], ['lines', 'isolines'], ['both', 'bands and isolines']],
        (v) => (this.steps = v as 'smooth'), () => this.steps),
      vectors.length > 0 && this.choose('arrows', 'Arrows', [['', 'none'], ...vectors], (v) => (this.arrows = v), () => this.arrows),
      this.check('axes', 'axes', (on) => (this.axes = on), () => this.axes),
      this.check('marks', 'min and max', (on) => (this.marks = on), () => this.marks));
  }

  get bands(): number { return this.steps === 'bands' || this.steps === 'both' ? bandCount : 0; }
  /** Places on the colour bar that have lines. */
  get levels(): number[] {
    return this.steps === 'lines' || this.steps === 'both'
      ? Array.from({ length: bandCount - 1 }, (_, i) => (i + 1) / bandCount) : [];
  }

  onChange(listener: () => void) { this.listeners.push(listener); }

  private tell() {
    for (const listener of this.listeners) listener();
    changed();
  }

  private choose(id: string, label: string, options: [string, string][], set: (value: string) => void, get: () => string) {
    const { box, select } = choice(label, options, get(), (value) => { set(value); this.tell(); });
    select.id = id;
    keepControl(id, select);
    return box;
  }

  private check(id: string, label: string, set: (on: boolean) => void, get: () => boolean) {
    const box = tick(label, get(), (on) => { set(on); this.tell(); });
    const input = box.querySelector('input')!;
    input.id = id;
    keepControl(id, input);
    return box;
  }
}
