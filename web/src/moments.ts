// The moments of a page: those of the fields and the steps of the tables, of all runs together; and what a run knows of
// one of them.
import { shown } from './numbers';
import { Result } from './results';

/** Single precision, in which the tables are, tells times apart that differ by more. */
const same = (a: number, b: number) => Math.abs(a - b) <= 3e-7 * Math.max(Math.abs(a), Math.abs(b));

export interface Moment { time: number; step?: number }

function momentsOf(result: Result): Moment[] {
  const steps = result.history?.column('step');
  return [...result.stateTimes.map((time, i) => ({ time, step: result.steps[i] })),
    ...[...(result.history?.column('time') ?? [])].map((time, i) => ({ time, step: steps?.[i] }))];
}

/** In order, each once. Two runs number their steps differently, so only those of one alone have numbers. */
export function momentsOfAll(results: Result[]): Moment[] {
  const all = results.flatMap(momentsOf).sort((a, b) => a.time - b.time);
  return all.filter((moment, i) => i === 0 || !same(moment.time, all[i - 1].time))
    .map(({ time, step }) => (results.length > 1 ? { time } : { time, step }));
}

/** The last moment [s] that a run reached. */
export function endOf(result: Result): number {
  const history = result.history?.column('time');
  return Math.max(result.stateTimes[result.stateTimes.length - 1] ?? 0, history?.[history.length - 1] ?? 0);
}

export function isReached(result: Result, time: number): boolean {
  const end = endOf(result);
  return time <= end || same(time, end);
}

/** The place of the last moment that every run reached. */
export function lastOfAll(results: Result[], moments: Moment[]): number {
  let last = 0;
  moments.forEach(({ time }, i) => { if (results.every((result) => isReached(result, time))) last = i; });
  return last;
}

/** The field file whose time is nearest; -1 where the run ended before. */
export function stateAt(result: Result, time: number): number {
  if (!isReached(result, time)) return -1;
  const times = result.stateTimes;
  let best = 0;
  for (let i = 1; i < times.length; ++i)
    if (Math.abs(times[i] - time) < Math.abs(times[best] - time)) best = i;
  return best;
}

/** What has to be said of rows of a table, at `ends` of steps [s], the `step`th of which are shown; else empty. */
export function strayStep(ends: number[], step: number, time: number): string {
  return step < 0 || same(ends[step], time) ? '' : `step of t = ${shown(ends[step])} s, the nearest one`;
}

/** What has to be said where a run does not reach the moment. */
export const notReached = (result: Result) => `the run ends at t = ${shown(endOf(result))} s`;

/** What has to be said of a field that is not that of the moment; else empty. */
export function strayMoment(result: Result, time: number): string {
  const state = stateAt(result, time);
  if (state < 0) return notReached(result);
  const own = result.stateTimes[state];
  return same(own, time) ? '' : `fields of t = ${shown(own)} s, the nearest moment on the page`;
}
