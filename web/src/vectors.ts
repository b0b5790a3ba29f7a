// Arrows of a vector field at places that are seen, and of the slip at the contact nodes.
import { valueAt } from './body';
import { contactNodes, stepAt, stepEnds } from './contact_line';
import { Frame } from './frame';
import { fieldTitle, shown, symbols } from './numbers';
import { Pen, Point } from './pen';
import { Result } from './results';
import { seenPlaces } from './screen_grid';
import { colour } from './theme';

export const slip = 'slip';
/** Between arrows, and the length of the greatest [pixels]. */
const apart = 30, longest = 28;

interface Arrow { at: number[]; vector: number[] }

const axes = ['x', 'y', 'z'];

/** Names and titles of what arrows can show. */
export function vectorNames(results: Result[]): [name: string, title: string][] {
  const fields = ['displacement', 'electric_displacement', 'electric_field', 'heat_flux']
    .filter((name) => results.some((r) => r.field(name)))
    .map((name): [string, string] => [name, `${fieldTitle(name)} ${symbols[name]}`]);
  return results.some((r) => r.contact && r.contact.rows > 0) ? [...fields, [slip, 'Slip']] : fields;
}

function ofField(frame: Frame, name: string, state: number): Arrow[] {
  const { body } = frame, field = body.result.field(name);
  if (!field) return [];
  return seenPlaces(frame, apart).map((hit) => ({
    at: axes.map((_, c) => hit.weights.reduce((sum, w, k) => sum + w * body.places[3 * body.grid.triangles[3 * hit.triangle + k] + c], 0)),
    vector: axes.map((axis) => (field.has(axis) ? valueAt(body.grid, field, axis, state, hit) : 0)),
  }));
}

/** The skin's nodes at the places of the contact's. */
function contactOnSkin(frame: Frame): number[] {
  const { result, grid, size } = frame.body;
  const places = axes.map((axis) => result.contact!.column(axis));
  const key = (at: (c: number) => number) => axes.map((_, c) => Math.round((at(c) / size) * 1e6)).join();
  const nodes = new Map<string, number>();
  for (let i = 0; i < grid.points.length / 3; ++i) nodes.set(key((c) => grid.points[3 * i + c]), i);
  return Array.from({ length: contactNodes(result) }, (_, row) => nodes.get(key((c) => places[c]?.[row] ?? 0)) ?? -1);
}

function ofSlip(frame: Frame, time: number): Arrow[] {
  const { result, places } = frame.body;
  if (!result.contact?.rows) return [];
  const step = stepAt(stepEnds(result), time);
  if (step < 0) return [];
  const on = contactOnSkin(frame);
  const parts = axes.map((axis) => result.contact!.column(`slip_${axis}`));
  const every = Math.ceil(on.length / 60);
  return on.flatMap((node, row): Arrow[] => (node < 0 || (result.dimension === 2 && row % every !== 0) ? []
    : [{ at: axes.map((_, c) => places[3 * node + c]), vector: parts.map((part) => part?.[step * on.length + row] ?? 0) }]));
}

/** What is drawn, in pixels, and how long the longest vector is. */
export function arrowsOf(frame: Frame, name: string, state: number, time: number): { arrows: [Point, Point][]; greatest: number; places: number } {
  const all = name === slip ? ofSlip(frame, time) : ofField(frame, name, state);
  const greatest = all.reduce((most, { vector }) => Math.max(most, Math.hypot(...vector)), 0);
  const places = all.length;
  if (greatest === 0) return { arrows: [], greatest, places };
  const perScene = frame.width / ((frame.camera.three.right - frame.camera.three.left) / frame.camera.three.zoom);
  const ends = frame.body.project(frame.camera.three, Float32Array.from(all.flatMap(({ at, vector }) =>
    [...at, ...at.map((v, c) => v + (vector[c] / greatest) * (longest / perScene))])));
  return { greatest, places, arrows: all.map((_, i): [Point, Point] =>
    [frame.inPixels(ends[6 * i], ends[6 * i + 1]), frame.inPixels(ends[6 * i + 3], ends[6 * i + 4])]) };
}

/** A line with a head at its end, none where it would be hardly a dot. */
function shape([[x, y], [tx, ty]]: [Point, Point]): { line: Point[]; head: Point[] } | undefined {
  const length = Math.hypot(tx - x, ty - y);
  if (length < 1.5) return undefined;
  const [ux, uy] = [(tx - x) / length, (ty - y) / length], size = Math.min(6, 0.5 * length);
  const beside = (side: number): Point => [tx - size * (ux - 0.45 * side * uy), ty - size * (uy + 0.45 * side * ux)];
  return { line: [[x, y], beside(0)], head: [[tx, ty], beside(1), beside(-1)] };
}

/** Says what the longest arrow stands for. */
export function drawVectors(pen: Pen, frame: Frame, name: string, state: number, time: number): string {
  const { arrows, greatest, places } = arrowsOf(frame, name, state, time);
  const shapes = arrows.flatMap((ends) => shape(ends) ?? []);
  const [ink, card] = [colour('--ink'), colour('--card')];
  pen.lines(shapes.map((s) => s.line), card, 3);
  pen.lines(shapes.map((s) => [...s.head, s.head[0]]), card, 2);
  pen.lines(shapes.map((s) => s.line), ink, 1.3);
  for (const { head } of shapes) pen.surface(head, ink);
  const unit = name === slip ? 'm' : frame.body.result.field(name)?.unit ?? '';
  if (places === 0) return `no arrows: ${name === slip ? 'no contact' : 'nothing of it'} in this picture`;
  return greatest > 0 ? `longest arrow ${shown(greatest, 3)} ${unit}` : 'no arrows: 0 everywhere';
}
