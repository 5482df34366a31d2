// SPDX-License-Identifier: BSD-3-Clause
// Edits: sent with what the viewer knows of the object, so that nobody's work is overwritten.
import { ApiError } from "../api/ask";
import { deleteObject, listEdits, moveObject, redoEdit, renameObject, undoEdit } from "../api/edits";
import { getObject } from "../api/maps";
import type { MapObject, Pose } from "../api/types";
import { noteEdit, noteRedo, noteUndo } from "../state/history";
import { withChanges } from "../state/objects";
import type { ViewStore } from "../state/view";

export class Edits {
  /** Of the edit under way; the next one waits for it. */
  private turn: Promise<void> = Promise.resolve();

  constructor(private readonly store: ViewStore) {}

  /** Shown at once, and back where it was if the server does not take it. */
  move(object: MapObject, pose: Pose): Promise<void> {
    this.store.set("pending", { id: object.id, pose });
    return this.run(object, `Moved ${object.label}`, (map, present) => moveObject(map, present, pose));
  }

  rename(object: MapObject, label: string): Promise<void> {
    return this.run(object, `Renamed to ${label || object.className}`, (map, present) =>
      renameObject(map, present, label),
    );
  }

  delete(object: MapObject): Promise<void> {
    return this.run(object, `Deleted ${object.label}`, (map, present) => deleteObject(map, present));
  }

  /** The last edit of this page, or the one of that revision. */
  undo(revision = this.store.get("undoable").at(-1)): Promise<void> {
    if (revision === undefined) return this.say("Nothing of yours to undo");
    return this.queue(async (map) => {
      const made = await undoEdit(map, revision);
      noteUndo(this.store, revision);
      this.store.set("toast", { text: `Undid revision ${revision} · now at ${made}`, tone: "plain" });
    });
  }

  redo(): Promise<void> {
    const revision = this.store.get("redoable").at(-1);
    if (revision === undefined) return this.say("Nothing to do again");
    return this.queue(async (map) => {
      const made = await redoEdit(map, revision);
      noteRedo(this.store, revision);
      this.store.set("toast", { text: `Did revision ${revision} again · now at ${made}`, tone: "plain" });
    });
  }

  async refreshHistory(): Promise<void> {
    const map = this.store.get("map");
    if (map) this.store.set("history", await listEdits(map.name).catch(() => []));
  }

  private async say(text: string): Promise<void> {
    this.store.set("toast", { text, tone: "plain" });
  }

  private run(
    object: MapObject,
    done: string,
    edit: (map: string, object: MapObject) => Promise<number>,
  ): Promise<void> {
    return this.queue(async (map) => {
      const revision = await edit(map, object);
      noteEdit(this.store, revision);
      this.store.set("toast", { text: `${done} · revision ${revision}`, tone: "plain", undoRevision: revision });
    }, object);
  }

  private queue(task: (map: string) => Promise<void>, object?: MapObject): Promise<void> {
    const map = this.store.get("map");
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
      await this.refreshHistory();
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

  private async failed(error: unknown, object?: MapObject): Promise<void> {
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
