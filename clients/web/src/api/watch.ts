// SPDX-License-Identifier: BSD-3-Clause
import { watchUrl } from "./maps";
import { readChanges } from "./read";
import type { ObjectChange } from "./types";

export interface WatchListener {
  /** What was stored, in order; nothing is left out. */
  onChanges(revision: number, changes: readonly ObjectChange[]): void;
  onLink(link: "live" | "lost"): void;
  /** What was told so far cannot be gone on from: list everything anew. */
  onRestart(): void;
}

/** Follows a map from a revision on until closed; connects again by itself, and goes on where it was. */
export class Watch {
  private readonly source: EventSource;

  constructor(map: string, revision: number, historyId: string, listener: WatchListener) {
    this.source = new EventSource(watchUrl(map, revision, historyId));
    this.source.addEventListener("open", () => listener.onLink("live"));
    this.source.addEventListener("change", (event) => {
      const { revision: told, changes } = readChanges(JSON.parse((event as MessageEvent<string>).data));
      listener.onChanges(told, changes);
    });
    this.source.addEventListener("error", () => {
      listener.onLink("lost");
      // Closed for good by an answer that is no stream: too far behind, or another history.
      if (this.source.readyState === EventSource.CLOSED) listener.onRestart();
    });
  }

  close(): void {
    this.source.close();
  }
}
