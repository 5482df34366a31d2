// SPDX-License-Identifier: BSD-3-Clause
// At which height the floor plan is shown, and what its colours say.
import type { ViewStore } from "../state/view";
import { button, el } from "./dom";
import { metres } from "./fields";

export function newSliceCard(store: ViewStore): HTMLElement {
  const height = el("input", { type: "range", aria: { label: "Height of the slice, m" } });
  [height.min, height.max, height.step] = ["-0.5", "3", "0.05"];
  const shown = el("span", { class: "muted" });
  height.addEventListener("input", () => store.set("slice_m", Number(height.value)));
  height.addEventListener("keydown", (event) => event.stopPropagation());
  const legend = (name: string, what: string) => el("span", { class: `legend ${name}` }, what);
  const card = el(
    "section",
    { class: "card slice" },
    el("h2", {}, "Slice"),
    el("div", { class: "slider" }, height, shown),
    el("p", {}, legend("occupied", "occupied"), legend("free", "free"), legend("unknown", "unknown")),
    button("close", "", "Put the slice away (S)", () => store.set("slice_m", null)),
  );
  store.follow(["slice_m"], () => {
    const slice_m = store.get("slice_m");
    card.hidden = slice_m === null;
    if (slice_m === null) return;
    height.value = String(slice_m);
    shown.textContent = `${metres(slice_m)} m`;
  });
  return card;
}
