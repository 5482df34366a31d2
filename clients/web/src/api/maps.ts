// SPDX-License-Identifier: BSD-3-Clause
// Maps, their objects and the surfaces of these.
import { ask, askJson, base } from "./ask";
import { asList, asNumber, asText, readMap, readObject } from "./read";
import type { MapInfo, MapObject } from "./types";

export async function listMaps(): Promise<readonly MapInfo[]> {
  return asList((await askJson("maps"))["maps"]).map(readMap);
}

export async function getMap(map: string): Promise<MapInfo> {
  const json = await askJson(map);
  return readMap(json["map"] ?? json);
}

/** All objects, and the revision of the first page: who watches from the next one on misses nothing. */
export async function listObjects(map: string): Promise<{ revision: number; objects: MapObject[] }> {
  const objects: MapObject[] = [];
  let revision = 0;
  for (let token = ""; ;) {
    const page = await askJson(`${map}/submaps?page_token=${encodeURIComponent(token)}`);
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
  map: string,
  ids: readonly string[],
  onBytes: (bytes: number) => void,
  signal?: AbortSignal,
): Promise<ArrayBuffer> {
  const only =
    ids.length === 1
      ? `${map}/submaps/${ids[0]}/mesh?format=GLB`
      : `${map}/mesh?format=GLB${ids.length > 0 ? `&instance_ids=${ids.join(",")}` : ""}`;
  const response = await ask(only, { cache: "no-cache", ...(signal ? { signal } : {}) });
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
