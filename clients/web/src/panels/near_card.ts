// SPDX-License-Identifier: BSD-3-Clause
// Which objects are nearest to the selection.
import type { MapObject } from "../api/types";
import type { ViewStore } from "../state/view";
import { button, el } from "./dom";
import { metres } from "./fields";

export function nearCard(store: ViewStore, object: MapObject): HTMLElement {
  const isAsked = store.get("asksNear");
  const from = store.get("clicked")?.id === object.id ? "Nearest to where you clicked" : "Nearest to its middle";
  const toggle = button(null, isAsked ? from : "What is nearest?", "Which objects are nearest to it", () =>
    store.set("asksNear", !isAsked),
  );
  toggle.setAttribute("aria-expanded", String(isAsked));
  if (!isAsked) return el("section", { class: "card" }, toggle);
  const near = store.get("near");
  const isKnown = near?.id === object.id && near.className === store.get("nearClass");
  const items = isKnown
    ? near.objects.map(({ id, label, distance_m }) =>
        el(
          "li",
          {},
          button(null, label, `Select ${label}`, () => store.set("selected", id)),
          el("span", { class: "muted" }, `${metres(distance_m)} m`),
        ),
      )
    : [el("li", { class: "muted" }, "Asking…")];
  const none = el("p", { class: "muted" }, "None near.");
  return el(
    "section",
    { class: "card near" },
    el("div", { class: "buttons" }, toggle, classPicker(store)),
    items.length > 0 ? el("ul", { class: "log" }, ...items) : none,
  );
}

function classPicker(store: ViewStore): HTMLElement {
  const there = [...store.get("objects").values()].filter(({ sphere }) => sphere);
  const names = new Set(there.map(({ className }) => className));
  const picker = el(
    "select",
    { class: "picker", aria: { label: "Of which class" } },
    el("option", { value: "" }, "any thing"),
    ...[...names].sort((a, b) => a.localeCompare(b, "en")).map((name) => el("option", { value: name }, name)),
  );
  picker.value = store.get("nearClass");
  picker.addEventListener("change", () => {
    picker.blur();
    store.set("nearClass", picker.value);
  });
  return picker;
}
