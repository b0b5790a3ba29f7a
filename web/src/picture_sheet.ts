// A picture of a field to be saved: title, picture, colour bar and what is said below; in pixels, or with everything but
// the colours of the body as vectors.
import { mapHex } from './colours';
import { isolines } from './isolines';
import { Look } from './body';
import { Frame } from './frame';
import { Picture } from './picture';
import { CanvasPen, Pen, Point } from './pen';
import { SvgPen } from './svg_pen';
import { colour } from './theme';

export interface Caption { title: string; ticks: string[]; unit: string; note: string }

const above = 34, below = 66;

function drawCaption(pen: Pen, look: Look, { title, ticks, unit, note }: Caption) {
  const [ink, muted] = [colour('--ink'), colour('--muted')];
  pen.words(title, [12, above / 2 + 2], { colour: ink, bold: true });
  const foot = pen.height - below;
  pen.words(note, [pen.width / 2, foot + 54], { colour: muted, align: 'center' });
  if (!look.field) return pen.words(ticks.join(' '), [pen.width / 2, foot + 26], { colour: ink, align: 'center' });
  const left = pen.width * 0.15, width = pen.width * 0.6, pieces = 128, hex = mapHex(look.range.signed, look.bands);
  for (let i = 0; i < pieces; ++i) {
    const [x, end] = [left + (i * width) / pieces, left + ((i + 1) * width) / pieces + (i + 1 < pieces ? 0.4 : 0)];
    pen.surface([[x, foot + 8], [end, foot + 8], [end, foot + 20], [x, foot + 20]],
      '#' + hex.substr(6 * Math.round(((i + 0.5) / pieces) * 255), 6));
  }
  ticks.forEach((text, i) => pen.words(text, [left + (i / (ticks.length - 1)) * width, foot + 26],
    { colour: ink, align: 'center', baseline: 'top' }));
  pen.words(unit, [left + width + 26, foot + 14], { colour: muted });
}

/** The picture as it is on the screen, with its caption. */
export function pixelSheet(picture: Picture, look: Look, caption: Caption): Promise<Blob> {
  const { canvas } = picture, ratio = canvas.width / canvas.clientWidth;
  const sheet = document.createElement('canvas');
  sheet.width = canvas.width;
  sheet.height = canvas.height + Math.round((above + below) * ratio);
  const context = sheet.getContext('2d')!;
  context.fillStyle = colour('--card');
  context.fillRect(0, 0, sheet.width, sheet.height);
  context.drawImage(canvas, 0, Math.round(above * ratio));
  drawCaption(new CanvasPen(context, ratio), look, caption);
  return new Promise((done) => sheet.toBlob((blob) => done(blob!), 'image/png'));
}

function drawIsolines(pen: Pen, frame: Frame, look: Look) {
  const ends = frame.body.project(frame.camera.three, isolines(frame.body, look, look.levels!));
  const paths: Point[][] = [];
  for (let i = 0; i < ends.length; i += 6)
    paths.push([frame.inPixels(ends[i], ends[i + 1]), frame.inPixels(ends[i + 3], ends[i + 4])]);
  pen.lines(paths, '#000000', 1);
}

/** `upon` draws what lies upon the picture. */
export function vectorSheet(picture: Picture, look: Look, caption: Caption, upon: (pen: Pen, frame: Frame) => void): string {
  const plane = picture.body.result.dimension === 2;
  picture.show(plane ? { ...look, levels: [] } : look);
  const { canvas } = picture, width = canvas.clientWidth, height = canvas.clientHeight;
  const pen = new SvgPen(width, height + above + below);
  pen.pixels(canvas.toDataURL('image/png'), 0, above, width, height);
  // What is drawn upon the picture takes its size from the pen.
  const inner = new SvgPen(width, height);
  const frame = new Frame(picture.body, picture.camera, width, height);
  if (plane && look.levels?.length) drawIsolines(inner, frame, look);
  upon(inner, frame);
  pen.shifted(0, above, inner);
  drawCaption(pen, look, caption);
  return pen.text(colour('--card'));
}
