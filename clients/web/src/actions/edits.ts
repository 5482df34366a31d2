// SPDX-License-Identifier: BSD-3-Clause
// Edits: sent with what the viewer knows of the object, so that nobody's work is overwritten.
import { ApiError } from "../api/ask";
import {
  cloneObject,
  deleteObject,
  ignoreRegion,
  lockObject,
  mergeObjects,
  moveObject,
  redoEdit,
  relabelObject,
  renameObject,
  splitObject,
  undoEdit,
  unignoreRegion,
} from "../api/edits";
import { getObject } from "../api/maps";
import type { EditOutcome, MapObject, Pose } from "../api/types";
import { nameOfEdit, noteEdit, noteRedo, noteUndo } from "../state/history";
import { withChanges } from "../state/objects";
import type { Draft, RegionDraft, ViewStore } from "../state/view";
import type { EditLog } from "./edit_log";

export class Edits {
  /** Of the edit under way; the next one waits for it. */
  private turn: Promise<void> = Promise.resolve();

  constructor(
    private readonly store: ViewStore,
    private readonly log: EditLog,
  ) {}

  /** Shown at once, and back where it was if the server does not take it. `touched`: what it would touch there. */
  move(object: MapObject, pose: Pose, touched: Promise<readonly string[]>): Promise<void> {
    this.store.set("pending", { id: object.id, pose });
    return this.run(object, `Moved ${object.label}`, async (map, present) => {
      const [revision, ids] = await Promise.all([moveObject(map, present, pose), touched]);
      const names = ids.map((id) => this.store.get("objects").get(id)?.label ?? `#${id}`);
      return { revision, note: names.length > 0 ? `: it touches ${names.join(", ")} there` : "" };
    });
  }

  /** A copy at that pose, which then is what is selected. */
  clone(object: MapObject, pose: Pose): Promise<void> {
    return this.run(object, `Cloned ${object.label}`, async (map, present) =>
      this.select(await cloneObject(map, present, pose)),
    );
  }

  /** Makes what was tried out. */
  make(draft: Draft): Promise<void> {
    const object = this.store.get("objects").get(draft.id);
    const other = this.store.get("objects").get((draft.is === "merge" && draft.other) || "");
    if (!object || (draft.is === "merge" && !other)) return Promise.resolve();
    const done = other ? `Merged ${other.label} into ${object.label}` : `Split ${object.label}`;
    return this.run(object, done, async (map, present) => {
      const { revision } = await this.apply(map, present, draft, false);
      this.store.set("draft", null);
      return revision;
    });
  }

  /** What a draft would do; null: it is not whole yet. Nothing is done. */
  async tryOut(draft: Draft): Promise<{ readonly text: string; readonly isGood: boolean } | null> {
    const map = this.store.get("map");
    const object = this.store.get("objects").get(draft.id);
    if (!map || !object || (draft.is === "merge" && draft.other === null)) return null;
    try {
      const outcome = await this.apply(map.name, object, draft, true);
      const num = outcome.created.length;
      const parts = num === 1 ? "One new object" : `${num} new objects`;
      const text =
        draft.is === "merge"
          ? `${object.label} keeps its name and gets all of it.`
          : `${parts} of ${outcome.numVoxels.toLocaleString("en")} voxels; ${object.label} keeps the rest.`;
      return { text, isGood: true };
    } catch (error) {
      const why = error instanceof ApiError && error.reason === "NOTHING_TO_SPLIT" ? "There is nothing to split so" : null;
      return { text: why ?? (error instanceof Error ? error.message : String(error)), isGood: false };
    }
  }

  private apply(map: string, object: MapObject, draft: Draft, isTrial: boolean): Promise<EditOutcome> {
    if (draft.is === "split") return splitObject(map, object, draft.cut, isTrial);
    const other = this.store.get("objects").get(draft.other ?? "");
    if (!other) throw new Error("what was to be merged is gone");
    return mergeObjects(map, object, other, isTrial);
  }

  /** What an edit has made, as soon as it is known. */
  private select({ revision, created }: EditOutcome): number {
    const [id] = created;
    const map = this.store.get("map");
    if (id !== undefined && map)
      void getObject(`${map.name}/submaps/${id}`).then(
        (object) => {
          if (!this.store.get("objects").has(id))
            this.store.set(
              "objects",
              withChanges(this.store.get("objects"), [{ id, kind: "created", isGeometry: false, object }]),
            );
          this.store.set("selected", id);
        },
        () => undefined,
      );
    return revision;
  }

  rename(object: MapObject, label: string): Promise<void> {
    return this.run(object, `Renamed to ${label || object.className}`, (map, present) =>
      renameObject(map, present, label),
    );
  }

  relabel(object: MapObject, className: string): Promise<void> {
    return this.run(object, `${object.label} is a ${className} now`, async (map, present) =>
      (await relabelObject(map, present, className)).revision,
    );
  }

  lock(object: MapObject, isLocked: boolean): Promise<void> {
    const done = isLocked ? `Locked ${object.label}: robots leave it as it is` : `Unlocked ${object.label}`;
    return this.run(object, done, async (map, present) => (await lockObject(map, present, isLocked)).revision);
  }

  ignore({ name, box, clears }: RegionDraft): Promise<void> {
    return this.run(null, `Robots map nothing in “${name}” any more`, async (map) => {
      const { revision } = await ignoreRegion(map, name, box, clears);
      this.store.set("regionDraft", null);
      return revision;
    });
  }

  lift(name: string): Promise<void> {
    return this.run(null, `Robots map in “${name}” again`, async (map) => (await unignoreRegion(map, name)).revision);
  }

  delete(object: MapObject): Promise<void> {
    return this.run(object, `Deleted ${object.label}`, (map, present) => deleteObject(map, present));
  }

  /** The last edit of this page, or the one of that revision. */
  undo(revision = this.store.get("undoable").at(-1)): Promise<void> {
    if (revision === undefined) return this.say("Nothing of yours to undo");
    return this.queue(async (map) => {
      const name = nameOfEdit(this.store, revision);
      const made = await undoEdit(map, revision);
      noteUndo(this.store, revision);
      this.store.set("toast", { text: `Undid: ${name} (${revision}) · revision ${made}`, tone: "plain" });
    });
  }

  redo(): Promise<void> {
    const revision = this.store.get("redoable").at(-1);
    if (revision === undefined) return this.say("Nothing to do again");
    return this.queue(async (map) => {
      const name = nameOfEdit(this.store, revision);
      const made = await redoEdit(map, revision);
      noteRedo(this.store, revision);
      this.store.set("toast", { text: `Did again: ${name} (${revision}) · revision ${made}`, tone: "plain" });
    });
  }

  private async say(text: string): Promise<void> {
    this.store.set("toast", { text, tone: "plain" });
  }

  /** `object`: what it is about, if it is about one. */
  private run<Object extends MapObject | null>(
    object: Object,
    done: string,
    edit: (map: string, object: Object) => Promise<number | { revision: number; note: string }>,
  ): Promise<void> {
    return this.queue(async (map) => {
      const made = await edit(map, object);
      const { revision, note } = typeof made === "number" ? { revision: made, note: "" } : made;
      noteEdit(this.store, revision);
      const tone = note ? "collision" : "plain";
      this.store.set("toast", { text: `${done}${note} · revision ${revision}`, tone, undoRevision: revision });
    }, object);
  }

  private queue(task: (map: string) => Promise<void>, object: MapObject | null = null): Promise<void> {
    const map = this.store.get("map");
    if (this.store.get("at") !== null) {
      this.store.set("pending", null);
      return this.say("This is how it was: nothing can be changed here. N takes you back to now.");
    }
    this.turn = this.turn.then(async () => {
      if (!map || this.store.get("map")?.historyId !== map.historyId) return; // another one was opened meanwhile
      try {
        await task(map.name);
        // The watch tells the same; where its link is lost, the edit must not look undone.
        if (object) await this.read(object);
      } catch (error) {
        await this.failed(error, object);
      } finally {
        if (object && this.store.get("pending")?.id === object.id) this.store.set("pending", null);
      }
      await this.log.refresh();
    });
    return this.turn;
  }

  private async read(object: MapObject): Promise<void> {
    const present = await getObject(object.name).catch(() => null);
    if (!present) return;
    const held = this.store.get("objects").get(present.id);
    if (held && held.revision > present.revision) return;
    this.store.set(
      "objects",
      withChanges(this.store.get("objects"), [{ id: present.id, kind: "changed", isGeometry: false, object: present }]),
    );
  }

  private async failed(error: unknown, object: MapObject | null): Promise<void> {
    const why = error instanceof Error ? error.message : String(error);
    const isConflict = error instanceof ApiError && error.isConflict;
    const text =
      isConflict && object
        ? `Somebody else has just edited ${object.label}: yours was not made. Here is theirs.`
        : `Not done: ${why}`;
    this.store.set("toast", { text, tone: "problem" });
    if (isConflict && object) await this.read(object);
  }
}
