// The moment that everything on the page shows, and the bar that sets it.
import { changed, keep } from './address';
import { element } from './dom';
import { isReached, lastOfAll, Moment, momentsOfAll, notReached } from './moments';
import { shown } from './numbers';
import { Result } from './results';

type Listener = () => void;

export class Timeline {
  readonly moments: Moment[];
  /** place in `moments` */
  at: number;
  readonly bar: HTMLElement;
  private readonly listeners: Listener[] = [];
  private readonly slider: HTMLInputElement;
  private readonly text = element('output', { class: 'moment' });
  private readonly beyond = element('span', { class: 'beyond', role: 'status' });
  private readonly button: HTMLButtonElement;
  private timer: number | undefined;
  private speed = 1;
  /** begins again at the end */
  loop = false;

  constructor(private readonly results: Result[]) {
    this.moments = momentsOfAll(results);
    this.at = lastOfAll(results, this.moments);
    const last = Math.max(0, this.moments.length - 1);
    this.slider = element('input', {
      type: 'range', id: 'time', min: 0, max: last, step: 1, value: this.at,
      'aria-label': 'moment', oninput: () => { this.stop(); this.go(Number(this.slider.value)); },
    });
    this.button = element('button', { id: 'play', type: 'button', onclick: () => this.toggle() });
    this.bar = element('div', { class: 'timebar', role: 'group', 'aria-label': 'time' }, this.button, this.slider,
      element('span', { class: 'says' }, this.text, this.beyond));
    this.stop();
    this.say();
    keep('t', () => (this.at === lastOfAll(results, this.moments) ? undefined : String(this.time)), (text) => this.goTo(Number(text)));
  }

  get times(): number[] { return this.moments.map(({ time }) => time); }
  get time(): number { return this.moments[this.at]?.time ?? 0; }
  /** of all runs */
  get end(): number { return this.moments[this.moments.length - 1]?.time ?? 0; }
  get step(): number | undefined { return this.moments[this.at]?.step; }

  onChange(listener: Listener) { this.listeners.push(listener); }

  go(at: number) {
    this.at = Math.max(0, Math.min(this.moments.length - 1, at));
    this.slider.value = String(this.at);
    this.say();
    for (const listener of this.listeners) listener();
    changed();
  }

  /** The moment nearest to a time. */
  goTo(time: number) {
    const away = this.moments.map((moment) => Math.abs(moment.time - time));
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
    if (this.at === this.moments.length - 1) this.go(0);
    this.button.textContent = '❚❚';
    this.button.setAttribute('aria-label', 'pause');
    this.play();
  }

  private play() {
    window.clearInterval(this.timer);
    const pause = Math.max(60, Math.min(250, 6000 / this.moments.length)) / this.speed;
    this.timer = window.setInterval(() => {
      if (this.at < this.moments.length - 1) this.go(this.at + 1);
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
    this.beyond.textContent = this.results.filter((result) => !isReached(result, this.time))
      .map((result) => `${result.name}: ${notReached(result)}`).join('; ');
    const step = this.step === undefined ? '' : `step ${this.step}, `;
    this.slider.setAttribute('aria-valuetext', step + this.text.textContent);
  }
}
