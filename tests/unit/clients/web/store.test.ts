// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import { noteEdit, noteRedo, noteUndo } from "../../../../clients/web/src/state/history";
import { Store } from "../../../../clients/web/src/state/store";
import { newViewStore } from "../../../../clients/web/src/state/view";

test("only who follows the key hears of it, and only of changes", () => {
  const store = new Store({ a: 1, b: 1 });
  const heard: string[] = [];
  store.follow(["a"], () => heard.push(`a${store.get("a")}`));
  store.follow(["b"], () => heard.push("b"));
  store.set("a", 2);
  store.set("a", 2);
  assert.deepEqual(heard, ["a1", "b", "a2"]);
});

test("a new edit ends what can be done again", () => {
  const store = newViewStore();
  noteEdit(store, 5);
  noteEdit(store, 6);
  noteUndo(store, 6);
  assert.deepEqual([store.get("undoable"), store.get("redoable")], [[5], [6]]);
  noteRedo(store, 6);
  noteUndo(store, 6);
  noteEdit(store, 9);
  assert.deepEqual([store.get("undoable"), store.get("redoable")], [[5, 9], []]);
});
