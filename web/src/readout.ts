// The values at a place of a body: where it is, the field that is shown, the unknowns.
import * as THREE from 'three';
import { Body, Hit, valueAt } from './body';
import { element } from './dom';
import { notReached, stateAt, strayMoment } from './moments';
import { shown, shownWithin, symbols, unitWith } from './numbers';
import { Field } from './results';

/** A place of the body, and the node that it is, if it is one. */
export interface Probed { hit: Hit; node?: number }

function item(value: string, unit: string, label: string, data: Record<string, unknown> = {}): HTMLElement {
  return element('span', { class: 'value', ...data }, element('i', {}, label), ' ', value, ' ', element('small', {}, unit));
}

/** Writes into `readout` what is known of a place at a moment. */
export function tell(readout: HTMLElement, body: Body, { hit, node }: Probed, time: number, field?: Field, component = '') {
  const { grid, result } = body;
  if (node !== undefined && grid.nodes[node] < 0) node = undefined;  // where a cut meets the side of a cell
  if (node !== undefined) readout.dataset.node = String(grid.nodes[node]);
  else delete readout.dataset.node;
  const state = stateAt(result, time);
  if (state < 0) return readout.replaceChildren(`${shown(time)} s is not reached: ${notReached(result)}.`);
  const place = [0, 1, 2].slice(0, result.dimension).map((c) =>
    hit.weights.reduce((sum, w, k) => sum + (w === 0 ? 0 : w * grid.points[3 * grid.triangles[3 * hit.triangle + k] + c]), 0));
  const digits = (v: number) => 5 + Math.max(0, Math.floor(Math.log10(Math.abs(v) / body.size)));  // far from the origin
  const coordinate = (v: number) => (Math.abs(v) <= 1e-12 * body.size ? '0' : shown(v, digits(v)));
  const items = [item(place.map(coordinate).join(', '), 'm', node === undefined ? 'at' : `node ${grid.nodes[node]} at`)];
  const own = new Set<string>();
  const add = (of: Field, part: string) => {
    const values = of.values(part);
    const value = valueAt(grid, of, part, state, hit);
    own.add(`${of.name}.${part}`);
    const symbol = symbols[of.name] ?? of.name;
    const label = part === 'size' ? `|${symbol}|` : part ? `${symbol}_${part}` : symbol;
    items.push(item(shownWithin(value, values.error), unitWith(0, of.unit), label,
      { 'data-field': of.name, 'data-component': part, 'data-value': value }));
  };
  if (field?.has(component)) add(field, component);
  for (const name of ['displacement', 'potential', 'temperature'])
    for (const part of result.field(name)?.components ?? [])
      if (part !== 'size' && !own.has(`${name}.${part}`)) add(result.field(name)!, part);
  const stray = strayMoment(result, time);
  if (stray) items.push(element('span', {}, stray));
  readout.replaceChildren(...items);
}

/** The corner of the triangle that is hit, if the pointer at (x, y) is within a few pixels of it. */
export function snapped(body: Body, hit: Hit, x: number, y: number, frame: DOMRect, camera: THREE.Camera): Probed {
  const corner = hit.weights.indexOf(Math.max(...hit.weights));
  const node = body.grid.triangles[3 * hit.triangle + corner];
  const places = body.project(camera);
  const away = Math.hypot(((places[3 * node] - x) / 2) * frame.width, ((places[3 * node + 1] - y) / 2) * frame.height);
  return away > 5 ? { hit } : atNode(body, node, hit.triangle);
}

/** A node as a place; `triangle`: one that has it as a corner. */
function atNode(body: Body, node: number, triangle: number): Probed {
  const weights: [number, number, number] = [0, 0, 0];
  weights[[0, 1, 2].findIndex((k) => body.grid.triangles[3 * triangle + k] === node)] = 1;
  return { hit: { triangle, weights }, node };
}

/** Whether nothing of the body lies in front of a node. */
function isSeen(body: Body, node: number, places: Float32Array, camera: THREE.Camera): boolean {
  if (body.result.dimension === 2) return true;
  const at = [places[3 * node], places[3 * node + 1]];
  const front = body.pick(at[0], at[1], camera);
  if (!front) return true;  // on the rim
  const depth = front.weights.reduce((sum, w, k) => sum + w * places[3 * body.grid.triangles[3 * front.triangle + k] + 2], 0);
  return places[3 * node + 2] <= depth + 1e-4;
}

/**
 * The seen node that lies next in a direction on the screen from another one; without one, the seen node nearest to the
 * middle of the picture.
 */
export function nextNode(body: Body, from: number | undefined, across: number, up: number, camera: THREE.Camera):
  Probed | undefined {
  const places = body.project(camera);
  const [x, y] = from === undefined ? [0, 0] : [places[3 * from], places[3 * from + 1]];
  const candidates: { node: number; cost: number }[] = [];
  for (let node = 0; node < places.length / 3; ++node) {
    const dx = places[3 * node] - x, dy = places[3 * node + 1] - y;
    const ahead = dx * across + dy * up, aside = Math.abs(dx * up - dy * across);
    if (from === undefined) candidates.push({ node, cost: Math.hypot(dx, dy) });
    else if (node !== from && ahead > 1e-6 && aside <= ahead) candidates.push({ node, cost: ahead + 2 * aside });
  }
  candidates.sort((a, b) => a.cost - b.cost);
  const found = candidates.slice(0, 50).find(({ node }) => isSeen(body, node, places, camera));
  if (!found) return undefined;
  const triangle = Math.floor(body.grid.triangles.indexOf(found.node) / 3);
  return atNode(body, found.node, triangle);
}

/** A ring around the place of `probed`, on a picture just drawn. */
export function drawRing(canvas: HTMLCanvasElement, body: Body, { hit }: Probed, camera: THREE.Camera, ratio: number) {
  const places = body.project(camera);
  const at = (c: number) => hit.weights.reduce((sum, w, k) => sum + w * places[3 * body.grid.triangles[3 * hit.triangle + k] + c], 0);
  const context = canvas.getContext('2d')!;
  for (const [colour, width] of [['#ffffff', 4], ['#000000', 1.6]] as const) {
    context.strokeStyle = colour;
    context.lineWidth = width * ratio;
    context.beginPath();
    context.arc(((at(0) + 1) / 2) * canvas.width, ((1 - at(1)) / 2) * canvas.height, 6 * ratio, 0, 2 * Math.PI);
    context.stroke();
  }
}
