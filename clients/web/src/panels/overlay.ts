// SPDX-License-Identifier: BSD-3-Clause
import type { MapInfo } from "../api/types";
import type { ViewStore } from "../state/view";
import { button, el } from "./dom";
import { newLoginForm } from "./login_form";

const mostChoices = 12;

const keys: readonly (readonly [string, string])[] = [
  ["Drag", "turn about what is under the cursor"],
  ["Right drag, Shift+drag", "shift"],
  ["Wheel, pinch", "come nearer to what is under the cursor"],
  ["Click", "select"],
  ["Double click, F", "go there"],
  ["/", "search"],
  ["↑ ↓ in the list", "next object"],
  ["H", "see all"],
  ["T", "from above"],
  ["W, then ↑ ↓ ← →", "walk through it; a drag looks around, Shift is faster"],
  ["B", "boxes"],
  ["1 – 6", "colour by sensor, class, object, confidence, last seen, presence"],
  ["X", "hide the selection"],
  ["P", "probe a point"],
  ["D", "a ray: what does it meet first"],
  ["M", "measure from one place of a surface to another"],
  ["C", "clip box: only what is in it"],
  ["G", "save the picture, with the link of the view"],
  ["I", "ignored regions: where robots map nothing"],
  ["R", "a robot's path: what does it touch first"],
  ["S", "slice: occupied, free, unknown at a height"],
  ["E", "earlier states of the map, and what has changed since"],
  [", and .", "one state back, one on"],
  ["N", "back to now"],
  ["Alt+arrows", "move the selection by 5 cm"],
  ["[ ]", "turn it by 15°"],
  ["Ctrl+Z, Ctrl+Shift+Z", "undo, do again"],
  ["L", "list of objects"],
  ["Esc", "let go, clear the search"],
];

/** What is said in the middle while there is no map to see. */
export function newOverlay(
  store: ViewStore,
  openMap: (map: MapInfo) => void = () => undefined,
  onLogin: () => void = () => undefined,
): HTMLElement {
  const overlay = el("div", { class: "overlay", role: "status" });
  store.follow(["phase"], () => {
    const phase = store.get("phase");
    overlay.hidden = phase.is === "ready";
    const say = (title: string, ...more: (Node | string)[]) =>
      overlay.replaceChildren(el("div", { class: "message" }, el("h1", {}, title), ...more));
    switch (phase.is) {
      case "connecting":
        return say("Connecting");
      case "loading":
        return say(
          "Loading the map",
          el(
            "p",
            { class: "muted" },
            phase.bytes > 0 ? `${(phase.bytes / 1e6).toFixed(1)} MB of surfaces` : "Making its surfaces",
          ),
          el("div", { class: "progress" }),
        );
      case "no maps":
        return say(
          "No map yet",
          el("p", {}, "Feed one, and it appears here while the robot maps:"),
          el("pre", {}, "dhpmap map DATASET_DIR --map office"),
        );
      case "no such map":
        return say(
          `There is no map “${phase.id}” here`,
          el("p", {}, "It appears once somebody makes it. These are there:"),
          el(
            "ul",
            { class: "choices" },
            ...store
              .get("maps")
              .slice(0, mostChoices)
              .map((map) =>
                el("li", {}, button(null, map.displayName, `Open ${map.displayName}`, () => openMap(map))),
              ),
          ),
        );
      case "failed":
        return say(
          "The server does not answer",
          el("p", {}, phase.why),
          el("p", { class: "muted" }, "Trying again by itself."),
        );
      case "locked":
        return say(
          "This server asks for a key",
          newLoginForm(onLogin),
          el("p", { class: "muted" }, phase.why),
        );
      case "no webgl":
        return say(
          "This browser shows no 3D",
          el(
            "p",
            {},
            "The viewer needs WebGL 2. Turn on hardware acceleration in the browser's settings, or use another browser.",
          ),
          el("p", { class: "muted" }, "The same map as files and JSON: /openapi.json"),
        );
      case "ready":
        return overlay.replaceChildren();
    }
  });
  return overlay;
}

export function newHelp(store: ViewStore): HTMLElement {
  const dialog = el(
    "dialog",
    { class: "help", aria: { label: "Keys" } },
    el("h1", {}, "Keys"),
    el(
      "dl",
      { class: "facts keys" },
      ...keys.flatMap(([key, what]) => [el("dt", {}, el("kbd", {}, key)), el("dd", {}, what)]),
    ),
    el("button", { type: "button", class: "button", onClick: () => store.set("showsHelp", false) }, "Close"),
  );
  dialog.addEventListener("close", () => store.set("showsHelp", false));
  store.follow(["showsHelp"], () => {
    if (store.get("showsHelp") && !dialog.open) dialog.showModal();
    if (!store.get("showsHelp") && dialog.open) dialog.close();
  });
  return dialog;
}
