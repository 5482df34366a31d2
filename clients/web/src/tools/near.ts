// SPDX-License-Identifier: BSD-3-Clause
// What is nearest to the selection: asked while that is wanted to be known, and again as the map changes.
import { listNear } from "../api/queries";
import { shownState, type ViewStore } from "../state/view";
import { pivotOf } from "./poses";

const mostAsked = 30;
const mostShown = 6;
const pause_ms = 500;

export class NearTool {
  private isAsking = false;
  private isStale = false;

  constructor(private readonly store: ViewStore) {
    store.follow(["selected", "clicked", "asksNear", "nearClass", "revision"], () => this.update());
  }

  private update(): void {
    if (!this.store.get("asksNear") || this.store.get("selected") === null) return;
    if (this.isAsking) this.isStale = true;
    else void this.ask();
  }

  private async ask(): Promise<void> {
    const map = shownState(this.store);
    const className = this.store.get("nearClass");
    const object = this.store.get("objects").get(this.store.get("selected") ?? "");
    if (!map || !object) return;
    this.isAsking = true;
    this.isStale = false;
    const clicked = this.store.get("clicked");
    const { x, y, z } = clicked?.id === object.id ? clicked.point_m : pivotOf(object);
    const found = await listNear(map, { x, y, z }, className, object.id, mostAsked).catch(() => null);
    // Backgrounds are around everything: only who asks for one wants to know.
    const objects = found?.filter(({ kind }) => className !== "" || kind === "thing").slice(0, mostShown);
    if (objects) this.store.set("near", { id: object.id, className, objects });
    window.setTimeout(() => {
      this.isAsking = false;
      if (this.isStale) this.update();
    }, pause_ms);
  }
}
