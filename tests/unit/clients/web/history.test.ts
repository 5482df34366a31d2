// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import type { LoggedEdit } from "../../../../clients/web/src/api/types";
import { withNewest } from "../../../../clients/web/src/state/history";

const edit = (revision: number, more: Partial<LoggedEdit> = {}): LoggedEdit => ({
  name: `edits/${revision}`,
  revision,
  time: "",
  author: "",
  what: "move",
  objects: [],
  isUndone: false,
  targets: [],
  ...more,
});

test("the newest edits come before those held, once each", () => {
  const held = [edit(7), edit(5), edit(3)];
  assert.deepEqual(withNewest(held, [edit(8), edit(7)])?.map(({ revision }) => revision), [8, 7, 5, 3]);
  assert.deepEqual(withNewest(held, held), held);
});

test("where edits are missing in between, or the log was lost, nothing is made up", () => {
  assert.equal(withNewest([edit(3)], [edit(9), edit(8)]), null);
  assert.equal(withNewest([edit(3)], []), null);
  assert.deepEqual(withNewest([], []), []);
  assert.equal(withNewest([], [edit(2)]), null);
});

test("an undo marks what it takes back, and doing again unmarks it", () => {
  const undone = withNewest([edit(5), edit(3)], [edit(6, { what: "undo", targets: ["edits/3"] }), edit(5)]);
  assert.deepEqual(undone?.map(({ isUndone }) => isUndone), [false, false, true]);
  const redo = edit(7, { what: "redo", targets: ["edits/3"] });
  const again = withNewest(undone ?? [], [redo, edit(6, { what: "undo", targets: ["edits/3"] })]);
  assert.deepEqual(again?.map(({ isUndone }) => isUndone), [false, false, false, false]);
});
