// SPDX-License-Identifier: BSD-3-Clause
import type { ViewStore } from "../state/view";
import { el } from "./dom";

/** The name of what is under the cursor. */
export function newLabel(store: ViewStore): HTMLElement {
  const label = el("div", { class: "label", hidden: true });
  store.follow(["hovered", "objects"], () => {
    const object = store.get("objects").get(store.get("hovered") ?? "");
    label.hidden = !object;
    if (object)
      label.replaceChildren(object.label, el("span", { class: "muted" }, object.isPresent ? `#${object.id}` : "gone"));
  });
  return label;
}
