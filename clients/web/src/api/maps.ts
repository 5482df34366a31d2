// SPDX-License-Identifier: BSD-3-Clause
// Maps, their objects and the surfaces of these.
import { ask, askJson, base } from "./ask";
import { asJson, asList, asNumber, asText, readMap, readObject } from "./read";
import type { KeptRevision, MapInfo, MapObject, MapState } from "./types";

export async function listMaps(): Promise<readonly MapInfo[]> {
  return asList((await askJson("maps"))["maps"]).map(readMap);
}

export async function getMap(map: string): Promise<MapInfo> {
  const json = await askJson(map);
  return readMap(json["map"] ?? json);
}

/** What the server can still show, the newest first. */
export async function listRevisions(map: string): Promise<readonly KeptRevision[]> {
  return asList((await askJson(`${map}/revisions`))["revisions"]).map((item) => {
    const json = asJson(item);
    return { revision: asNumber(json["revision"]), time_ms: Date.parse(asText(json["update_time"])) || 0 };
  });
}

const askedAt = (revision: number | null): string => (revision === null ? "" : `&read_revision=${revision}`);

/** All objects, and the revision of the first page: who watches from the next one on misses nothing. */
export async function listObjects(map: MapState): Promise<{ revision: number; objects: MapObject[] }> {
  const objects: MapObject[] = [];
  let revision = 0;
  for (let token = ""; ;) {
    const page = await askJson(`${map.name}/submaps?page_token=${encodeURIComponent(token)}${askedAt(map.at)}`);
    if (revision === 0) revision = asNumber(page["revision"]);
    for (const object of asList(page["submaps"])) objects.push(readObject(object));
    token = asText(page["next_page_token"]);
    if (token === "") return { revision, objects };
  }
}

export async function getObject(name: string): Promise<MapObject> {
  return readObject((await askJson(name))["submap"]);
}

export const urlOfObject = (name: string): string => location.origin + base + name;

/** Surfaces as GLB, each in its object's own frame; no ids: of all that is present. `onBytes` hears of each part. */
export async function getSurfaces(
  map: MapState,
  ids: readonly string[],
  onBytes: (bytes: number) => void,
  signal?: AbortSignal,
): Promise<ArrayBuffer> {
  const only =
    ids.length === 1
      ? `${map.name}/submaps/${ids[0]}/mesh?format=GLB`
      : `${map.name}/mesh?format=GLB${ids.length > 0 ? `&instance_ids=${ids.join(",")}` : ""}`;
  const response = await ask(only + askedAt(map.at), { cache: "no-cache", ...(signal ? { signal } : {}) });
  const reader = response.body?.getReader();
  if (!reader) return response.arrayBuffer();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value);
    size += value.length;
    onBytes(value.length);
  }
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole.buffer;
}

export const watchUrl = (map: string, revision: number, historyId: string): string =>
  `${base}${map}:watch?start_revision=${revision}&history_id=${historyId}`;
