// How moments follow each other: single steps, speed, over and over.
import { changed, keepControl } from './address';
import { choice, element, tick } from './dom';
import { Timeline } from './timeline';

export function playback(timeline: Timeline): HTMLElement {
  const step = (by: number, name: string, sign: string) => element('button', { type: 'button', class: 'step', 'aria-label': name,
    onclick: () => timeline.goOn(by) }, sign);
  const speed = choice('', [['0.25', '¼ ×'], ['0.5', '½ ×'], ['1', '1 ×'], ['2', '2 ×'], ['4', '4 ×']], '1',
    (value) => { timeline.setSpeed(Number(value)); changed(); });
  speed.select.id = 'speed';
  speed.select.setAttribute('aria-label', 'speed');
  const loop = tick('loop', false, (on) => { timeline.loop = on; changed(); });
  const box = loop.querySelector('input')!;
  box.id = 'loop';
  keepControl('speed', speed.select);
  keepControl('loop', box);
  return element('span', { class: 'playback' }, step(-1, 'one moment back', '‹'), step(1, 'one moment on', '›'), speed.select, loop);
}
