// SPDX-License-Identifier: BSD-3-Clause
// Drags what is selected over the floor, and turns it by the ring around it.
import { DoubleSide, Mesh, MeshBasicMaterial, Plane, RingGeometry, Vector3, type Ray } from "three";
import type { Edits } from "../actions/edits";
import type { MapObject, Pose } from "../api/types";
import type { Renderer } from "../scene/renderer";
import type { ViewStore } from "../state/view";
import { pivotOf, shifted, turned } from "./poses";
import type { TouchCheck } from "./touch";

const up = new Vector3(0, 0, 1);
const farthest_m = 60;
const snap_rad = Math.PI / 12;

interface Drag {
  readonly object: MapObject;
  readonly from: Pose;
  readonly pivot: Vector3;
  readonly grip: Vector3;
  readonly isTurn: boolean;
}

export class MoveTool {
  private readonly ring = new Mesh(
    new RingGeometry(0.94, 1, 64),
    new MeshBasicMaterial({ color: "#4C9AFF", transparent: true, opacity: 0.8, side: DoubleSide, depthTest: false }),
  );
  private drag: Drag | null = null;

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
    private readonly edits: Edits,
    private readonly touch: TouchCheck,
  ) {
    store.follow(["selected", "objects", "pending", "tool", "draft", "at"], () => this.placeRing());
  }

  get isBusy(): boolean {
    return this.drag !== null;
  }

  private get object(): MapObject | null {
    const object = this.store.get("objects").get(this.store.get("selected") ?? "");
    const isNow = this.store.get("at") === null;
    const isFree = isNow && this.store.get("tool") === "select" && this.store.get("draft") === null;
    return object?.kind === "thing" && isFree ? object : null;
  }

  /** Whether a drag that begins there turns or moves what is selected; `hit`: the surface under the cursor. */
  gripAt(ray: Ray, hit: { id: string; point: Vector3 } | null): "turn" | "move" | null {
    if (!this.object || this.store.get("pending")) return null;
    const onPlane = ray.intersectPlane(new Plane(up, -this.ring.position.z), new Vector3());
    const share = onPlane ? onPlane.distanceTo(this.ring.position) / this.ring.scale.x : 0;
    if (share > 0.9 && share < 1.06) return "turn";
    return hit?.id === this.object.id ? "move" : null;
  }

  begin(ray: Ray, hit: { id: string; point: Vector3 } | null): void {
    const grip = this.gripAt(ray, hit);
    const object = this.object;
    if (!grip || !object) return;
    const z = grip === "turn" ? this.ring.position.z : (hit?.point.z ?? 0);
    const point = ray.intersectPlane(new Plane(up, -z), new Vector3()) ?? hit?.point.clone();
    if (point) this.drag = { object, from: object.pose, pivot: pivotOf(object), grip: point, isTurn: grip === "turn" };
  }

  /** `snaps`: in steps of 15 degrees, or of 10 cm. */
  drags(ray: Ray, snaps: boolean): void {
    if (!this.drag) return;
    const { object, from, pivot, grip, isTurn } = this.drag;
    const point = ray.intersectPlane(new Plane(up, -grip.z), new Vector3());
    if (!point || point.distanceTo(ray.origin) > farthest_m) return;
    this.store.set("pending", {
      id: object.id,
      pose: isTurn ? turnTo(from, pivot, grip, point, snaps) : shiftTo(from, grip, point, snaps),
    });
  }

  async end(): Promise<void> {
    const { drag } = this;
    const pending = this.store.get("pending");
    this.drag = null;
    if (!drag || pending?.id !== drag.object.id) return;
    await this.send(drag.object, pending.pose);
  }

  cancel(): void {
    if (this.drag) this.store.set("pending", null);
    this.drag = null;
  }

  /** By keys or numbers. */
  shift(by_m: Vector3): void {
    if (this.object && !this.store.get("pending")) void this.send(this.object, shifted(this.object.pose, by_m));
  }
  turn(angle_rad: number): void {
    if (this.object && !this.store.get("pending"))
      void this.send(this.object, turned(this.object.pose, pivotOf(this.object), angle_rad));
  }

  /** What it then touches is asked of the map as it is before. */
  private send(object: MapObject, pose: Pose): Promise<void> {
    return this.edits.move(object, pose, this.touch.touchedAt(object, pose));
  }

  private placeRing(): void {
    const object = this.object;
    this.ring.removeFromParent();
    if (object?.box) {
      const pending = this.store.get("pending");
      const pivot = pivotOf(object);
      const { x, y, z } = object.box.size_m;
      this.ring.position.set(pivot.x, pivot.y, pivot.z - z / 2);
      if (pending?.id === object.id && this.drag && !this.drag.isTurn) {
        this.ring.position.x += pending.pose.translation_m.x - object.pose.translation_m.x;
        this.ring.position.y += pending.pose.translation_m.y - object.pose.translation_m.y;
      }
      this.ring.scale.setScalar(Math.max(0.3, 0.55 * Math.hypot(x, y) + 0.12));
      this.renderer.tools.add(this.ring);
    }
    this.renderer.frames.invalidate();
  }
}

function shiftTo(from: Pose, grip: Vector3, point: Vector3, snaps: boolean): Pose {
  const by = point.clone().sub(grip).setZ(0);
  if (snaps) by.set(Math.round(by.x * 10) / 10, Math.round(by.y * 10) / 10, 0);
  return shifted(from, by);
}

function turnTo(from: Pose, pivot: Vector3, grip: Vector3, point: Vector3, snaps: boolean): Pose {
  const angleOf = (p: Vector3) => Math.atan2(p.y - pivot.y, p.x - pivot.x);
  const angle = angleOf(point) - angleOf(grip);
  return turned(from, pivot, snaps ? Math.round(angle / snap_rad) * snap_rad : angle);
}
