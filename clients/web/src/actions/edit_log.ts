// SPDX-License-Identifier: BSD-3-Clause
import { listEdits } from "../api/edits";
import { mostLogged, withNewest } from "../state/history";
import type { ViewStore } from "../state/view";

/** After a change. */
const mostNew = 4;

/** Keeps what the store knows of the server's log up. */
export class EditLog {
  private isAsked = false;
  private isStale = false;

  constructor(private readonly store: ViewStore) {}

  /** A live map changes often: one request at a time, for the newest edits alone where these are all that is new. */
  async refresh(): Promise<void> {
    this.isStale = true;
    if (this.isAsked) return;
    this.isAsked = true;
    while (this.isStale) {
      this.isStale = false;
      await this.ask();
    }
    this.isAsked = false;
  }

  private async ask(): Promise<void> {
    const map = this.store.get("map");
    if (!map) return;
    const held = this.store.get("history");
    // What was known stays where there is no answer: the lost link is said elsewhere.
    const list = (most: number) => listEdits(map.name, most).catch(() => null);
    const newest = await list(held.length > 0 ? mostNew : mostLogged);
    const known = newest && (held.length > 0 ? withNewest(held, newest) : newest);
    const all = known ?? (newest && (await list(mostLogged)));
    if (all && this.store.get("map")?.historyId === map.historyId) this.store.set("history", all);
  }
}
