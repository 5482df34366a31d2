// SPDX-License-Identifier: BSD-3-Clause
// What has become of the map since the state that is shown.
import { differencesOf } from "../state/differences";
import type { ViewStore } from "../state/view";
import { button, el } from "./dom";

const mostNamed = 30;

export function newPastCard(store: ViewStore, showNow: () => void): HTMLElement {
  const title = el("h2");
  const list = el("ul", { class: "log" });
  const rest = el("p", { class: "muted" });
  const card = el(
    "section",
    { class: "card past" },
    title,
    list,
    rest,
    el("div", { class: "buttons" }, button(null, "Back to now", "Back to now (N)", showNow)),
  );
  store.follow(["at", "objects", "present"], () => {
    const at = store.get("at");
    card.hidden = at === null;
    if (at === null) return;
    title.textContent = `Since revision ${at}`;
    const { named, numMapped } = differencesOf(store.get("objects"), store.get("present"));
    list.replaceChildren(
      ...named.slice(0, mostNamed).map(({ id, label, what }) => {
        const select = button(null, label, `Select ${label}`, () => store.set("selected", id));
        select.disabled = !store.get("objects").has(id);
        return el("li", {}, select, el("span", { class: "muted" }, what));
      }),
    );
    rest.textContent = restOf(named.length, numMapped);
  });
  return card;
}

function restOf(numNamed: number, numMapped: number): string {
  const more = numNamed > mostNamed ? `And ${numNamed - mostNamed} more. ` : "";
  if (numMapped > 0) return `${more}Of ${numMapped === 1 ? "one object" : `${numMapped} objects`} more was seen.`;
  return numNamed === 0 ? "Nothing has changed." : more;
}
