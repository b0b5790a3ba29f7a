// Lines, surfaces and words as an SVG.
import { Pen, Point, Words, wordsSize } from './pen';

const escaped = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const at = ([x, y]: Point) => `${Number(x.toFixed(2))} ${Number(y.toFixed(2))}`;
const along = (path: Point[]) => path.map((p, i) => (i === 0 ? 'M' : 'L') + at(p)).join('');
const anchors = { left: 'start', center: 'middle', right: 'end' };
const shifts = { top: '0.8em', middle: '0.35em', bottom: '-0.2em' };

export class SvgPen implements Pen {
  private readonly pieces: string[] = [];
  constructor(readonly width: number, readonly height: number) {}

  lines(paths: Point[][], colour: string, width: number, dashes?: string) {
    if (paths.length === 0) return;
    this.pieces.push(`<path d="${paths.map(along).join('')}" fill="none" stroke="${colour}" stroke-width="${width}" ` +
      `stroke-linecap="${dashes ? 'butt' : 'round'}" stroke-linejoin="round"${dashes ? ` stroke-dasharray="${dashes}"` : ''}/>`);
  }

  surface(path: Point[], fill: string, rim?: string) {
    this.pieces.push(`<path d="${along(path)}Z" fill="${fill}"${rim ? ` stroke="${rim}" stroke-width="1.2"` : ''}/>`);
  }

  words(text: string, [x, y]: Point, { colour, rim, align = 'left', baseline = 'middle', bold }: Words) {
    const shared = `x="${x.toFixed(2)}" y="${y.toFixed(2)}" dy="${shifts[baseline]}" text-anchor="${anchors[align]}"` +
      (bold ? ' font-weight="600"' : '');
    if (rim) this.pieces.push(`<text ${shared} stroke="${rim}" stroke-width="3" fill="none">${escaped(text)}</text>`);
    this.pieces.push(`<text ${shared} fill="${colour}">${escaped(text)}</text>`);
  }

  /** A picture in pixels over a part of the sheet. */
  pixels(url: string, x: number, y: number, width: number, height: number) {
    this.pieces.push(`<image href="${url}" x="${x}" y="${y}" width="${width}" height="${height}"/>`);
  }

  /** All of another sheet, shifted. */
  shifted(x: number, y: number, other: SvgPen) {
    this.pieces.push(`<g transform="translate(${x} ${y})">`, ...other.pieces, '</g>');
  }

  text(paper?: string): string {
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${this.width}" height="${this.height}" ` +
      `viewBox="0 0 ${this.width} ${this.height}" font-family="system-ui, sans-serif" font-size="${wordsSize}">` +
      (paper ? `<rect width="100%" height="100%" fill="${paper}"/>` : '') + this.pieces.join('\n') + '</svg>\n';
  }
}
