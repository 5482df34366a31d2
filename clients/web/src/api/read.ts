// SPDX-License-Identifier: BSD-3-Clause
// From the JSON of the API to the viewer's own words.
import type {
  IgnoredRegion,
  Kind,
  LabelClass,
  LoggedEdit,
  MapInfo,
  MapObject,
  ObjectChange,
  Pose,
  Quaternion,
  Vector3,
} from "./types";

type Json = { readonly [name: string]: unknown };

const asJson = (value: unknown): Json => (typeof value === "object" && value !== null ? (value as Json) : {});
const asList = (value: unknown): readonly unknown[] => (Array.isArray(value) ? value : []);
const asText = (value: unknown): string => (typeof value === "string" ? value : "");
const asNumber = (value: unknown): number => {
  const number = typeof value === "string" ? Number(value) : value;
  return typeof number === "number" && Number.isFinite(number) ? number : 0;
};

export const idOfName = (name: string): string => name.slice(name.lastIndexOf("/") + 1);

export function readVector(value: unknown): Vector3 {
  const json = asJson(value);
  return { x: asNumber(json["x"]), y: asNumber(json["y"]), z: asNumber(json["z"]) };
}

function readQuaternion(value: unknown): Quaternion {
  if (value === undefined || value === null) return { x: 0, y: 0, z: 0, w: 1 };
  return { ...readVector(value), w: asNumber(asJson(value)["w"]) };
}

export function readPose(value: unknown): Pose {
  const json = asJson(value);
  return { translation_m: readVector(json["translation_m"]), rotation: readQuaternion(json["rotation"]) };
}

const kinds: { readonly [name: string]: Kind } = { THING: "thing", STUFF: "stuff" };

export function readObject(value: unknown): MapObject {
  const json = asJson(value);
  const name = asText(json["name"]);
  const sphere = json["bounding_sphere"] === undefined ? null : asJson(json["bounding_sphere"]);
  const box = json["oriented_box"] === undefined ? null : asJson(json["oriented_box"]);
  const id = idOfName(name);
  return {
    id,
    name,
    label: asText(json["display_name"]) || `object ${id}`,
    kind: kinds[asText(json["kind"])] ?? "unknown",
    className: asText(json["class_name"]) || "unknown",
    classId: asNumber(json["class_id"]),
    classConfidence: asNumber(json["class_confidence"]),
    instanceConfidence: asNumber(json["instance_confidence"]),
    pose: readPose(json["map_from_submap"]),
    sphere: sphere && { center: readVector(sphere["center_m"]), radius_m: asNumber(sphere["radius_m"]) },
    box: box && { pose: readPose(box["pose"]), size_m: readVector(box["size_m"]) },
    footprint_m: asList(asJson(json["footprint"])["xy_m"]).map(asNumber),
    isPresent: json["presence"] !== "ABSENT",
    isLocked: json["locked"] === true,
    isConfirmed: json["confirmed"] !== false,
    numFrames: asNumber(json["num_frames_observed"]),
    lastSeen_ns: BigInt(asText(json["last_observed_stamp_ns"]) || "0"),
    revision: asNumber(json["revision"]),
    etag: asText(json["etag"]),
  };
}

function readClass(value: unknown): LabelClass {
  const json = asJson(value);
  return { name: asText(json["name"]), kind: kinds[asText(json["kind"])] ?? "unknown" };
}

export function readRegion(value: unknown): IgnoredRegion {
  const json = asJson(value);
  const name = asText(json["name"]);
  const box = asJson(json["box"]);
  if (json["sphere"] === undefined)
    return { name, box: { min_m: readVector(box["min_m"]), max_m: readVector(box["max_m"]) } };
  const ball = asJson(json["sphere"]);
  const { x, y, z } = readVector(ball["center_m"]);
  const r = asNumber(ball["radius_m"]);
  return { name, box: { min_m: { x: x - r, y: y - r, z: z - r }, max_m: { x: x + r, y: y + r, z: z + r } } };
}

export function readMap(value: unknown): MapInfo {
  const json = asJson(value);
  const name = asText(json["name"]);
  return {
    name,
    id: idOfName(name),
    displayName: asText(json["display_name"]) || idOfName(name),
    revision: asNumber(json["revision"]),
    numFrames: asNumber(json["num_frames"]),
    numObjects: asNumber(json["num_submaps"]),
    historyId: asText(json["history_id"]),
    classes: asList(json["label_classes"]).map(readClass),
  };
}

export function readEdit(value: unknown): LoggedEdit {
  const json = asJson(value);
  const kind = asText(json["kind"]);
  const steps = asList(json["steps"]).map((step) => asText(asJson(step)["action"]).toLowerCase().replaceAll("_", " "));
  const objects = [
    ...asList(json["changed_submaps"]),
    ...asList(json["created_submaps"]),
    ...asList(json["removed_submaps"]),
  ];
  return {
    name: asText(json["name"]),
    revision: asNumber(json["revision"]),
    time: asText(json["create_time"]),
    author: asText(json["author"]),
    what: kind === "EDIT" ? [...new Set(steps)].join(", ") : kind.toLowerCase(),
    objects: objects.map((object) => idOfName(asText(object))),
    isUndone: json["undone"] === true,
    targets: asList(json["targets"]).map(asText),
  };
}

/** One event of a watch: where all is told up to, and what became of which object. */
export function readChanges(value: unknown): { readonly revision: number; readonly changes: readonly ObjectChange[] } {
  const change = asJson(asJson(value)["change"]);
  const changes = asList(change["submaps"]).map((event): ObjectChange => {
    const json = asJson(event);
    const kind = asText(json["kind"]);
    const isGone = kind === "REMOVED" || kind === "MERGED";
    const object = readObject(json["submap"]);
    return {
      id: object.id,
      kind: isGone ? "removed" : kind === "CREATED" ? "created" : "changed",
      isGeometry: !isGone && (kind === "CREATED" || asList(json["parts"]).includes("GEOMETRY")),
      object: isGone ? null : object,
    };
  });
  return { revision: asNumber(change["last_revision"]), changes };
}

export { asJson, asList, asNumber, asText };
