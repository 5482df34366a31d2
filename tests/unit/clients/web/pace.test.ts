// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import { Pace, details } from "../../../../clients/web/src/scene/pace";

test("one slow frame is let pass, two make the next ones coarser, down to the coarsest", () => {
  const pace = new Pace(false);
  assert.equal(pace.detail, details[0]);
  assert.equal(pace.drew(500), false);
  assert.equal(pace.drew(10), false);
  assert.equal(pace.drew(500), false);
  assert.equal(pace.drew(500), true);
  assert.equal(pace.detail, details[1]);
  for (let i = 0; i < 100; ++i) pace.drew(500);
  assert.equal(pace.detail, details.at(-1));
});

test("after a movement that was fast throughout it is finer by one step, after a short one it is not", () => {
  const pace = new Pace(true);
  const before = details.indexOf(pace.detail);
  assert.ok(before > 0, "without a GPU it begins coarse");
  for (let i = 0; i < 20; ++i) pace.drew(10);
  assert.equal(details.indexOf(pace.detail), before, "not while it moves");
  pace.rests();
  assert.equal(details.indexOf(pace.detail), before - 1);
  pace.drew(10);
  pace.rests();
  assert.equal(details.indexOf(pace.detail), before - 1);
});
