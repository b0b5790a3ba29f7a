// Axes with ticks and a scale bar for a plane body; the three axes of a solid one, as they lie.
import { Frame } from './frame';
import { Pen, Point } from './pen';
import { shown, thousands, unitWith } from './numbers';
import { colour } from './theme';
import * as THREE from 'three';

/** Room for numbers and names beside the body [pixels]. */
export const margins = { left: 52, bottom: 38 };

/** 1, 2 or 5 times a power of ten, at most `length`. */
export function roundLength(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  return [5, 2, 1].find((m) => m * power <= length * (1 + 1e-9))! * power;
}

/** Round numbers between the ends, so many pixels apart or a little more. */
export function ticks(low: number, high: number, pixels: number, apart: number): number[] {
  const least = ((high - low) * apart) / pixels;
  const step = [1, 2, 5, 10].map((m) => m * 10 ** Math.floor(Math.log10(least))).find((s) => s >= least)!;
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, i) => (first + i) * step);
}

/** Of an axis that a plane body is measured along: metres per pixel and the coordinate at pixel 0. */
function axis(frame: Frame, along: 0 | 1): { perPixel: number; zero: number } {
  // From the body's middle: of one far from the origin single precision would lose the places.
  const { body, camera } = frame;
  const ends = [0, 1].map((v) => {
    const [x, y] = body.project(camera.three, Float32Array.from([along === 0 ? v : 0, along === 1 ? v : 0, 0]));
    return frame.inPixels(x, y)[along];
  });
  const perPixel = body.size / (ends[1] - ends[0]);
  return { perPixel, zero: body.centre[along] - ends[0] * perPixel };
}

export function drawAxes(pen: Pen, frame: Frame) {
  const [x, y] = [axis(frame, 0), axis(frame, 1)];
  const left = margins.left, foot = pen.height - margins.bottom;
  const across: [number, number] = [x.zero + left * x.perPixel, x.zero + pen.width * x.perPixel];
  const up: [number, number] = [y.zero + foot * y.perPixel, y.zero];
  const power = thousands(frame.body.size);
  const [ink, muted] = [colour('--ink'), colour('--muted')];
  // Neighbours differ in the last digits, however far from the origin they are.
  const namesOf = (all: number[]) => {
    const farthest = Math.max(...all.map(Math.abs)), apart = all.length > 1 ? all[1] - all[0] : farthest;
    const digits = Math.max(5, Math.min(15, Math.floor(Math.log10(farthest / apart)) + 2));
    return all.map((v) => shown(Number((v / 10 ** power).toPrecision(digits)), digits));
  };
  pen.lines([[[left, 4], [left, foot], [pen.width - 4, foot]]], muted, 1);
  const along = ticks(...across, pen.width - left, 80), upwards = ticks(...up, foot, 50);
  const names = namesOf(along), upNames = namesOf(upwards);
  for (const [i, v] of along.entries()) {
    const at = (v - x.zero) / x.perPixel;
    if (at < left - 0.5 || at > pen.width - 20) continue;
    pen.lines([[[at, foot], [at, foot + 4]]], muted, 1);
    pen.words(names[i], [at, foot + 6], { colour: ink, align: 'center', baseline: 'top' });
  }
  for (const [i, v] of upwards.entries()) {
    const at = (v - y.zero) / y.perPixel;
    if (at > foot + 0.5 || at < 8) continue;
    pen.lines([[[left - 4, at], [left, at]]], muted, 1);
    pen.words(upNames[i], [left - 7, at], { colour: ink, align: 'right' });
  }
  pen.words(`x [${unitWith(power, 'm')}]`, [pen.width - 6, foot + 22], { colour: muted, align: 'right', baseline: 'top' });
  pen.words(`y [${unitWith(power, 'm')}]`, [left + 6, 6], { colour: muted, baseline: 'top', rim: colour('--card') });
}

/** A length of a quarter of the picture at most, below a plane body, beside a solid one. */
export function drawScaleBar(pen: Pen, frame: Frame) {
  const perPixel = metresPerPixel(frame);
  const length = roundLength((perPixel * pen.width) / 4);
  const power = thousands(length);
  const plane = frame.body.result.dimension === 2;
  const begin = plane ? margins.left : pen.width - 12 - length / perPixel, end = begin + length / perPixel;
  const foot = pen.height - (plane ? 4 : 8);
  const [ink, card] = [colour('--ink'), colour('--card')];
  const bar: Point[] = [[begin, foot - 5], [begin, foot], [end, foot], [end, foot - 5]];
  pen.lines([bar], card, 4.5);
  pen.lines([bar], ink, 2);
  pen.words(`${shown(length / 10 ** power, 3)} ${unitWith(power, 'm')}`, plane ? [end + 7, foot - 1] : [(begin + end) / 2, foot - 6],
    { colour: ink, rim: card, align: plane ? 'left' : 'center', baseline: 'bottom' });
}

export function metresPerPixel(frame: Frame): number {
  const { three } = frame.camera;
  return ((three.right - three.left) / three.zoom / frame.width) * frame.body.size;
}

/** Where x, y and z point to in the picture. */
export function drawTriad(pen: Pen, frame: Frame) {
  const turn = new THREE.Matrix3().setFromMatrix4(frame.camera.three.matrixWorldInverse).elements;
  const middle: Point = [44, pen.height - 44];
  const axes = ['x', 'y', 'z'].map((name, c) => ({ name, across: turn[3 * c], up: turn[3 * c + 1], towards: turn[3 * c + 2] }));
  const colours: Record<string, string> = { x: '#d9442f', y: '#2f9e4f', z: '#2f6fd9' };
  for (const { name, across, up } of axes.sort((a, b) => a.towards - b.towards)) {
    const at = (length: number): Point => [middle[0] + length * across, middle[1] - length * up];
    pen.lines([[middle, at(26)]], colour('--card'), 4.5);
    pen.lines([[middle, at(26)]], colours[name], 2.2);
    pen.words(name, at(36), { colour: colour('--ink'), rim: colour('--card'), align: 'center', bold: true });
  }
}
