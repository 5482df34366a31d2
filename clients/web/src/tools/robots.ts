// SPDX-License-Identifier: BSD-3-Clause
// Follows the robots that map: asked for as the map changes, while one feeds it.
import { listRobots } from "../api/sessions";
import type { Renderer } from "../scene/renderer";
import { RobotMarks } from "../scene/robot_marks";
import type { ViewStore } from "../state/view";

const pause_ms = 500;

export class RobotFollower {
  private readonly marks = new RobotMarks();
  private isAsking = false;
  private isStale = false;

  constructor(
    private readonly store: ViewStore,
    renderer: Renderer,
  ) {
    renderer.addToScene(this.marks.group);
    store.follow(["map"], () => store.set("robots", []));
    store.follow(["map", "revision"], () => this.update());
    // Where they are now says nothing of the past.
    store.follow(["robots", "at"], () => {
      this.marks.show(store.get("at") === null ? store.get("robots") : []);
      renderer.frames.invalidate();
    });
  }

  private update(): void {
    if (this.isAsking) this.isStale = true;
    else void this.ask();
  }

  private async ask(): Promise<void> {
    const map = this.store.get("map");
    if (!map) return;
    this.isAsking = true;
    this.isStale = false;
    // What is shown stays where the answer does not come: the lost link is said elsewhere.
    const robots = await listRobots(map.name).catch(() => null);
    if (robots && this.store.get("map")?.name === map.name && !(robots.length === 0 && this.isEmpty))
      this.store.set("robots", robots);
    window.setTimeout(() => {
      this.isAsking = false;
      if (this.isStale) this.update();
    }, pause_ms);
  }

  private get isEmpty(): boolean {
    return this.store.get("robots").length === 0;
  }
}
