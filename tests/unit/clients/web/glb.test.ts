// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import { readGlb } from "../../../../clients/web/src/api/glb";

/** One object of one triangle, as the server writes it. */
function newGlb(): ArrayBuffer {
  const json = JSON.stringify({
    scenes: [{ nodes: [0, 2] }],
    nodes: [
      { extras: { instance_id: 7 }, children: [1] },
      { mesh: 0, translation: [1, 2, 3], scale: [2, 2, 2] },
      { extras: { instance_id: 8 } },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5123, count: 3 },
      { bufferView: 1, componentType: 5123, count: 3 },
    ],
    bufferViews: [{ byteOffset: 0, byteStride: 20 }, { byteOffset: 60 }],
  });
  const text = new TextEncoder().encode(json.padEnd(Math.ceil(json.length / 4) * 4));
  const file = new ArrayBuffer(20 + text.length + 8 + 68);
  const view = new DataView(file);
  [0x46546c67, 2, file.byteLength, text.length, 0x4e4f534a].forEach((number, i) => view.setUint32(4 * i, number, true));
  new Uint8Array(file).set(text, 20);
  const bin = 28 + text.length;
  view.setUint16(bin + 20, 65535, true); // second vertex: x
  view.setInt8(bin + 20 + 10, 127); // its normal: z
  view.setUint16(bin + 20 + 12, 4000, true); // its red
  [0, 1, 2].forEach((index, i) => view.setUint16(bin + 60 + 2 * i, index, true));
  return file;
}

test("objects come out of a file with their places and colours", () => {
  const [surface, empty] = readGlb(newGlb());
  assert.equal(surface?.id, "7");
  assert.deepEqual(surface?.offset_m, [1, 2, 3]);
  assert.equal(surface?.scale_m, 2);
  assert.deepEqual([...(surface?.positions ?? [])].slice(4, 8), [65535, 0, 0, 0]);
  assert.equal(surface?.normals[6], 127);
  assert.equal(surface?.colors[4], 4000);
  assert.deepEqual([...(surface?.indices ?? [])], [0, 1, 2]);
  assert.equal(empty?.id, "8");
  assert.equal(empty?.indices.length, 0);
});

test("what is no such file is an error", () => {
  assert.throws(() => readGlb(new ArrayBuffer(64)), /no GLB/);
  assert.throws(() => readGlb(new ArrayBuffer(3)), /no GLB/);
});
