// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import type { MapObject } from "../../../../clients/web/src/api/types";
import { boxBetween, boxOfObjects, readBox, writeBox } from "../../../../clients/web/src/state/boxes";

test("a box is the same whichever of its corners come first, and never flat", () => {
  const box = { min_m: { x: -1, y: 0, z: 2 }, max_m: { x: 3, y: 1, z: 4 } };
  assert.deepEqual(boxBetween({ x: 3, y: 0, z: 4 }, { x: -1, y: 1, z: 2 }), box);
  const flat = boxBetween({ x: 1, y: 1, z: 1 }, { x: 1, y: 1, z: 1 });
  assert.ok(flat.max_m.x > 1 && flat.max_m.y > 1 && flat.max_m.z > 1);
});

test("a box comes back from its text, and nonsense is none", () => {
  const box = { min_m: { x: -1.5, y: 0, z: 0.25 }, max_m: { x: 3, y: 1, z: 4 } };
  assert.deepEqual(readBox(writeBox(box)), box);
  for (const text of [null, "", "1,2,3", "1,2,3,4,5,6,7", "1,2,3,4,5,x", "1,2,,4,5,6"]) assert.equal(readBox(text), null);
});

test("around an object that is turned by a quarter its sides change places", () => {
  const pose = { translation_m: { x: 1, y: 2, z: 0.5 }, rotation: { x: 0, y: 0, z: Math.SQRT1_2, w: Math.SQRT1_2 } };
  const object = { box: { pose, size_m: { x: 2, y: 1, z: 1 } }, sphere: null } as unknown as MapObject;
  const box = boxOfObjects([object]);
  assert.ok(box);
  const found = [box.min_m.x, box.max_m.x, box.min_m.y, box.max_m.y, box.min_m.z, box.max_m.z];
  [0.5, 1.5, 1, 3, 0, 1].forEach((number, i) => assert.ok(Math.abs(number - (found[i] ?? NaN)) < 1e-9));
  assert.equal(boxOfObjects([]), null);
});
