// SPDX-License-Identifier: BSD-3-Clause
// Edits of a map; each answers with the revision that has it.
import { askJson, post } from "./ask";
import { asJson, asList, asNumber, asText, idOfName, readEdit, readRegion } from "./read";
import type { AxisBox, Cut, EditOutcome, IgnoredRegion, LoggedEdit, MapObject, Pose } from "./types";

const author = "viewer";

/** The revision that has the edit. */
export async function moveObject(map: string, object: MapObject, pose: Pose): Promise<number> {
  const move = { submap: object.name, etag: object.etag, move: { map_from_submap: pose } };
  return asNumber((await post(`${map}:applyEdits`, { edits: [move], author }))["revision"]);
}

export async function renameObject(map: string, object: MapObject, label: string): Promise<number> {
  const rename = { submap: object.name, etag: object.etag, rename: { display_name: label } };
  return asNumber((await post(`${map}:applyEdits`, { edits: [rename], author }))["revision"]);
}

export async function deleteObject(map: string, object: MapObject): Promise<number> {
  const edit = { submap: object.name, etag: object.etag, delete: {} };
  return asNumber((await post(`${map}:applyEdits`, { edits: [edit], author }))["revision"]);
}

/** `isTrial`: what it would do; nothing is done. */
async function apply(map: string, edit: object, isTrial = false): Promise<EditOutcome> {
  const answer = await post(`${map}:applyEdits`, { edits: [edit], author, validate_only: isTrial });
  const result = asJson(asList(answer["results"])[0]);
  const ids = (names: unknown) => asList(names).map((name) => idOfName(asText(name)));
  return {
    revision: asNumber(answer["revision"]),
    created: ids(result["created_submaps"]),
    removed: ids(result["removed_submaps"]),
    numVoxels: asNumber(result["num_voxels"]),
  };
}

export const cloneObject = (map: string, object: MapObject, pose: Pose): Promise<EditOutcome> =>
  apply(map, { submap: object.name, etag: object.etag, clone: { map_from_submap: pose } });

/** `other` becomes a part of `object`. */
export const mergeObjects = (map: string, object: MapObject, other: MapObject, isTrial: boolean): Promise<EditOutcome> =>
  apply(map, { submap: object.name, etag: object.etag, merge: { merged_submaps: [other.name] } }, isTrial);

export const splitObject = (map: string, object: MapObject, cut: Cut, isTrial: boolean): Promise<EditOutcome> =>
  apply(
    map,
    {
      submap: object.name,
      etag: object.etag,
      split: cut.by === "parts" ? { parts: {} } : { plane: { point_m: cut.point_m, normal: cut.normal } },
    },
    isTrial,
  );

/** Another class of the same kind; mapping no longer changes it. */
export const relabelObject = (map: string, object: MapObject, className: string): Promise<EditOutcome> =>
  apply(map, { submap: object.name, etag: object.etag, relabel: { class_name: className } });

/** Whether mapping may change it. */
export const lockObject = (map: string, object: MapObject, isLocked: boolean): Promise<EditOutcome> =>
  apply(map, { submap: object.name, etag: object.etag, [isLocked ? "lock" : "unlock"]: {} });

/** From now on mapping takes nothing in there; `clears`: what is there goes, too. */
export const ignoreRegion = (map: string, name: string, box: AxisBox, clears: boolean): Promise<EditOutcome> =>
  apply(map, clears ? { clear: { box, ignored_region_name: name } } : { ignore_region: { name, box } });

export const unignoreRegion = (map: string, name: string): Promise<EditOutcome> =>
  apply(map, { unignore_region: { name } });

export async function listRegions(map: string): Promise<readonly IgnoredRegion[]> {
  return asList((await askJson(`${map}/ignoredRegions`))["ignored_regions"]).map(readRegion);
}

export async function undoEdit(map: string, revision: number): Promise<number> {
  return asNumber((await post(`${map}:undoEdits`, { edit: `${map}/edits/${revision}`, author }))["revision"]);
}

export async function redoEdit(map: string, revision: number): Promise<number> {
  return asNumber((await post(`${map}:redoEdits`, { edit: `${map}/edits/${revision}`, author }))["revision"]);
}

/** The newest first. */
export async function listEdits(map: string, most: number): Promise<readonly LoggedEdit[]> {
  return asList((await askJson(`${map}/edits?page_size=${most}`))["edits"]).map(readEdit);
}
