// Colour maps to choose from: the program's, one that red-green blind eyes see as others do, and one for paper in grey.
// Each has a second one for values of both signs.

export interface MapPair { even: string; signed: string }

export const mapNames = ['viridis', 'cividis', 'grey'] as const;
export type MapName = (typeof mapNames)[number];

// Cividis by Nuñez, Anderton and Renslow; purple and orange by Brewer. Straight between these.
const cividis = ['00204d', '00336f', '39486b', '575c6d', '707173', '8a8779', 'a69d75', 'c4b56c', 'e4cf5b', 'ffea46'];
const purpleOrange = ['2d004b', '542788', '8073ac', 'b2abd2', 'd8daeb', 'f7f7f7', 'fee0b6', 'fdb863', 'e08214', 'b35806', '7f3b08'];
const grey = ['1a1a1a', 'f2f2f2'];

const channels = (hex: string) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16));

/** 256 colours, evenly between those given. */
function between(colours: string[]): string {
  return Array.from({ length: 256 }, (_, i) => {
    const at = (i / 255) * (colours.length - 1), first = Math.min(Math.floor(at), colours.length - 2);
    const [a, b] = [channels(colours[first]), channels(colours[first + 1])];
    return a.map((v, c) => Math.round(v + (at - first) * (b[c] - v)).toString(16).padStart(2, '0')).join('');
  }).join('');
}

export function mapsNamed(name: MapName, program: MapPair): MapPair {
  if (name === 'cividis') return { even: between(cividis), signed: between(purpleOrange) };
  return name === 'grey' ? { even: between(grey), signed: between(grey) } : program;
}

/** The same in so many bands. */
export function banded(map: string, bands: number): string {
  return Array.from({ length: 256 }, (_, i) => {
    const middle = (Math.min(bands - 1, Math.floor((i * bands) / 256)) + 0.5) / bands;
    const at = Math.round(middle * 255);
    return map.slice(6 * at, 6 * at + 6);
  }).join('');
}
