// Which values a field's colours stand for: the counterpart of shown_range in src/report/scale.cc.
import { colourRange, Range } from './colours';
import { shown } from './numbers';
import { Field } from './results';

export interface Extremes { least: number; greatest: number }

/** Values differ by less than what single precision tells apart. */
const same = 4e-7;

/** Share of the values. */
export const peaks = 0.03;

/** Empty where values between `least` and `greatest` have a range to be shown. */
function noRange({ least, greatest }: Extremes, field: Field, error: number): string {
  const size = Math.max(-least, greatest);
  const withUnit = (value: number) => `${shown(value, 4)}${field.unit ? ' ' + field.unit : ''}`;
  if (least === 0 && greatest === 0) return '0 everywhere';
  if (greatest - least <= same * size + 2 * error) return `constant, ${withUnit((least + greatest) / 2)}`;
  return field.belowRoundOff ? `below round-off, at most ${withUnit(size)}` : '';
}

/** From the least to the greatest value. */
export function wholeRange(all: Extremes, field: Field, error: number): Range {
  return { ...colourRange(all.least, all.greatest), instead: noRange(all, field, error) };
}

/**
 * Of what is derived, without `peaks` of the values at either end where these reach half as far again, as at singular
 * corners and in layers beside the contact, which would leave nothing to be seen of the rest.
 */
export function shownRange(all: Extremes, usual: Extremes, field: Field, error: number): Range {
  const size = Math.max(-usual.least, usual.greatest);
  const cutAbove = !field.isUnknown && usual.greatest > 0 && all.greatest - usual.greatest > size / 2;
  const cutBelow = !field.isUnknown && usual.least < 0 && usual.least - all.least > size / 2;
  const range = colourRange(cutBelow ? usual.least : all.least, cutAbove ? usual.greatest : all.greatest);
  return { ...range, cutBelow, cutAbove, instead: noRange(all, field, error) };
}
