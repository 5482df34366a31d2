// SPDX-License-Identifier: BSD-3-Clause
// What an object is, and whether robots may change it: both can be set.
import type { Edits } from "../actions/edits";
import type { MapObject } from "../api/types";
import type { ViewStore } from "../state/view";
import { button, el } from "./dom";

export function classCard(store: ViewStore, edits: Edits, object: MapObject): HTMLElement | null {
  const isPast = store.get("at") !== null;
  if (object.kind === "unknown") return null;
  const names = (store.get("map")?.classes ?? [])
    .filter(({ kind }) => kind === object.kind)
    .map(({ name }) => name)
    .sort((a, b) => a.localeCompare(b, "en"));
  const known = names.includes(object.className) ? names : [object.className, ...names];
  const picker = el(
    "select",
    { class: "picker", disabled: isPast || object.kind !== "thing", aria: { label: "Class of the object" } },
    ...known.map((name) => el("option", { value: name }, name)),
  );
  picker.title =
    object.kind === "thing" ? "What it is; robots no longer change it then" : "Backgrounds keep their class";
  picker.value = object.className;
  picker.addEventListener("change", () => {
    picker.blur();
    void edits.relabel(object, picker.value);
  });
  const lock = button(
    "lock",
    object.isLocked ? "Unlock" : "Lock",
    object.isLocked ? "Robots may change it again; can be undone" : "Robots leave it as it is; can be undone",
    () => void edits.lock(object, !object.isLocked),
  );
  lock.setAttribute("aria-pressed", String(object.isLocked));
  lock.disabled = isPast;
  return el("section", { class: "card class-card" }, el("label", { class: "labelled" }, "It is a", picker), lock);
}
