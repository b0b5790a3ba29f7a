// What pointer and keys do to the large view: they move the cameras and point at places, whose values are told.
import * as THREE from 'three';
import { Look } from './body';
import { stateAt } from './moments';
import { Point } from './pen';
import { Probing } from './probing';
import { drawRing, nextNode, Probed, snapped, tell } from './readout';
import { Field } from './results';
import { isSameMesh } from './same_mesh';
import { fitted } from './stage';
import { Timeline } from './timeline';
import { View } from './view';

/** What is shown, and how. */
interface Shown {
  readonly views: View[];
  readonly timeline: Timeline;
  readonly probing: Probing;
  readonly component: string;
  look(view: View): Look;
  fieldOf(view: View): Field | undefined;
  refresh(): void;
}

export class Pointing {
  /** what the readouts tell of, and whether a ring marks it */
  private probed?: Probed & { view: View; ring: boolean };

  constructor(private readonly of: Shown) {}

  /** Takes what happens on the canvas of a view. */
  listen(view: View) {
    const { canvas } = view.picture;
    canvas.addEventListener('keydown', (event) => this.key(view, event));
    canvas.addEventListener('pointermove', (event) => this.point(view, event));
    // Before the controls, which turn and shift.
    canvas.addEventListener('pointerdown', (event) => this.press(view, event), { capture: true });
    canvas.addEventListener('pointerup', () => this.release(view));
    // A finger that is lifted leaves as well: what it pointed at stays.
    canvas.addEventListener('pointerleave', (event) => { if (event.pointerType === 'mouse') this.forget(); });
  }

  /** Of bodies that are no more: without a word. */
  drop() { this.probed = undefined; }

  /** Marks what is pointed at, where that is to be seen. */
  mark(view: View, look: Look) {
    if (!this.isTold(view) || !this.probed!.ring || look.state < 0) return;
    const { canvas } = view.picture;
    this.aim(view);
    drawRing(canvas, view.body, this.probed!, view.camera.three, fitted(canvas)?.ratio ?? 1);
  }

  home(view: View) {
    view.camera.reset();
    for (const other of this.besides(view)) {
      other.controls.target.copy(view.camera.target);
      other.controls.update();
    }
    this.of.refresh();
  }

  /** The views that move with one, itself among them. */
  private besides(view: View): View[] { return this.of.views.filter((other) => other.camera === view.camera); }

  zoom(view: View, by: number) {
    view.camera.three.zoom = Math.min(200, Math.max(0.5, view.camera.three.zoom * by));
    this.of.refresh();
  }

  key(view: View, event: KeyboardEvent) {
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
    if (stateAt(view.result, this.of.timeline.time) < 0) return;
    this.aim(view);
    const from = this.probed?.view === view ? this.probed.node : undefined;
    const next = nextNode(view.body, from, across, up, view.camera.three);
    if (!next) return;
    this.probed = { ...next, view, ring: true };
    this.of.refresh();
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
    this.of.refresh();
  }

  /** Brings camera and body to what the picture of a view shows. */
  aim(view: View) {
    const frame = view.picture.canvas.getBoundingClientRect(), { state, scale } = this.of.look(view);
    view.camera.aim(frame.width, frame.height, 1);
    view.body.place(state, scale);
  }

  forget() {
    const ring = this.probed?.ring;
    this.probed = undefined;
    for (const view of this.of.views) this.sayProbed(view);
    if (ring) this.of.refresh();
  }

  /** Where the pointer is, in normalised device coordinates, and what of the body lies there. */
  private under(view: View, event: PointerEvent): { at: Point; near?: Probed } {
    const { state, scale } = this.of.look(view);
    const frame = view.picture.canvas.getBoundingClientRect();
    const x = ((event.clientX - frame.left) / frame.width) * 2 - 1;
    const y = 1 - ((event.clientY - frame.top) / frame.height) * 2;
    if (state < 0) return { at: [x, y] };
    view.camera.aim(frame.width, frame.height, 1);
    view.body.place(state, scale);
    const hit = view.body.pick(x, y, view.camera.three);
    return { at: [x, y], near: hit && snapped(view.body, hit, x, y, frame, view.camera.three) };
  }

  press(view: View, event: PointerEvent) {
    const { at, near } = this.under(view, event);
    const taken = this.of.probing.press(view.body, at, near?.hit);
    view.controls.enabled = !taken;
    if (taken) view.picture.canvas.setPointerCapture(event.pointerId);
    this.point(view, event);
  }

  release(view: View) {
    view.controls.enabled = true;
    const frame = view.picture.canvas.getBoundingClientRect();
    view.camera.aim(frame.width, frame.height, 1);
    this.of.probing.release(view.camera);
  }

  point(view: View, event: PointerEvent) {
    const { at, near } = this.under(view, event);
    this.of.probing.move(at);
    const ring = this.probed?.ring;
    this.probed = near && { ...near, view, ring: event.pointerType !== 'mouse' };
    if (ring || this.probed?.ring) this.of.refresh();
    else for (const other of this.of.views) this.sayProbed(other);
  }

  /** Whether what is pointed at is a place of this view's body too. */
  isTold(view: View): boolean {
    return !!this.probed && (view === this.probed.view || isSameMesh(view.body, this.probed.view.body));
  }

  // Of the moment that is shown, so again whenever that changes.
  sayProbed(view: View) {
    if (this.isTold(view))
      return tell(view.readout, view.body, this.probed!, this.of.timeline.time, this.of.fieldOf(view), this.of.component);
    view.readout.replaceChildren();
    delete view.readout.dataset.node;
  }
}

// OrbitControls measures angles about y; the body's up is z.
const turned = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(0, 1, 0));
