// SPDX-License-Identifier: BSD-3-Clause
import type { ViewStore } from "../state/view";
import type { ClipTool } from "../tools/clip";
import { boxFields } from "./box_fields";
import { button, el } from "./dom";
import { metres } from "./fields";

const slider_m = 3;

export function newClipCard(store: ViewStore, tool: ClipTool): HTMLElement {
  const fields = el("div");
  const height = el("input", { type: "range", aria: { label: "Upper side of the box, m" } });
  const shown = el("span", { class: "muted" });
  const around = button(null, "Around the selection", "Only what is near the selection", () => tool.aroundSelection());
  height.addEventListener("input", () => {
    const clip = store.get("clip");
    if (clip) store.set("clip", { ...clip, max_m: { ...clip.max_m, z: Number(height.value) } });
  });
  height.addEventListener("keydown", (event) => event.stopPropagation());
  const card = el(
    "section",
    { class: "card tool" },
    el("h2", {}, "Clip box"),
    el("label", { class: "slider" }, el("span", { class: "muted" }, "Up to"), height, shown),
    fields,
    el("div", { class: "buttons" }, around),
    button("close", "", "Show all again (C)", () => store.set("clip", null)),
  );
  store.follow(["clip", "selected"], () => {
    const clip = store.get("clip");
    card.hidden = !clip;
    around.disabled = store.get("selected") === null;
    if (!clip) return;
    [height.min, height.max, height.step] = [String(clip.min_m.z + 0.05), String(clip.min_m.z + slider_m), "0.05"];
    height.value = String(clip.max_m.z);
    shown.textContent = `${metres(clip.max_m.z)} m`;
    if (!fields.contains(document.activeElement))
      fields.replaceChildren(boxFields(clip, (changed) => store.set("clip", changed)));
  });
  return card;
}
