// SPDX-License-Identifier: BSD-3-Clause
// What a ray meets: from a place through another, or from the eye along the view.
import { Vector3 } from "three";
import { castRay } from "../api/queries";
import { Marks } from "../scene/marks";
import type { Hit, Renderer } from "../scene/renderer";
import { shownState, type ViewStore } from "../state/view";

/** Off the surface that it begins at, or that would be what it meets. */
const lift_m = 0.1;
const shownOfNothing_m = 50;
const pause_ms = 300;

export class RayTool {
  private readonly marks = new Marks();
  private begin: Vector3 | null = null;
  private isAsking = false;
  private isStale = false;

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
  ) {
    renderer.tools.add(this.marks.group);
    store.follow(["tool"], () => (this.begin = null));
    store.follow(["ray", "tool"], () => this.show());
    store.follow(["revision", "map"], () => this.update());
  }

  /** Where it begins, then what it goes through. */
  click(hit: Hit | null): void {
    if (!hit) return this.store.set("toast", { text: "There is no surface there", tone: "plain" });
    if (!this.begin) {
      const toEye = this.renderer.camera.three.position.clone().sub(hit.point).normalize();
      this.begin = hit.point.clone().addScaledVector(toEye, lift_m);
      this.store.set("ray", null);
      return this.show();
    }
    const direction = hit.point.clone().sub(this.begin);
    const origin = this.begin;
    this.begin = null;
    this.cast(origin, direction);
  }

  alongTheView(): void {
    const { three } = this.renderer.camera;
    this.cast(three.position.clone(), three.getWorldDirection(new Vector3()));
  }

  private cast(origin: Vector3, along: Vector3): void {
    const { x, y, z } = along.normalize();
    const origin_m = { x: origin.x, y: origin.y, z: origin.z };
    this.store.set("ray", { origin_m, direction: { x, y, z }, answer: null });
    this.update();
  }

  private update(): void {
    if (!this.store.get("ray")) return;
    if (this.isAsking) this.isStale = true;
    else void this.ask();
  }

  private async ask(): Promise<void> {
    const [map, ray] = [shownState(this.store), this.store.get("ray")];
    if (!map || !ray) return;
    this.isAsking = true;
    this.isStale = false;
    try {
      const answer = await castRay(map, ray.origin_m, ray.direction);
      if (this.store.get("ray")?.origin_m === ray.origin_m) this.store.set("ray", { ...ray, answer });
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      this.store.set("toast", { text: `Not answered: ${why}`, tone: "problem" });
    }
    window.setTimeout(() => {
      this.isAsking = false;
      if (this.isStale) this.update();
    }, pause_ms);
  }

  private show(): void {
    const eye = this.renderer.camera.three.position;
    const ray = this.store.get("ray");
    this.marks.clear();
    if (this.begin) this.marks.point(this.begin, "plain", eye);
    if (ray) {
      const from = new Vector3(ray.origin_m.x, ray.origin_m.y, ray.origin_m.z);
      const at = (length_m: number) =>
        from.clone().add(new Vector3(ray.direction.x, ray.direction.y, ray.direction.z).multiplyScalar(length_m));
      const { distance_m, free_m, point_m } = ray.answer ?? { distance_m: 0, free_m: 0, point_m: null };
      const end_m = point_m ? distance_m : Math.min(shownOfNothing_m, distance_m);
      this.marks.point(from, "plain", eye);
      this.marks.line(from, at(Math.min(free_m, end_m)), "plain");
      if (free_m < end_m) this.marks.line(at(free_m), at(end_m), "amber");
      if (point_m) this.marks.point(at(distance_m), "amber", eye);
      if (point_m) this.marks.text(at(distance_m), `${distance_m.toFixed(2)} m`);
    }
    this.renderer.frames.invalidate();
  }
}
