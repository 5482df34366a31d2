// SPDX-License-Identifier: BSD-3-Clause
import { Box3, Vector3, type Ray } from "three";
import type { AxisBox } from "../api/types";
import { clipping } from "./surface_material";

const far_m = 1e9;
const everything: AxisBox = {
  min_m: { x: -far_m, y: -far_m, z: -far_m },
  max_m: { x: far_m, y: far_m, z: far_m },
};

/** Surfaces beyond it are neither drawn nor picked; null: all are. What it then is. */
export function setClipBox(box: AxisBox | null): Box3 | null {
  const { min_m, max_m } = box ?? everything;
  clipping.min.value.set(min_m.x, min_m.y, min_m.z);
  clipping.max.value.set(max_m.x, max_m.y, max_m.z);
  return box && new Box3(clipping.min.value, clipping.max.value);
}

/** From where to where along the ray one is in the box; null: nowhere. */
export function inClipBox({ origin, direction }: Ray): readonly [number, number] | null {
  let [near, far] = [0, Infinity];
  for (const axis of ["x", "y", "z"] as const) {
    if (direction[axis] === 0) continue; // along these sides; the others decide
    const to = (side: Vector3) => (side[axis] - origin[axis]) / direction[axis];
    const ends = [to(clipping.min.value), to(clipping.max.value)];
    near = Math.max(near, Math.min(...ends));
    far = Math.min(far, Math.max(...ends));
  }
  return near < far ? [near, far] : null;
}
