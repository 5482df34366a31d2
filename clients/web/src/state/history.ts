// SPDX-License-Identifier: BSD-3-Clause
// What this page has edited and may undo: the server's log is the history, these are places in it.
import type { LoggedEdit } from "../api/types";
import type { ViewStore } from "./view";

/** An edit of this page: what was undone before cannot be done again. */
export function noteEdit(store: ViewStore, revision: number): void {
  store.set("undoable", [...store.get("undoable"), revision]);
  store.set("redoable", []);
}

export function noteUndo(store: ViewStore, revision: number): void {
  store.set(
    "undoable",
    store.get("undoable").filter((each) => each !== revision),
  );
  store.set("redoable", [...store.get("redoable"), revision]);
}

export function noteRedo(store: ViewStore, revision: number): void {
  store.set(
    "redoable",
    store.get("redoable").filter((each) => each !== revision),
  );
  store.set("undoable", [...store.get("undoable"), revision]);
}

/** Of another map, or of one that was made anew, nothing that this page did or asked before holds. */
export function forgetMap(store: ViewStore): void {
  store.set("undoable", []);
  store.set("redoable", []);
  store.set("history", []);
  store.set("toast", null);
  store.set("pending", null);
  store.set("probe", null);
  store.set("draft", null);
  store.set("ray", null);
  store.set("near", null);
  store.set("regions", []);
  store.set("regionDraft", null);
  store.set("pathAnswer", null);
}

/** How much of the log is held. */
export const mostLogged = 100;

/** The log after its newest edits, which come first; null: edits between them and what is held are missing. */
export function withNewest(held: readonly LoggedEdit[], newest: readonly LoggedEdit[]): readonly LoggedEdit[] | null {
  const oldest = newest.at(-1);
  if (!oldest) return held.length === 0 ? held : null;
  if (!held.some(({ revision }) => revision >= oldest.revision)) return null;
  const undone = new Map<string, boolean>();
  for (const edit of [...newest].reverse())
    for (const target of edit.targets) undone.set(target, edit.what === "undo");
  const older = held
    .filter(({ revision }) => revision < oldest.revision)
    .map((edit) => ({ ...edit, isUndone: undone.get(edit.name) ?? edit.isUndone }));
  return [...newest, ...older].slice(0, mostLogged);
}

const mostNamed = 3;

/** "move of sofa 3", as far as the log says. */
export function nameOfEdit(store: ViewStore, revision: number): string {
  const edit = store.get("history").find((each) => each.revision === revision);
  if (!edit) return `revision ${revision}`;
  const names = edit.objects.map((id) => store.get("objects").get(id)?.label ?? `#${id}`);
  const more = names.length > mostNamed ? ` and ${names.length - mostNamed} more` : "";
  const what = edit.what || "edit";
  return names.length === 0 ? what : `${what} of ${names.slice(0, mostNamed).join(", ")}${more}`;
}
