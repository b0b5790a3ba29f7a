// Between values and places on a colour bar: even, by logarithms, or, where values have both signs, by logarithms of
// their sizes with a straight piece around 0.
import { Range } from './colours';

/** A logarithmic bar shows so many powers of ten, unless its lower end is nearer. */
const decades = 4;

const symmetric = (range: Range) => range.low < 0 && range.high > 0;
const lowest = (range: Range) => (range.low > 0 ? Math.max(range.low, range.high * 10 ** -decades) : range.high * 10 ** -decades);
const half = (range: Range) => Math.max(-range.low, range.high);

/** Whether logarithms can be taken of it; of values all below 0 they are not. */
export const canBeLogarithmic = (range: Range) => range.high > 0;

/** From 0 to 1 between the ends. */
export function levelOf(range: Range, value: number): number {
  if (!range.logarithmic || !canBeLogarithmic(range)) return (value - range.low) / (range.high - range.low);
  if (symmetric(range)) {
    const size = Math.log10(1 + (Math.abs(value) / half(range)) * (10 ** decades - 1)) / decades;
    return 0.5 + 0.5 * Math.sign(value) * size;
  }
  const low = lowest(range);
  return value <= low ? 0 : Math.log(value / low) / Math.log(range.high / low);
}

/** The value at a place of the bar. */
export function valueAtLevel(range: Range, level: number): number {
  if (!range.logarithmic || !canBeLogarithmic(range)) return range.low + level * (range.high - range.low);
  if (symmetric(range)) {
    const side = 2 * level - 1;
    return (Math.sign(side) * half(range) * (10 ** (decades * Math.abs(side)) - 1)) / (10 ** decades - 1);
  }
  const low = lowest(range);
  return low * (range.high / low) ** level;
}
