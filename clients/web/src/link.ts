// SPDX-License-Identifier: BSD-3-Clause
// The address follows the view, and the view the address.
import { readLink, writeLink, type Linked } from "./state/url";
import type { ViewStore } from "./state/view";

/** Kept as they are, in the address and in the store. */
const kept = [
  "selected",
  "query",
  "hiddenClasses",
  "hiddenObjects",
  "showsGone",
  "colour",
  "showsBoxes",
  "theme",
  "slice_m",
  "measured_m",
  "clip",
  "path",
] as const;
const followed = ["map", "at", ...kept, "camera"] as const;
/** Browsers stop pages that change their address more often. */
const pause_ms = 300;

function linkedOf(store: ViewStore): Linked {
  return {
    mapId: store.get("map")?.id ?? "",
    at: store.get("at"),
    selected: store.get("selected"),
    query: store.get("query"),
    hiddenClasses: store.get("hiddenClasses"),
    hiddenObjects: store.get("hiddenObjects"),
    showsGone: store.get("showsGone"),
    colour: store.get("colour"),
    showsBoxes: store.get("showsBoxes"),
    theme: store.get("theme"),
    slice_m: store.get("slice_m"),
    measured_m: store.get("measured_m"),
    clip: store.get("clip"),
    path: store.get("path"),
    camera: store.get("camera"),
  };
}

function apply(store: ViewStore, link: Linked): void {
  for (const key of kept) store.set(key, link[key]);
}

/** The address of what is shown, as it is now. */
export const linkOf = (store: ViewStore): string =>
  `${location.origin}${location.pathname}#${writeLink(linkedOf(store))}`;

/** Takes the address as the view, and keeps it up from there on. What the address said at first. */
export function keepLink(store: ViewStore): Linked {
  const first = readLink(location.hash);
  apply(store, first);
  let timer = 0;
  store.follow(followed, () => {
    if (timer !== 0 || !store.get("map")) return;
    timer = window.setTimeout(() => {
      timer = 0;
      history.replaceState(null, "", `#${writeLink(linkedOf(store))}`);
    }, pause_ms);
  });
  addEventListener("hashchange", () => location.reload());
  return first;
}
