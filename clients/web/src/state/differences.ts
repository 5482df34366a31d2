// SPDX-License-Identifier: BSD-3-Clause
// What has become of a map since a past state of it.
import type { MapObject, Pose, Vector3 } from "../api/types";

export interface Difference {
  readonly id: string;
  readonly label: string;
  /** "moved by 1.02 m" */
  readonly what: string;
}

export interface Differences {
  /** What people did, and what came and went, by name. */
  readonly named: readonly Difference[];
  /** Objects of which robots have merely seen more. */
  readonly numMapped: number;
}

const leastMove_m = 0.001;
const leastTurn_rad = 0.001;

const isThere = (object: MapObject | undefined): boolean =>
  object !== undefined && object.sphere !== null && object.isPresent;

/** The same place of both: events may come without boxes. */
function placesOf(before: MapObject, after: MapObject): readonly [Vector3, Vector3] {
  if (before.box && after.box) return [before.box.pose.translation_m, after.box.pose.translation_m];
  if (before.sphere && after.sphere) return [before.sphere.center, after.sphere.center];
  return [before.pose.translation_m, after.pose.translation_m];
}

/** Of its middle: a turn about the middle is no move. */
function moveOf(before: MapObject, after: MapObject): string {
  if (isSamePose(before.pose, after.pose)) return "";
  const [p, q] = placesOf(before, after);
  const length_m = Math.hypot(q.x - p.x, q.y - p.y, q.z - p.z);
  return length_m >= leastMove_m ? `moved by ${length_m.toFixed(2)} m` : "turned";
}

function isSamePose(a: Pose, b: Pose): boolean {
  const [p, q] = [a.translation_m, b.translation_m];
  const [r, s] = [a.rotation, b.rotation];
  const cos = Math.abs(r.x * s.x + r.y * s.y + r.z * s.z + r.w * s.w);
  return Math.hypot(q.x - p.x, q.y - p.y, q.z - p.z) < leastMove_m && 2 * Math.acos(Math.min(1, cos)) < leastTurn_rad;
}

function whatOf(before: MapObject | undefined, after: MapObject | undefined): string {
  if (!isThere(before)) return isThere(after) ? (before ? "is back" : "is new") : "";
  if (!before || !after) return "was removed";
  if (!isThere(after)) return "is gone";
  const changes = [
    moveOf(before, after),
    before.className !== after.className ? `was ${before.className}` : "",
    before.label !== after.label && before.className === after.className ? `was called ${before.label}` : "",
    before.isLocked !== after.isLocked ? (after.isLocked ? "locked" : "unlocked") : "",
  ];
  return changes.filter((change) => change !== "").join(", ");
}

/** By name, as one reads. */
export function differencesOf(
  past: ReadonlyMap<string, MapObject>,
  present: ReadonlyMap<string, MapObject>,
): Differences {
  const named: Difference[] = [];
  let numMapped = 0;
  for (const id of new Set([...past.keys(), ...present.keys()])) {
    const [before, after] = [past.get(id), present.get(id)];
    const what = whatOf(before, after);
    if (what !== "") named.push({ id, label: after?.label ?? before?.label ?? id, what });
    else if (isThere(after) && before?.revision !== after?.revision) ++numMapped;
  }
  named.sort((a, b) => a.label.localeCompare(b.label, "en", { numeric: true }));
  return { named, numMapped };
}
