// The counterpart of src/report/packing.cc: arrays that were predicted, sorted by bytes, deflated and
// turned into base64.
import { unzlibSync } from 'fflate';

export interface Packed {
  coding: 'floats' | 'integers' | 'levels';
  rows: number;
  columns: number;
  at: number;
  length: number;
  low?: number;
  step?: number;
}

let text: string | undefined;

function bytesOf(packed: Packed): Uint8Array {
  text ??= document.getElementById('numbers')?.textContent ?? '';
  const binary = atob(text.substr(packed.at, packed.length));
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return unzlibSync(bytes);
}

function words(bytes: Uint8Array, size: number): Uint32Array {
  const n = bytes.length / size;
  const result = new Uint32Array(n);
  for (let b = 0; b < size; ++b)
    for (let i = 0; i < n; ++i) result[i] |= bytes[b * n + i] << (8 * b);
  return result;
}

// 0, 1, 2, 3, ... to 0, -1, 1, -2, ...
const unfolded = (word: number) => (word >>> 1) ^ -(word & 1);

export function unpackIntegers(packed: Packed): Uint32Array {
  const result = words(bytesOf(packed), 4);
  for (let i = 0; i < result.length; ++i)
    result[i] = unfolded(result[i]) + (i > 0 ? result[i - 1] : 0);
  return result;
}

function unpackFloats(packed: Packed): Float32Array {
  const differences = words(bytesOf(packed), 4);
  const result = new Float32Array(differences.length);
  const bits = new Uint32Array(result.buffer);
  const line = new Float32Array(1);
  const lineBits = new Uint32Array(line.buffer);
  const n = packed.columns;
  for (let i = 0; i < result.length; ++i) {
    if (i < n) line[0] = i === 0 ? 0 : result[i - 1];
    else if (i < 2 * n) line[0] = result[i - n];
    else line[0] = Math.fround(2 * result[i - n]) - result[i - 2 * n];
    if (Number.isNaN(line[0])) line[0] = 0;
    const ordered = lineBits[0] >>> 31 ? ~lineBits[0] : lineBits[0] | 0x80000000;
    const value = (ordered + unfolded(differences[i])) >>> 0;
    bits[i] = value >>> 31 ? value & 0x7fffffff : ~value;
  }
  return result;
}

function unpackLevels(packed: Packed): Float32Array {
  const levels = words(bytesOf(packed), 2);
  const result = new Float32Array(levels.length);
  const n = packed.columns;
  for (let i = 0; i < levels.length; ++i) {
    const line = i < n ? (i === 0 ? 0 : levels[i - 1])
      : i < 2 * n ? levels[i - n] : 2 * levels[i - n] - levels[i - 2 * n];
    levels[i] = (line + unfolded(levels[i])) & 0xffff;
    result[i] = packed.low! + packed.step! * levels[i];
  }
  return result;
}

/** All rows, one behind the other. */
export function unpack(packed: Packed): Float32Array {
  return packed.coding === 'levels' ? unpackLevels(packed) : unpackFloats(packed);
}
