// SPDX-License-Identifier: BSD-3-Clause
// What the server says of a point.
import type { ViewStore } from "../state/view";
import { button, el } from "./dom";
import { metres, percent, table } from "./fields";

export function probeCard(store: ViewStore): HTMLElement | null {
  const probe = store.get("probe");
  if (!probe) return null;
  const { x, y, z } = probe.point_m;
  const { answer } = probe;
  const rows: [string, string][] = [["Point", `${metres(x)}, ${metres(y)}, ${metres(z)} m`]];
  const object = store.get("objects").get(probe.id);
  if (object) rows.push(["Of", object.label]);
  if (answer) {
    rows.push(["Class sure to", percent(answer.classConfidence)]);
    rows.push(["Nearest other", answer.neighbour ?? "nothing near"]);
    if (answer.neighbour) rows.push(["How far", `${metres(answer.distance_m)} m`]);
  }
  return el(
    "section",
    { class: "card probe" },
    el("h2", {}, "Probe"),
    table(rows),
    button("close", "", "Put the probe away", () => store.set("probe", null)),
  );
}
