// SPDX-License-Identifier: BSD-3-Clause
// Can a robot go there: asked as a planner asks, and asked again as the map changes.
import { Vector3 } from "three";
import { checkPath } from "../api/trajectories";
import { PathShape } from "../scene/path_shape";
import type { Hit, Renderer } from "../scene/renderer";
import { mostWaypoints } from "../state/path_text";
import { columnOf } from "../state/robot";
import { shownState, type ViewStore } from "../state/view";

const pause_ms = 300;
/** What is clicked higher than that is no floor: the robot stays at the height that it has. */
const highestFloor_m = 0.3;

export class PathTool {
  private readonly shape = new PathShape();
  private isAsking = false;
  private isStale = false;

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
  ) {
    store.follow(["path", "pathAnswer"], () => this.show());
    store.follow(["path", "revision", "map"], () => this.update());
  }

  /** The next waypoint; `hit`: what is under the cursor, null: nothing, and `floor` is where its ray meets z = 0. */
  click(hit: Hit | null, floor: Vector3 | null): void {
    const at = hit?.point ?? floor;
    const path = this.store.get("path");
    if (!at || path.points_m.length >= mostWaypoints) return;
    const z = at.z <= highestFloor_m ? at.z : (path.points_m.at(-1)?.z ?? 0);
    this.store.set("path", { ...path, points_m: [...path.points_m, { x: at.x, y: at.y, z }] });
  }

  private update(): void {
    if (this.store.get("path").points_m.length === 0) this.store.set("pathAnswer", null);
    else if (this.isAsking) this.isStale = true;
    else void this.ask();
  }

  /** One request at a time; the last path wins. */
  private async ask(): Promise<void> {
    const map = shownState(this.store);
    const path = this.store.get("path");
    if (!map) return;
    this.isAsking = true;
    this.isStale = false;
    try {
      const robot = columnOf(path.radius_m, path.height_m);
      // A robot that stays where it is, is checked there.
      const points = path.points_m.length === 1 ? [...path.points_m, ...path.points_m] : path.points_m;
      const answer = await checkPath(map, robot, points, path.seenAlone);
      if (this.store.get("path") === path && this.store.get("map")?.name === map.name)
        this.store.set("pathAnswer", answer);
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      this.store.set("pathAnswer", null);
      this.store.set("toast", { text: `The path was not checked: ${why}`, tone: "problem" });
    }
    window.setTimeout(() => {
      this.isAsking = false;
      if (this.isStale) this.update();
    }, pause_ms);
  }

  private show(): void {
    const { points_m, radius_m, height_m } = this.store.get("path");
    this.shape.group.removeFromParent();
    if (points_m.length > 0) {
      const points = points_m.map(({ x, y, z }) => new Vector3(x, y, z));
      this.shape.show(points, columnOf(radius_m, height_m), this.store.get("pathAnswer"));
      this.renderer.tools.add(this.shape.group);
    } else {
      this.shape.clear();
    }
    this.renderer.frames.invalidate();
  }
}
