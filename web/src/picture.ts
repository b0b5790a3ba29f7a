// One picture of a body: a canvas with the field, the mesh and, in the plane, the boundaries.
import { inOrderOfPainting } from './setting';
import { arrow } from './arrow';
import { Body, Look } from './body';
import { Camera, draw, fitted } from './stage';
import { element } from './dom';
import { Frame } from './frame';
import { notReached } from './moments';
import { CanvasPen, Pen } from './pen';
import { colour } from './theme';

export class Picture {
  readonly canvas = element('canvas', {});
  constructor(public body: Body, readonly camera: Camera, private readonly boundaries?: Map<string, string>) {}

  show(look: Look, upon?: (pen: Pen, frame: Frame) => void) {
    const size = fitted(this.canvas);
    if (!size) return;
    if (look.state < 0) return this.say(look.missing ?? notReached(this.body.result), size.ratio);
    this.camera.aim(size.width, size.height, size.ratio);
    this.body.set(look, colour('--ink'), colour('--body'));
    const solid = this.body.result.dimension === 3;
    this.body.showSetting(solid && !!this.boundaries);
    draw(this.body.scene, this.camera.three, this.canvas);
    if (this.boundaries && !solid) this.outline(this.boundaries, 3.5 * size.ratio);
    else if (!solid) this.outline(undefined, size.ratio);
    if (this.boundaries) this.poling(size.ratio);
    if (upon) this.cover(size.ratio, upon);
  }

  private cover(ratio: number, upon: (pen: Pen, frame: Frame) => void) {
    const pen = new CanvasPen(this.canvas.getContext('2d')!, ratio);
    upon(pen, new Frame(this.body, this.camera, pen.width, pen.height));
    pen.end();
  }

  /** A text in place of the picture. */
  private say(text: string, ratio: number) {
    const context = this.canvas.getContext('2d')!;
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.fillStyle = colour('--muted');
    context.font = `${13 * ratio}px system-ui, sans-serif`;
    context.textAlign = 'center';
    context.fillText(text, this.canvas.width / 2, this.canvas.height / 2, 0.95 * this.canvas.width);
  }

  // Only places that are seen from the first position of the camera have an arrow, and the setting keeps it.
  private poling(ratio: number) {
    const { body, canvas } = this;
    if (!body.result.poling) return;
    const ends = body.project(this.camera.three, body.inScene(body.result.poling));
    const at = (i: number): [number, number] =>
      [((ends[i] + 1) / 2) * canvas.width, ((1 - ends[i + 1]) / 2) * canvas.height];
    for (let i = 0; i < ends.length; i += 6) arrow(canvas.getContext('2d')!, at(i), at(i + 3), ratio);
  }

  private outline(colours: Map<string, string> | undefined, width: number) {
    const context = this.canvas.getContext('2d')!;
    const places = this.body.project(this.camera.three);
    const x = (node: number) => ((places[3 * node] + 1) / 2) * this.canvas.width;
    const y = (node: number) => ((1 - places[3 * node + 1]) / 2) * this.canvas.height;
    context.lineWidth = width;
    context.lineCap = 'round';
    for (const boundary of inOrderOfPainting(this.body.result, colours)) {
      context.strokeStyle = colours?.get(boundary.name) ?? colour('--outline');
      context.beginPath();
      for (const facet of boundary.facets) {
        context.moveTo(x(facet[0]), y(facet[0]));
        for (const node of facet.subarray(1)) context.lineTo(x(node), y(node));
      }
      context.stroke();
    }
  }
}
