// SPDX-License-Identifier: BSD-3-Clause
// Where an object is, in numbers that can be typed over.
import { Vector3 } from "three";
import type { MapObject } from "../api/types";
import type { ViewStore } from "../state/view";
import type { MoveTool } from "../tools/move";
import { pivotOf } from "../tools/poses";
import { el } from "./dom";
import { metres, numberField } from "./fields";

export function poseCard(store: ViewStore, moveTool: MoveTool, object: MapObject): HTMLElement {
  const pending = store.get("pending");
  const pivot = pivotOf(object);
  const isFixed = object.kind !== "thing" || store.get("at") !== null;
  const shift =
    pending?.id === object.id
      ? new Vector3(
          pending.pose.translation_m.x - object.pose.translation_m.x,
          pending.pose.translation_m.y - object.pose.translation_m.y,
          pending.pose.translation_m.z - object.pose.translation_m.z,
        )
      : new Vector3();
  const field = (axis: "x" | "y" | "z") =>
    numberField(axis.toUpperCase(), metres(pivot[axis] + shift[axis]), "m", isFixed, (value) => {
      moveTool.shift(new Vector3().setComponent("xyz".indexOf(axis), value - pivot[axis]));
    });
  const turn = numberField("Turn by", "0", "°", isFixed, (value) =>
    moveTool.turn((value * Math.PI) / 180),
  );
  return el(
    "section",
    { class: "card pose" },
    el("h2", {}, "Middle, in the map"),
    el("div", { class: "numbers" }, field("x"), field("y"), field("z"), turn),
    el(
      "p",
      { class: "muted" },
      store.get("at") !== null
        ? "As it was then."
        : object.kind === "thing"
          ? "Drag it over the floor, turn it by its ring, or type and press Enter."
          : "Backgrounds stay where they are.",
    ),
  );
}
