// SPDX-License-Identifier: BSD-3-Clause
// A robot as planners know it: balls, in its own frame, whose origin is on the floor.
import type { Vector3 } from "../api/types";

export interface Ball {
  readonly center_m: Vector3;
  readonly radius_m: number;
}

/** Over the floor, so that this is not what it touches. */
export const clearance_m = 0.06;
export const robotLimits = { radius_m: [0.03, 2], height_m: [0.1, 3] } as const;

/** A column: balls one above the other, each into the next by half, up to its height. */
export function columnOf(radius_m: number, height_m: number): readonly Ball[] {
  const lowest = clearance_m + radius_m;
  const highest = Math.max(lowest, height_m - radius_m);
  const num = 1 + Math.ceil((highest - lowest) / radius_m);
  return Array.from({ length: num }, (_, i) => ({
    center_m: { x: 0, y: 0, z: num === 1 ? lowest : lowest + ((highest - lowest) * i) / (num - 1) },
    radius_m,
  }));
}
