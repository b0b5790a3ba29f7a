// Between values and places on a colour bar: even, by logarithms, or, where values have both signs, by logarithms of
// their sizes with a straight piece around 0.
import { Range } from './colours';

/** A logarithmic bar shows so many powers of ten, unless its lower end is nearer. */
const decades = 4;

const hasBothSigns = (range: Range) => range.low < 0 && range.high > 0;
const lowest = (range: Range) => (range.low > 0 ? Math.max(range.low, range.high * 10 ** -decades) : range.high * 10 ** -decades);
const half = (range: Range) => Math.max(-range.low, range.high);

/** Whether logarithms can be taken of it; of values all below 0 they are not. */
export const canBeLogarithmic = (range: Range) => range.high > 0;

/** Whether there is room for values below the lower end of the bar. */
export const beginsAbove = (range: Range) =>
  !!range.logarithmic && canBeLogarithmic(range) && !hasBothSigns(range) && lowest(range) > range.low;

/** From -1 to 1, by the logarithm of the size. */
const signedShare = (range: Range, value: number) =>
  Math.sign(value) * Math.log10(1 + (Math.abs(value) / half(range)) * (10 ** decades - 1)) / decades;

/** From 0 to 1 between the ends. */
export function levelOf(range: Range, value: number): number {
  if (!range.logarithmic || !canBeLogarithmic(range)) return (value - range.low) / (range.high - range.low);
  if (hasBothSigns(range)) {
    const [low, high] = [signedShare(range, range.low), signedShare(range, range.high)];
    return (signedShare(range, value) - low) / (high - low);
  }
  const low = lowest(range);
  return value <= low ? 0 : Math.log(value / low) / Math.log(range.high / low);
}

/** The value at a place of the bar. */
export function valueAtLevel(range: Range, level: number): number {
  if (!range.logarithmic || !canBeLogarithmic(range)) return range.low + level * (range.high - range.low);
  if (hasBothSigns(range)) {
    const [low, high] = [signedShare(range, range.low), signedShare(range, range.high)];
    const side = low + level * (high - low);
    return (Math.sign(side) * half(range) * (10 ** (decades * Math.abs(side)) - 1)) / (10 ** decades - 1);
  }
  const low = lowest(range);
  return low * (range.high / low) ** level;
}
