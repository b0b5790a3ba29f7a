// What is off the screen is not drawn: it is marked, and drawn when it comes there, or before it is printed.

const all: Drawing[] = [];
const waiting = new Set<Drawing>();
const of = new WeakMap<Element, Drawing>();
let asked = false;

const observer = new IntersectionObserver((entries) => {
  for (const entry of entries) of.get(entry.target)?.seen(entry.isIntersecting);
}, { rootMargin: '60px' });
const sizes = new ResizeObserver((entries) => { for (const entry of entries) of.get(entry.target)?.ask(); });

/** Draws once before the next frame, however often it is asked, and only while `place` is on the screen. */
export class Drawing {
  private onScreen = false;
  private stale = true;

  constructor(place: Element, private readonly draw: () => void) {
    all.push(this);
    of.set(place, this);
    observer.observe(place);
    sizes.observe(place);
  }

  ask() {
    this.stale = true;
    this.queue();
  }

  seen(onScreen: boolean) {
    this.onScreen = onScreen;
    this.queue();
  }

  /** Now, wherever it stands. */
  finish() {
    if (!this.stale) return;
    this.stale = false;
    this.draw();
  }

  private queue() {
    if (!this.onScreen || !this.stale) return;
    waiting.add(this);
    if (asked) return;
    asked = true;
    requestAnimationFrame(drawAll);
  }
}

function drawAll() {
  asked = false;
  const now = [...waiting];
  waiting.clear();
  for (const drawing of now) drawing.finish();
}

/** Also what is off the screen, now: paper has all of it. */
export function drawEverything() { for (const drawing of all) drawing.finish(); }
