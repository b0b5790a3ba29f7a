// The large view: any field, any component, any moment; for two results with linked camera and range.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { Body, Hit, Look, valueAt } from './body';
import { margins } from './axes';
import { canBeLogarithmic } from './colour_scale';
import { differenceOf } from './difference';
import { Display } from './display';
import { drawOverlay } from './overlay';
import { keepCamera } from './view_camera';
import { changed, keepControl } from './address';
import { Camera } from './stage';
import { Frame } from './frame';
import { Pen, Point } from './pen';
import { Probing } from './probing';
import { Caption, pixelSheet, vectorSheet } from './picture_sheet';
import { fileName, save, saveButtons, saveText } from './save';
import { vectorNames } from './vectors';
import { Field, Result } from './results';
import { Picture } from './picture';
import { ColourBar } from './colour_bar';
import { colourRange, Range } from './colours';
import { choice, element, tick } from './dom';
import { Extremes, peaks, shownRange, wholeRange } from './shown_range';
import { fieldTitle, shown, shownWithin, symbols, unitWith } from './numbers';
import { Drawing } from './on_screen';
import { homeCamera } from './overview';
import { Timeline } from './timeline';

interface View {
  result: Result;
  body: Body;
  picture: Picture;
  controls: OrbitControls;
  bar: ColourBar;
  note: HTMLElement;
  readout: HTMLElement;
  drawing: Drawing;
  /** of a difference of two: said of it */
  less?: string;
}

const nothing = (): Extremes => ({ least: Infinity, greatest: -Infinity });

function include(range: Extremes, other: Extremes) {
  range.least = Math.min(range.least, other.least);
  range.greatest = Math.max(range.greatest, other.greatest);
}

/** Cells above which the mesh would only darken the picture. */
const mostCellsWithMesh = 20000;

export class Explorer {
  readonly box: HTMLElement;
  field: string;
  component = '';
  private rangeOver: 'all' | 'peaks' | 'step' | 'hand' = 'all';
  private byHand: [number, number] = [0, 1];
  private linked = true;
  private stretch = 1;
  /** typed, the same for all bodies; undefined: `stretch` times what suits each */
  private magnification?: number;
  private mesh: boolean;
  private readonly views: View[];
  private readonly camera: Camera;
  private readonly componentChoice: ReturnType<typeof choice>;
  private readonly fieldChoice: ReturnType<typeof choice>;
  private readonly hand: HTMLElement;
  readonly display: Display;
  private readonly probing: Probing;

  constructor(bodies: Body[], private readonly timeline: Timeline) {
    const first = bodies[0].result;
    this.camera = homeCamera(bodies[0]);
    this.mesh = first.grid!.cells.length <= mostCellsWithMesh;
    this.field = first.field('potential')?.name ?? first.fields[0].name;
    this.views = bodies.map((body) => this.view(body));
    const less = bodies.length === 2 ? differenceOf(bodies[0], bodies[1]) : undefined;
    if (less) this.views.push(this.view(less.body, less.said));
    this.probing = new Probing(bodies, timeline, () => this, () => this.refresh());
    timeline.onChange(() => this.probing.update());
    this.display = new Display(vectorNames(bodies.map((b) => b.result)));
    this.display.onChange(() => this.showOtherwise());
    this.fieldChoice = choice('Field', first.fields.map((f) => [f.name, fieldTitle(f.name)]), this.field,
      (name) => this.choose(name));
    this.fieldChoice.select.id = 'field';
    this.componentChoice = choice('Component', [], '', (c) => { this.component = c; this.probing.update(); this.refresh(); });
    this.componentChoice.select.id = 'component';
    this.hand = this.rangeByHand();
    this.display.box.append(this.probing.control);
    this.box = element('div', {}, this.toolbar(), this.display.box,
      element('div', { class: `views views-${bodies.length}` }, ...this.views.map((v) => this.frame(v))), this.probing.box);
    this.choose(this.field);
    this.showOtherwise();
    this.keepAll();
  }

  choose(name: string) {
    this.field = name;
    this.fieldChoice.select.value = name;
    const { components } = this.views[0].result.field(name)!;
    this.component = components[0];
    this.componentChoice.box.hidden = components.length === 1;
    this.componentChoice.select.replaceChildren(...components.map((c) =>
      element('option', { value: c }, c === 'size' ? `|${symbols[name] ?? name}|` : c)));
    this.probing.update();
    this.refresh();
  }

  refresh() {
    for (const view of this.views) view.drawing.ask();
    changed();
  }

  /** What of it stands in the address. */
  private keepAll() {
    keepControl('field', this.fieldChoice.select);
    keepControl('component', this.componentChoice.select, () => this.views[0].result.field(this.field)!.components[0]);
    this.box.querySelectorAll<HTMLInputElement>('.toolbar:not(.further) :is(#range, #stretch, #magnification, .tick input, .hand input)')
      .forEach((control) => keepControl(control.id || control.getAttribute('aria-label') || control.parentElement!.textContent!, control));
    keepCamera(this.camera, this.views.map((view) => view.controls), () => this.refresh());
  }

  private showOtherwise() {
    const plane = this.camera.dimension === 2 && this.display.axes;
    this.camera.inset = plane ? margins : { left: 0, bottom: 0 };
    this.refresh();
  }

  private view(body: Body, less?: string): View {
    const picture = new Picture(body, this.camera);
    const { canvas } = picture;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', `field of ${body.result.title}; arrow keys, plus, minus and 0 move the view`);
    const controls = new OrbitControls(this.camera.three, canvas);
    controls.target.copy(this.camera.target);
    controls.update();  // its constructor has turned the camera towards the origin
    controls.addEventListener('change', () => this.refresh());
    controls.zoomToCursor = true;
    controls.enableZoom = false;
    controls.minZoom = 0.5;
    controls.maxZoom = 200;
    if (body.result.dimension === 2) {
      controls.enableRotate = false;
      controls.mouseButtons = { LEFT: THREE.MOUSE.PAN, MIDDLE: THREE.MOUSE.DOLLY, RIGHT: THREE.MOUSE.PAN };
      // One finger scrolls the page and shows values; two move the body.
      controls.touches = { ONE: null, TWO: THREE.TOUCH.DOLLY_PAN };
      canvas.style.touchAction = 'pan-y';
    }
    // The wheel scrolls the page until the picture has been clicked.
    canvas.addEventListener('focus', () => (controls.enableZoom = true));
    canvas.addEventListener('blur', () => (controls.enableZoom = false));
    canvas.addEventListener('keydown', (event) => this.key(event));
    const view: View = {
      result: body.result, body, picture, controls, less, bar: new ColourBar(),
      note: element('p', { class: 'note' }), readout: element('div', { class: 'readout' }),
      drawing: new Drawing(canvas, () => this.draw(view)),
    };
    canvas.addEventListener('pointermove', (event) => this.point(view, event));
    // Before the controls, which turn and shift.
    canvas.addEventListener('pointerdown', (event) => this.press(view, event), { capture: true });
    canvas.addEventListener('pointerup', () => this.release(view));
    canvas.addEventListener('pointerleave', () => this.clearReadouts());
    return view;
  }

  private frame(view: View): HTMLElement {
    const zoom = (by: number) => () => this.zoom(by);
    const buttons = element('div', { class: 'zoom' },
      element('button', { type: 'button', 'aria-label': 'closer', onclick: zoom(1.4) }, '+'),
      element('button', { type: 'button', 'aria-label': 'farther', onclick: zoom(1 / 1.4) }, '−'),
      element('button', { type: 'button', 'aria-label': 'whole body', onclick: () => this.home() }, '⤢'));
    return element('figure', { class: view.less === undefined ? 'view' : 'view difference', hidden: view.less !== undefined },
      element('div', { class: 'head' }, element('figcaption', {}, this.views.length > 1 && view.result.title), element('div', { class: 'tools' },
        saveButtons('the picture', [['PNG', () => this.savePixels(view)], ['SVG', () => this.saveVectors(view)]]), buttons)),
      view.picture.canvas, view.bar.box, view.note, view.readout);
  }

  private toolbar(): HTMLElement {
    const stretch = element('input', {
      type: 'range', id: 'stretch', min: 0, max: 3, step: 0.1, value: 1,
      oninput: () => {
        this.stretch = Number(stretch.value);
        this.magnification = undefined;
        typed.value = '';
        this.refresh();
      },
    });
    const typed = element('input', {
      type: 'number', id: 'magnification', step: 'any', min: 0, placeholder: '×', 'aria-label': 'magnification of displacements',
      onchange: () => {
        this.magnification = typed.value === '' || !(Number(typed.value) >= 0) ? undefined : Number(typed.value);
        this.refresh();
      },
    });
    const range = choice('Colour range', [['all', 'all moments'], ['peaks', 'all moments, with peaks'], ['step', 'this moment'],
      ['hand', 'by hand']], 'all',
      (over) => {
        const current = this.range(this.views[0]);
        this.byHand = [current.low, current.high];
        this.rangeOver = over as 'all';
        this.hand.hidden = over !== 'hand';
        this.hand.querySelectorAll('input').forEach((input, i) => (input.value = String(Number(this.byHand[i].toPrecision(4)))));
        this.refresh();
      });
    range.select.id = 'range';
    return element('div', { class: 'toolbar' }, this.fieldChoice.box, this.componentChoice.box, range.box, this.hand,
      element('label', { class: 'control' }, element('span', {}, 'Deformation'), stretch),
      element('label', { class: 'control' }, element('span', {}, 'or displacement ×'), typed),
      tick('mesh', this.mesh, (on) => { this.mesh = on; this.refresh(); }),
      this.views.length > 1 && tick('same colours', true, (on) => { this.linked = on; this.refresh(); }), this.differenceTick());
  }

  private differenceTick(): HTMLElement | false {
    if (!this.views.some((v) => v.less !== undefined)) return false;
    const box = tick('difference', false, (on) => {
      this.box.querySelector<HTMLElement>('.difference')!.hidden = !on;
      changed();
    });
    box.querySelector('input')!.id = 'difference';
    return box;
  }

  private rangeByHand(): HTMLElement {
    const input = (i: 0 | 1, label: string) => {
      const box = element('input', {
        type: 'number', step: 'any', 'aria-label': label,
        onchange: () => { this.byHand[i] = Number(box.value); this.refresh(); },
      });
      return box;
    };
    return element('span', { class: 'hand', hidden: true }, input(0, 'least'), '…', input(1, 'greatest'));
  }

  private fieldOf(view: View): Field | undefined { return view.result.field(this.field); }

  /** Of the views that share their colours. */
  private valuesOf(views: View[]): { all: Extremes; usual: Extremes; error: number } {
    const found = { all: nothing(), usual: nothing(), error: 0 };
    for (const view of views) {
      const field = this.fieldOf(view);
      if (!field?.has(this.component)) continue;
      const values = field.values(this.component);
      const state = view.result.stateAt(this.timeline.time);
      include(found.all, this.rangeOver === 'step' ? values.of(state) : values);
      // Nothing is cut off an unknown.
      include(found.usual, field.isUnknown ? found.all : values.usual(peaks, this.rangeOver === 'step' ? state : undefined));
      found.error = Math.max(found.error, values.error);
    }
    return found;
  }

  private range(view: View): Range {
    if (this.rangeOver === 'hand') {
      const [low, high] = this.byHand;
      return { low, high: high > low ? high : low + 1e-30, signed: low < 0 && high === -low };
    }
    const field = this.fieldOf(view);
    if (!field) return colourRange(0, 0);
    const { all, usual, error } = this.valuesOf(this.linked && view.less === undefined ? this.views.filter((v) => v.less === undefined) : [view]);
    return this.rangeOver === 'peaks' ? wholeRange(all, field, error) : shownRange(all, usual, field, error);
  }

  private look(view: View): Look {
    const field = this.fieldOf(view);
    const range = this.range(view);
    return {
      state: view.result.stateAt(this.timeline.time), scale: this.magnification ?? this.stretch * view.body.suitableScale, mesh: this.mesh,
      field: field?.has(this.component) && !range.instead ? field : undefined, component: this.component,
      range: { ...range, logarithmic: this.display.logarithmic && canBeLogarithmic(range) },
      bands: this.display.bands, levels: this.display.levels,
    };
  }

  private draw(view: View) {
    if (view.result.dimension === 2) view.picture.canvas.style.touchAction = this.probing.tool === 'line' ? 'none' : 'pan-y';
    const look = this.look(view);
    let said = '';
    view.picture.show(look, (pen, frame) => { said = this.cover(pen, frame, look); });
    view.bar.show(look.range, this.fieldOf(view)?.unit ?? '', look.bands);
    const { origin } = this.fieldOf(view) ?? { origin: '' };
    view.note.textContent = (look.scale === 0 ? 'not deformed' : `displacement × ${shown(look.scale, 2)}`) +
      (origin ? ` · values: ${origin}` : '') + (said ? ` · ${said}` : '') + (view.less ? ` · ${view.less}` : '');
  }

  private caption(view: View): Caption {
    const { result, bar, note } = view, field = this.fieldOf(view);
    const component = this.component === 'size' ? '' : this.component;
    return { title: `${result.title}: ${[fieldTitle(this.field), component].join(' ').trim()}, t = ${shown(this.timeline.time)} s`,
      ticks: field ? bar.texts : [], unit: bar.unit, note: note.textContent ?? '' };
  }

  private fileOf(view: View): string {
    return fileName(view.result.name, this.field, this.component, `t${shown(this.timeline.time)}`);
  }

  private async savePixels(view: View) {
    this.draw(view);
    save(this.fileOf(view) + '.png', await pixelSheet(view.picture, this.look(view), this.caption(view)));
  }

  private saveVectors(view: View) {
    const look = this.look(view);
    saveText(this.fileOf(view) + '.svg', 'image/svg+xml', vectorSheet(view.picture, look, this.caption(view),
      (pen, frame) => { this.cover(pen, frame, look); }));
    this.draw(view);
  }

  private cover(pen: Pen, frame: Frame, look: Look): string {
    const said = drawOverlay(pen, frame, look, this.display, this.timeline.time);
    this.probing.draw(pen, frame);
    return said;
  }

  private home() {
    for (const view of this.views) view.controls.target.copy(this.camera.target);
    this.camera.reset();
    for (const view of this.views) view.controls.update();
    this.refresh();
  }

  private zoom(by: number) {
    this.camera.three.zoom = Math.min(200, Math.max(0.5, this.camera.three.zoom * by));
    this.refresh();
  }

  private key(event: KeyboardEvent) {
    const turns: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1],
    };
    if (event.key === '+' || event.key === '=') this.zoom(1.2);
    else if (event.key === '-') this.zoom(1 / 1.2);
    else if (event.key === '0') this.home();
    else if (turns[event.key]) this.move(...turns[event.key]);
    else return;
    event.preventDefault();
  }

  // Turns a solid body, shifts a plane one.
  private move(across: number, up: number) {
    const camera = this.camera.three;
    const { target } = this.views[0].controls;
    if (this.camera.dimension === 3) {
      const place = new THREE.Spherical().setFromVector3(
        camera.position.clone().sub(target).applyQuaternion(turned));
      place.theta -= 0.15 * across;
      place.phi = Math.min(Math.PI - 0.05, Math.max(0.05, place.phi - 0.15 * up));
      camera.position.setFromSpherical(place).applyQuaternion(turned.clone().invert()).add(target);
      camera.lookAt(target);
    } else {
      const shift = new THREE.Vector3(-0.08 * across, -0.08 * up, 0).divideScalar(camera.zoom);
      camera.position.add(shift);
      for (const view of this.views) view.controls.target.add(shift);
    }
    for (const view of this.views) view.controls.update();
    this.refresh();
  }

  private clearReadouts() {
    for (const view of this.views) view.readout.replaceChildren();
  }

  /** Where the pointer is, in normalised device coordinates, and what of the body lies there. */
  private under(view: View, event: PointerEvent): { at: Point; near?: { hit: Hit; node?: number } } {
    const frame = view.picture.canvas.getBoundingClientRect();
    const x = ((event.clientX - frame.left) / frame.width) * 2 - 1;
    const y = 1 - ((event.clientY - frame.top) / frame.height) * 2;
    this.camera.aim(frame.width, frame.height, 1);
    const { state, scale } = this.look(view);
    view.body.place(state, scale);
    const hit = view.body.pick(x, y, this.camera.three);
    return { at: [x, y], near: hit && snapped(view.body, hit, x, y, frame, this.camera.three) };
  }

  private press(view: View, event: PointerEvent) {
    const { at, near } = this.under(view, event);
    const taken = this.probing.press(view.body, at, near?.hit);
    view.controls.enabled = !taken;
    if (taken) view.picture.canvas.setPointerCapture(event.pointerId);
    this.point(view, event);
  }

  private release(view: View) {
    view.controls.enabled = true;
    const frame = view.picture.canvas.getBoundingClientRect();
    this.camera.aim(frame.width, frame.height, 1);
    this.probing.release(this.camera);
  }

  private point(view: View, event: PointerEvent) {
    const { at, near } = this.under(view, event);
    this.probing.move(at);
    this.clearReadouts();
    if (!near) return;
    for (const other of this.views)
      if (other === view || sameGrid(other.body, view.body)) this.tell(other, near.hit, near.node);
  }

  private tell(view: View, hit: Hit, node: number | undefined) {
    const { grid } = view.body;
    const state = view.result.stateAt(this.timeline.time);
    const place = [0, 1, 2].slice(0, view.result.dimension).map((c) =>
      hit.weights.reduce((sum, w, k) => sum + (w === 0 ? 0 : w * grid.points[3 * grid.triangles[3 * hit.triangle + k] + c]), 0));
    const coordinate = (v: number) => shown(Math.abs(v) <= 1e-12 * view.body.size ? 0 : v, 5);
    const items = [item(place.map(coordinate).join(', '), 'm', node === undefined ? 'at' : `node ${grid.nodes[node]} at`)];
    const own = new Set<string>();
    const add = (field: Field, component: string) => {
      const values = field.values(component);
      const value = valueAt(grid, field, component, state, hit);
      own.add(`${field.name}.${component}`);
      const symbol = symbols[field.name] ?? field.name;
      const label = component === 'size' ? `|${symbol}|` : component ? `${symbol}_${component}` : symbol;
      items.push(item(shownWithin(value, values.error), unitWith(0, field.unit), label,
        { 'data-field': field.name, 'data-component': component, 'data-value': value }));
    };
    const field = this.fieldOf(view);
    if (field?.has(this.component)) add(field, this.component);
    for (const name of ['displacement', 'potential', 'temperature'])
      for (const component of view.result.field(name)?.components ?? [])
        if (component !== 'size' && !own.has(`${name}.${component}`)) add(view.result.field(name)!, component);
    view.readout.replaceChildren(...items);
    if (node !== undefined) view.readout.dataset.node = String(grid.nodes[node]);
    else delete view.readout.dataset.node;
  }
}

// OrbitControls measures angles about y; the body's up is z.
const turned = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(0, 1, 0));

function item(value: string, unit: string, label: string, data: Record<string, unknown> = {}): HTMLElement {
  return element('span', { class: 'value', ...data }, element('i', {}, label), ' ', value, ' ', element('small', {}, unit));
}

function sameGrid(a: Body, b: Body): boolean {
  return a.grid.triangles.length === b.grid.triangles.length && a.grid.points.length === b.grid.points.length;
}

/** The corner of the triangle that is hit, if the pointer is within a few pixels of it. */
function snapped(body: Body, hit: Hit, x: number, y: number, frame: DOMRect, camera: THREE.Camera):
  { hit: Hit; node?: number } {
  const corner = hit.weights.indexOf(Math.max(...hit.weights));
  const node = body.grid.triangles[3 * hit.triangle + corner];
  const places = body.project(camera);
  const away = Math.hypot(((places[3 * node] - x) / 2) * frame.width, ((places[3 * node + 1] - y) / 2) * frame.height);
  if (away > 5) return { hit };
  const weights: [number, number, number] = [0, 0, 0];
  weights[corner] = 1;
  return { hit: { triangle: hit.triangle, weights }, node };
}
