// SPDX-License-Identifier: BSD-3-Clause
// What a ray meets, as a planner is told it.
import type { ViewStore } from "../state/view";
import type { RayTool } from "../tools/ray";
import { button, el } from "./dom";
import { metres, table } from "./fields";

export function newRayCard(store: ViewStore, tool: RayTool): HTMLElement {
  const result = el("div", { role: "status" });
  const along = button(null, "Along the view", "From the eye, straight ahead", () => tool.alongTheView());
  const card = el(
    "section",
    { class: "card tool" },
    el("h2", {}, "Ray"),
    result,
    el("div", { class: "buttons" }, along),
    button("close", "", "Put the ray away (D)", () => {
      store.set("ray", null);
      if (store.get("tool") === "ray") store.set("tool", "select");
    }),
  );
  store.follow(["ray", "tool", "objects"], () => {
    card.hidden = store.get("tool") !== "ray" && store.get("ray") === null;
    result.replaceChildren(...resultOf(store));
  });
  return card;
}

function resultOf(store: ViewStore): HTMLElement[] {
  const ray = store.get("ray");
  if (!ray) return [el("p", { class: "muted" }, "Click where it begins, then what it goes through.")];
  const { answer } = ray;
  if (!answer) return [el("p", { class: "muted" }, "Asking…")];
  const rows: [string, string][] = [
    ["Free for", `${metres(answer.free_m)} m`],
    ["Then", answer.isSeen ? (answer.point_m ? "a surface" : "nothing, as far as one asks") : "what nobody has seen"],
  ];
  if (!answer.point_m) return [el("p", {}, "It meets nothing"), table(rows)];
  const label = store.get("objects").get(answer.id ?? "")?.label ?? "what is not known";
  const { id } = answer;
  return [
    el(
      "p",
      {},
      `After ${metres(answer.distance_m)} m it meets `,
      id === null ? label : button(null, label, `Select ${label}`, () => store.set("selected", id)),
    ),
    table(rows),
  ];
}
