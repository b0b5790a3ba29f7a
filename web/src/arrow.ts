// Arrows along the poling, in pixels. The counterpart of Figure::arrow in src/report/figure.cc.
import { element } from './dom';
import { colour } from './theme';

type Point = [x: number, y: number];

/** With a rim in the colour of the paper, as it may lie on any colour. */
export function arrow(context: CanvasRenderingContext2D, tail: Point, tip: Point, ratio: number) {
  const length = Math.max(Math.hypot(tip[0] - tail[0], tip[1] - tail[1]), 1e-9);
  const x = (tip[0] - tail[0]) / length, y = (tip[1] - tail[1]) / length;
  const head = Math.min(6 * ratio, 0.55 * length);
  const beside = (side: number): Point =>
    [tip[0] - head * (x - 0.42 * side * y), tip[1] - head * (y + 0.42 * side * x)];
  const path = new Path2D();
  path.moveTo(...tail);
  path.lineTo(...beside(0));
  const point = new Path2D();
  point.moveTo(...tip);
  point.lineTo(...beside(1));
  point.lineTo(...beside(-1));
  point.closePath();
  context.lineCap = context.lineJoin = 'round';
  context.strokeStyle = colour('--card');
  context.lineWidth = 3.2 * ratio;
  context.stroke(path);
  context.stroke(point);
  context.strokeStyle = context.fillStyle = colour('--ink');
  context.lineWidth = 1.3 * ratio;
  context.stroke(path);
  context.fill(point);
}

/** The same for a legend, in the colour of its text. */
export function arrowMark(): HTMLElement {
  return element('span', { class: 'mark', 'aria-hidden': 'true' }, '→');
}
