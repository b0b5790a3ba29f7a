// A solid body behind a plane, with its fields.
import { Body } from './body';
import { Field, Values } from './results';
import { Plane, Section, sectionOf } from './section';

class CutField extends Field {
  constructor(private readonly whole: Field, private readonly section: Section) { super(whole.description); }

  /** Colours mean the same wherever the plane stands. */
  override ranges(component: string): Values[] { return this.whole.insideToo(component); }

  protected override component(name: string): Values {
    const [skin, inner] = this.whole.insideToo(name), { ends, shares, grid } = this.section;
    const states = skin.data.length / skin.places, count = this.onPoints ? shares.length : grid.cells.length;
    const data = new Float32Array(states * count);
    for (let state = 0; state < states; ++state) {
      const at = (i: number) => (i < skin.places ? skin.data[state * skin.places + i] : inner.data[state * inner.places + i - skin.places]);
      for (let i = 0; i < count; ++i)
        data[state * count + i] = !this.onPoints ? at(grid.cells[i])
          : shares[i] === 0 ? at(ends[2 * i]) : (1 - shares[i]) * at(ends[2 * i]) + shares[i] * at(ends[2 * i + 1]);
    }
    return new Values(data, count, Math.max(skin.error, inner.error));
  }
}

/** The body itself, where the page does not hold what is inside. */
export function cutBody(whole: Body, plane: Plane): Body {
  const { solid, fields } = whole.result;
  if (!solid) return whole;
  const section = sectionOf(whole.grid, solid, plane, whole.size);
  const result = whole.result.cut(section.grid, fields.map((field) => new CutField(field, section)));
  return new Body(result, result, whole);
}
