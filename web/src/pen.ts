// What is drawn upon a picture: lines, surfaces and words, onto a canvas here, into an SVG in svg_pen.ts.

export type Point = [x: number, y: number];

export interface Words {
  colour: string;
  /** a rim that keeps words readable on any colour */
  rim?: string;
  align?: 'left' | 'center' | 'right';
  baseline?: 'top' | 'middle' | 'bottom';
  bold?: boolean;
}

export interface Pen {
  readonly width: number;
  readonly height: number;
  /** each path by itself, all in one colour */
  lines(paths: Point[][], colour: string, width: number): void;
  surface(path: Point[], fill: string, rim?: string): void;
  words(text: string, at: Point, how: Words): void;
}

export const wordsSize = 12;

/** In the pixels of the page, whatever the canvas has of them. */
export class CanvasPen implements Pen {
  readonly width: number;
  readonly height: number;
  constructor(private readonly context: CanvasRenderingContext2D, ratio: number) {
    this.width = context.canvas.width / ratio;
    this.height = context.canvas.height / ratio;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.lineJoin = context.lineCap = 'round';
  }

  lines(paths: Point[][], colour: string, width: number) {
    const { context } = this;
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    for (const path of paths) path.forEach((at, i) => (i === 0 ? context.moveTo(...at) : context.lineTo(...at)));
    context.stroke();
  }

  surface(path: Point[], fill: string, rim?: string) {
    const { context } = this;
    context.beginPath();
    path.forEach((at, i) => (i === 0 ? context.moveTo(...at) : context.lineTo(...at)));
    context.closePath();
    context.fillStyle = fill;
    context.fill();
    if (!rim) return;
    context.strokeStyle = rim;
    context.lineWidth = 1.2;
    context.stroke();
  }

  words(text: string, at: Point, { colour, rim, align = 'left', baseline = 'middle', bold }: Words) {
    const { context } = this;
    context.font = `${bold ? '600 ' : ''}${wordsSize}px system-ui, sans-serif`;
    context.textAlign = align;
    context.textBaseline = baseline;
    if (rim) {
      context.strokeStyle = rim;
      context.lineWidth = 3;
      context.strokeText(text, ...at);
    }
    context.fillStyle = colour;
    context.fillText(text, ...at);
  }

  /** Back to the pixels of the canvas. */
  end() { this.context.setTransform(1, 0, 0, 1, 0, 0); }
}
