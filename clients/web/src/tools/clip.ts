// SPDX-License-Identifier: BSD-3-Clause
// Leaves away all that is beyond a box: a look into what is hidden.
import type { AxisBox } from "../api/types";
import { BoxLines } from "../scene/box_lines";
import type { Renderer } from "../scene/renderer";
import { floorOf_m } from "../scene/unseen";
import { boxOfObjects, grown } from "../state/boxes";
import type { ViewStore } from "../state/view";

const around_m = 0.4;
/** Over the floor: doors and furniture stay, what hangs higher goes. */
const usualHeight_m = 1.2;

export class ClipTool {
  private readonly edges = new BoxLines("#8B93A3", false);

  constructor(
    private readonly store: ViewStore,
    renderer: Renderer,
  ) {
    renderer.addToScene(this.edges.lines);
    store.follow(["clip"], () => {
      const clip = store.get("clip");
      this.edges.show(clip ? [clip] : []);
      renderer.setClip(clip);
    });
  }

  toggle(): void {
    if (this.store.get("clip")) return this.store.set("clip", null);
    if (this.store.get("selected") !== null) return this.aroundSelection();
    this.all(usualHeight_m);
  }

  aroundSelection(): void {
    const object = this.store.get("objects").get(this.store.get("selected") ?? "");
    const box = object ? boxOfObjects([object]) : null;
    if (box) this.store.set("clip", grown(box, around_m));
  }

  /** The whole map, up to a height over its floor. */
  all(height_m: number): void {
    const objects = [...this.store.get("objects").values()];
    const box = boxOfObjects(objects);
    if (!box) return;
    const { min_m, max_m }: AxisBox = grown(box, 0.1);
    this.store.set("clip", { min_m, max_m: { ...max_m, z: floorOf_m(objects) + height_m } });
  }
}
