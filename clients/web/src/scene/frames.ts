// SPDX-License-Identifier: BSD-3-Clause

/** When to draw: once after each invalidate(), and while something moves; at rest never. */
export class Frames {
  /** Drawn so far. */
  drawn = 0;
  private asked = false;
  private asked_ms = 0;
  private readonly movers = new Set<(now_ms: number) => boolean>();

  /** `waited_ms`: since the frame was asked for. */
  constructor(private readonly draw: (waited_ms: number) => void) {}

  get isIdle(): boolean {
    return !this.asked && this.movers.size === 0;
  }

  invalidate(): void {
    if (this.asked) return;
    this.asked = true;
    this.asked_ms = performance.now();
    requestAnimationFrame((now_ms) => {
      this.asked = false;
      for (const mover of [...this.movers]) {
        if (!mover(now_ms)) this.movers.delete(mover);
      }
      this.draw(performance.now() - this.asked_ms);
      ++this.drawn;
      if (this.movers.size > 0) this.invalidate();
    });
  }

  /** Calls `mover` before each frame until it returns false. */
  animate(mover: (now_ms: number) => boolean): void {
    this.movers.add(mover);
    this.invalidate();
  }

  stop(mover: (now_ms: number) => boolean): void {
    this.movers.delete(mover);
  }
}
