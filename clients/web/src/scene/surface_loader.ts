// SPDX-License-Identifier: BSD-3-Clause
import { readGlb, type Surface } from "../api/glb";
import { ApiError } from "../api/ask";
import { getSurfaces } from "../api/maps";
import type { MapState } from "../api/types";

const mostAtOnce = 150;
/** A server that has no room for so much is asked for less, and later. */
const retry_ms = 2000;
/** Live mapping changes an object many times a second; it is fetched this often at most. */
const pause_ms = 700;

/** Fetches surfaces that are missing or have changed, many in one request, one request at a time. */
export class SurfaceLoader {
  private wanted = new Set<string>();
  private running: AbortController | null = null;
  private timer = 0;
  private last_ms = -Infinity;
  private atOnce = mostAtOnce;
  fetchedBytes = 0;
  numRequests = 0;

  constructor(
    private readonly onSurfaces: (surfaces: readonly Surface[]) => void,
    private readonly onBytes: (bytes: number) => void,
    private readonly onFailed: (error: unknown) => void,
  ) {}

  private map: MapState = { name: "", at: null };
  private fetching: readonly string[] = [];

  /** Of that state from here on. What was wanted before and has not come. */
  start(map: MapState): ReadonlySet<string> {
    const missing = new Set([...this.wanted, ...(this.running ? this.fetching : [])]);
    this.stop();
    this.atOnce = mostAtOnce;
    this.map = map;
    this.last_ms = -Infinity;
    return missing;
  }

  stop(): void {
    this.running?.abort();
    this.running = null;
    this.wanted.clear();
    clearTimeout(this.timer);
    this.timer = 0;
  }

  get isIdle(): boolean {
    return this.running === null && this.wanted.size === 0;
  }

  /** What was asked for before, and is on its way; the rest waits for it. False: it did not come. */
  async takeFirst(file: Promise<ArrayBuffer>, ids: readonly string[]): Promise<boolean> {
    this.fetching = ids;
    const abort = (this.running = new AbortController());
    ++this.numRequests;
    try {
      const surfaces = readGlb(await file);
      if (!abort.signal.aborted) this.onSurfaces(surfaces);
      return true;
    } catch {
      return abort.signal.aborted;
    } finally {
      if (this.running === abort) {
        this.running = null;
        this.schedule();
      }
    }
  }

  want(ids: Iterable<string>): void {
    for (const id of ids) this.wanted.add(id);
    this.schedule();
  }

  /** It was removed: what waits is not asked for. */
  forget(id: string): void {
    this.wanted.delete(id);
  }

  private schedule(): void {
    if (this.running || this.timer !== 0 || this.wanted.size === 0) return;
    const wait_ms = Math.max(0, this.last_ms + pause_ms - performance.now());
    this.timer = window.setTimeout(() => {
      this.timer = 0;
      void this.fetchNext();
    }, wait_ms);
  }

  /** What is shown until then is what was there before. */
  private tryLater(ids: readonly string[], error: unknown): void {
    const status = error instanceof ApiError ? error.status : 0; // 0: the link broke
    if (status === 404) return; // it was removed meanwhile
    const hasNoRoom = status === 413 || status === 429;
    if (status !== 0 && !(hasNoRoom && ids.length > 1)) return this.onFailed(error);
    if (hasNoRoom) this.atOnce = Math.max(1, Math.floor(ids.length / 2));
    for (const id of ids) this.wanted.add(id);
    this.last_ms = performance.now() + retry_ms;
  }

  private async fetchNext(): Promise<void> {
    const ids = [...this.wanted].slice(0, this.atOnce);
    for (const id of ids) this.wanted.delete(id);
    this.fetching = ids;
    const abort = (this.running = new AbortController());
    this.last_ms = performance.now();
    ++this.numRequests;
    try {
      const file = await getSurfaces(
        this.map,
        ids,
        (bytes) => {
          this.fetchedBytes += bytes;
          this.onBytes(this.fetchedBytes);
        },
        abort.signal,
      );
      if (abort.signal.aborted) return;
      this.atOnce = Math.min(mostAtOnce, 2 * this.atOnce);
      this.onSurfaces(readGlb(file));
    } catch (error) {
      if (abort.signal.aborted) return;
      this.tryLater(ids, error);
    } finally {
      if (this.running === abort) {
        this.running = null;
        // The first fetch of a large map goes on at once.
        if (this.wanted.size >= mostAtOnce && this.last_ms < performance.now()) this.last_ms = -Infinity;
        this.schedule();
      }
    }
  }
}
