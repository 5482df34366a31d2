// SPDX-License-Identifier: BSD-3-Clause
// How fine to draw while something moves, so that it moves smoothly without a GPU, too.

/** A frame that is waited for longer is slow. */
const slow_ms = 90;
const fast_ms = 24;
/** One slow frame is a hiccup. */
const mostSlow = 2;
const leastFast = 12;

export interface Detail {
  readonly mostTriangles: number;
  /** Of the screen's own pixels, along a side. */
  readonly pixelShare: number;
}

export const details: readonly Detail[] = [
  { mostTriangles: Infinity, pixelShare: 1 },
  { mostTriangles: 1_000_000, pixelShare: 1 },
  { mostTriangles: 300_000, pixelShare: 0.75 },
  { mostTriangles: 140_000, pixelShare: 0.7 },
  { mostTriangles: 60_000, pixelShare: 0.6 },
  { mostTriangles: 25_000, pixelShare: 0.5 },
];

const firstWithoutGpu = 4;

/** Coarser after slow frames, finer after a movement that was fast throughout. */
export class Pace {
  private level: number;
  private numSlow = 0;
  private numFast = 0;

  constructor(isWithoutGpu: boolean) {
    this.level = isWithoutGpu ? firstWithoutGpu : 0;
  }

  get detail(): Detail {
    return details[this.level]!;
  }

  /** `waited_ms`: from when a frame was asked for until it was drawn. True: what follows is drawn coarser. */
  drew(waited_ms: number): boolean {
    this.numFast = waited_ms < fast_ms ? this.numFast + 1 : 0;
    this.numSlow = waited_ms > slow_ms ? this.numSlow + 1 : 0;
    if (this.numSlow < mostSlow || this.level + 1 === details.length) return false;
    this.numSlow = 0;
    ++this.level;
    return true;
  }

  rests(): void {
    if (this.numFast >= leastFast && this.level > 0) --this.level;
    this.numFast = this.numSlow = 0;
  }
}

/** Whether WebGL is drawn by the processor. */
export function isWithoutGpu(gl: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
