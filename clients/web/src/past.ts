// SPDX-License-Identifier: BSD-3-Clause
// Goes back to what the map was, as far as the server keeps it, and to now again.
import { ApiError } from "./api/ask";
import { listObjects, listRevisions } from "./api/maps";
import type { Session } from "./session";
import type { ViewStore } from "./state/view";

const pause_ms = 500;

export class Past {
  private wanted: number | null = null;
  private isAsking = false;
  private listTimer = 0;
  private isListStale = false;

  constructor(
    private readonly store: ViewStore,
    private readonly session: Session,
  ) {
    store.follow(["map"], () => store.set("kept", []));
    store.follow(["showsTime", "newest", "map"], () => this.listSoon());
  }

  /** That revision, or null: now. While one drags a slider, the last one wins. */
  show(revision: number | null): void {
    this.wanted = revision;
    if (revision === null || revision >= this.store.get("newest")) {
      this.wanted = null;
      this.session.showAt(null, new Map());
    } else if (!this.isAsking) {
      void this.ask(revision);
    }
  }

  /** To the next kept state: back in time, or on. */
  async step(by: 1 | -1): Promise<void> {
    if (this.store.get("kept")[0]?.revision !== this.store.get("newest")) await this.list();
    const kept = this.store.get("kept");
    const at = this.wanted ?? this.store.get("at");
    const shown = at === null ? 0 : kept.findIndex(({ revision }) => revision <= at);
    // One that is no longer kept is older than all that are.
    const place = (shown < 0 ? kept.length : shown) - by;
    this.store.set("showsTime", true);
    const target = kept[Math.min(kept.length - 1, place)];
    if (target) this.show(place <= 0 ? null : target.revision);
  }

  private async ask(revision: number): Promise<void> {
    const map = this.store.get("map");
    if (!map) return;
    this.isAsking = true;
    try {
      const { objects } = await listObjects({ name: map.name, at: revision });
      const isStill = this.wanted !== null && this.store.get("map")?.historyId === map.historyId;
      if (isStill) this.session.showAt(revision, new Map(objects.map((object) => [object.id, object])));
    } catch (error) {
      this.failed(revision, error);
    }
    this.isAsking = false;
    if (this.wanted !== null && this.wanted !== revision) void this.ask(this.wanted);
    else this.wanted = null;
  }

  private failed(revision: number, error: unknown): void {
    if (this.wanted === revision) this.wanted = null;
    const isOver = error instanceof ApiError && (error.status === 410 || error.reason === "BAD_REVISION");
    const why = error instanceof Error ? error.message : String(error);
    const text = isOver
      ? `Revision ${revision} is not kept any longer: here is what is`
      : `The past was not sent: ${why}`;
    this.store.set("toast", { text, tone: "problem" });
    if (isOver) this.listSoon();
  }

  /** What is kept changes with each commit: asked for while it is shown, now and then. */
  private listSoon(): void {
    this.isListStale = this.listTimer !== 0;
    if (!this.store.get("showsTime") || this.isListStale) return;
    void this.list();
    this.listTimer = window.setTimeout(() => {
      this.listTimer = 0;
      if (this.isListStale) this.listSoon();
    }, pause_ms);
  }

  private async list(): Promise<void> {
    const map = this.store.get("map");
    if (!map) return;
    // Where there is no answer, what was kept is all that is known: the lost link is said elsewhere.
    const kept = await listRevisions(map.name).catch(() => null);
    if (kept && this.store.get("map")?.name === map.name) this.store.set("kept", kept);
  }
}
