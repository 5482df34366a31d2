// SPDX-License-Identifier: BSD-3-Clause
// What was done to an object, and what can be done with it.
import { Vector3 } from "three";
import type { Edits } from "../actions/edits";
import { copyText, curlOf, pythonOf } from "../actions/snippets";
import type { MapObject } from "../api/types";
import type { ViewStore } from "../state/view";
import { shifted } from "../tools/poses";
import { button, el } from "./dom";

export function logCard(store: ViewStore, edits: Edits, object: MapObject): HTMLElement {
  const logged = store
    .get("history")
    .filter((edit) => edit.objects.includes(object.id))
    .slice(0, 6);
  const items = logged.map((edit) =>
    el(
      "li",
      edit.isUndone ? { class: "is-undone" } : {},
      el("span", {}, edit.what || "edit"),
      el("span", { class: "muted" }, `${edit.author || "somebody"} · r${edit.revision}`),
      edit.isUndone || !store.get("undoable").includes(edit.revision)
        ? null
        : button("undo", "", `Undo revision ${edit.revision}`, () => void edits.undo(edit.revision)),
    ),
  );
  return el(
    "section",
    { class: "card" },
    el("h2", {}, "Edits"),
    items.length > 0 ? el("ul", { class: "log" }, ...items) : el("p", { class: "muted" }, "Nobody has edited it."),
  );
}

export function actionsCard(store: ViewStore, edits: Edits, object: MapObject): HTMLElement {
  const copy = (label: string, text: string) =>
    button(null, label, `Copy: ${text.split("\n")[0]}…`, () => {
      void copyText(text).then((isCopied) =>
        store.set(
          "toast",
          isCopied
            ? { text: `${label.replace("Copy as ", "")} is in the clipboard`, tone: "plain" }
            : { text: `The browser does not let the page copy: ${text}`, tone: "problem" },
        ),
      );
    });
  const hide = button("hidden", "Hide", "Hide it (X)", () => {
    store.set("hiddenObjects", new Set([...store.get("hiddenObjects"), object.id]));
    store.set("selected", null);
  });
  const canEdit = object.kind === "thing" && store.get("at") === null;
  const remove = button(null, "Delete", "Delete it from the map; can be undone", () => void edits.delete(object));
  remove.classList.add("danger");
  return el(
    "footer",
    { class: "card actions" },
    ...(canEdit ? thingButtons(store, edits, object) : []),
    copy("Copy as curl", curlOf(object.name)),
    copy("Copy as Python", pythonOf(object.name)),
    hide,
    canEdit ? remove : null,
  );
}

function thingButtons(store: ViewStore, edits: Edits, object: MapObject): HTMLElement[] {
  const beside = new Vector3((object.box?.size_m.x ?? 0.5) + 0.1, 0, 0);
  return [
    button(null, "Clone", "A copy beside it; can be undone", () => void edits.clone(object, shifted(object.pose, beside))),
    button(null, "Merge…", "Another thing becomes a part of it; shown before it is done", () =>
      store.set("draft", { is: "merge", id: object.id, other: null }),
    ),
    button(null, "Split…", "Take it apart; shown before it is done", () =>
      store.set("draft", { is: "split", id: object.id, cut: { by: "parts" } }),
    ),
  ];
}
