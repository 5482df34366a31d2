// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import { readLink, writeLink } from "../../../../clients/web/src/state/url";

const view = {
  mapId: "home",
  at: 12,
  selected: "7",
  query: "red chair",
  hiddenClasses: new Set(["wall", "ceiling"]),
  hiddenObjects: new Set(["3", "12"]),
  showsGone: true,
  colour: "last seen" as const,
  showsBoxes: true,
  theme: "light" as const,
  slice_m: 0.4,
  measured_m: [{ x: 1, y: 2, z: 0.5 }, { x: 1.25, y: 2, z: -1 }],
  clip: { min_m: { x: -1, y: 0, z: 0.5 }, max_m: { x: 2, y: 3.25, z: 1 } },
  path: { points_m: [{ x: 1, y: -2.5, z: 0 }, { x: 4, y: 6, z: 0.25 }], radius_m: 0.3, height_m: 1.2, seenAlone: true },
  camera: { position_m: { x: 1.5, y: -2.25, z: 3 }, yaw: 0.5, pitch: -0.75 },
};

test("a view comes back from its link", () => {
  assert.deepEqual(readLink(`#${writeLink(view)}`), view);
});

test("what is as at first is not in the link", () => {
  assert.equal(writeLink(readLink("")), "");
  assert.equal(writeLink(readLink("#map=home")), "map=home");
});

test("nonsense in a link is as if it were not there", () => {
  const link = readLink("#colour=loud&theme=7&view=1,2,x&gone=yes&unknown=1&at=-3&clip=1,2,3,4,5&measure=1+2&path=1+2;door&robot=-1,x");
  assert.deepEqual(link.path, readLink("").path);
  assert.equal(link.colour, "sensor");
  assert.equal(link.theme, "system");
  assert.equal(link.camera, null);
  assert.equal(link.at, null);
  assert.equal(link.clip, null);
  assert.deepEqual(link.measured_m, []);
  assert.equal(link.showsGone, false);
  assert.equal(readLink("#view=1,2,3,4,5,6").camera, null);
});

test("that nothing is hidden, not even ceilings, is said", () => {
  const link = readLink(`#${writeLink({ ...view, hiddenClasses: new Set<string>() })}`);
  assert.equal(link.hiddenClasses.size, 0);
});
