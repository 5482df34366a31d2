// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import type { MapObject } from "../../../../clients/web/src/api/types";
import { differencesOf } from "../../../../clients/web/src/state/differences";

const still = { translation_m: { x: 0, y: 0, z: 0 }, rotation: { x: 0, y: 0, z: 0, w: 1 } };
const chair: MapObject = {
  id: "7",
  name: "maps/home/submaps/7",
  label: "chair 7",
  kind: "thing",
  className: "chair",
  classId: 10,
  classConfidence: 1,
  instanceConfidence: 1,
  pose: still,
  sphere: { center: { x: 0, y: 0, z: 0 }, radius_m: 1 },
  box: { pose: still, size_m: { x: 1, y: 1, z: 1 } },
  footprint_m: [],
  isPresent: true,
  isLocked: false,
  isConfirmed: true,
  numFrames: 1,
  lastSeen_ns: 0n,
  revision: 3,
  etag: "",
};
const only = (object: MapObject | null) => new Map(object ? [[object.id, object]] : []);
const what = (before: MapObject | null, after: MapObject | null) =>
  differencesOf(only(before), only(after)).named.map((difference) => difference.what);
const at = (x: number, turn = 0): Pick<MapObject, "pose" | "box"> => {
  const pose = { translation_m: { x, y: 0, z: 0 }, rotation: { x: 0, y: 0, z: Math.sin(turn), w: Math.cos(turn) } };
  return { pose, box: { pose, size_m: { x: 1, y: 1, z: 1 } } };
};

test("what came, went, moved and was renamed is named", () => {
  assert.deepEqual(what(null, chair), ["is new"]);
  assert.deepEqual(what(chair, null), ["was removed"]);
  assert.deepEqual(what(chair, { ...chair, isPresent: false }), ["is gone"]);
  assert.deepEqual(what({ ...chair, isPresent: false }, chair), ["is back"]);
  assert.deepEqual(what(chair, { ...chair, ...at(1.5) }), ["moved by 1.50 m"]);
  assert.deepEqual(what(chair, { ...chair, ...at(0, 0.5) }), ["turned"]);
  assert.deepEqual(what(chair, { ...chair, label: "throne" }), ["was called chair 7"]);
  assert.deepEqual(what(chair, { ...chair, isLocked: true, ...at(1) }), ["moved by 1.00 m, locked"]);
  assert.deepEqual(what(chair, { ...chair, className: "sofa", label: "sofa 7" }), ["was chair"]);
});

test("of an object that is told of without its box the way is that of its middle, too", () => {
  const before = { ...chair, box: { pose: at(5).pose, size_m: { x: 1, y: 1, z: 1 } } };
  const after = { ...chair, ...at(2), box: null, sphere: { center: { x: 2, y: 0, z: 0 }, radius_m: 1 } };
  assert.deepEqual(what(before, after), ["moved by 2.00 m"]);
});

test("objects that were only mapped further are counted, and unchanged ones are not listed", () => {
  assert.deepEqual(differencesOf(only(chair), only({ ...chair, revision: 4 })), { named: [], numMapped: 1 });
  assert.deepEqual(differencesOf(only(chair), only(chair)), { named: [], numMapped: 0 });
  const empty = { ...chair, sphere: null };
  assert.deepEqual(differencesOf(only(empty), only({ ...empty, revision: 9 })), { named: [], numMapped: 0 });
});
