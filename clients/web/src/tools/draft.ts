// SPDX-License-Identifier: BSD-3-Clause
// A merge or a split before it is made: asked of the server as a trial, and the cut shown in the scene.
import { DoubleSide, Mesh, MeshBasicMaterial, PlaneGeometry, Vector3 } from "three";
import type { Edits } from "../actions/edits";
import type { Cut, MapObject } from "../api/types";
import type { Renderer } from "../scene/renderer";
import type { ViewStore } from "../state/view";
import { pivotOf } from "./poses";

/** A vertical plane; `offset_m` from the middle of the object along its normal. */
export function cutAcross(object: MapObject, angle_rad: number, offset_m: number): Cut {
  const normal = { x: Math.cos(angle_rad), y: Math.sin(angle_rad), z: 0 };
  const middle = pivotOf(object);
  return {
    by: "plane",
    normal,
    point_m: { x: middle.x + offset_m * normal.x, y: middle.y + offset_m * normal.y, z: middle.z },
  };
}

export class DraftTool {
  private readonly plane = new Mesh(
    new PlaneGeometry(1, 1),
    new MeshBasicMaterial({ color: "#E6E9EF", transparent: true, opacity: 0.35, side: DoubleSide, depthWrite: false }),
  );
  private isAsking = false;
  private isStale = false;

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
    private readonly edits: Edits,
  ) {
    store.follow(["draft"], () => this.show());
    store.follow(["draft", "revision"], () => this.update());
    store.follow(["selected", "objects"], () => this.dropIfGone());
  }

  /** Of a draft of a merge: what becomes a part of it. */
  choose(id: string): void {
    const draft = this.store.get("draft");
    const other = this.store.get("objects").get(id);
    if (draft?.is !== "merge" || id === draft.id) return;
    if (other?.kind === "thing") this.store.set("draft", { ...draft, other: id });
    else this.store.set("toast", { text: `${other?.label ?? "That"} is a background: things alone are merged`, tone: "problem" });
  }

  private dropIfGone(): void {
    const draft = this.store.get("draft");
    if (!draft) return;
    if (this.store.get("selected") !== draft.id || !this.store.get("objects").has(draft.id)) this.store.set("draft", null);
  }

  private update(): void {
    if (!this.store.get("draft")) this.store.set("trial", null);
    else if (this.isAsking) this.isStale = true;
    else void this.ask();
  }

  private async ask(): Promise<void> {
    const draft = this.store.get("draft");
    if (!draft) return;
    this.isAsking = true;
    this.isStale = false;
    const trial = await this.edits.tryOut(draft);
    if (this.store.get("draft") === draft) this.store.set("trial", trial);
    this.isAsking = false;
    if (this.isStale) this.update();
  }

  private show(): void {
    const draft = this.store.get("draft");
    this.plane.removeFromParent();
    const object = this.store.get("objects").get(draft?.id ?? "");
    if (draft?.is === "split" && draft.cut.by === "plane" && object?.box) {
      const { point_m, normal } = draft.cut;
      const { x, y, z } = object.box.size_m;
      this.plane.position.set(point_m.x, point_m.y, point_m.z);
      this.plane.scale.set(Math.hypot(x, y) + 0.2, z + 0.2, 1);
      this.plane.up.set(0, 0, 1);
      this.plane.lookAt(new Vector3(point_m.x + normal.x, point_m.y + normal.y, point_m.z + normal.z));
      this.renderer.addToScene(this.plane);
    }
    this.renderer.frames.invalidate();
  }
}
