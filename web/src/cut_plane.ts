// The controls of the plane that cuts solid bodies.
import { changed, keepControl } from './address';
import { Body } from './body';
import { choice, element, tick } from './dom';
import { shown } from './numbers';
import { Plane } from './section';

const axes = ['x', 'y', 'z'];

export class CutPlane {
  readonly box = element('span', { class: 'cut' });
  private axis = -1;
  private lower = true;
  private readonly place = element('input', { type: 'range', id: 'cut-at', min: 0.005, max: 0.995, step: 0.005, value: 0.5,
    'aria-label': 'place of the cut', oninput: () => this.tell() });
  private readonly said = element('span', { class: 'note' });
  private readonly further: HTMLElement;
  private readonly kept: [string, HTMLInputElement | HTMLSelectElement][];

  constructor(private readonly bodies: Body[], private readonly onChange: () => void) {
    const solids = bodies.filter((b) => b.result.dimension === 3), can = solids.some((b) => b.result.solid);
    const { box, select } = choice('Cut across', [['', can ? 'nothing' : 'not in this page'], ...(can ? axes.map((a): [string, string] => [a, a]) : [])], '',
      (axis) => { this.axis = axes.indexOf(axis); this.tell(); });
    select.id = 'cut';
    select.disabled = !can;
    if (!can) box.title = 'What is inside would make the page large: `tourmaline report DIR --size MB` takes it where it fits.';
    const side = tick('the other side', false, (on) => { this.lower = !on; this.tell(); });
    side.querySelector('input')!.id = 'cut-side';
    this.further = element('span', { hidden: true }, this.place, this.said, side);
    if (solids.length > 0) this.box.append(box, this.further);
    this.kept = [['cut', select], ['cut-at', this.place], ['cut-side', side.querySelector('input')!]];
  }

  /** In the address, which may ask for a cut at once. */
  keep() { for (const [name, control] of this.kept) keepControl(name, control); }

  /** Undefined: none. */
  get plane(): Plane | undefined {
    const body = this.bodies.find((b) => b.result.solid);
    if (this.axis < 0 || !body) return undefined;
    const [low, high] = body.ends(this.axis);
    return { axis: this.axis, at: low + Number(this.place.value) * (high - low), lower: this.lower };
  }

  private tell() {
    const { plane } = this;
    this.further.hidden = !plane;
    if (plane) this.said.textContent = `${axes[plane.axis]} = ${shown(plane.at, 3)} m`;
    this.onChange();
    changed();
  }
}
