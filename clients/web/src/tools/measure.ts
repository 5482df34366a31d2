// SPDX-License-Identifier: BSD-3-Clause
// From one place of a surface to another: two clicks.
import { Vector3 } from "three";
import { Marks } from "../scene/marks";
import type { Hit, Renderer } from "../scene/renderer";
import type { ViewStore } from "../state/view";

export class MeasureTool {
  private readonly marks = new Marks();
  private ahead: Vector3 | null = null;

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
  ) {
    renderer.tools.add(this.marks.group);
    store.follow(["map"], () => {
      if (store.get("measured_m").length === 1) store.set("measured_m", []);
    });
    store.follow(["measured_m", "tool"], () => {
      this.ahead = null;
      this.show();
    });
  }

  /** The first end, or the second; a third click begins anew. */
  click(hit: Hit | null): void {
    if (!hit) return this.store.set("toast", { text: "There is no surface there", tone: "plain" });
    const { x, y, z } = hit.point;
    const held = this.store.get("measured_m");
    this.store.set("measured_m", [...(held.length === 1 ? held : []), { x, y, z }]);
  }

  hover(hit: Hit | null): void {
    if (this.store.get("measured_m").length !== 1) return;
    this.ahead = hit?.point.clone() ?? null;
    this.show();
  }

  private show(): void {
    const ends = this.store.get("measured_m").map(({ x, y, z }) => new Vector3(x, y, z));
    if (ends.length === 1 && this.ahead) ends.push(this.ahead);
    const [from, to] = ends;
    this.marks.clear();
    for (const end of ends) this.marks.point(end, "plain", this.renderer.camera.three.position);
    if (from && to) {
      this.marks.line(from, to, "plain");
      this.marks.text(from.clone().lerp(to, 0.5), `${from.distanceTo(to).toFixed(2)} m`);
    }
    this.renderer.frames.invalidate();
  }
}
