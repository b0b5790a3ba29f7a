// The large view: any field, any component, any moment; for two results with linked camera and range.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { Body, Look } from './body';
import { margins } from './axes';
import { canBeLogarithmic } from './colour_scale';
import { differenceOf } from './difference';
import { Display } from './display';
import { drawOverlay } from './overlay';
import { keepCamera } from './view_camera';
import { changed, keepControl } from './address';
import { cutBody } from './cut_body';
import { CutPlane } from './cut_plane';
import { Camera } from './stage';
import { Frame } from './frame';
import { Pen } from './pen';
import { Pointing } from './pointing';
import { Probing } from './probing';
import { Caption, pixelSheet, vectorSheet } from './picture_sheet';
import { fileName, save, saveButtons, saveText } from './save';
import { vectorNames } from './vectors';
import { Field } from './results';
import { Picture } from './picture';
import { ColourBar } from './colour_bar';
import { colourRange, Range } from './colours';
import { choice, element, tick } from './dom';
import { HandRange } from './hand_range';
import { isReached, notReached, stateAt, strayMoment } from './moments';
import { Extremes, Found, peaks, shownRange, wholeRange } from './shown_range';
import { fieldTitle, shown, symbols } from './numbers';
import { Drawing } from './on_screen';
import { camerasOf } from './overview';
import { Timeline } from './timeline';
import { View } from './view';

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
  readonly views: View[];
  private readonly componentChoice: ReturnType<typeof choice>;
  private readonly fieldChoice: ReturnType<typeof choice>;
  readonly display: Display;
  readonly probing: Probing;
  private readonly cut: CutPlane;
  private readonly hand = new HandRange(() => this.refresh());
  private readonly pointing = new Pointing(this);

  constructor(bodies: Body[], readonly timeline: Timeline) {
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
    this.pointing.drop();
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
    this.pointing.listen(view);
    return view;
  }

  private frame(view: View): HTMLElement {
    const zoom = (by: number) => () => this.pointing.zoom(view, by);
    const buttons = element('div', { class: 'zoom' },
      element('button', { type: 'button', 'aria-label': 'closer', onclick: zoom(1.4) }, '+'),
      element('button', { type: 'button', 'aria-label': 'farther', onclick: zoom(1 / 1.4) }, '−'),
      element('button', { type: 'button', 'aria-label': 'whole body', onclick: () => this.pointing.home(view) }, '⤢'));
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

  fieldOf(view: View): Field | undefined { return view.result.field(this.field); }

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

  look(view: View): Look {
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
    this.pointing.sayProbed(view);
    this.pointing.mark(view, look);
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

}
