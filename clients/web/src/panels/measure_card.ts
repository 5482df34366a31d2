// SPDX-License-Identifier: BSD-3-Clause
import type { ViewStore } from "../state/view";
import { button, el } from "./dom";
import { metres, table } from "./fields";

export function newMeasureCard(store: ViewStore): HTMLElement {
  const result = el("div", { role: "status" });
  const card = el(
    "section",
    { class: "card tool" },
    el("h2", {}, "Measure"),
    result,
    button("close", "", "Put the measure away (M)", () => {
      store.set("measured_m", []);
      if (store.get("tool") === "measure") store.set("tool", "select");
    }),
  );
  store.follow(["measured_m", "tool"], () => {
    const [from, to] = store.get("measured_m");
    card.hidden = store.get("tool") !== "measure" && !to;
    if (!from || !to)
      return result.replaceChildren(el("p", { class: "muted" }, from ? "Click the other end." : "Click a surface."));
    const [x, y, z] = [to.x - from.x, to.y - from.y, to.z - from.z];
    result.replaceChildren(
      table([
        ["Distance", `${metres(Math.hypot(x, y, z))} m`],
        ["Over the floor", `${metres(Math.hypot(x, y))} m`],
        ["Up", `${metres(z)} m`],
        ["Along X, Y", `${metres(x)}, ${metres(y)} m`],
      ]),
    );
  });
  return card;
}
