// SPDX-License-Identifier: BSD-3-Clause
// What planners ask, too.
import { askJson, post } from "./ask";
import { asJson, asList, asNumber, asText, idOfName, readVector } from "./read";
import type { Pose, Slice, SurfacePoint, Touch, Vector3 } from "./types";

/** What is at a point, and how far the nearest surface is that is not that of `excluded`. */
export async function askPoint(map: string, point: Vector3, excluded: string): Promise<SurfacePoint> {
  const body = { points_m: [point] };
  const [distances, points] = await Promise.all([
    post(`${map}:queryDistances`, { ...body, options: { excluded_submaps: [`${map}/submaps/${excluded}`] } }),
    post(`${map}:queryPoints`, body),
  ]);
  const near = asJson(asList(distances["results"])[0]);
  const at = asJson(asList(points["results"])[0]);
  return {
    distance_m: asNumber(near["distance_m"]),
    nearest:
      near["nearest_point_m"] === undefined || near["nearest_point_m"] === null
        ? null
        : readVector(near["nearest_point_m"]),
    neighbour: near["submap"]
      ? `${asText(near["class_name"]) || "unknown"} #${idOfName(asText(near["submap"]))}`
      : null,
    ownerId: at["submap"] ? idOfName(asText(at["submap"])) : null,
    classConfidence: asNumber(at["class_confidence"]),
  };
}

/** Occupied, free and unknown between two heights. */
export async function getSlice(map: string, min_z_m: number, max_z_m: number): Promise<Slice> {
  const json = await askJson(`${map}:queryOccupancySlice?min_z_m=${min_z_m}&max_z_m=${max_z_m}`);
  return {
    width: asNumber(json["width"]),
    height: asNumber(json["height"]),
    resolution_m: asNumber(json["resolution_m"]),
    origin_m: readVector(json["origin_m"]),
    cells: Uint8Array.from(atob(asText(json["cells"])), (byte) => byte.charCodeAt(0)),
  };
}

/** What a box touches, the deepest first; what nobody has seen counts as free. */
export async function askTouched(
  map: string,
  box: { readonly pose: Pose; readonly size_m: Vector3 },
  excluded: readonly string[],
): Promise<readonly Touch[]> {
  const answer = await post(`${map}:checkCollisions`, {
    bodies: [{ box }],
    all_contacts: true,
    options: { unknown_policy: "FREE", excluded_submaps: excluded.map((id) => `${map}/submaps/${id}`) },
  });
  return asList(asJson(asList(answer["results"])[0])["contacts"]).map((contact) => {
    const json = asJson(contact);
    return { id: idOfName(asText(json["submap"])), isUnder: readVector(json["normal"]).z > 0.7 };
  });
}
