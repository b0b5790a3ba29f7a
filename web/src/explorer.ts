// The large view: any field, any component, any moment; for two results with linked camera and range.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { Body, Look } from './body';
import { margins } from './axes';
import { canBeLogarithmic } from './colour_scale';
import { differenceOf } from './difference';
import { isSameMesh } from './same_mesh';
import { Display } from './display';
import { drawOverlay } from './overlay';
import { keepCamera } from './view_camera';
import { changed, keepControl } from './address';
import { cutBody } from './cut_body';
import { CutPlane } from './cut_plane';
import { Camera, fitted } from './stage';
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
import { HandRange } from './hand_range';
import { isReached, notReached, stateAt, strayMoment } from './moments';
import { drawRing, nextNode, Probed, snapped, tell } from './readout';
import { Extremes, Found, peaks, shownRange, wholeRange } from './shown_range';
import { fieldTitle, shown, symbols } from './numbers';
import { Drawing } from './on_screen';
import { camerasOf } from './overview';
import { Timeline } from './timeline';

interface View {
  /** the body, and what of it is shown */
  whole: Body;
  result: Result;
  body: Body;
  picture: Picture;
  camera: Camera;
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
  private linked = true;
  private sameScale = false;
  private light = false;
  private stretch = 1;
  /** typed, the same for all bodies; undefined: `stretch` times what suits each */
  private magnification?: number;
  private mesh: boolean;
  private readonly views: View[];
  private readonly componentChoice: ReturnType<typeof choice>;
  private readonly fieldChoice: ReturnType<typeof choice>;
  readonly display: Display;
  private readonly probing: Probing;
  private readonly cut: CutPlane;
  private readonly hand = new HandRange(() => this.refresh());
  /** what the readouts tell of, and whether a ring marks it */
  private probed?: Probed & { view: View; ring: boolean };

  constructor(bodies: Body[], private readonly timeline: Timeline) {
    const first = bodies[0].result;
    this.mesh = first.grid!.cells.length <= mostCellsWithMesh;
    this.field = first.field('potential')?.name ?? first.fields[0].name;
    const cameras = camerasOf(bodies);
    this.views = bodies.map((body, i) => this.view(body, cameras[i]));
    const less = bodies.length === 2 ? differenceOf(bodies[0], bodies[1]) : undefined;
    if (less) this.views.push(this.view(less.body, cameras[0], less.said));
    this.probing = new Probing(bodies, timeline, () => this, () => this.refresh());
    timeline.onChange(() => this.probing.update());
    this.display = new Display(vectorNames(bodies.map((b) => b.result)));
    this.display.onChange(() => this.showOtherwise());
    const names = new Set(bodies.flatMap((body) => body.result.fields.map((f) => f.name)));
    this.fieldChoice = choice('Field', [...names].map((name) => [name, fieldTitle(name)]), this.field,
      (name) => this.choose(name));
    this.fieldChoice.select.id = 'field';
    this.componentChoice = choice('Component', [], '', (c) => { this.component = c; this.useHand(); this.probing.update(); this.refresh(); });
    this.componentChoice.select.id = 'component';
    this.cut = new CutPlane(bodies, () => this.recut());
    this.display.box.append(this.cut.box, this.probing.control);
    this.box = element('div', {}, this.toolbar(), this.display.box,
      element('div', { class: `views views-${bodies.length}` }, ...this.views.map((v) => this.frame(v))), this.probing.box);
    this.choose(this.field);
    this.showOtherwise();
    this.keepAll();
  }

  choose(name: string) {
    this.field = name;
    this.fieldChoice.select.value = name;
    const components = this.componentsOf(name);
    this.component = components[0];
    this.componentChoice.box.hidden = components.length === 1;
    this.componentChoice.select.replaceChildren(...components.map((c) =>
      element('option', { value: c }, c === 'size' ? `|${symbols[name] ?? name}|` : c)));
    this.useHand();
    this.probing.update();
    this.refresh();
  }

  /** In the first run that has the field. */
  private componentsOf(name: string): string[] {
    return this.views.find((view) => view.result.field(name))!.result.field(name)!.components;
  }

  // Limits are those of one quantity: 0.03 V are not 0.03 K.
  private useHand() {
    if (this.rangeOver !== 'hand') return;
    this.hand.use(`${this.field} ${this.component}`, () => {
      const view = this.views.find((one) => this.fieldOf(one)) ?? this.views[0], field = this.fieldOf(view);
      return field ? shownRange(this.valuesOf(this.sharing(view)), field) : colourRange(0, 0);
    });
  }

  /** Shows what the plane leaves of the bodies. */
  private recut() {
    const { plane } = this.cut, own = this.views.filter((view) => view.less === undefined);
    for (const view of own) this.become(view, plane ? cutBody(view.whole, plane) : view.whole);
    for (const view of this.views.filter((v) => v.less !== undefined))
      this.become(view, plane ? differenceOf(own[0].body, own[1].body, view.whole)!.body : view.whole);
    this.probed = undefined;
    this.probing.become(own.map((view) => view.body));
    this.refresh();
  }

  private become(view: View, body: Body) {
    if (view.body !== view.whole && view.body !== body) view.body.dispose();
    view.body = view.picture.body = body;
    view.result = body.result;
  }

  refresh() {
    for (const view of this.views) view.drawing.ask();
    changed();
  }

  /** What of it stands in the address. */
  private keepAll() {
    this.cut.keep();
    keepControl('field', this.fieldChoice.select);
    keepControl('component', this.componentChoice.select, () => this.componentsOf(this.field)[0]);
    this.box.querySelectorAll<HTMLInputElement>('.toolbar:not(.further) :is(#range, #stretch, #magnification, .tick input, .hand input)')
      .forEach((control) => keepControl(control.id || control.getAttribute('aria-label') || control.parentElement!.textContent!, control));
    const cameras = [...new Set(this.views.map((view) => view.camera))];
    cameras.forEach((camera, i) => keepCamera(i === 0 ? 'camera' : `camera${i + 1}`, camera,
      this.views.filter((view) => view.camera === camera).map((view) => view.controls), () => this.refresh()));
  }

  private showOtherwise() {
    for (const { camera } of this.views)
      camera.inset = camera.dimension === 2 && this.display.axes ? margins : { left: 0, bottom: 0 };
    this.refresh();
  }

  private view(body: Body, camera: Camera, less?: string): View {
    const picture = new Picture(body, camera);
    const { canvas } = picture;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', `field of ${body.result.title}; arrow keys, plus, minus and 0 move the view, ` +
      'arrow keys with shift go from node to node for values');
    const controls = new OrbitControls(camera.three, canvas);
    controls.target.copy(camera.target);
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
    const view: View = {
      whole: body, result: body.result, body, picture, camera, controls, less, bar: new ColourBar(),
      note: element('p', { class: 'note' }), readout: element('div', { class: 'readout', role: 'status' }),
      drawing: new Drawing(canvas, () => this.draw(view)),
    };
    canvas.addEventListener('keydown', (event) => this.key(view, event));
    canvas.addEventListener('pointermove', (event) => this.point(view, event));
    // Before the controls, which turn and shift.
    canvas.addEventListener('pointerdown', (event) => this.press(view, event), { capture: true });
    canvas.addEventListener('pointerup', () => this.release(view));
    // A finger that is lifted leaves as well: what it pointed at stays.
    canvas.addEventListener('pointerleave', (event) => { if (event.pointerType === 'mouse') this.forget(); });
    return view;
  }

  private frame(view: View): HTMLElement {
    const zoom = (by: number) => () => this.zoom(view, by);
    const buttons = element('div', { class: 'zoom' },
      element('button', { type: 'button', 'aria-label': 'closer', onclick: zoom(1.4) }, '+'),
      element('button', { type: 'button', 'aria-label': 'farther', onclick: zoom(1 / 1.4) }, '−'),
      element('button', { type: 'button', 'aria-label': 'whole body', onclick: () => this.home(view) }, '⤢'));
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
        this.rangeOver = over as 'all';
        this.hand.box.hidden = over !== 'hand';
        this.useHand();
        this.refresh();
      });
    range.select.id = 'range';
    return element('div', { class: 'toolbar' }, this.fieldChoice.box, this.componentChoice.box, range.box, this.hand.box,
      element('label', { class: 'control' }, element('span', {}, 'Deformation'), stretch),
      element('label', { class: 'control' }, element('span', {}, 'or displacement ×'), typed),
      tick('mesh', this.mesh, (on) => { this.mesh = on; this.refresh(); }),
      this.views.some(({ body }) => body.result.dimension === 3) &&
        tick('light', false, (on) => { this.light = on; this.refresh(); }),
      this.views.length > 1 && tick('same colours', true, (on) => { this.linked = on; this.refresh(); }),
      this.views.length > 1 && tick('same magnification', false, (on) => { this.sameScale = on; this.refresh(); }),
      this.differenceTick());
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

  private fieldOf(view: View): Field | undefined { return view.result.field(this.field); }

  /** Of the views that share their colours. */
  private valuesOf(views: View[]): Found {
    const found = { all: nothing(), usual: nothing(), error: 0, belowRoundOff: true };
    for (const view of views) {
      const field = this.fieldOf(view);
      if (!field?.has(this.component)) continue;
      const state = stateAt(view.result, this.timeline.time);
      if (this.rangeOver === 'step' && state < 0) continue;
      found.belowRoundOff &&= field.belowRoundOff;
      for (const values of field.ranges(this.component)) {
        include(found.all, this.rangeOver === 'step' ? values.of(state) : values);
        // Nothing is cut off an unknown.
        include(found.usual, field.isUnknown ? found.all : values.usual(peaks, this.rangeOver === 'step' ? state : undefined));
        found.error = Math.max(found.error, values.error);
      }
    }
    return found;
  }

  /** The views whose colours mean the same as those of this one. */
  private sharing(view: View): View[] {
    return this.linked && view.less === undefined ? this.views.filter((other) => other.less === undefined) : [view];
  }

  private range(view: View): Range {
    const field = this.fieldOf(view);
    if (!field) return { ...colourRange(0, 0), instead: view.less === undefined ? 'not in this run' : 'not in both runs' };
    const found = this.valuesOf(this.sharing(view));
    if (this.rangeOver === 'hand' && view.less === undefined) return this.hand.range(found.all);
    return this.rangeOver === 'peaks' ? wholeRange(found, field) : shownRange(found, field);
  }

  /** The magnification of displacements: of all views, if it is to be the same, what none of them is folded by. */
  private scale(view: View): number {
    const views = this.sameScale ? this.views.filter((other) => other.less === undefined) : [view];
    return this.magnification ?? this.stretch * Math.min(...views.map(({ body }) => body.suitableScale));
  }

  private look(view: View): Look {
    const field = this.fieldOf(view);
    const range = this.range(view);
    // A difference is there only where both runs are.
    const needed = view.less === undefined ? [view] : this.views;
    const ended = needed.find((other) => !isReached(other.result, this.timeline.time));
    const isCutOff = needed.some((other) => other.body.grid.triangles.length === 0);
    return {
      state: ended || isCutOff ? -1 : stateAt(view.result, this.timeline.time),
      missing: ended ? notReached(ended.result) : isCutOff ? 'nothing of the body lies on this side of the plane' : undefined, scale: this.scale(view), mesh: this.mesh,
      field: field?.has(this.component) && !range.instead ? field : undefined, component: this.component,
      range: { ...range, logarithmic: this.display.logarithmic && canBeLogarithmic(range) },
      bands: this.display.bands, levels: this.display.levels, light: this.light,
    };
  }

  private draw(view: View) {
    if (view.result.dimension === 2) view.picture.canvas.style.touchAction = this.probing.tool === 'line' ? 'none' : 'pan-y';
    const look = this.look(view);
    let said = '';
    view.picture.show(look, (pen, frame) => { said = this.cover(pen, frame, look); });
    view.bar.show(look.range, this.fieldOf(view)?.unit ?? '', look.bands);
    const { origin } = this.fieldOf(view) ?? { origin: '' };
    const parts = [look.scale === 0 ? 'not deformed' : `displacement × ${shown(look.scale, 2)}`,
      origin && `values: ${origin}`, said, view.less, look.missing ?? strayMoment(view.result, this.timeline.time)];
    view.note.textContent = parts.filter((part) => part).join(' · ');
    this.sayProbed(view);
    const { canvas } = view.picture;
    if (!this.isTold(view) || !this.probed!.ring || look.state < 0) return;
    this.aim(view);
    drawRing(canvas, view.body, this.probed!, view.camera.three, fitted(canvas)?.ratio ?? 1);
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

  private home(view: View) {
    view.camera.reset();
    for (const other of this.besides(view)) {
      other.controls.target.copy(view.camera.target);
      other.controls.update();
    }
    this.refresh();
  }

  /** The views that move with one, itself among them. */
  private besides(view: View): View[] { return this.views.filter((other) => other.camera === view.camera); }

  private zoom(view: View, by: number) {
    view.camera.three.zoom = Math.min(200, Math.max(0.5, view.camera.three.zoom * by));
    this.refresh();
  }

  private key(view: View, event: KeyboardEvent) {
    const turns: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1],
    };
    if (event.key === '+' || event.key === '=') this.zoom(view, 1.2);
    else if (event.key === '-') this.zoom(view, 1 / 1.2);
    else if (event.key === '0') this.home(view);
    else if (event.key === 'Escape' && this.probed) this.forget();
    else if (turns[event.key] && event.shiftKey) this.step(view, ...turns[event.key]);
    else if (turns[event.key]) this.move(view, ...turns[event.key]);
    else return;
    event.preventDefault();
  }

  // From node to node.
  private step(view: View, across: number, up: number) {
    if (stateAt(view.result, this.timeline.time) < 0) return;
    this.aim(view);
    const from = this.probed?.view === view ? this.probed.node : undefined;
    const next = nextNode(view.body, from, across, up, view.camera.three);
    if (!next) return;
    this.probed = { ...next, view, ring: true };
    this.refresh();
  }

  // Turns a solid body, shifts a plane one.
  private move(view: View, across: number, up: number) {
    const camera = view.camera.three;
    const { target } = view.controls;
    const views = this.besides(view);
    if (view.camera.dimension === 3) {
      const place = new THREE.Spherical().setFromVector3(
        camera.position.clone().sub(target).applyQuaternion(turned));
      place.theta -= 0.15 * across;
      place.phi = Math.min(Math.PI - 0.05, Math.max(0.05, place.phi - 0.15 * up));
      camera.position.setFromSpherical(place).applyQuaternion(turned.clone().invert()).add(target);
      camera.lookAt(target);
    } else {
      const shift = new THREE.Vector3(-0.08 * across, -0.08 * up, 0).divideScalar(camera.zoom);
      camera.position.add(shift);
      for (const other of views) other.controls.target.add(shift);
    }
    for (const other of views) other.controls.update();
    this.refresh();
  }

  /** Brings camera and body to what the picture of a view shows. */
  private aim(view: View) {
    const frame = view.picture.canvas.getBoundingClientRect(), { state, scale } = this.look(view);
    view.camera.aim(frame.width, frame.height, 1);
    view.body.place(state, scale);
  }

  private forget() {
    const ring = this.probed?.ring;
    this.probed = undefined;
    for (const view of this.views) this.sayProbed(view);
    if (ring) this.refresh();
  }

  /** Where the pointer is, in normalised device coordinates, and what of the body lies there. */
  private under(view: View, event: PointerEvent): { at: Point; near?: Probed } {
    const { state, scale } = this.look(view);
    const frame = view.picture.canvas.getBoundingClientRect();
    const x = ((event.clientX - frame.left) / frame.width) * 2 - 1;
    const y = 1 - ((event.clientY - frame.top) / frame.height) * 2;
    if (state < 0) return { at: [x, y] };
    view.camera.aim(frame.width, frame.height, 1);
    view.body.place(state, scale);
    const hit = view.body.pick(x, y, view.camera.three);
    return { at: [x, y], near: hit && snapped(view.body, hit, x, y, frame, view.camera.three) };
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
    view.camera.aim(frame.width, frame.height, 1);
    this.probing.release(view.camera);
  }

  private point(view: View, event: PointerEvent) {
    const { at, near } = this.under(view, event);
    this.probing.move(at);
    const ring = this.probed?.ring;
    this.probed = near && { ...near, view, ring: event.pointerType !== 'mouse' };
    if (ring || this.probed?.ring) this.refresh();
    else for (const other of this.views) this.sayProbed(other);
  }

  /** Whether what is pointed at is a place of this view's body too. */
  private isTold(view: View): boolean {
    return !!this.probed && (view === this.probed.view || isSameMesh(view.body, this.probed.view.body));
  }

  // Of the moment that is shown, so again whenever that changes.
  private sayProbed(view: View) {
    if (this.isTold(view))
      return tell(view.readout, view.body, this.probed!, this.timeline.time, this.fieldOf(view), this.component);
    view.readout.replaceChildren();
    delete view.readout.dataset.node;
  }
}

// OrbitControls measures angles about y; the body's up is z.
const turned = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(0, 1, 0));
