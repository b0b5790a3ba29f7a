// What the paper's figures show, one picture each: the setting, the deformed mesh, potential, temperature
// and von Mises stress.
import { Body, Look } from './body';
import { Camera } from './stage';
import { Field, Result } from './results';
import { Picture } from './picture';
import { ColourBar } from './colour_bar';
import { colourRange } from './colours';
import { element } from './dom';
import { fieldTitle, shown } from './numbers';
import { coloursOf, Group, legend } from './setting';
import { Timeline } from './timeline';

export function homeCamera(body: Body): Camera {
  const low = [0, 0, 0], high = [0, 0, 0];
  const { points } = body.grid;
  for (let i = 0; i < points.length; ++i) {
    const at = (points[i] - body.centre[i % 3]) / body.size;
    low[i % 3] = Math.min(low[i % 3], at);
    high[i % 3] = Math.max(high[i % 3], at);
  }
  if (body.result.dimension === 3) {
    const radius = Math.hypot(...high) * 1.06 + 0.04;
    return new Camera(3, radius, radius);
  }
  return new Camera(2, high[0] + 0.12, high[1] + 0.12);
}

interface Card { picture: Picture; look: (state: number) => Look; bar?: ColourBar; field?: Field }

export class Overview {
  readonly box: HTMLElement;
  private readonly cards: Card[] = [];
  constructor(body: Body, private readonly result: Result, groups: Group[],
    private readonly timeline: Timeline, pick: (field: string) => void) {
    const scale = body.suitableScale;
    const even = { low: 0, high: 1, signed: false };
    const camera = homeCamera(body);
    const figures: HTMLElement[] = [];
    const add = (title: string, picture: Picture, look: Card['look'], below: HTMLElement, field?: Field,
      bar?: ColourBar) => {
      this.cards.push({ picture, look, field, bar });
      const heading = field
        ? element('button', { type: 'button', class: 'link', onclick: () => pick(field.name) }, title)
        : element('span', {}, title);
      picture.canvas.setAttribute('role', 'img');
      picture.canvas.setAttribute('aria-label', title);
      figures.push(element('figure', { class: 'card' }, element('figcaption', {}, heading), picture.canvas, below));
    };
    if (result.boundaries.length > 0)
      add('Physical setting', new Picture(body, camera, coloursOf(result, groups)),
        () => ({ state: 0, scale: 0, mesh: false, component: '', range: even }), legend(result, groups));
    const plain = result.field('displacement');
    if (plain)
      add('Deformed mesh', new Picture(body, camera),
        (state) => ({ state, scale, mesh: true, component: '', range: even }),
        element('p', { class: 'note' },
          body.largestDisplacement > 0 ? `displacement × ${shown(scale, 1)}` : 'nothing moves'));
    for (const name of ['potential', 'temperature', 'von_mises']) {
      const field = result.field(name);
      if (!field) continue;
      const values = field.values('');
      const range = colourRange(values.least, values.greatest);
      const bar = new ColourBar();
      bar.show(range, field.unit);
      add(fieldTitle(name), new Picture(body, camera),
        (state) => ({ state, scale, mesh: false, field, component: '', range }), bar.box, field, bar);
    }
    this.box = element('div', { class: 'cards' }, ...figures);
  }

  draw() {
    const state = this.result.stateAt(this.timeline.time);
    for (const card of this.cards) card.picture.show(card.look(state));
  }

}
