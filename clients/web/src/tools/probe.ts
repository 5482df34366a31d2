// SPDX-License-Identifier: BSD-3-Clause
// What is at a point: a click asks the server, as a planner would.
import { Vector3 } from "three";
import { askPoint } from "../api/queries";
import { Marks } from "../scene/marks";
import type { Hit, Renderer } from "../scene/renderer";
import { shownState, type ViewStore } from "../state/view";

export class ProbeTool {
  private readonly marks = new Marks();

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
  ) {
    renderer.tools.add(this.marks.group);
    store.follow(["probe"], () => this.show());
  }

  click(hit: Hit | null): void {
    if (hit) void this.ask(hit.point, hit.id);
  }

  /** `id`: whose surface it is. */
  private async ask(point: Vector3, id: string): Promise<void> {
    const map = shownState(this.store);
    if (!map) return;
    const point_m = { x: point.x, y: point.y, z: point.z };
    this.store.set("probe", { point_m, id, answer: null });
    try {
      const answer = await askPoint(map, point_m, id);
      if (this.store.get("probe")?.point_m === point_m) this.store.set("probe", { point_m, id, answer });
    } catch (error) {
      this.store.set("toast", {
        text: `Not answered: ${error instanceof Error ? error.message : String(error)}`,
        tone: "problem",
      });
    }
  }

  private show(): void {
    const probe = this.store.get("probe");
    this.marks.clear();
    if (probe) {
      const eye = this.renderer.camera.three.position;
      const from = new Vector3(probe.point_m.x, probe.point_m.y, probe.point_m.z);
      this.marks.point(from, "plain", eye);
      const near = probe.answer?.nearest;
      if (near) {
        const to = new Vector3(near.x, near.y, near.z);
        this.marks.point(to, "amber", eye);
        this.marks.line(from, to, "amber");
      }
    }
    this.renderer.frames.invalidate();
  }
}
