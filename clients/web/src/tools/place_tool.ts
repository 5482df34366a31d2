// SPDX-License-Identifier: BSD-3-Clause
import type { Vector3 } from "three";
import type { Hit } from "../scene/renderer";
import type { Tool } from "../state/view";

/** What a click on a place does, while that tool is in hand. */
export interface PlaceTool {
  /** `hit`: the surface there; `floor`: where one looks through it at z = 0, if one does. */
  click(hit: Hit | null, floor: Vector3 | null): void;
  /** What it would do there. */
  hover?(hit: Hit | null, floor: Vector3 | null): void;
}

export type PlaceTools = { readonly [Name in Exclude<Tool, "select">]: PlaceTool };
