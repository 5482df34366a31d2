// SPDX-License-Identifier: BSD-3-Clause
// Whether a robot can go somewhere.
import { post } from "./ask";
import { askedAt } from "./queries";
import { asJson, asList, asNumber, asText, idOfName, readVector } from "./read";
import type { MapState, PathAnswer, Vector3 } from "./types";

interface Ball {
  readonly center_m: Vector3;
  readonly radius_m: number;
}

/** A robot of balls along straight lines from place to place. `seenAlone`: what nobody has seen is in the way. */
export async function checkPath(
  map: MapState,
  robot: readonly Ball[],
  points: readonly Vector3[],
  seenAlone: boolean,
): Promise<PathAnswer> {
  const answer = await post(`${map.name}:checkTrajectory`, {
    robot,
    trajectories: [{ waypoints: points.map((translation_m) => ({ translation_m })) }],
    options: { unknown_policy: seenAlone ? "OCCUPIED" : "FREE" },
    include_clearance: true,
    ...askedAt(map),
  });
  const result = asJson(asList(answer["results"])[0]);
  const first = asJson(asList(result["contacts"])[0]);
  const contact = asJson(first["contact"]);
  const clearance = result["clearance"] ? asJson(result["clearance"]) : null;
  return {
    revision: asNumber(answer["revision"]),
    isFree: result["valid"] === true,
    contact:
      result["valid"] === true
        ? null
        : {
            waypoint: asNumber(first["waypoint"]),
            fraction: asNumber(first["fraction"]),
            id: contact["submap"] ? idOfName(asText(contact["submap"])) : null,
            point_m: readVector(contact["point_m"]),
          },
    clearance: clearance && {
      distance_m: asNumber(clearance["distance_m"]),
      id: clearance["submap"] ? idOfName(asText(clearance["submap"])) : null,
    },
  };
}
