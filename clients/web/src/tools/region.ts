// SPDX-License-Identifier: BSD-3-Clause
// Where mapping shall take nothing any more: a box drawn by two clicks on the floor.
import type { Vector3 } from "three";
import { listRegions } from "../api/edits";
import type { AxisBox } from "../api/types";
import { BoxLines } from "../scene/box_lines";
import type { Hit, Renderer } from "../scene/renderer";
import { floorOf_m } from "../scene/unseen";
import { boxBetween, boxOfObjects, grown } from "../state/boxes";
import type { ViewStore } from "../state/view";

const height_m = 2;
const around_m = 0.15;

export class RegionTool {
  private readonly drawn = new BoxLines("#E6E9EF", true);
  private readonly there = new BoxLines("#F2B84B", true);
  private corner: Vector3 | null = null;
  private asked = 0;

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
  ) {
    store.follow(["tool"], () => {
      this.corner = null;
      if (store.get("tool") !== "region") store.set("regionDraft", null);
    });
    store.follow(["tool", "revision", "map", "history"], () => void this.refresh());
    store.follow(["tool", "regions", "regionDraft"], () => this.show());
  }

  /** One corner, then the opposite one. */
  click(hit: Hit | null, floor: Vector3 | null): void {
    const at = hit?.point ?? floor;
    if (!at) return;
    this.spread(at);
    this.corner = this.corner ? null : at.clone();
  }

  hover(hit: Hit | null, floor: Vector3 | null): void {
    const at = hit?.point ?? floor;
    if (at && this.corner) this.spread(at);
  }

  /** What is selected, and a little more; else the middle of the view. */
  around(): void {
    const object = this.store.get("objects").get(this.store.get("selected") ?? "");
    const box = object ? boxOfObjects([object]) : null;
    this.corner = null;
    if (box) return this.propose(grown(box, around_m));
    const middle = this.renderer.bounds().getCenter(this.renderer.camera.three.position.clone());
    this.propose(this.boxOver({ x: middle.x - 0.5, y: middle.y - 0.5 }, { x: middle.x + 0.5, y: middle.y + 0.5 }));
  }

  private spread(to: Vector3): void {
    this.propose(this.boxOver(this.corner ?? to, to));
  }

  private boxOver(a: { x: number; y: number }, b: { x: number; y: number }): AxisBox {
    const floor_m = floorOf_m(this.store.get("objects").values());
    return boxBetween({ x: a.x, y: a.y, z: floor_m }, { x: b.x, y: b.y, z: floor_m + height_m });
  }

  private propose(box: AxisBox): void {
    const held = this.store.get("regionDraft");
    this.store.set("regionDraft", { name: held?.name ?? this.freeName(), box, clears: held?.clears ?? true });
  }

  private freeName(): string {
    const names = new Set(this.store.get("regions").map(({ name }) => name));
    for (let number = 1; ; ++number) if (!names.has(`region-${number}`)) return `region-${number}`;
  }

  private async refresh(): Promise<void> {
    const map = this.store.get("map");
    if (!map || this.store.get("tool") !== "region") return;
    const asked = ++this.asked;
    // What was there stays where there is no answer: the lost link is said elsewhere.
    const regions = await listRegions(map.name).catch(() => null);
    if (regions && asked === this.asked) this.store.set("regions", regions);
  }

  private show(): void {
    const isInHand = this.store.get("tool") === "region";
    const draft = this.store.get("regionDraft");
    this.drawn.show(isInHand && draft ? [draft.box] : []);
    this.there.show(isInHand ? this.store.get("regions").map(({ box }) => box) : []);
    this.renderer.tools.add(this.drawn.lines, this.there.lines);
    this.renderer.frames.invalidate();
  }
}
