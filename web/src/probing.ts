// What the reader asks of places: a line over the body with the field along it, pins with the field over time.
import { changed, keep, numbersIn, numbersText } from './address';
import { Body, Hit, valueAt } from './body';
import { Chart, Curve } from './chart';
import { lineColours } from './colours';
import { choice, element } from './dom';
import { Frame } from './frame';
import { lineOnSkin, LineProbe, straightLine } from './line_probe';
import { Locator } from './locate';
import { stateAt, strayMoment } from './moments';
import { isSameMesh } from './same_mesh';
import { fieldTitle, shown, symbols } from './numbers';
import { Pen, Point } from './pen';
import { inScene, overTime, undeformed } from './skin_place';
import { Camera } from './stage';
import { colour } from './theme';
import { Timeline } from './timeline';

type Place = [number, number, number];
/** Of a coordinate [m], also where the body is far smaller than its distance from the origin. */
const digitsOfPlaces = 12;
export type Tool = 'values' | 'line' | 'pin';

/** What is asked of the places. */
export interface Question { field: string; component: string }

export class Probing {
  tool: Tool = 'values';
  readonly control: HTMLElement;
  readonly box = element('div', { class: 'charts asked' });
  private readonly lines = new Map<Body, LineProbe>();
  /** ends of the line in a plane body [m] */
  private ends?: [Place, Place];
  private dragged?: { from: Point; to: Point; body: Body };
  private pins: Place[] = [];
  private readonly locators = new Map<Body, Locator>();
  private readonly lineChart: Chart;
  private readonly pinChart: Chart;
  private readonly plane: boolean;

  constructor(private bodies: Body[], private readonly timeline: Timeline, private readonly question: () => Question,
    private readonly refresh: () => void) {
    this.plane = bodies.every((b) => b.result.dimension === 2);
    const options = { title: '', xLabel: '', unit: '', sync: 'probing' };
    this.lineChart = new Chart({ ...options, further: () => this.linePlaces() }, [], []);
    this.pinChart = new Chart({ ...options, sync: 'time', mark: () => timeline.time }, [], []);
    this.lineChart.box.classList.add('line');
    this.pinChart.box.classList.add('pins');
    this.box.append(this.lineChart.box, this.pinChart.box);
    this.control = this.makeControl();
    this.keepAll();
    this.update();
  }

  /** Takes a press of the pointer; false: it is not for this. In normalised device coordinates. */
  press(body: Body, at: Point, hit: Hit | undefined): boolean {
    if (this.tool === 'pin' && hit) {
      this.pins.push(undeformed(body, hit));
      this.tell();
    }
    if (this.tool === 'line') this.dragged = { from: at, to: at, body };
    return this.tool !== 'values';
  }

  move(at: Point) {
    if (!this.dragged) return;
    this.dragged.to = at;
    this.refresh();
  }

  release(camera: Camera) {
    if (!this.dragged) return;
    const { body, from, to } = this.dragged;
    this.dragged = undefined;
    if (Math.hypot(to[0] - from[0], to[1] - from[1]) > 0.02) this.lay(body, camera, from, to);
    this.tell();
  }

  /** Of other parts of the same bodies; a line over what was seen before is gone. */
  become(bodies: Body[]) {
    this.bodies = bodies;
    this.locators.clear();
    if (!this.plane) this.lines.clear();
    this.update();
  }

  /** With another field or moment. */
  update() {
    const { field: name, component } = this.question();
    const bodies = this.bodies.filter((b) => b.result.field(name)?.has(component));
    const unit = bodies[0]?.result.field(name)!.unit ?? '';
    const title = `${fieldTitle(name)} ${component === 'size' ? `|${symbols[name] ?? name}|` : component}`.trim();
    this.lineChart.box.hidden = this.lines.size === 0;
    this.pinChart.box.hidden = this.pins.length === 0;
    const [longest] = [...this.lines.values()];
    if (longest) this.lineChart.become({ title: `${title} along the line`, xLabel: 's [m]', unit }, longest.along,
      bodies.flatMap((b, i) => this.alongLine(b, name, component, i)));
    if (this.pins.length === 0) return;
    const curves = bodies.flatMap((b, i) => this.atPins(b, name, component, i));
    this.pinChart.become({ title: `${title} at the pins${curves.length === 0 ? ': none lies on what is shown' : ''}`, xLabel: 't [s]', unit },
      this.timeline.times, curves);
  }

  draw(pen: Pen, frame: Frame) {
    const [ink, card] = [colour('--ink'), colour('--card')];
    const { body } = frame, line = this.lines.get(body);
    const project = (at: number[]) => { const [x, y] = body.project(frame.camera.three, Float32Array.from(at)); return frame.inPixels(x, y); };
    const path = this.dragged?.body === body ? [this.dragged.from, this.dragged.to].map((p) => frame.inPixels(...p))
      : (line?.hits ?? []).flatMap((hit) => (hit ? [project(inScene(body, hit))] : []));
    if (path.length > 1) {
      pen.lines([path], card, 4.5);
      pen.lines([path], ink, 1.8);
      pen.words('s = 0', [path[0][0] + 6, path[0][1] - 9], { colour: ink, rim: card });
    }
    this.pins.forEach((place, i) => {
      const hit = this.locator(body).find(...place);
      if (!hit) return;
      const [x, y] = project(inScene(body, hit)), own = lineColours[i % lineColours.length];
      pen.surface([[x, y], [x - 4, y - 11], [x + 4, y - 11]], own, card);
      pen.words(String(i + 1), [x, y - 19], { colour: ink, rim: card, align: 'center', bold: true });
    });
  }

  private lay(body: Body, camera: Camera, from: Point, to: Point) {
    this.lines.clear();
    this.ends = undefined;
    if (!this.plane) {
      const line = lineOnSkin(body, camera, from, to);
      for (const b of this.bodies)
        this.lines.set(b, isSameMesh(b, body) ? line : { ...line, hits: line.places.map((p) => this.locator(b).find(...p)) });
      if (line.hits.length < 2) this.lines.clear();
      return;
    }
    // Ends beside the body are taken where the picture has them.
    const m = camera.three;
    const inBody = ([x, y]: Point): Place => {
      const hit = body.pick(x, y, m);
      if (hit) return undeformed(body, hit);
      const scene = [m.position.x + (m.right + m.left) / 2 + (x * (m.right - m.left)) / 2 / m.zoom,
        m.position.y + (m.top + m.bottom) / 2 + (y * (m.top - m.bottom)) / 2 / m.zoom];
      return [body.centre[0] + scene[0] * body.size, body.centre[1] + scene[1] * body.size, 0];
    };
    this.layBetween(inBody(from), inBody(to));
  }

  private layBetween(from: Place, to: Place) {
    this.lines.clear();
    this.ends = [from, to];
    for (const b of this.bodies) {
      const line = straightLine(this.locator(b), from, to);
      if (line.hits.some((hit) => hit)) this.lines.set(b, line);
    }
  }

  private clear() {
    this.lines.clear();
    this.ends = undefined;
    this.pins = [];
    this.tell();
  }

  private tell() {
    this.update();
    this.refresh();
    changed();
  }

  private locator(body: Body): Locator {
    let locator = this.locators.get(body);
    if (!locator) this.locators.set(body, (locator = new Locator(body.grid, body.size)));
    return locator;
  }

  private named(body: Body, label: string): string {
    return this.bodies.length > 1 ? `${label} ${body.result.title}`.trim() : label || symbols[this.question().field] || 'value';
  }

  private alongLine(body: Body, name: string, component: string, i: number): Curve[] {
    const line = this.lines.get(body), field = body.result.field(name)!;
    if (!line) return [];
    const state = stateAt(body.result, this.timeline.time);
    const stray = state >= 0 && strayMoment(body.result, this.timeline.time) ? `, t = ${shown(body.result.stateTimes[state])} s` : '';
    return [{ label: this.named(body, '') + stray, colour: lineColours[i],
      values: line.hits.map((hit) => (hit && state >= 0 ? valueAt(body.grid, field, component, state, hit) : null)) }];
  }

  private atPins(body: Body, name: string, component: string, i: number): Curve[] {
    const field = body.result.field(name)!;
    return this.pins.flatMap((place, k): Curve[] => {
      const hit = this.locator(body).find(...place);
      if (!hit) return [];
      const own = overTime(body, field, component, hit);
      // At the moments that the page has fields of, with lines between.
      const values = this.timeline.times.map((t) => (strayMoment(body.result, t) ? null : own[stateAt(body.result, t)]));
      return [{ label: this.named(body, `pin ${k + 1}`), colour: lineColours[k % lineColours.length], values, dashed: i > 0, joined: true }];
    });
  }

  private linePlaces(): [string, number[]][] {
    const [line] = [...this.lines.values()];
    return ['x', 'y', 'z'].slice(0, this.plane ? 2 : 3).map((axis, c) => [`${axis} [m]`, (line?.places ?? []).map((p) => p[c])]);
  }

  private makeControl(): HTMLElement {
    const { box, select } = choice('Pointer', [['values', 'values'], ['line', 'line: drag'], ['pin', 'pin: click']], this.tool,
      (tool) => { this.tool = tool as Tool; this.refresh(); });
    select.id = 'tool';
    return element('span', { class: 'pointer' }, box, element('button', { type: 'button', id: 'unask', onclick: () => this.clear() }, 'clear'));
  }

  private keepAll() {
    keep('line', () => this.ends && numbersText(this.ends.flatMap(([x, y]) => [x, y]), digitsOfPlaces), (text) => {
      const n = numbersIn(text, 4);
      if (n && this.plane) this.layBetween([n[0], n[1], 0], [n[2], n[3], 0]);
    });
    keep('pins', () => (this.pins.length > 0 ? this.pins.map((pin) => numbersText(pin, digitsOfPlaces)).join(' ') : undefined), (text) => {
      this.pins = text.split(' ').flatMap((pin) => (numbersIn(pin, 3) as Place | undefined ? [numbersIn(pin, 3) as Place] : []));
    });
  }
}
