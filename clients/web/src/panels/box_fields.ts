// SPDX-License-Identifier: BSD-3-Clause
// A box in numbers that can be typed over.
import type { AxisBox } from "../api/types";
import { boxBetween } from "../state/boxes";
import { el } from "./dom";
import { metres, numberField } from "./fields";

const axes = ["x", "y", "z"] as const;

export function boxFields(box: AxisBox, change: (box: AxisBox) => void): HTMLElement {
  const field = (end: "min_m" | "max_m", axis: "x" | "y" | "z") => {
    const name = `${axis.toUpperCase()} ${end === "min_m" ? "from" : "to"}`;
    return numberField(name, metres(box[end][axis]), "m", false, (value) => {
      const changed = { ...box, [end]: { ...box[end], [axis]: value } };
      change(boxBetween(changed.min_m, changed.max_m));
    });
  };
  return el("div", { class: "numbers" }, ...axes.flatMap((axis) => [field("min_m", axis), field("max_m", axis)]));
}
