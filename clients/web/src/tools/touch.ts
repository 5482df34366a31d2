// SPDX-License-Identifier: BSD-3-Clause
// What an object would touch where it is held: asked while it is dragged, as a planner would ask.
import { askTouched } from "../api/queries";
import type { MapObject, Pose, Vector3 } from "../api/types";
import { poseOfMatrix } from "./poses";
import { movedBy } from "../scene/follow";
import { matrixOfPose } from "../scene/object_mesh";
import type { ViewStore } from "../state/view";

/** Boxes are larger than what is in them; what only brushes a corner is no touch. */
const margin_m = 0.08;
const least_m = 0.04;

export class TouchCheck {
  private isAsking = false;
  private isStale = false;
  /** What the object stands on or carries from the beginning, and itself. */
  private own: { readonly id: string; readonly excluded: readonly string[] } | null = null;

  constructor(private readonly store: ViewStore) {
    store.follow(["pending"], () => {
      if (store.get("pending")) return this.isAsking ? void (this.isStale = true) : void this.ask();
      this.own = null;
      store.set("touched", []);
    });
  }

  private async ask(): Promise<void> {
    const map = this.store.get("map");
    const pending = this.store.get("pending");
    const object = this.store.get("objects").get(pending?.id ?? "");
    if (!map || !pending || !object?.box) return;
    this.isAsking = true;
    this.isStale = false;
    try {
      if (this.own?.id !== object.id)
        this.own = { id: object.id, excluded: await this.excludedBy(map.name, object) };
      const touched = await askTouched(map.name, boxAt(object, pending.pose), this.own.excluded);
      if (this.store.get("pending")?.id === object.id)
        this.store.set("touched", [...new Set(touched.map(({ id }) => id))]);
    } catch {
      this.store.set("touched", []); // not known is not red
    }
    this.isAsking = false;
    if (this.isStale && this.store.get("pending")) void this.ask();
  }

  /** What the object would touch at a pose and does not touch where it is; nothing if that cannot be told. */
  async touchedAt(object: MapObject, pose: Pose): Promise<readonly string[]> {
    const map = this.store.get("map");
    if (!map || !object.box) return [];
    try {
      const touched = await askTouched(map.name, boxAt(object, pose), await this.excludedBy(map.name, object));
      return [...new Set(touched.map(({ id }) => id))];
    } catch {
      return []; // not known is not red
    }
  }

  private async excludedBy(map: string, object: MapObject): Promise<readonly string[]> {
    const before = await askTouched(map, boxAt(object, object.pose), [object.id]);
    const isThing = (id: string) => this.store.get("objects").get(id)?.kind === "thing";
    return [object.id, ...before.filter(({ id, isUnder }) => isUnder || isThing(id)).map(({ id }) => id)];
  }
}

/** The object's box, a little smaller, where the object would be. */
function boxAt(object: MapObject, pose: Pose): { pose: Pose; size_m: Vector3 } {
  const box = object.box ?? { pose, size_m: { x: 0, y: 0, z: 0 } };
  const smaller = (side: number) => Math.max(least_m, side - 2 * margin_m);
  const moved = movedBy(object.pose, pose).multiply(matrixOfPose(box.pose));
  const { x, y, z } = box.size_m;
  return { pose: poseOfMatrix(moved), size_m: { x: smaller(x), y: smaller(y), z: smaller(z) } };
}
