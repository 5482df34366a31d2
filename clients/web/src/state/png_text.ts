// SPDX-License-Identifier: BSD-3-Clause
// A note in a PNG file (tEXt, PNG specification 11.3.3.2), which picture viewers show and browsers leave alone.

const headBytes = 8 + 25; // signature, and IHDR, which is first

const crcTable = Uint32Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; ++bit) value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
  return value;
});

export function crc32(bytes: Uint8Array): number {
  let value = 0xffffffff;
  for (const byte of bytes) value = crcTable[(value ^ byte) & 255]! ^ (value >>> 8);
  return (value ^ 0xffffffff) >>> 0;
}

/** The file with the note behind its head. `key` and `text`: Latin letters. */
export function withPngText(png: Uint8Array<ArrayBuffer>, key: string, text: string): Uint8Array<ArrayBuffer> {
  const data = new TextEncoder().encode(`tEXt${key}\0${text}`);
  const out = new Uint8Array(png.length + 8 + data.length);
  const view = new DataView(out.buffer);
  out.set(png.subarray(0, headBytes));
  view.setUint32(headBytes, data.length - 4);
  out.set(data, headBytes + 4);
  view.setUint32(headBytes + 4 + data.length, crc32(data));
  out.set(png.subarray(headBytes), headBytes + 8 + data.length);
  return out;
}
