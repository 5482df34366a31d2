// SPDX-License-Identifier: BSD-3-Clause
// What is known of an object.
import type { MapObject } from "../api/types";
import { metres, percent, table } from "./fields";

export function factsCard(object: MapObject, newest_ns: bigint): HTMLElement {
  const size = object.box?.size_m;
  return table([
    ["Class", `${object.className}, ${percent(object.classConfidence)} of its views`],
    ["Kind", object.kind === "thing" ? "thing" : object.kind === "stuff" ? "background" : "not known"],
    ["Voxels its own", percent(object.instanceConfidence)],
    ["Size", size ? `${metres(size.x)} × ${metres(size.y)} × ${metres(size.z)} m` : "—"],
    ["Presence", object.isPresent ? (object.isConfirmed ? "there" : "there, seen too little to be sure") : "gone"],
    ["Last seen", lastSeen(object, newest_ns)],
    ["Seen in", `${object.numFrames} frames`],
    ["Locked", object.isLocked ? "robots leave it as it is" : "no"],
    ["Id", `#${object.id}, revision ${object.revision}`],
  ]);
}

function lastSeen(object: MapObject, newest_ns: bigint): string {
  if (object.lastSeen_ns === 0n) return "never";
  const ago_s = Number(newest_ns - object.lastSeen_ns) / 1e9;
  return ago_s < 0.05
    ? "in the newest frame"
    : `${ago_s < 120 ? `${ago_s.toFixed(1)} s` : `${Math.round(ago_s / 60)} min`} before the newest frame`;
}
