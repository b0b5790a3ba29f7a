// What lies upon the picture of a field: axes, scale bar, arrows, marks.
import { drawAxes, drawScaleBar, drawTriad } from './axes';
import { Look } from './body';
import { Display } from './display';
import { drawExtremes } from './extreme_marks';
import { Frame } from './frame';
import { Pen } from './pen';
import { drawVectors } from './vectors';

/** Says what is to be said of it. */
export function drawOverlay(pen: Pen, frame: Frame, look: Look, display: Display, time: number): string {
  const said = display.arrows ? drawVectors(pen, frame, display.arrows, look.state, time) : '';
  if (display.marks) drawExtremes(pen, frame, look);
  if (!display.axes) return said;
  if (frame.body.result.dimension === 2) drawAxes(pen, frame);
  else drawTriad(pen, frame);
  drawScaleBar(pen, frame);
  return said;
}
