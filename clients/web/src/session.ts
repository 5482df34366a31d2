// SPDX-License-Identifier: BSD-3-Clause
// Opens a map and follows it.
import { ApiError } from "./api/ask";
import { askWhole, chosenMap, type Ahead } from "./api/ahead";
import { getObject, listMaps } from "./api/maps";
import type { MapInfo, MapObject, ObjectChange } from "./api/types";
import { Watch } from "./api/watch";
import { forgetMap } from "./state/history";
import { withChanges } from "./state/objects";
import type { ViewStore } from "./state/view";
import type { Renderer } from "./scene/renderer";
import type { SurfaceLoader } from "./scene/surface_loader";

/** Of an edit of a few objects all is read, with the boxes that events leave out. */
const mostReadWhole = 4;

async function readWhole(change: ObjectChange): Promise<ObjectChange> {
  if (!change.object || change.object.box) return change;
  const object = await getObject(change.object.name).catch(() => null);
  return object && object.revision >= change.object.revision ? { ...change, object } : change;
}

const howToGetAKey = "Who runs the server makes one by “dhpmap keys create”.";
const lockedWhy: { readonly [reason: string]: string } = {
  KEY_EXPIRED: "Your key has expired: ask for a new one.",
  KEY_REVOKED: "Your key was revoked: ask for a new one.",
};

const retry_ms = [500, 1000, 2000, 4000];

export class Session {
  private watch: Watch | null = null;
  private retryTimer = 0;
  private numRetries = 0;
  private retry: () => void = () => undefined;
  /** Which map is followed, and since which list of it: answers to what was asked before are left. */
  private generation = 0;
  private turn: Promise<void> = Promise.resolve();

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
    private readonly surfaces: SurfaceLoader,
    private ahead: Ahead | null,
    private readonly onTaken: () => void,
  ) {}

  /** The map of that id, or the one that was changed last. */
  async start(mapId: string): Promise<void> {
    const generation = this.generation;
    try {
      const maps = await (this.ahead?.maps ?? listMaps());
      if (generation !== this.generation) return;
      this.store.set("maps", maps);
      const wanted = chosenMap(maps, mapId);
      if (!wanted) return this.waitForMaps(mapId, maps.length > 0);
      await this.open(wanted);
    } catch (error) {
      this.ahead = null;
      this.failed(error, () => this.start(mapId));
    }
  }

  async open(map: MapInfo): Promise<void> {
    const generation = this.close();
    this.renderer.clear();
    this.store.set("at", null);
    this.store.set("objects", new Map());
    this.store.set("phase", { is: "loading", bytes: 0 });
    this.store.set("map", map);
    this.surfaces.start({ name: map.name, at: null });
    await this.list(map).catch((error: unknown) => {
      if (generation === this.generation) this.failed(error, () => this.start(map.id));
    });
  }

  /** The generation that begins. */
  private close(): number {
    this.watch?.close();
    this.watch = null;
    clearTimeout(this.retryTimer);
    return ++this.generation;
  }

  /** Takes what is there in place of what is held, and watches from there on. */
  private async list(map: MapInfo): Promise<void> {
    const generation = this.generation;
    const first = this.ahead?.take(map.name) ?? null;
    this.ahead = null;
    const [present, { revision, objects }] = await (first?.whole ?? askWhole(map.name));
    if (generation !== this.generation) return;
    const isSameHistory = present.historyId === this.store.get("map")?.historyId;
    if (!isSameHistory) forgetMap(this.store);
    this.store.set("map", present);
    this.store.set("newest", revision);
    const listed = new Map(objects.map((object) => [object.id, object]));
    if (isSameHistory && this.store.get("at") !== null) {
      this.store.set("present", listed);
    } else {
      this.store.set("at", null);
      const missing = this.replace(listed, revision, isSameHistory);
      // What the surfaces on their way have, unless it was changed meanwhile.
      const isComing = (object: MapObject) =>
        first?.surfaces != null && object.isPresent && object.revision <= first.map.revision;
      if (first?.surfaces)
        void this.surfaces.takeFirst(first.surfaces, [...listed.keys()]).then((isTaken) => {
          if (!isTaken && generation === this.generation) this.surfaces.want(missing.map(({ id }) => id));
        });
      this.surfaces.want(missing.filter((object) => !isComing(object)).map(({ id }) => id));
      if (objects.every((object) => object.sphere === null)) this.store.set("phase", { is: "ready" });
    }
    this.follow(present, revision);
  }

  /** These objects in place of what is held. Those whose surfaces are missing. */
  private replace(objects: ReadonlyMap<string, MapObject>, revision: number, isSameHistory: boolean): MapObject[] {
    const held = this.store.get("objects");
    this.store.set("revision", revision);
    this.store.set("objects", objects);
    for (const id of held.keys()) if (!objects.has(id)) this.renderer.drop(id);
    const isHeld = (object: MapObject) =>
      isSameHistory && held.get(object.id)?.revision === object.revision && this.renderer.meshOf(object.id) !== null;
    return [...objects.values()].filter((object) => object.sphere !== null && !isHeld(object));
  }

  /** The map as it was, with these objects; `at` null: as it is. It is followed on all the while. */
  showAt(at: number | null, past: ReadonlyMap<string, MapObject>): void {
    const map = this.store.get("map");
    if (!map || at === this.store.get("at")) return;
    if (this.store.get("at") === null) this.store.set("present", this.store.get("objects"));
    const objects = at === null ? this.store.get("present") : past;
    // Before who follows "objects" or "revision" asks.
    this.store.set("at", at);
    const unfinished = this.surfaces.start({ name: map.name, at });
    const missing = this.replace(objects, at ?? this.store.get("newest"), true).map(({ id }) => id);
    this.surfaces.want([...missing, ...[...unfinished].filter((id) => objects.has(id))]);
    if (at === null) this.store.set("present", new Map());
  }

  private follow(map: MapInfo, revision: number): void {
    const { generation } = this;
    this.watch = new Watch(map.name, revision + 1, map.historyId, {
      onLink: (link) => {
        if (link === "live") this.numRetries = 0;
        this.store.set("link", link);
      },
      onRestart: () => this.listAgain(map),
      onChanges: (told, changes) => {
        this.turn = this.turn
          .then(() => this.take(generation, told, changes))
          .catch(() => {
            if (generation === this.generation) this.listAgain(map);
          });
      },
    });
  }

  /** In the order in which they come. */
  private async take(generation: number, told: number, changes: readonly ObjectChange[]): Promise<void> {
    if (generation !== this.generation) return;
    const whole = changes.length <= mostReadWhole ? await Promise.all(changes.map(readWhole)) : changes;
    if (generation !== this.generation) return;
    this.store.set("newest", told);
    if (this.store.get("at") !== null) {
      // What is looked at stays as it was.
      this.store.set("present", withChanges(this.store.get("present"), whole));
      return this.onTaken();
    }
    this.store.set("revision", told);
    this.store.set("objects", withChanges(this.store.get("objects"), whole));
    for (const { id, kind } of whole) {
      if (kind !== "removed") continue;
      this.renderer.drop(id);
      this.surfaces.forget(id);
    }
    if (whole.some((change) => change.id === this.store.get("selected") && change.kind === "removed"))
      this.store.set("selected", null);
    this.surfaces.want(whole.filter((change) => change.isGeometry).map((change) => change.id));
    this.onTaken();
  }

  private listAgain(map: MapInfo): void {
    const generation = this.close();
    this.later(() =>
      this.list(map).catch((error: unknown) => {
        if (generation !== this.generation) return;
        if (error instanceof ApiError && error.status === 404) void this.start(map.id);
        else if (error instanceof ApiError && error.status === 401) this.failed(error, () => this.start(map.id));
        else this.listAgain(map);
      }),
    );
  }

  /** `hasOthers`: there are maps, but not that one. */
  private waitForMaps(mapId: string, hasOthers: boolean): void {
    this.ahead = null;
    this.store.set("phase", hasOthers ? { is: "no such map", id: mapId } : { is: "no maps" });
    this.store.set("link", "live");
    this.later(() => this.start(mapId));
  }

  /** What was waited for is asked for at once: somebody has logged in. */
  retryNow(): void {
    clearTimeout(this.retryTimer);
    this.store.set("phase", { is: "connecting" });
    this.retry();
  }

  private failed(error: unknown, again: () => void): void {
    const isLocked = error instanceof ApiError && error.status === 401;
    this.store.set("link", isLocked ? "off" : "lost");
    if (isLocked) {
      this.retry = again;
      return this.store.set("phase", { is: "locked", why: lockedWhy[error.reason] ?? howToGetAKey });
    }
    this.store.set("phase", { is: "failed", why: error instanceof Error ? error.message : String(error) });
    this.later(again);
  }

  private later(task: () => void): void {
    clearTimeout(this.retryTimer);
    this.retryTimer = window.setTimeout(task, retry_ms[Math.min(this.numRetries++, retry_ms.length - 1)]);
  }
}
