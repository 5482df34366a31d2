// SPDX-License-Identifier: BSD-3-Clause
import { Vector3 } from "three";
import { toggleSlice } from "../actions/toggle_slice";
import type { Edits } from "../actions/edits";
import { toggleTool } from "../actions/toggle_tool";
import { colourModes, type ViewStore } from "../state/view";
import type { MoveTool } from "../tools/move";
import type { WalkTool } from "../tools/walk";

export interface KeyActions {
  focusSearch(): void;
  focusSelection(): void;
  frameAll(): void;
  lookDown(): void;
  toggleList(): void;
  /** null: now. */
  showRevision(revision: number | null): void;
  stepTime(by: 1 | -1): Promise<void>;
  toggleClip(): void;
  saveScreenshot(): void;
}

const step_m = 0.05;
const nudges: { readonly [key: string]: readonly [number, number] } = {
  ArrowLeft: [-step_m, 0],
  ArrowRight: [step_m, 0],
  ArrowUp: [0, step_m],
  ArrowDown: [0, -step_m],
};

/** Keys that count wherever nothing is typed. */
export function listenToKeys(
  store: ViewStore,
  edits: Edits,
  moveTool: MoveTool,
  walkTool: WalkTool,
  actions: KeyActions,
): void {
  const hideSelected = () => {
    const selected = store.get("selected");
    if (selected === null) return;
    store.set("hiddenObjects", new Set([...store.get("hiddenObjects"), selected]));
    store.set("selected", null);
  };
  const letGo = () => {
    if (moveTool.isBusy) return moveTool.cancel();
    if (store.get("draft")) return store.set("draft", null);
    if (store.get("walks")) return store.set("walks", false);
    if (store.get("regionDraft")) return store.set("regionDraft", null);
    if (store.get("tool") !== "select") store.set("tool", "select");
    else if (store.get("selected") !== null) store.set("selected", null);
    else store.set("query", "");
    store.set("probe", null);
    store.set("ray", null);
    store.set("measured_m", []);
  };
  const byKey: { readonly [key: string]: () => void } = {
    "/": actions.focusSearch,
    f: actions.focusSelection,
    h: actions.frameAll,
    Home: actions.frameAll,
    t: actions.lookDown,
    l: actions.toggleList,
    s: () => toggleSlice(store),
    b: () => store.set("showsBoxes", !store.get("showsBoxes")),
    x: hideSelected,
    Escape: letGo,
    p: () => toggleTool(store, "probe"),
    r: () => toggleTool(store, "path"),
    d: () => toggleTool(store, "ray"),
    m: () => toggleTool(store, "measure"),
    i: () => toggleTool(store, "region"),
    c: actions.toggleClip,
    g: actions.saveScreenshot,
    w: () => store.set("walks", !store.get("walks")),
    "?": () => store.set("showsHelp", true),
    e: () => store.set("showsTime", !store.get("showsTime")),
    n: () => actions.showRevision(null),
    ",": () => void actions.stepTime(-1),
    ".": () => void actions.stepTime(1),
    "[": () => moveTool.turn(Math.PI / 12),
    "]": () => moveTool.turn(-Math.PI / 12),
  };
  document.addEventListener("pointerdown", () => document.body.classList.remove("by-keys"), { capture: true });
  document.addEventListener("keydown", (event) => {
    if (event.key === "Tab") document.body.classList.add("by-keys");
    const { target } = event;
    const isTyping =
      (target instanceof HTMLInputElement && target.type !== "checkbox") || target instanceof HTMLTextAreaElement;
    if (isTyping || target instanceof HTMLSelectElement || document.querySelector("dialog[open]")) return;
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z") {
      event.preventDefault();
      void (event.shiftKey ? edits.redo() : edits.undo());
      return;
    }
    if (event.ctrlKey || event.metaKey) return;
    if (walkTool.press(event)) return event.preventDefault();
    const nudge = event.altKey ? nudges[event.key] : undefined;
    const mode = colourModes[Number(event.key) - 1];
    const action = nudge
      ? () => moveTool.shift(new Vector3(nudge[0], nudge[1], 0))
      : event.altKey
        ? undefined
        : mode
          ? () => store.set("colour", mode)
          : byKey[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
