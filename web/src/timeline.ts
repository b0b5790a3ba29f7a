// The moment that everything on the page shows, and the bar that sets it.
import { changed, keep } from './address';
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
  private speed = 1;
  /** begins again at the end */
  loop = false;

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
    keep('t', () => (this.at === times.length - 1 ? undefined : String(this.time)), (text) => this.goTo(Number(text)));
  }

  get time(): number { return this.times[this.at] ?? 0; }
  get step(): number { return this.steps[this.at] ?? 0; }

  onChange(listener: Listener) { this.listeners.push(listener); }

  go(at: number) {
    this.at = Math.max(0, Math.min(this.times.length - 1, at));
    this.slider.value = String(this.at);
    this.say();
    for (const listener of this.listeners) listener();
    changed();
  }

  /** The moment nearest to a time. */
  goTo(time: number) {
    const away = this.times.map((t) => Math.abs(t - time));
    if (Number.isFinite(time)) this.go(away.indexOf(Math.min(...away)));
  }

  /** Stops, and goes on or back by so many moments. */
  goOn(by: number) {
    this.stop();
    this.go(this.at + by);
  }

  /** 1: as it is by itself. */
  setSpeed(speed: number) {
    this.speed = speed;
    if (this.timer !== undefined) this.play();
  }

  toggle() {
    if (this.timer !== undefined) return this.stop();
    if (this.at === this.times.length - 1) this.go(0);
    this.button.textContent = '❚❚';
    this.button.setAttribute('aria-label', 'pause');
    this.play();
  }

  private play() {
    window.clearInterval(this.timer);
    const pause = Math.max(60, Math.min(250, 6000 / this.times.length)) / this.speed;
    this.timer = window.setInterval(() => {
      if (this.at < this.times.length - 1) this.go(this.at + 1);
      else if (this.loop) this.go(0);
      else this.stop();
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
