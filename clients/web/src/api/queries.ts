// SPDX-License-Identifier: BSD-3-Clause
// What planners ask, too.
import { post } from "./ask";
import { asJson, asList, asNumber, asText, idOfName, readObject, readVector } from "./read";
import type { MapState, NearObject, Pose, RayAnswer, Slice, SurfacePoint, Touch, Vector3 } from "./types";

export const askedAt = (map: MapState) => ({ read_revision: map.at ?? 0 });

/** What is at a point, and how far the nearest surface is that is not that of `excluded`. */
export async function askPoint(map: MapState, point: Vector3, excluded: string): Promise<SurfacePoint> {
  const body = { points_m: [point], ...askedAt(map) };
  const [distances, points] = await Promise.all([
    post(`${map.name}:queryDistances`, { ...body, options: { excluded_submaps: [`${map.name}/submaps/${excluded}`] } }),
    post(`${map.name}:queryPoints`, body),
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
export async function getSlice(map: MapState, min_z_m: number, max_z_m: number): Promise<Slice> {
  const json = await post(`${map.name}:queryOccupancySlice`, { min_z_m, max_z_m, ...askedAt(map) });
  return {
    width: asNumber(json["width"]),
    height: asNumber(json["height"]),
    resolution_m: asNumber(json["resolution_m"]),
    origin_m: readVector(json["origin_m"]),
    cells: Uint8Array.from(atob(asText(json["cells"])), (byte) => byte.charCodeAt(0)),
  };
}

const farthest_m = 50;

/** What a ray from a place in a direction of any length meets first. */
export async function castRay(map: MapState, origin_m: Vector3, direction: Vector3): Promise<RayAnswer> {
  const answer = await post(`${map.name}:castRays`, {
    rays: [{ origin_m, direction }],
    options: { max_distance_m: farthest_m },
    ...askedAt(map),
  });
  const ray = asJson(asList(answer["results"])[0]);
  const isHit = ray["point_m"] !== undefined && ray["point_m"] !== null;
  return {
    point_m: isHit ? readVector(ray["point_m"]) : null,
    distance_m: asNumber(ray["distance_m"]),
    free_m: asNumber(ray["free_distance_m"]),
    isSeen: ray["status"] !== "UNKNOWN",
    id: ray["submap"] ? idOfName(asText(ray["submap"])) : null,
  };
}

/** The objects but `excluded` whose surfaces are nearest to a place, the nearest first; of that class, or "": of any. */
export async function listNear(
  map: MapState,
  near_point_m: Vector3,
  className: string,
  excluded: string,
  most: number,
): Promise<readonly NearObject[]> {
  const answer = await post(`${map.name}/submaps:search`, {
    near_point_m,
    page_size: most,
    options: {
      excluded_submaps: [`${map.name}/submaps/${excluded}`],
      ...(className === "" ? {} : { class_names: [className] }),
    },
    ...askedAt(map),
  });
  return asList(answer["matches"]).map((item) => {
    const match = asJson(item);
    const { id, label, kind } = readObject(match["submap"]);
    return { id, label, kind, distance_m: asNumber(match["distance_m"]) };
  });
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
