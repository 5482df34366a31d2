// SPDX-License-Identifier: BSD-3-Clause

/** When to draw: once after each invalidate(), and while something moves; at rest never. */
export class Frames {
  /** Drawn so far. */
  drawn = 0;
  private asked = false;
  private readonly movers = new Set<(now_ms: number) => boolean>();

  constructor(private readonly draw: () => void) {}

  get isIdle(): boolean {
    return !this.asked && this.movers.size === 0;
  }

  invalidate(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame((now_ms) => {
      this.asked = false;
      for (const mover of [...this.movers]) {
        if (!mover(now_ms)) this.movers.delete(mover);
      }
      this.draw();
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
