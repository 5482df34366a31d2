// SPDX-License-Identifier: BSD-3-Clause
// A path as text: what one pastes from a planner, and what a link holds.
import type { Vector3 } from "../api/types";

export const mostWaypoints = 1000;
const farthest_m = 1e5;

const isPlace = (number: unknown): number is number =>
  typeof number === "number" && Number.isFinite(number) && Math.abs(number) <= farthest_m;

function placeOf(numbers: readonly unknown[], where: string): Vector3 {
  const [x, y, z = 0] = numbers;
  if (!isPlace(x) || !isPlace(y) || !isPlace(z)) throw new Error(`${where} is no place: x y, or x y z, in metres`);
  return { x, y, z };
}

function placeOfJson(item: unknown, i: number): Vector3 {
  const where = `waypoint ${i + 1}`;
  if (Array.isArray(item)) return placeOf(item, where);
  const json = (typeof item === "object" && item !== null ? item : {}) as { readonly [name: string]: unknown };
  const place = (json["translation_m"] ?? json["position"] ?? json) as { readonly [name: string]: unknown };
  return placeOf([place["x"] ?? 0, place["y"] ?? 0, place["z"]], where);
}

function itemsOf(json: unknown): readonly unknown[] {
  if (Array.isArray(json)) return json;
  const waypoints = (json as { readonly waypoints?: unknown } | null)?.waypoints;
  if (Array.isArray(waypoints)) return waypoints;
  throw new Error("a list of waypoints is wanted");
}

/**
 * A waypoint a line, x y or x y z (what follows does not count), or JSON: a list of lists, of {x, y, z} or of poses, or
 * {"waypoints": ...}. Throws an Error that names what is wrong.
 */
export function readPath(text: string): readonly Vector3[] {
  const trimmed = text.trim();
  const points = /^[[{]/.test(trimmed)
    ? itemsOf(parsed(trimmed)).map(placeOfJson)
    : trimmed
        .split(/[\n;]/)
        .map((line) => line.trim())
        .filter((line) => line !== "" && !line.startsWith("#"))
        .map((line, i) => placeOf(line.split(/[\s,]+/).map(Number), `line ${i + 1}`));
  if (points.length > mostWaypoints) throw new Error(`more than ${mostWaypoints} waypoints`);
  return points;
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    throw new Error("this is no JSON");
  }
}

const short = (number: number): string => String(Math.round(number * 1000) / 1000);

export const writePath = (points: readonly Vector3[], between = "\n"): string =>
  points.map(({ x, y, z }) => [x, y, z].map(short).join(" ")).join(between);

export const lengthOf_m = (points: readonly Vector3[], upTo = points.length): number =>
  points
    .slice(1, upTo)
    .reduce((sum, to, i) => sum + Math.hypot(to.x - points[i]!.x, to.y - points[i]!.y, to.z - points[i]!.z), 0);
