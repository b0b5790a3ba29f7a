// Which values a field's colours stand for: the counterpart of shown_range in src/report/scale.cc.
import { colourRange, Range } from './colours';
import { shown } from './numbers';
import { Field } from './results';

export interface Extremes { least: number; greatest: number }

/** Values differ by less than what single precision tells apart. */
const same = 4e-7;

/** Share of the values. */
export const peaks = 0.03;

/** What the bodies that share their colours have of a field. */
export interface Found {
  all: Extremes;
  /** without `peaks` of the values at either end */
  usual: Extremes;
  error: number;
  /** in all of them */
  belowRoundOff: boolean;
}

/** Empty where the values have a range to be shown. */
function noRange({ all: { least, greatest }, error, belowRoundOff }: Found, field: Field): string {
  if (!(least <= greatest)) return 'no values';
  const size = Math.max(-least, greatest);
  const withUnit = (value: number) => `${shown(value, 4)}${field.unit ? ' ' + field.unit : ''}`;
  if (least === 0 && greatest === 0) return '0 everywhere';
  if (size <= error) return `0 but for the rounding of the page, ${withUnit(error)}`;
  if (greatest - least <= same * size + 2 * error) return `constant, ${withUnit((least + greatest) / 2)}`;
  return belowRoundOff ? `below round-off, at most ${withUnit(size)}` : '';
}

/** From the least to the greatest value. */
export function wholeRange(found: Found, field: Field): Range {
  return { ...colourRange(found.all.least, found.all.greatest), instead: noRange(found, field) };
}

/**
 * Of what is derived, without `peaks` of the values at either end where these reach half as far again, as at singular
 * corners and in layers beside the contact, which would leave nothing to be seen of the rest.
 */
export function shownRange(found: Found, field: Field): Range {
  const { all, usual } = found;
  const size = Math.max(-usual.least, usual.greatest);
  const cutAbove = !field.isUnknown && usual.greatest > 0 && all.greatest - usual.greatest > size / 2;
  const cutBelow = !field.isUnknown && usual.least < 0 && usual.least - all.least > size / 2;
  const range = colourRange(cutBelow ? usual.least : all.least, cutAbove ? usual.greatest : all.greatest);
  return { ...range, cutBelow, cutAbove, instead: noRange(found, field) };
}
