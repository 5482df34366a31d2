// SPDX-License-Identifier: BSD-3-Clause
// A merge or a split, tried out before it is made.
import type { Edits } from "../actions/edits";
import type { MapObject } from "../api/types";
import type { Draft, ViewStore } from "../state/view";
import { cutAcross } from "../tools/draft";
import { button, el } from "./dom";

/** Stays as it is while one drags its sliders. */
export function newDraftCard(store: ViewStore, edits: Edits): HTMLElement {
  const title = el("h2");
  const what = el("p");
  const trial = el("p", { class: "muted", role: "status" });
  const make = button(null, "Merge", "Do it", () => {
    const draft = store.get("draft");
    if (draft) void edits.make(draft);
  });
  const cut = newCutFields(store);
  const card = el(
    "section",
    { class: "card draft" },
    title,
    what,
    cut,
    trial,
    el(
      "div",
      { class: "buttons" },
      make,
      button(null, "Cancel", "Leave it (Esc)", () => store.set("draft", null)),
    ),
  );
  store.follow(["draft", "trial", "objects"], () => {
    const draft = store.get("draft");
    const object = store.get("objects").get(draft?.id ?? "");
    card.hidden = !draft || !object;
    if (!draft || !object) return;
    const result = store.get("trial");
    title.textContent = draft.is === "merge" ? "Merge" : "Split";
    what.textContent = describe(store, draft, object);
    cut.hidden = draft.is !== "split";
    trial.textContent = result?.text ?? (draft.is === "merge" && draft.other === null ? "" : "Asking…");
    trial.className = result && !result.isGood ? "trouble" : "muted";
    make.textContent = draft.is === "merge" ? "Merge" : "Split";
    make.setAttribute("aria-label", make.textContent);
    make.disabled = result?.isGood !== true;
  });
  return card;
}

function describe(store: ViewStore, draft: Draft, object: MapObject): string {
  if (draft.is === "split")
    return draft.cut.by === "parts" ? "Each part that hangs together, for itself." : "What is beyond the plane, for itself.";
  if (draft.other === null) return `Click what shall become a part of ${object.label}.`;
  return `${store.get("objects").get(draft.other)?.label ?? "It"} becomes a part of ${object.label}.`;
}

function newCutFields(store: ViewStore): HTMLElement {
  const slider = (label: string, least: number, most: number, step: number) => {
    const input = el("input", { type: "range", aria: { label } });
    [input.min, input.max, input.step] = [String(least), String(most), String(step)];
    input.value = "0";
    input.addEventListener("input", () => cutByPlane());
    input.addEventListener("keydown", (event) => event.stopPropagation());
    return input;
  };
  const turn = slider("Turn of the plane, degrees", -90, 90, 5);
  const shift = slider("Place of the plane, share of the size", -0.5, 0.5, 0.02);
  const set = (by: "parts" | "plane", object: MapObject) => {
    const size_m = object.box ? Math.hypot(object.box.size_m.x, object.box.size_m.y) : 1;
    const cut =
      by === "parts"
        ? ({ by } as const)
        : cutAcross(object, (Number(turn.value) * Math.PI) / 180, Number(shift.value) * size_m);
    store.set("draft", { is: "split", id: object.id, cut });
  };
  const current = () => {
    const draft = store.get("draft");
    return draft?.is === "split" ? (store.get("objects").get(draft.id) ?? null) : null;
  };
  const cutByPlane = () => {
    const object = current();
    if (object) set("plane", object);
  };
  const parts = button(null, "Its parts", "Each part that hangs together", () => {
    const object = current();
    if (object) set("parts", object);
  });
  const plane = button(null, "By a plane", "What is beyond an upright plane", cutByPlane);
  const sliders = el(
    "div",
    {},
    el("label", { class: "slider" }, el("span", { class: "muted" }, "Turn"), turn),
    el("label", { class: "slider" }, el("span", { class: "muted" }, "Place"), shift),
  );
  store.follow(["draft"], () => {
    const draft = store.get("draft");
    const isPlane = draft?.is === "split" && draft.cut.by === "plane";
    parts.setAttribute("aria-pressed", String(!isPlane));
    plane.setAttribute("aria-pressed", String(isPlane));
    sliders.hidden = !isPlane;
  });
  return el("div", {}, el("div", { class: "buttons" }, parts, plane), sliders);
}
