// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import { lengthOf_m, readPath, writePath } from "../../../../clients/web/src/state/path_text";
import { clearance_m, columnOf } from "../../../../clients/web/src/state/robot";

const path = [
  { x: 1, y: 2, z: 0 },
  { x: 4, y: 6, z: 0.5 },
];

test("a path is read from lines and from what planners write as JSON", () => {
  assert.deepEqual(readPath("# my path\n1 2\n\n4, 6, 0.5, 90\n"), path);
  assert.deepEqual(readPath("1 2 0;4 6 0.5"), path);
  assert.deepEqual(readPath("[[1, 2], [4, 6, 0.5]]"), path);
  assert.deepEqual(readPath('[{"x": 1, "y": 2}, {"translation_m": {"x": 4, "y": 6, "z": 0.5}}]'), path);
  assert.deepEqual(readPath('{"waypoints": [{"position": {"x": 1, "y": 2, "z": 0}}, {"x": 4, "y": 6, "z": 0.5}]}'), path);
  assert.deepEqual(readPath("  "), []);
});

test("what is no path names its place, and paths have a bound", () => {
  assert.throws(() => readPath("1 2\n3 door"), /line 2 is no place/);
  assert.throws(() => readPath("1"), /line 1/);
  assert.throws(() => readPath("[[1, 2], [null, 3]]"), /waypoint 2/);
  assert.throws(() => readPath("1e9 0"), /line 1/);
  assert.throws(() => readPath("[1, 2"), /no JSON/);
  assert.throws(() => readPath('{"path": 3}'), /list of waypoints/);
  assert.throws(() => readPath("0 0\n".repeat(1001)), /more than 1000/);
});

test("a path comes back from its text, to the millimetre, and has its length", () => {
  assert.deepEqual(readPath(writePath(path)), path);
  assert.deepEqual(readPath(writePath(path, ";")), path);
  assert.equal(writePath([{ x: 1.23456, y: -0.0001, z: 0 }]), "1.235 0 0");
  assert.equal(lengthOf_m([path[0]!, { x: 4, y: 6, z: 0 }, { x: 4, y: 6, z: 1 }]), 6);
  assert.equal(lengthOf_m([path[0]!, { x: 4, y: 6, z: 0 }, { x: 4, y: 6, z: 1 }], 2), 5);
  assert.equal(lengthOf_m([]), 0);
});

test("a robot is a column of balls without gaps, just above the floor", () => {
  for (const [radius_m, height_m] of [
    [0.2, 0.6],
    [0.25, 1.7],
    [0.3, 0.2],
  ] as const) {
    const balls = columnOf(radius_m, height_m);
    assert.equal(balls[0]?.center_m.z, clearance_m + radius_m);
    const top = Math.max(height_m, clearance_m + 2 * radius_m);
    assert.ok(Math.abs((balls.at(-1)?.center_m.z ?? 0) + radius_m - top) < 1e-9);
    balls.slice(1).forEach((ball, i) => assert.ok(ball.center_m.z - balls[i]!.center_m.z <= radius_m + 1e-9));
  }
});
