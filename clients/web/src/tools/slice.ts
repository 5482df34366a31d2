// SPDX-License-Identifier: BSD-3-Clause
// Where one could be at a height: occupied, free or unknown, as a planner is told it; again when the map has changed.
import { getSlice } from "../api/queries";
import type { Renderer } from "../scene/renderer";
import { SlicePlane } from "../scene/slice_plane";
import { shownState, type ViewStore } from "../state/view";

export const band_m = 0.1;
const pause_ms = 300;

export class SliceTool {
  private readonly plane = new SlicePlane();
  private isAsking = false;
  private isStale = false;

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
  ) {
    store.follow(["slice_m", "revision", "map"], () => this.update());
  }

  private update(): void {
    if (this.store.get("slice_m") === null) {
      this.plane.mesh.removeFromParent();
      this.renderer.frames.invalidate();
    } else if (this.isAsking) {
      this.isStale = true;
    } else {
      void this.ask();
    }
  }

  /** One request at a time; the last height wins. */
  private async ask(): Promise<void> {
    const map = shownState(this.store);
    const z_m = this.store.get("slice_m");
    if (!map || z_m === null) return;
    this.isAsking = true;
    this.isStale = false;
    try {
      const slice = await getSlice(map, z_m - band_m / 2, z_m + band_m / 2);
      if (this.store.get("slice_m") !== null && slice.width > 0) {
        this.plane.show(slice, z_m);
        this.renderer.addToScene(this.plane.mesh);
      }
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      this.store.set("toast", { text: `No slice: ${why}`, tone: "problem" });
    }
    window.setTimeout(() => {
      this.isAsking = false;
      if (this.isStale) this.update();
    }, pause_ms);
  }
}
