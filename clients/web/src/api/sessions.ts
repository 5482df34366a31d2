// SPDX-License-Identifier: BSD-3-Clause
// Who feeds a map, where it is and where it has been.
import { askJson } from "./ask";
import { asJson, asList, asNumber, asText, readPose } from "./read";
import type { Robot, Vector3 } from "./types";

const most = 100;

function readRobot(value: unknown): Robot | null {
  const json = asJson(value);
  if (json["map_from_sensor"] === undefined || json["map_from_sensor"] === null) return null;
  const numbers = asList(json["packed_path_m"]).map(asNumber);
  const path_m: Vector3[] = [];
  for (let i = 0; i + 2 < numbers.length; i += 3)
    path_m.push({ x: numbers[i] ?? 0, y: numbers[i + 1] ?? 0, z: numbers[i + 2] ?? 0 });
  return {
    name: asText(json["session"]) || "a robot",
    isFeeding: json["feeding"] === true,
    pose: readPose(json["map_from_sensor"]),
    path_m,
  };
}

/** Those of which frames were fused since the map was opened. */
export async function listRobots(map: string): Promise<readonly Robot[]> {
  const answer = await askJson(`${map}/sessions?page_size=${most}`);
  return asList(answer["sessions"])
    .map(readRobot)
    .filter((robot): robot is Robot => robot !== null);
}
