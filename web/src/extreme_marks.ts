// Marks where a field is least and greatest at the moment that is shown.
import { Look } from './body';
import { Frame } from './frame';
import { Pen, Point } from './pen';
import { shown } from './numbers';
import { colour } from './theme';

export interface Extreme { kind: 'min' | 'max'; value: number; place: number }

/** Places of the skin, nodes or cells. */
export function extremesOf(look: Look): Extreme[] {
  if (!look.field) return [];
  const { data, places } = look.field.values(look.component);
  const first = look.state * places;
  let least = -1, greatest = -1;  // a difference is no number where one of the two is not
  for (let i = 0; i < places; ++i) {
    if (Number.isNaN(data[first + i])) continue;
    if (least < 0 || data[first + i] < data[first + least]) least = i;
    if (greatest < 0 || data[first + i] > data[first + greatest]) greatest = i;
  }
  return least < 0 ? [] : [{ kind: 'min', value: data[first + least], place: least },
    { kind: 'max', value: data[first + greatest], place: greatest }];
}

/** In the picture, the middle of a cell. */
function placeOf(frame: Frame, look: Look, place: number): Point {
  if (look.field!.onPoints) return frame.node(place);
  const { triangleCells, triangles } = frame.body.grid;
  const first = triangleCells.indexOf(place);
  const corners = [0, 1, 2].map((k) => frame.node(triangles[3 * first + k]));
  return [0, 1].map((c) => corners.reduce((sum, p) => sum + p[c] / 3, 0)) as Point;
}

export function drawExtremes(pen: Pen, frame: Frame, look: Look) {
  const [ink, card] = [colour('--ink'), colour('--card')];
  for (const { kind, value, place } of extremesOf(look)) {
    const [x, y] = placeOf(frame, look, place);
    if (x < 0 || y < 0 || x > pen.width || y > pen.height) continue;
    const up = kind === 'max' ? 1 : -1;
    pen.surface([[x, y - 6 * up], [x + 5.5, y + 4 * up], [x - 5.5, y + 4 * up]], card, ink);
    const left = x > pen.width - 120;
    pen.words(`${kind} ${shown(value, 4)}`, [x + (left ? -9 : 9), Math.min(pen.height - 8, Math.max(8, y))],
      { colour: ink, rim: card, align: left ? 'right' : 'left' });
  }
}
