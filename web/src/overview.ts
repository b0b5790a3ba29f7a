// What the paper's figures show, one picture each: the setting, the deformed mesh, potential, temperature
// and von Mises stress.
import { Body, Look } from './body';
import { Camera } from './stage';
import { Field, Result } from './results';
import { peaks, shownRange } from './shown_range';
import { Drawing } from './on_screen';
import { Picture } from './picture';
import { ColourBar } from './colour_bar';
import { element } from './dom';
import { fieldTitle, shown } from './numbers';
import { stateAt, strayMoment } from './moments';
import { coloursOf, groupsOf, legend } from './setting';
import { Timeline } from './timeline';

/** A camera that has all of these bodies in view at every moment. */
export function homeCamera(bodies: Body[], arrows = false): Camera {
  const reaches = bodies.map((body) => body.reach(body.suitableScale, arrows));
  const low = [0, 1, 2].map((c) => Math.min(...reaches.map((r) => r.low[c])));
  const high = [0, 1, 2].map((c) => Math.max(...reaches.map((r) => r.high[c])));
  const middle = low.map((v, c) => (v + high[c]) / 2) as [number, number, number];
  const half = low.map((v, c) => (high[c] - v) / 2);
  if (bodies[0].result.dimension === 3) {
    const radius = 1.02 * Math.hypot(...half);
    return new Camera(3, middle, radius, radius);
  }
  const room = 0.04 * Math.max(...half);
  return new Camera(2, middle, half[0] + room, half[1] + room);
}

/** Bodies of one shape are looked at through one camera; others each through its own. */
export function camerasOf(bodies: Body[]): Camera[] {
  if (!bodies.every((body) => body.isShapedLike(bodies[0]))) return bodies.map((body) => homeCamera([body]));
  const camera = homeCamera(bodies);
  return bodies.map(() => camera);
}

export class Overview {
  readonly box: HTMLElement;
  private readonly drawings: Drawing[] = [];
  private readonly moving: Drawing[] = [];
  private readonly bars: (() => void)[] = [];
  private readonly result: Result;
  private readonly stray = element('p', { class: 'stray', role: 'status' });
  constructor(body: Body, private readonly timeline: Timeline, pick: (field: string) => void) {
    this.result = body.result;
    const { result } = body;
    const groups = groupsOf(result);
    const scale = body.suitableScale;
    const even = { low: 0, high: 1, signed: false };
    const camera = homeCamera([body]);
    const figures: HTMLElement[] = [];
    const add = (title: string, picture: Picture, look: (state: number) => Look, below: HTMLElement, field?: Field) => {
      const drawing = new Drawing(picture.canvas, () => picture.show(look(stateAt(result, timeline.time))));
      this.drawings.push(drawing);
      if (title !== 'Physical setting') this.moving.push(drawing);
      const heading = field
        ? element('button', { type: 'button', class: 'link', onclick: () => pick(field.name) }, title)
        : element('span', {}, title);
      picture.canvas.setAttribute('role', 'img');
      picture.canvas.setAttribute('aria-label', title);
      figures.push(element('figure', { class: field || title === 'Deformed mesh' ? 'card' : 'card setting' },
        element('figcaption', {}, heading), picture.canvas, below));
    };
    if (result.boundaries.length > 0)
      add('Physical setting', new Picture(body, homeCamera([body], true), coloursOf(groups)),
        () => ({ state: 0, scale: 0, mesh: false, component: '', range: even }), legend(groups, result));
    const plain = result.field('displacement');
    if (plain)
      add('Deformed mesh', new Picture(body, camera),
        (state) => ({ state, scale, mesh: true, component: '', range: even }),
        element('p', { class: 'note' },
          body.largestDisplacement > 0 ? `displacement × ${shown(scale, 1)}` : 'nothing moves'));
    const stress = result.field('recovered_von_mises') ? 'recovered_von_mises' : 'von_mises';
    for (const name of ['potential', 'temperature', stress]) {
      const field = result.field(name);
      if (!field) continue;
      const values = field.values('');
      const range = shownRange({ all: values, usual: field.isUnknown ? values : values.usual(peaks), error: values.error,
        belowRoundOff: field.belowRoundOff }, field);
      const bar = new ColourBar(true);
      const showBar = () => bar.show(range, field.unit);
      this.bars.push(showBar);
      showBar();
      add(fieldTitle(name), new Picture(body, camera),
        (state) => ({ state, scale, mesh: false, field: range.instead ? undefined : field, component: '', range }),
        element('div', {}, bar.box, field.origin !== '' && element('p', { class: 'note' }, field.origin)), field);
    }
    this.box = element('div', {}, this.stray, element('div', { class: 'cards' }, ...figures));
  }

  draw() {
    for (const show of this.bars) show();
    for (const drawing of this.drawings) drawing.ask();
    this.say();
  }

  /** What another moment changes. */
  move() {
    for (const drawing of this.moving) drawing.ask();
    this.say();
  }

  private say() { this.stray.textContent = strayMoment(this.result, this.timeline.time); }
}
