// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import { crc32, withPngText } from "../../../../clients/web/src/state/png_text";

test("the check sum is that of the PNG specification", () => {
  assert.equal(crc32(new TextEncoder().encode("123456789")), 0xcbf43926);
  assert.equal(crc32(new TextEncoder().encode("IEND")), 0xae426082); // as every PNG file ends
});

test("a note stands behind the head of the file, and the rest follows as it was", () => {
  const png = Uint8Array.from({ length: 60 }, (_, i) => i);
  const noted = withPngText(png, "Source", "http://a/#b");
  assert.deepEqual(noted.subarray(0, 33), png.subarray(0, 33));
  assert.deepEqual(noted.subarray(-27), png.subarray(33));
  const view = new DataView(noted.buffer);
  const length = view.getUint32(33);
  assert.equal(noted.length, png.length + 12 + length);
  const data = noted.subarray(37, 41 + length);
  assert.equal(new TextDecoder().decode(data), "tEXtSource\0http://a/#b");
  assert.equal(view.getUint32(41 + length), crc32(data));
});
