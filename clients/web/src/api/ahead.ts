// SPDX-License-Identifier: BSD-3-Clause
// What the first picture needs, asked for before the page is made: the server works while the browser starts.
import { getMap, getSurfaces, listMaps, listObjects } from "./maps";
import type { MapInfo, MapObject } from "./types";

/** More objects come in several requests, see SurfaceLoader. */
const mostAtOnce = 150;

export interface FirstAnswers {
  /** As it was before the others were asked for. */
  readonly map: MapInfo;
  readonly whole: Promise<readonly [MapInfo, { revision: number; objects: MapObject[] }]>;
  /** All that is present; null: too much for one request. */
  readonly surfaces: Promise<ArrayBuffer> | null;
}

/** The map of that id; without an id the one that was changed last. */
export const chosenMap = (maps: readonly MapInfo[], id: string): MapInfo | null =>
  (id === "" ? maps[0] : maps.find((map) => map.id === id)) ?? null;

export const askWhole = (map: string) => Promise.all([getMap(map), listObjects({ name: map, at: null })] as const);

export class Ahead {
  readonly maps = listMaps();
  private first: FirstAnswers | null = null;
  /** Fulfilled once all is asked for, or cannot be. */
  readonly isAsked: Promise<void>;

  constructor(mapId: string, onBytes: (bytes: number) => void) {
    this.isAsked = this.maps.then(
      (maps) => {
        const map = chosenMap(maps, mapId);
        if (!map) return;
        const isOne = map.numObjects > 0 && map.numObjects <= mostAtOnce;
        const surfaces = isOne ? getSurfaces({ name: map.name, at: null }, [], onBytes) : null;
        const whole = askWhole(map.name);
        // Who takes them hears of what goes wrong; until then nobody needs to.
        for (const answer of [surfaces, whole]) answer?.catch(() => undefined);
        this.first = { map, whole, surfaces };
      },
      () => undefined,
    );
  }

  /** Once. */
  take(map: string): FirstAnswers | null {
    const { first } = this;
    this.first = null;
    return first?.map.name === map ? first : null;
  }
}
