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

function words(bytes: Uint8Array): Uint32Array {
  const n = bytes.length / 4;
  const result = new Uint32Array(n);
  for (let i = 0; i < n; ++i) result[i] = bytes[i] | (bytes[n + i] << 8) | (bytes[2 * n + i] << 16) | (bytes[3 * n + i] << 24);
  return result;
}

// 0, 1, 2, 3, ... to 0, -1, 1, -2, ...
const unfolded = (word: number) => (word >>> 1) ^ -(word & 1);

export function unpackIntegers(packed: Packed): Uint32Array {
  const result = words(bytesOf(packed));
  for (let i = 0; i < result.length; ++i)
    result[i] = unfolded(result[i]) + (i > 0 ? result[i - 1] : 0);
  return result;
}

function unpackFloats(packed: Packed): Float32Array {
  const differences = words(bytesOf(packed));
  const result = new Float32Array(differences.length);
  const bits = new Int32Array(result.buffer);
  const line = new Float32Array(1);
  const lineBits = new Int32Array(line.buffer);
  const n = packed.columns;
  for (let i = 0; i < result.length; ++i) {
    const before = i < n ? (i === 0 ? 0 : result[i - 1]) : i < 2 * n ? result[i - n] : 2 * result[i - n] - result[i - 2 * n];
    line[0] = before === before ? before : 0;
    const word = lineBits[0];
    const value = ((word < 0 ? ~word : word | 0x80000000) + unfolded(differences[i])) | 0;
    bits[i] = value < 0 ? value & 0x7fffffff : ~value;
  }
  return result;
}

function unpackLevels(packed: Packed): Float32Array {
  const bytes = bytesOf(packed);
  const n = packed.columns, all = bytes.length / 2;
  const levels = new Uint16Array(all), result = new Float32Array(all);
  const low = packed.low!, step = packed.step!;
  for (let i = 0; i < all; ++i) {
    const line = i < n ? (i === 0 ? 0 : levels[i - 1])
      : i < 2 * n ? levels[i - n] : 2 * levels[i - n] - levels[i - 2 * n];
    levels[i] = line + unfolded(bytes[i] | (bytes[all + i] << 8));
    result[i] = low + step * levels[i];
  }
  return result;
}

/** All rows, one behind the other. */
export function unpack(packed: Packed): Float32Array {
  return packed.coding === 'levels' ? unpackLevels(packed) : unpackFloats(packed);
}
