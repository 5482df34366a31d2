// SPDX-License-Identifier: BSD-3-Clause
// Which of the states that the server keeps is shown.
import { nameOfEdit } from "../state/history";
import type { ViewStore } from "../state/view";
import { button, el } from "./dom";

export interface TimeActions {
  /** null: now. */
  show(revision: number | null): void;
  step(by: 1 | -1): Promise<void>;
}

export const clockOf = (time_ms: number): string => new Date(time_ms).toLocaleTimeString("en-GB");

/** "40 s", "3 min", "2 h": how long before `now_ms`. */
export function agoOf(time_ms: number, now_ms: number): string {
  const ago_s = Math.max(0, (now_ms - time_ms) / 1000);
  if (ago_s < 100) return `${Math.round(ago_s)} s`;
  return ago_s < 6000 ? `${Math.round(ago_s / 60)} min` : `${Math.round(ago_s / 3600)} h`;
}

export function newTimeline(store: ViewStore, actions: TimeActions): HTMLElement {
  const slider = el("input", { type: "range", aria: { label: "State of the map" } });
  [slider.min, slider.step] = ["0", "1"];
  const said = el("span", { class: "when", role: "status" });
  const older = button(null, "‹", "The state before (,)", () => void actions.step(-1));
  const newer = button(null, "›", "The state after (.)", () => void actions.step(1));
  const now = button(null, "Now", "Back to now (N)", () => actions.show(null));
  const close = button("close", "", "Put the timeline away (E)", () => {
    actions.show(null);
    store.set("showsTime", false);
  });
  const element = el("section", { class: "timeline", aria: { label: "Time" } }, older, slider, newer, said, now, close);
  slider.addEventListener("input", () => {
    const kept = store.get("kept");
    const chosen = kept[kept.length - 1 - Number(slider.value)];
    if (chosen) actions.show(chosen === kept[0] ? null : chosen.revision);
  });
  store.follow(["showsTime", "at", "kept", "history", "newest"], () => {
    const [at, kept] = [store.get("at"), store.get("kept")];
    element.hidden = !store.get("showsTime");
    document.body.classList.toggle("has-timeline", !element.hidden);
    element.classList.toggle("is-past", at !== null);
    const place = at === null ? 0 : kept.findIndex(({ revision }) => revision === at);
    slider.max = String(Math.max(0, kept.length - 1));
    if (place >= 0) slider.value = String(kept.length - 1 - place);
    slider.disabled = kept.length < 2;
    older.disabled = place === kept.length - 1;
    newer.disabled = now.disabled = at === null;
    said.textContent = describe(store, place);
    slider.setAttribute("aria-valuetext", said.textContent);
  });
  return element;
}

/** `place`: of what is shown among the kept states; -1: it is none of them any more. */
function describe(store: ViewStore, place: number): string {
  const [at, kept] = [store.get("at"), store.get("kept")];
  if (at === null) {
    const oldest = kept.at(-1);
    if (oldest && kept.length > 1)
      return `Now. ${kept.length - 1} earlier states are kept, back to ${clockOf(oldest.time_ms)}`;
    return "Now. No earlier state is kept: the server keeps the last ones of a map while it is open";
  }
  const shown = kept[place];
  if (!shown) return `Revision ${at} is no longer kept: what you see is all that is left of it`;
  const edit = store.get("history").some(({ revision }) => revision === at) ? ` · after ${nameOfEdit(store, at)}` : "";
  return `${clockOf(shown.time_ms)}, ${agoOf(shown.time_ms, Date.now())} ago · revision ${at}${edit}`;
}
