// One WebGL context draws every picture of the page; a picture is then copied to its own canvas, so that
// any number of them can stand side by side.
import * as THREE from 'three';

THREE.ColorManagement.enabled = false;

let renderer: THREE.WebGLRenderer | undefined;
let reason = '';

/** Why nothing can be drawn; empty when it can. */
export function obstacle(): string {
  if (renderer || reason) return reason;
  try {
    renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true });
    renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    renderer.autoClear = true;
    renderer.setClearColor(0x000000, 0);
  } catch {
    reason = 'The fields cannot be drawn: this browser has no WebGL, or it is switched off. ' +
      'The curves and tables below do not need it, and tourmaline figures DIR draws pictures without a browser.';
  }
  return reason;
}

/** Sizes a canvas to the pixels it covers; returns them, or undefined while it covers none. */
export function fitted(canvas: HTMLCanvasElement): { width: number; height: number; ratio: number } | undefined {
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
  if (width === 0 || height === 0) return undefined;
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  return { width, height, ratio };
}

/** Draws a scene into a canvas that `fitted` has sized. */
export function draw(scene: THREE.Scene, camera: THREE.Camera, canvas: HTMLCanvasElement) {
  if (!renderer) return;
  const { width, height } = canvas;
  const gl = renderer.domElement;
  if (gl.width < width || gl.height < height)
    renderer.setSize(Math.max(gl.width, width), Math.max(gl.height, height), false);
  renderer.setViewport(0, 0, width, height);
  renderer.setScissor(0, 0, width, height);
  renderer.setScissorTest(true);
  renderer.render(scene, camera);
  const context = canvas.getContext('2d')!;
  context.clearRect(0, 0, width, height);
  context.drawImage(gl, 0, gl.height - height, width, height, 0, 0, width, height);
}

/** A camera that shows a part of the scene around `target` in a canvas of any shape. */
export class Camera {
  readonly three = new THREE.OrthographicCamera(-1, 1, 1, -1, -100, 100);
  readonly target: THREE.Vector3;
  /** Room beside the body and below it [pixels of the page]. */
  inset = { left: 0, bottom: 0 };
  constructor(readonly dimension: 2 | 3, target: [number, number, number], private readonly halfWidth: number,
    private readonly halfHeight: number) {
    this.target = new THREE.Vector3(...target);
    this.reset();
  }

  reset() {
    this.three.zoom = 1;
    this.three.up.set(0, this.dimension === 3 ? 0 : 1, this.dimension === 3 ? 1 : 0);
    if (this.dimension === 3) this.three.position.set(-5, -7, 4.5);
    else this.three.position.set(0, 0, 10);
    this.three.position.add(this.target);
    this.three.lookAt(this.target);
  }

  /** Fits the frustum to a canvas that has `ratio` pixels for each of the page. */
  aim(width: number, height: number, ratio = 1) {
    const left = this.inset.left * ratio, bottom = this.inset.bottom * ratio;
    const aspect = (width - left) / (height - bottom);
    let up = this.halfHeight, across = this.halfWidth;
    if (across / up < aspect) across = up * aspect;
    else up = across / aspect;
    const pixel = (2 * across) / (width - left);
    Object.assign(this.three, { left: -across - left * pixel, right: across, top: up, bottom: -up - bottom * pixel });
    this.three.updateProjectionMatrix();
    this.three.updateMatrixWorld();
  }
}
