// Where the nodes of a body stand in a picture, in the picture's pixels.
import { Body } from './body';
import { Camera } from './stage';
import { Point } from './pen';

export class Frame {
  /** normalised device coordinates of all nodes, three numbers each */
  readonly nodes: Float32Array;
  constructor(readonly body: Body, readonly camera: Camera, readonly width: number, readonly height: number) {
    this.nodes = body.project(camera.three);
  }

  node(i: number): Point { return this.inPixels(this.nodes[3 * i], this.nodes[3 * i + 1]); }

  inPixels(x: number, y: number): Point { return [((x + 1) / 2) * this.width, ((1 - y) / 2) * this.height]; }
}
