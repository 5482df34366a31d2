// SPDX-License-Identifier: BSD-3-Clause
// Edits of a map; each answers with the revision that has it.
import { askJson, post } from "./ask";
import { asList, asNumber, readEdit } from "./read";
import type { LoggedEdit, MapObject, Pose } from "./types";

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

export async function undoEdit(map: string, revision: number): Promise<number> {
  return asNumber((await post(`${map}:undoEdits`, { edit: `${map}/edits/${revision}`, author }))["revision"]);
}

export async function redoEdit(map: string, revision: number): Promise<number> {
  return asNumber((await post(`${map}:redoEdits`, { edit: `${map}/edits/${revision}`, author }))["revision"]);
}

export async function listEdits(map: string): Promise<readonly LoggedEdit[]> {
  return asList((await askJson(`${map}/edits?page_size=100`))["edits"]).map(readEdit);
}
