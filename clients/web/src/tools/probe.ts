// SPDX-License-Identifier: BSD-3-Clause
// What is at a point: a click asks the server, as a planner would.
import {
  BufferAttribute,
  BufferGeometry,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
} from "three";
import { askPoint } from "../api/queries";
import type { Renderer } from "../scene/renderer";
import type { ViewStore } from "../state/view";

const ball = (colour: string) =>
  new Mesh(new SphereGeometry(1, 16, 12), new MeshBasicMaterial({ color: colour, depthTest: false }));

export class ProbeTool {
  private readonly point = ball("#E6E9EF");
  private readonly nearest = ball("#F2B84B");
  private readonly line = new Line(new BufferGeometry(), new LineBasicMaterial({ color: "#F2B84B", depthTest: false }));

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
  ) {
    this.line.frustumCulled = false;
    store.follow(["probe"], () => this.show());
  }

  /** `id`: whose surface it is. */
  async ask(point: Vector3, id: string): Promise<void> {
    const map = this.store.get("map");
    if (!map) return;
    const point_m = { x: point.x, y: point.y, z: point.z };
    this.store.set("probe", { point_m, id, answer: null });
    try {
      const answer = await askPoint(map.name, point_m, id);
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
    for (const part of [this.point, this.nearest, this.line]) part.removeFromParent();
    if (probe) {
      const from = new Vector3(probe.point_m.x, probe.point_m.y, probe.point_m.z);
      this.place(this.point, from);
      const near = probe.answer?.nearest;
      if (near) {
        const to = new Vector3(near.x, near.y, near.z);
        this.place(this.nearest, to);
        this.line.geometry.dispose();
        this.line.geometry = new BufferGeometry();
        this.line.geometry.setAttribute(
          "position",
          new BufferAttribute(new Float32Array([...from.toArray(), ...to.toArray()]), 3),
        );
        this.renderer.tools.add(this.line);
      }
    }
    this.renderer.frames.invalidate();
  }

  private place(part: Mesh, at: Vector3): void {
    part.position.copy(at);
    part.scale.setScalar(Math.max(0.012, 0.006 * at.distanceTo(this.renderer.camera.three.position)));
    this.renderer.tools.add(part);
  }
}
