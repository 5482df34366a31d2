// SPDX-License-Identifier: BSD-3-Clause
import type { Edits } from "../actions/edits";
import type { MapInfo } from "../api/types";
import { toggleSlice } from "../actions/toggle_slice";
import { toggleTool } from "../actions/toggle_tool";
import { nameOfEdit } from "../state/history";
import { colourModes, type ColourMode, type Tool, type ViewStore } from "../state/view";
import { button, el, icon, type IconName } from "./dom";

export interface TopBarActions {
  openMap(map: MapInfo): void;
  frameAll(): void;
  lookDown(): void;
  toggleList(): void;
  toggleClip(): void;
  saveScreenshot(): void;
}

const toolButtons: readonly (readonly [Tool, IconName, string])[] = [
  ["probe", "probe", "Probe (P): what is at a point, how far is the nearest surface"],
  ["ray", "ray", "Ray (D): what does it meet first"],
  ["measure", "measure", "Measure (M): from one place to another"],
  ["path", "path", "Path (R): can a robot go there, and what does it touch first"],
  ["region", "region", "Ignored regions (I): where robots map nothing"],
];

const next = { system: "dark", dark: "light", light: "system" } as const;

export class TopBar {
  readonly element: HTMLElement;

  constructor(
    private readonly store: ViewStore,
    edits: Edits,
    actions: TopBarActions,
  ) {
    const link = el("span", { class: "link", role: "status" });
    const revision = el("span", { class: "revision" });
    const undo = button("undo", "", "Undo", () => void edits.undo());
    const redo = button("redo", "", "Do again", () => void edits.redo());
    const boxes = button("box", "", "Boxes (B)", () => store.set("showsBoxes", !store.get("showsBoxes")));
    const tools = toolButtons.map(([tool, name, title]) => {
      const element = button(name, "", title, () => toggleTool(store, tool));
      store.follow(["tool"], () => element.setAttribute("aria-pressed", String(store.get("tool") === tool)));
      return element;
    });
    const clip = button("clip", "", "Clip box (C): only what is in it", actions.toggleClip);
    const picture = button("camera", "", "Save the picture (G), with the link of the view", actions.saveScreenshot);
    const slice = button("slice", "", "Slice (S): occupied, free and unknown at a height", () => toggleSlice(store));
    const walk = button("walk", "", "Walk (W): at the height of the eyes, by arrow keys", () =>
      store.set("walks", !store.get("walks")),
    );
    const time = button("clock", "", "Earlier states (E), and what has changed since", () =>
      store.set("showsTime", !store.get("showsTime")),
    );
    const theme = button("theme", "", "Dark, light or as the system", () =>
      store.set("theme", next[store.get("theme")]),
    );
    this.element = el(
      "header",
      { class: "top" },
      button("list", "", "Objects (L)", actions.toggleList),
      el("span", { class: "brand" }, logo(), "DHP"),
      this.mapPicker(actions),
      link,
      revision,
      el("span", { class: "gap" }),
      this.colourPicker(),
      el(
        "span",
        { class: "group" },
        button("frame", "", "See all (H)", actions.frameAll),
        button("top", "", "From above (T)", actions.lookDown),
        walk,
        boxes,
        slice,
        clip,
        time,
        picture,
      ),
      el("span", { class: "group" }, ...tools),
      el("span", { class: "group" }, undo, redo),
      el(
        "span",
        { class: "group" },
        theme,
        button("help", "", "Keys (?)", () => store.set("showsHelp", true)),
      ),
    );
    store.follow(["link", "phase"], () => {
      const texts = { live: "live", lost: "link lost, trying again", off: "connecting" } as const;
      link.dataset["link"] = store.get("link");
      link.textContent = store.get("phase").is === "locked" ? "asks for a key" : texts[store.get("link")];
    });
    store.follow(["revision", "at"], () => {
      const past = store.get("at") === null ? "" : ", in the past";
      revision.textContent = store.get("revision") > 0 ? `revision ${store.get("revision")}${past}` : "";
      revision.classList.toggle("is-past", past !== "");
    });
    store.follow(["showsBoxes", "slice_m", "walks", "showsTime", "clip"], () => {
      time.setAttribute("aria-pressed", String(store.get("showsTime")));
      walk.setAttribute("aria-pressed", String(store.get("walks")));
      slice.setAttribute("aria-pressed", String(store.get("slice_m") !== null));
      boxes.setAttribute("aria-pressed", String(store.get("showsBoxes")));
      clip.setAttribute("aria-pressed", String(store.get("clip") !== null));
    });
    store.follow(["undoable", "redoable", "history", "at"], () => {
      const last = store.get("undoable").at(-1);
      const again = store.get("redoable").at(-1);
      undo.disabled = last === undefined || store.get("at") !== null;
      redo.disabled = again === undefined || store.get("at") !== null;
      undo.title = last === undefined ? "Nothing to undo" : `Undo: ${nameOfEdit(store, last)} (Ctrl+Z)`;
      redo.title = again === undefined ? "Nothing to do again" : `Do again: ${nameOfEdit(store, again)} (Ctrl+Shift+Z)`;
    });
  }

  private mapPicker(actions: TopBarActions): HTMLElement {
    const picker = el("select", { class: "picker", aria: { label: "Map" } });
    picker.addEventListener("change", () => {
      const map = this.store.get("maps").find((each) => each.id === picker.value);
      if (map) actions.openMap(map);
    });
    this.store.follow(["maps", "map"], () => {
      picker.replaceChildren(...this.store.get("maps").map((map) => el("option", { value: map.id }, map.displayName)));
      picker.value = this.store.get("map")?.id ?? "";
      picker.hidden = this.store.get("maps").length === 0;
    });
    return picker;
  }

  private colourPicker(): HTMLElement {
    const picker = el(
      "select",
      { class: "picker", aria: { label: "Colour by" } },
      ...colourModes.map((mode) => el("option", { value: mode }, mode)),
    );
    picker.addEventListener("change", () => this.store.set("colour", picker.value as ColourMode));
    this.store.follow(["colour"], () => {
      picker.value = this.store.get("colour");
    });
    return el("label", { class: "labelled" }, el("span", {}, "Colour"), picker);
  }
}

const logo = () => icon("box");
