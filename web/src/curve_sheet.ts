// Curves as a drawing: what an SVG of a chart holds.
import { ticks } from './axes';
import { shown } from './numbers';
import { Point } from './pen';
import { SvgPen } from './svg_pen';
import { colour } from './theme';

export interface SheetCurve { label: string; colour: string; points: (Point | null)[]; dashed?: boolean; bars?: boolean }

export interface Sheet {
  title: string;
  x: { label: string; ends: [number, number] };
  y: { label: string; ends: [number, number] };
  curves: SheetCurve[];
}

const size = { width: 640, height: 400, left: 66, right: 20, top: 36, bottom: 48 };

/** Pieces between gaps. */
function pieces(points: (Point | null)[]): Point[][] {
  const all: Point[][] = [[]];
  for (const point of points) if (point) all[all.length - 1].push(point); else all.push([]);
  return all.filter((piece) => piece.length > 0);
}

function drawFrame(pen: SvgPen, { title, x, y }: Sheet, at: (p: Point) => Point) {
  const [ink, muted, grid] = [colour('--ink'), colour('--muted'), colour('--grid')];
  pen.words(title, [size.left, 16], { colour: ink, bold: true });
  for (const v of ticks(...x.ends, size.width - size.left - size.right, 80)) {
    const foot = at([v, y.ends[0]]);
    pen.lines([[foot, at([v, y.ends[1]])]], grid, 1);
    pen.words(shown(v, 4), [foot[0], foot[1] + 6], { colour: muted, align: 'center', baseline: 'top' });
  }
  for (const v of ticks(...y.ends, size.height - size.top - size.bottom, 45)) {
    const left = at([x.ends[0], v]);
    pen.lines([[left, at([x.ends[1], v])]], grid, 1);
    pen.words(shown(v, 4), [left[0] - 6, left[1]], { colour: muted, align: 'right' });
  }
  pen.words(x.label, [size.width - size.right, size.height - 24], { colour: muted, align: 'right', baseline: 'top' });
  pen.words(y.label, [size.left - 6, size.top - 4], { colour: muted, align: 'right', baseline: 'bottom' });
}

/** Names in the colours of their curves, from the right. */
function drawKey(pen: SvgPen, curves: SheetCurve[]) {
  let right = size.width - size.right;
  for (const { label, colour: own } of [...curves].reverse()) {
    pen.words(label, [right, 16], { colour: own, align: 'right', bold: true });
    right -= 7.5 * label.length + 14;
  }
}

export function curveSheet(sheet: Sheet): string {
  const { x, y } = sheet, pen = new SvgPen(size.width, size.height);
  const across = size.width - size.left - size.right, up = size.height - size.top - size.bottom;
  const at = ([u, v]: Point): Point => [size.left + ((u - x.ends[0]) / (x.ends[1] - x.ends[0])) * across,
    size.height - size.bottom - ((v - y.ends[0]) / (y.ends[1] - y.ends[0])) * up];
  drawFrame(pen, sheet, at);
  for (const { points, colour: own, bars, dashed } of sheet.curves) {
    const placed = points.map((p) => (p ? at(p) : null));
    if (bars) for (const p of placed) p && pen.lines([[p, [p[0], at([0, 0])[1]]]], own, Math.max(2, (0.6 * across) / placed.length));
    else pen.lines(pieces(placed), own, 1.8, dashed ? '6 4' : undefined);
  }
  if (sheet.curves.length > 1) drawKey(pen, sheet.curves);
  return pen.text(colour('--card'));
}
