// SPDX-License-Identifier: BSD-3-Clause
// The scene follows the store: what is shown, where, in which colour.
import { Matrix4 } from "three";
import type { MapObject, Pose } from "../api/types";
import { isFound, isShown } from "../state/objects";
import type { ViewStore } from "../state/view";
import type { Box } from "./boxes";
import { classColour, flatColour, type Rgb } from "./colours";
import { matrixOfPose } from "./object_mesh";
import type { Renderer } from "./renderer";

const blue: Rgb = [0.075, 0.323, 1];
const red: Rgb = [1, 0.102, 0.114];

/** 0 of what was seen last, 1 of what was seen first. */
function ageOf(object: MapObject, oldest_ns: bigint, newest_ns: bigint): number {
  const span = Number(newest_ns - oldest_ns);
  return span > 0 ? Number(newest_ns - object.lastSeen_ns) / span : 0;
}

function spanOf(objects: Iterable<MapObject>): readonly [bigint, bigint] {
  let oldest: bigint | null = null;
  let newest: bigint | null = null;
  for (const { lastSeen_ns, kind } of objects) {
    if (kind === "unknown" || lastSeen_ns === 0n) continue;
    if (oldest === null || lastSeen_ns < oldest) oldest = lastSeen_ns;
    if (newest === null || lastSeen_ns > newest) newest = lastSeen_ns;
  }
  return [oldest ?? 0n, newest ?? 0n];
}

export class SceneFollower {
  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
  ) {
    store.follow(["objects", "hiddenClasses", "hiddenObjects", "showsGone", "colour", "query"], () => this.look());
    store.follow(["pending", "objects"], () => this.place());
    store.follow(["selected", "hovered"], () => this.point());
    store.follow(
      [
        "showsBoxes",
        "selected",
        "objects",
        "pending",
        "touched",
        "touched",
        "hiddenClasses",
        "hiddenObjects",
        "showsGone",
      ],
      () => this.box(),
    );
  }

  /** After surfaces have come. */
  refresh(): void {
    this.look();
    this.place();
    this.point();
  }

  poseOf(object: MapObject): Pose {
    const pending = this.store.get("pending");
    return pending?.id === object.id ? pending.pose : object.pose;
  }

  private look(): void {
    const objects = this.store.get("objects");
    const [oldest, newest] = spanOf(objects.values());
    const query = this.store.get("query");
    const view = {
      hiddenClasses: this.store.get("hiddenClasses"),
      hiddenObjects: this.store.get("hiddenObjects"),
      showsGone: this.store.get("showsGone"),
    };
    for (const mesh of this.renderer.allMeshes()) {
      const object = objects.get(mesh.id);
      mesh.mesh.visible = object !== undefined && isShown(object, view);
      if (!object || !mesh.mesh.visible) continue;
      const ghost = query !== "" && !isFound(object, query) ? 1 : object.isPresent ? 0 : 0.4;
      mesh.setLook(flatColour(this.store.get("colour"), object, ageOf(object, oldest, newest)), ghost);
    }
    this.renderer.unseen.show(objects.values());
    this.renderer.frames.invalidate();
  }

  private place(): void {
    const objects = this.store.get("objects");
    for (const mesh of this.renderer.allMeshes()) {
      const object = objects.get(mesh.id);
      if (object) mesh.setPose(this.poseOf(object));
    }
    this.renderer.frames.invalidate();
  }

  private point(): void {
    const shown = (id: string | null) => {
      const mesh = this.renderer.meshOf(id);
      return mesh?.mesh.visible ? mesh : null;
    };
    this.renderer.selected = shown(this.store.get("selected"));
    this.renderer.hovered = shown(this.store.get("hovered"));
    this.renderer.frames.invalidate();
  }

  private box(): void {
    const selected = this.store.get("selected");
    const pending = this.store.get("pending");
    const view = {
      hiddenClasses: this.store.get("hiddenClasses"),
      hiddenObjects: this.store.get("hiddenObjects"),
      showsGone: this.store.get("showsGone"),
    };
    const isTouching = this.store.get("touched").length > 0;
    const boxes: Box[] = [];
    for (const object of this.store.get("objects").values()) {
      const isSelected = object.id === selected;
      const isWanted = this.store.get("showsBoxes") && object.kind === "thing" && isShown(object, view);
      if (!isSelected && !isWanted) continue;
      const T_moved = pending?.id === object.id ? movedBy(object.pose, pending.pose) : null;
      boxes.push({ object, colour: isSelected ? (isTouching ? red : blue) : classColour(object), T_moved });
    }
    this.renderer.boxes.show(boxes);
    this.renderer.setTouching(isTouching);
    this.renderer.frames.invalidate();
  }
}

/** What takes a place of the object as it was to where it is. */
export const movedBy = (before: Pose, after: Pose): Matrix4 =>
  matrixOfPose(after).multiply(matrixOfPose(before).invert());
