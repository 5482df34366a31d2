// SPDX-License-Identifier: BSD-3-Clause
// Where mapping takes nothing any more: a box is drawn, said to be so, and lifted.
import type { Edits } from "../actions/edits";
import type { RegionDraft, ViewStore } from "../state/view";
import type { RegionTool } from "../tools/region";
import { boxFields } from "./box_fields";
import { button, el } from "./dom";

export function newRegionCard(store: ViewStore, edits: Edits, tool: RegionTool): HTMLElement {
  const fields = el("div");
  const name = el("input", { type: "text", aria: { label: "Name of the region" } });
  const clears = el("input", { type: "checkbox" });
  const change = (part: Partial<RegionDraft>) => {
    const draft = store.get("regionDraft");
    if (draft) store.set("regionDraft", { ...draft, ...part });
  };
  name.addEventListener("input", () => change({ name: name.value.trim() }));
  name.addEventListener("keydown", (event) => {
    event.stopPropagation();
    if (event.key === "Escape" || event.key === "Enter") name.blur();
  });
  clears.addEventListener("change", () => change({ clears: clears.checked }));
  const make = button(null, "Keep it clear", "From now on robots map nothing there; can be undone", () => {
    const draft = store.get("regionDraft");
    if (draft) void edits.ignore(draft);
  });
  const cancel = button(null, "Cancel", "Leave it (Esc)", () => store.set("regionDraft", null));
  const form = el(
    "div",
    {},
    el("label", { class: "number" }, el("span", {}, "Name"), name),
    fields,
    el("label", { class: "check" }, clears, "Clear what is there now, too"),
    el("div", { class: "buttons" }, make, cancel),
  );
  const around = button(null, "Around the selection", "A box around what is selected, or in the middle", () =>
    tool.around(),
  );
  const hint = el(
    "div",
    {},
    el("p", { class: "muted" }, "Robots map nothing in an ignored region: a door that swings, a screen."),
    el("p", { class: "muted" }, "Click two corners on the floor, or:"),
    el("div", { class: "buttons" }, around),
  );
  const there = el("ul", { class: "log" });
  const card = el(
    "section",
    { class: "card tool region" },
    el("h2", {}, "Ignored regions"),
    hint,
    form,
    there,
    button("close", "", "Put the regions away (I)", () => store.set("tool", "select")),
  );
  store.follow(["tool", "regionDraft", "regions", "at"], () => {
    const draft = store.get("regionDraft");
    card.hidden = store.get("tool") !== "region";
    hint.hidden = draft !== null;
    form.hidden = draft === null;
    make.disabled = store.get("at") !== null || draft?.name === "";
    there.replaceChildren(...store.get("regions").map((region) => regionRow(store, edits, region.name)));
    if (!draft) return;
    if (document.activeElement !== name) name.value = draft.name;
    clears.checked = draft.clears;
    if (!fields.contains(document.activeElement))
      fields.replaceChildren(boxFields(draft.box, (box) => change({ box })));
  });
  return card;
}

function regionRow(store: ViewStore, edits: Edits, name: string): HTMLElement {
  const lift = button(null, "Lift", `Robots map in ${name} again; can be undone`, () => void edits.lift(name));
  lift.disabled = store.get("at") !== null;
  return el("li", {}, el("span", {}, name), el("span", { class: "gap" }), lift);
}
