// Colour maps come from the program, so that page and figures agree.
import { banded, MapPair } from './colour_maps';

export interface Range {
  low: number;
  high: number;
  signed: boolean;
  logarithmic?: boolean;
  /** there are lower or greater values than the range's */
  cutBelow?: boolean;
  cutAbove?: boolean;
  /** said where there is no range to be shown: constant, or below round-off */
  instead?: string;
}

/** The counterpart of colour_range in src/report/colour_map.cc. */
export function colourRange(least: number, greatest: number): Range {
  const size = Math.max(-least, greatest);
  if (least < 0 && greatest > 0 && Math.min(-least, greatest) > size / 10)
    return { low: -size, high: size, signed: true };
  if (least === greatest) {
    const half = least === 0 ? 1 : Math.abs(least) / 2;
    return { low: least - half, high: greatest + half, signed: false };
  }
  return { low: least, high: greatest, signed: false };
}

let maps: MapPair;
export function useColourMaps(given: MapPair) { maps = given; }

/** 256 colours as hexadecimal digits, in so many bands if there are any. */
export function mapHex(signed: boolean, bands = 0): string {
  const hex = maps[signed ? 'signed' : 'even'];
  return bands > 0 ? banded(hex, bands) : hex;
}

const unpacked = new Map<string, Uint8Array>();

/** The same as bytes r, g, b, 255. */
export function mapBytes(signed: boolean, bands = 0): Uint8Array {
  const hex = mapHex(signed, bands);
  let bytes = unpacked.get(hex);
  if (!bytes) {
    bytes = new Uint8Array(1024).fill(255);
    for (let i = 0; i < 768; ++i) bytes[4 * Math.floor(i / 3) + (i % 3)] = parseInt(hex.substr(2 * i, 2), 16);
    unpacked.set(hex, bytes);
  }
  return bytes;
}

const pictures = new Map<string, string>();

/** The map from left to right as a data address. */
export function mapPicture(signed: boolean, bands = 0): string {
  const key = `${mapHex(signed)} ${bands}`;
  let address = pictures.get(key);
  if (!address) {
    const bytes = mapBytes(signed);
    const shown = new Uint8ClampedArray(bytes.length);
    for (let i = 0; i < 256; ++i) {
      const from = bands > 0 ? Math.round(((Math.min(bands - 1, Math.floor((i * bands) / 256)) + 0.5) / bands) * 255) : i;
      shown.set(bytes.subarray(4 * from, 4 * from + 4), 4 * i);
    }
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [256, 1];
    canvas.getContext('2d')!.putImageData(new ImageData(shown, 256, 1), 0, 0);
    address = canvas.toDataURL();
    pictures.set(key, address);
  }
  return address;
}

/** Colours that differ for all eyes (Okabe and Ito), for lines and boundaries. */
export const palette = {
  contact: '#d55e00', displacement: '#0072b2', traction: '#009e73', free: '#8a8f98',
};
export const furtherColours = ['#b5629b', '#c28400', '#3f9fd6', '#7a6ac8', '#8a8f98'];
export const lineColours = ['#0f7fc4', '#d9660f', '#12996f', '#b5629b', '#c28400', '#6f63c9'];
