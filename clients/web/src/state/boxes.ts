// SPDX-License-Identifier: BSD-3-Clause
// Boxes along the axes: made of corners, kept in order, as text.
import type { AxisBox, MapObject, Vector3 } from "../api/types";

/** Thinner ones show nothing. */
const leastSide_m = 0.02;

/** Whichever corners they are. */
export function boxBetween(a: Vector3, b: Vector3): AxisBox {
  const least = (axis: "x" | "y" | "z") => Math.min(a[axis], b[axis]);
  const most = (axis: "x" | "y" | "z") => Math.max(least(axis) + leastSide_m, a[axis], b[axis]);
  return {
    min_m: { x: least("x"), y: least("y"), z: least("z") },
    max_m: { x: most("x"), y: most("y"), z: most("z") },
  };
}

/** The smallest around all; null: around nothing. */
export function boxAround(points: Iterable<Vector3>): AxisBox | null {
  let box: AxisBox | null = null;
  for (const point of points) {
    const { min_m, max_m }: AxisBox = box ?? { min_m: point, max_m: point };
    box = {
      min_m: { x: Math.min(min_m.x, point.x), y: Math.min(min_m.y, point.y), z: Math.min(min_m.z, point.z) },
      max_m: { x: Math.max(max_m.x, point.x), y: Math.max(max_m.y, point.y), z: Math.max(max_m.z, point.z) },
    };
  }
  return box;
}

/** Its corners seen from above, at its lower and its upper side. */
function cornersOf({ box, sphere }: MapObject): Vector3[] {
  const middle = box?.pose.translation_m ?? sphere?.center;
  if (!middle) return [];
  const ball = 2 * (sphere?.radius_m ?? 0);
  const half = box?.size_m ?? { x: ball, y: ball, z: ball };
  // A box is turned about the vertical alone.
  const turn = box ? 2 * Math.atan2(box.pose.rotation.z, box.pose.rotation.w) : 0;
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  return [-0.5, 0.5].flatMap((u) =>
    [-0.5, 0.5].flatMap((v) =>
      [-0.5, 0.5].map((w) => ({
        x: middle.x + u * half.x * cos - v * half.y * sin,
        y: middle.y + u * half.x * sin + v * half.y * cos,
        z: middle.z + w * half.z,
      })),
    ),
  );
}

export const boxOfObjects = (objects: Iterable<MapObject>): AxisBox | null =>
  boxAround([...objects].flatMap(cornersOf));

export function grown({ min_m, max_m }: AxisBox, by_m: number): AxisBox {
  return {
    min_m: { x: min_m.x - by_m, y: min_m.y - by_m, z: min_m.z - by_m },
    max_m: { x: max_m.x + by_m, y: max_m.y + by_m, z: max_m.z + by_m },
  };
}

const short = (number: number): string => String(Math.round(number * 1000) / 1000);

export const writeBox = ({ min_m, max_m }: AxisBox): string =>
  [min_m.x, min_m.y, min_m.z, max_m.x, max_m.y, max_m.z].map(short).join(",");

/** Null where it is none. */
export function readBox(text: string | null): AxisBox | null {
  const numbers = (text ?? "").split(",").map((part) => (part === "" ? NaN : Number(part)));
  if (numbers.length !== 6 || !numbers.every(Number.isFinite)) return null;
  const [a, b, c, d, e, f] = numbers as [number, number, number, number, number, number];
  return boxBetween({ x: a, y: b, z: c }, { x: d, y: e, z: f });
}
