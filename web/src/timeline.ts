// The moment that everything on the page shows, and the bar that sets it.
import { element } from './dom';
import { shown } from './numbers';

type Listener = () => void;

export class Timeline {
  /** place in `times` */
  at: number;
  readonly bar: HTMLElement;
  private readonly listeners: Listener[] = [];
  private readonly slider: HTMLInputElement;
  private readonly text = element('output', { class: 'moment' });
  private readonly button: HTMLButtonElement;
  private timer: number | undefined;

  constructor(readonly times: number[], private readonly steps: number[]) {
    this.at = Math.max(0, times.length - 1);
    this.slider = element('input', {
      type: 'range', id: 'time', min: 0, max: Math.max(0, times.length - 1), step: 1, value: this.at,
      'aria-label': 'moment', oninput: () => { this.stop(); this.go(Number(this.slider.value)); },
    });
    this.button = element('button', { id: 'play', type: 'button', onclick: () => this.toggle() });
    this.bar = element('div', { class: 'timebar' }, this.button, this.slider, this.text);
    this.stop();
    this.say();
  }

  get time(): number { return this.times[this.at] ?? 0; }
  get step(): number { return this.steps[this.at] ?? 0; }

  onChange(listener: Listener) { this.listeners.push(listener); }

  go(at: number) {
    this.at = Math.max(0, Math.min(this.times.length - 1, at));
    this.slider.value = String(this.at);
    this.say();
    for (const listener of this.listeners) listener();
  }

  toggle() {
    if (this.timer !== undefined) return this.stop();
    if (this.at === this.times.length - 1) this.go(0);
    this.button.textContent = '❚❚';
    this.button.setAttribute('aria-label', 'pause');
    const pause = Math.max(60, Math.min(250, 6000 / this.times.length));
    this.timer = window.setInterval(() => {
      if (this.at >= this.times.length - 1) return this.stop();
      this.go(this.at + 1);
    }, pause);
  }

  private stop() {
    window.clearInterval(this.timer);
    this.timer = undefined;
    this.button.textContent = '▶';
    this.button.setAttribute('aria-label', 'play');
  }

  private say() {
    this.text.textContent = `t = ${shown(this.time)} s`;
    this.slider.setAttribute('aria-valuetext', `step ${this.step}, ${this.text.textContent}`);
  }
}
